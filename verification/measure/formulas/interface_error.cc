#include <cases/velocity_field.h>
#include <verification/measure/formulas/exact_region.h>
#include <verification/measure/formulas/interface_error.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    using cases::Position;

    constexpr int samples_in_plane = 10, samples_in_space = 4;

    /** The cells of a grid of a run's spacing, and the samples in them. */
    struct Cells
    {
      Cells(const cases::Domain &domain, double spacing)
        : dimension(domain.dimension)
        , samples(dimension == 3 ? samples_in_space : samples_in_plane)
        , lower(domain.lower)
      {
        for(int d = 0; d < dimension; ++d)
        {
          const double extent = domain.upper[d] - domain.lower[d];
          count[d] = std::max(1, static_cast<int>(std::lround(extent / spacing)));
          size[d] = extent / count[d];
        }
      }

      std::size_t number() const
      {
        return static_cast<std::size_t>(count[0]) * count[1] * count[2];
      }

      std::size_t index(const std::array<int, 3> &cell) const
      {
        return (static_cast<std::size_t>(cell[2]) * count[1] + cell[1]) * count[0]
               + cell[0];
      }

      /** A sample, counted through the whole domain. */
      Position place(const std::array<int, 3> &cell,
                     const std::array<int, 3> &sample) const
      {
        Position point{};
        for(int d = 0; d < dimension; ++d)
          point[d] = lower[d] + (cell[d] + (sample[d] + 0.5) / samples) * size[d];
        return point;
      }

      double volume_of_sample() const
      {
        double volume = 1;
        for(int d = 0; d < dimension; ++d)
          volume *= size[d] / samples;
        return volume;
      }

      int dimension, samples;
      Position lower;
      std::array<int, 3> count{1, 1, 1};
      Position size{};
    };

    template <typename Visit>
    void for_all(const std::array<int, 3> &count, const Visit &visit)
    {
      std::array<int, 3> i{};
      for(i[2] = 0; i[2] < count[2]; ++i[2])
        for(i[1] = 0; i[1] < count[1]; ++i[1])
          for(i[0] = 0; i[0] < count[0]; ++i[0])
            visit(i);
    }

    /** Cells whose corners lie on either side of the level set's front. */
    std::vector<char> cells_cut(const Cells &cells, const cases::Snapshot &snapshot)
    {
      std::array<int, 3> nodes = cells.count;
      for(int d = 0; d < cells.dimension; ++d)
        ++nodes[d];
      std::vector<char> inside(static_cast<std::size_t>(nodes[0]) * nodes[1] * nodes[2]);
      const auto node = [&](int i, int j, int k)
      { return (static_cast<std::size_t>(k) * nodes[1] + j) * nodes[0] + i; };
      for_all(nodes,
              [&](const std::array<int, 3> &at)
              {
                Position point{};
                for(int d = 0; d < cells.dimension; ++d)
                  point[d] = cells.lower[d] + at[d] * cells.size[d];
                inside[node(at[0], at[1], at[2])] = snapshot.level_set(point) > 0;
              });
      std::vector<char> cut(cells.number());
      const int depth = cells.dimension == 3 ? 1 : 0;
      for_all(cells.count,
              [&](const std::array<int, 3> &at)
              {
                int corners = 0;
                for(int k = 0; k <= depth; ++k)
                  for(int j = 0; j <= 1; ++j)
                    for(int i = 0; i <= 1; ++i)
                      corners += inside[node(at[0] + i, at[1] + j, at[2] + k)];
                cut[cells.index(at)] = corners != 0 && corners != 4 * (1 + depth);
              });
      return cut;
    }

    /** Samples in one region, in the other, in both. */
    struct Counts
    {
      long found = 0, exact = 0, both = 0;
    };

    /**
     * Count over all samples; one stands for its whole cell where that is not fine.
     * @param inside (point, cell, sample): the exact region
     */
    template <typename Inside>
    Counts count(const Cells &cells, const std::vector<char> &fine,
                 const cases::Snapshot &snapshot, const Inside &inside)
    {
      std::array<int, 3> all{cells.samples, cells.samples,
                             cells.dimension == 3 ? cells.samples : 1};
      const long whole = static_cast<long>(all[0]) * all[1] * all[2];
      std::array<int, 3> middle{};
      for(int d = 0; d < cells.dimension; ++d)
        middle[d] = cells.samples / 2;
      Counts counts;
      for_all(cells.count,
              [&](const std::array<int, 3> &cell)
              {
                const auto look = [&](const std::array<int, 3> &sample, long weight)
                {
                  const Position point = cells.place(cell, sample);
                  const bool found = snapshot.level_set(point) > 0;
                  const bool exact = inside(point, cell, sample);
                  counts.found += weight * found;
                  counts.exact += weight * exact;
                  counts.both += weight * (found && exact);
                };
                if(fine[cells.index(cell)])
                  for_all(all, [&](const std::array<int, 3> &s) { look(s, 1); });
                else
                  look(middle, whole);
              });
      return counts;
    }

    double length_inside(const std::vector<FrontPiece> &pieces,
                         const cases::Domain &domain)
    {
      const auto within = [&domain](const Position &p)
      {
        return p[0] >= domain.lower[0] && p[0] <= domain.upper[0]
               && p[1] >= domain.lower[1] && p[1] <= domain.upper[1];
      };
      double length = 0;
      for(const FrontPiece &piece : pieces)
        if(within(piece.begin) && within(piece.end))
          length
              += std::hypot(piece.end[0] - piece.begin[0], piece.end[1] - piece.begin[1]);
      return length;
    }

    /** @param volume of the exact region; @param length of its front */
    void judge_region(const Cells &cells, const Counts &counts, double volume,
                      double length, double spacing, InterfaceErrors &errors)
    {
      const double part = cells.volume_of_sample();
      const double missing = part * static_cast<double>(counts.exact - counts.both);
      const double extra = part * static_cast<double>(counts.found - counts.both);
      errors.volume = part * static_cast<double>(counts.found) / volume - 1;
      errors.missing = missing / volume;
      errors.extra = extra / volume;
      errors.mismatch = (missing + extra) / volume;
      errors.front = (missing + extra) / length / spacing;
    }

    /** Out of the region, by central differences of the distance. */
    Position normal_of(const cases::Shape &shape, const Position &point, int dimension,
                       double step)
    {
      Position normal{};
      double square = 0;
      for(int d = 0; d < dimension; ++d)
      {
        Position ahead = point, behind = point;
        ahead[d] += step;
        behind[d] -= step;
        normal[d] = shape.signed_distance(behind) - shape.signed_distance(ahead);
        square += normal[d] * normal[d];
      }
      for(double &component : normal)
        component /= std::sqrt(square);
      return normal;
    }

    double angle(const Position &a, const Position &b)
    {
      const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      const double sine = std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                     a[0] * b[1] - a[1] * b[0]);
      return std::atan2(sine, cosine) * 180 / std::numbers::pi;
    }

    void judge_geometry(const cases::Snapshot &snapshot, const cases::Shape &shape,
                        const RigidMap &back, double side, InterfaceErrors &errors)
    {
      double angles = 0, bends = 0;
      long normals = 0, curvatures = 0;
      for(std::size_t i = 0; i < snapshot.front[0].size(); ++i)
      {
        Position point{}, normal{};
        for(int d = 0; d < snapshot.dimension; ++d)
        {
          point[d] = snapshot.front[d][i];
          if(i < snapshot.front_normal[d].size())
            normal[d] = snapshot.front_normal[d][i];
        }
        const Position place = back(point);
        const double exact = shape.curvature(place);
        if(std::isnan(exact)) // near a corner
          continue;
        if(i < snapshot.front_normal[0].size())
        {
          const double off = angle(
              normal,
              back.turned_back(normal_of(shape, place, snapshot.dimension, 1e-6 * side)));
          angles += off * off;
          ++normals;
        }
        if(i < snapshot.front_curvature.size() && exact != 0)
        {
          const double off = snapshot.front_curvature[i] / exact - 1;
          bends += off * off;
          ++curvatures;
        }
      }
      if(normals > 0)
        errors.normal = std::sqrt(angles / static_cast<double>(normals));
      if(curvatures > 0)
        errors.curvature = std::sqrt(bends / static_cast<double>(curvatures));
    }

    /** Where the exact region is the initial one at its place. */
    InterfaceErrors compare_placed(const cases::Scene &scene, double spacing,
                                   const cases::Snapshot &snapshot, const RigidMap &back)
    {
      const cases::Shape &shape = *scene.interface->shape;
      const Cells cells(scene.domain, spacing);
      std::vector<char> fine = cells_cut(cells, snapshot);
      const double reach = std::hypot(cells.size[0], cells.size[1], cells.size[2]);
      std::array<int, 3> middle{};
      for(int d = 0; d < cells.dimension; ++d)
        middle[d] = cells.samples / 2;
      for_all(cells.count,
              [&](const std::array<int, 3> &cell)
              {
                const Position point = back(cells.place(cell, middle));
                fine[cells.index(cell)] |= std::abs(shape.signed_distance(point)) < reach;
              });
      const Counts counts = count(cells, fine, snapshot,
                                  [&](const Position &point, const auto &, const auto &)
                                  { return shape.signed_distance(back(point)) > 0; });
      double length = shape.surface(), volume = shape.volume();
      if(!std::isfinite(volume))
        volume = cells.volume_of_sample() * static_cast<double>(counts.exact);
      if(!std::isfinite(length))
        length = cells.dimension == 2 ? length_inside(
                     exact_front_pieces(scene, snapshot.time, spacing), scene.domain)
                                      : InterfaceErrors::unknown;
      InterfaceErrors errors;
      judge_region(cells, counts, volume, length, spacing, errors);
      judge_geometry(snapshot, shape, back, scene.domain.side(), errors);
      return errors;
    }

    /** Cells that a front passes, and those about them. */
    void add_cells_of(const std::vector<FrontPiece> &pieces, const Cells &cells,
                      std::vector<char> &fine)
    {
      for(const FrontPiece &piece : pieces)
      {
        const int i = static_cast<int>(
            std::floor((piece.begin[0] - cells.lower[0]) / cells.size[0]));
        const int j = static_cast<int>(
            std::floor((piece.begin[1] - cells.lower[1]) / cells.size[1]));
        for(int y = std::max(j - 1, 0); y <= std::min(j + 1, cells.count[1] - 1); ++y)
          for(int x = std::max(i - 1, 0); x <= std::min(i + 1, cells.count[0] - 1); ++x)
            fine[cells.index({x, y, 0})] = 1;
      }
    }

    /** Where the exact region is drawn out, in the plane. */
    InterfaceErrors compare_drawn_out(const cases::Scene &scene, double spacing,
                                      const cases::Snapshot &snapshot)
    {
      const Cells cells(scene.domain, spacing);
      const auto pieces = exact_front_pieces(scene, snapshot.time, spacing / 8);
      const double step = cells.size[1] / cells.samples;
      const EnclosedRows region(pieces, cells.lower[1] + 0.5 * step, step,
                                cells.count[1] * cells.samples);
      InterfaceErrors errors;
      if(pieces.empty() || !region.closed())
        return errors;
      std::vector<char> fine = cells_cut(cells, snapshot);
      add_cells_of(pieces, cells, fine);
      const Counts counts
          = count(cells, fine, snapshot,
                  [&](const Position &point, const std::array<int, 3> &cell,
                      const std::array<int, 3> &sample) {
                    return region.inside(cell[1] * cells.samples + sample[1], point[0]);
                  });
      judge_region(cells, counts,
                   cells.volume_of_sample() * static_cast<double>(counts.exact),
                   length_inside(pieces, scene.domain), spacing, errors);
      return errors;
    }
  } // namespace

  InterfaceComparison::InterfaceComparison(const cases::Scene &scene, double spacing)
    : scene(scene)
    , spacing(spacing)
  {
  }

  double InterfaceComparison::volume(const cases::Snapshot &snapshot) const
  {
    const Cells cells(scene.domain, spacing);
    const Counts counts
        = count(cells, cells_cut(cells, snapshot), snapshot,
                [](const Position &, const auto &, const auto &) { return false; });
    return cells.volume_of_sample() * static_cast<double>(counts.found);
  }

  InterfaceErrors InterfaceComparison::errors(const cases::Snapshot &snapshot) const
  {
    if(const auto back = way_back(scene, snapshot.time))
      return compare_placed(scene, spacing, snapshot, *back);
    if(scene.domain.dimension == 2)
      return compare_drawn_out(scene, spacing, snapshot);
    InterfaceErrors errors;
    if(const double exact = scene.interface->shape->volume(); std::isfinite(exact))
      errors.volume = volume(snapshot) / exact - 1;
    return errors;
  }
} // namespace meltfront::verification
