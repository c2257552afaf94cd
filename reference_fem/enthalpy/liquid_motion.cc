#include <cases/error.h>
#include <cases/initial_level.h>
#include <cases/stopwatch.h>
#include <reference_fem/enthalpy/liquid_motion.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meltfront::reference_fem
{
  namespace
  {
    using cases::Position;

    /** Nodes of liquid between the front and the first that moves, and beyond that. */
    constexpr std::size_t at_rest_beyond_front = 2, fewest_that_move = 2;

    /** Where cells of one dimension end: half way between nodes, and at the last one. */
    std::vector<double> ends_of_cells(const std::vector<Position> &positions)
    {
      std::vector<double> ends;
      for(std::size_t i = 0; i + 1 < positions.size(); ++i)
        ends.push_back((positions[i][0] + positions[i + 1][0]) / 2);
      ends.push_back(positions.back()[0]);
      return ends;
    }

    double lesser_slope(double left, double right)
    {
      return left * right > 0
                 ? std::copysign(std::min(std::abs(left), std::abs(right)), left)
                 : 0;
    }

    /**
     * The heat up to a coordinate, counted from where a cell ends: profiles are linear
     * within cells, of the lesser slope of those to the neighbours, constant in the last
     * cell and beyond.
     */
    class Profile
    {
    public:
      Profile(const std::vector<double> &ends, const std::vector<double> &enthalpy,
              std::size_t first)
        : ends(ends)
        , enthalpy(enthalpy)
        , first(first)
        , heat(enthalpy.size())
      {
        for(std::size_t i = first; i < heat.size(); ++i)
          heat[i] = heat[i - 1] + enthalpy[i] * (ends[i] - ends[i - 1]);
      }

      double operator()(double x) const
      {
        std::size_t i = first;
        while(i + 1 < ends.size() && ends[i] < x)
          ++i;
        const double from = ends[i - 1], part = x - from;
        return heat[i - 1]
               + part * (enthalpy[i] + slope(i) * (part - (ends[i] - from)) / 2);
      }

    private:
      double centre(std::size_t i) const
      {
        return (ends[i - 1] + ends[i]) / 2;
      }

      double slope(std::size_t i) const
      {
        if(i + 1 == ends.size())
          return 0;
        return lesser_slope((enthalpy[i] - enthalpy[i - 1]) / (centre(i) - centre(i - 1)),
                            (enthalpy[i + 1] - enthalpy[i])
                                / (centre(i + 1) - centre(i)));
      }

      const std::vector<double> &ends;
      const std::vector<double> &enthalpy;
      std::size_t first;
      std::vector<double> heat;
    };

    /** Cells from `first` on end elsewhere now; returns the heat that came in at the end.
     */
    double remap(const std::vector<double> &old_ends, const std::vector<double> &new_ends,
                 std::size_t first, std::vector<double> &enthalpy)
    {
      const std::vector<double> old = enthalpy;
      const Profile heat(old_ends, old, first);
      double begin = 0;
      for(std::size_t i = first; i < enthalpy.size(); ++i)
      {
        const double end = heat(new_ends[i]);
        enthalpy[i] = (end - begin) / (new_ends[i] - new_ends[i - 1]);
        begin = end;
      }
      return begin - heat(old_ends.back());
    }

    void measure_cells(Discretisation &mesh)
    {
      const std::vector<Position> &x = mesh.positions;
      const std::vector<double> ends = ends_of_cells(x);
      ConductionMatrix &matrix = mesh.conduction;
      for(std::size_t i = 0; i < x.size(); ++i)
      {
        mesh.volume[i] = ends[i] - (i > 0 ? ends[i - 1] : x[0][0]);
        mesh.site_positions[0][i] = x[i][0];
        matrix.diagonal[i] = 0;
        for(std::size_t k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
        {
          matrix.conductance[k] = 1 / std::abs(x[matrix.column[k]][0] - x[i][0]);
          matrix.diagonal[i] += matrix.conductance[k];
        }
      }
      mesh.site_weights = mesh.volume;
    }
  } // namespace

  LiquidMotion::LiquidMotion(const cases::Scene &in_space)
    : lowest(in_space.domain.lower[0])
    , length(in_space.domain.side())
    , density_ratio(in_space.material.liquid.density / in_space.material.solid.density)
    , scene(in_space)
  {
    const double solid = thickness_of_solid(in_space);
    scene.domain.lower[0] = 0;
    scene.domain.upper[0] = density_ratio * length + (1 - density_ratio) * solid;
    cases::PhaseProperties &liquid = scene.material.liquid;
    liquid.conductivity *= density_ratio;
    liquid.density = scene.material.solid.density;
    const auto moved = [&](cases::Field field)
    {
      field.value = [value = field.value, solid, low = lowest,
                     ratio = density_ratio](const Position &p, double time)
      {
        const double x = std::min(p[0], solid) + std::max(p[0] - solid, 0.) / ratio;
        return value({low + x, 0, 0}, time);
      };
      return field;
    };
    cases::InitialState &initial = scene.initial;
    if(solid > 0 && solid < length)
      initial.front = moved(initial.exact ? cases::exact_level(initial.exact)
                                          : cases::initial_level(in_space));
    initial.temperature = moved(initial.temperature);
    initial.exact.reset();
    for(const auto &[side, x] : {std::pair(cases::Side::x_min, lowest),
                                 std::pair(cases::Side::x_max, lowest + length)})
    {
      cases::Field &field = scene.boundaries[static_cast<std::size_t>(side)]->value;
      if(field.value)
        field.value = [value = field.value, x](const Position &, double time) {
          return value({x, 0, 0}, time);
        };
    }
  }

  double LiquidMotion::thickness_of_solid(const cases::Scene &in_space) const
  {
    const double start = in_space.start_time;
    const auto &exact = in_space.initial.exact;
    const cases::Field level = exact && exact->has_front() && exact->front(start) > 0
                                   ? cases::exact_level(exact)
                                   : cases::initial_level(in_space);
    const auto is_solid = [&](double share) {
      return level({lowest + share * length, 0, 0}, start) < 0;
    };
    constexpr int samples = 4096;
    int solid = 0;
    for(int i = 0; i < samples; ++i)
      if(is_solid((i + 0.5) / samples) && solid++ != i)
        throw cases::Refusal("fem-enthalpy moves liquid only away from solid at x_min: "
                             "at the start there is solid elsewhere");
    if(solid == 0 || solid == samples)
      return solid == 0 ? 0 : length;
    double lower = (solid - 0.5) / samples, upper = (solid + 0.5) / samples;
    for(int k = 0; k < 60; ++k)
    {
      const double middle = (lower + upper) / 2;
      (is_solid(middle) ? lower : upper) = middle;
    }
    return length * lower;
  }

  double LiquidMotion::solid_fraction(double enthalpy) const
  {
    return scene.material.solid_fraction(enthalpy / scene.material.solid.density);
  }

  std::size_t LiquidMotion::first_to_move(const Discretisation &mesh,
                                          const std::vector<double> &enthalpy,
                                          double time) const
  {
    std::size_t beyond = 0;
    bool liquid = false;
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
    {
      const double fraction = solid_fraction(enthalpy[i]);
      if(liquid && fraction > 0)
        throw cases::Refusal(
            fmt::format("fem-enthalpy moves liquid only away from solid at x_min: at t = "
                        "{:.6g} s there is solid beyond liquid",
                        time));
      liquid = fraction == 0;
      if(fraction > 0)
        beyond = i + 1;
    }
    const std::size_t first = std::max<std::size_t>(beyond, 1) + at_rest_beyond_front;
    if(first + fewest_that_move > mesh.positions.size())
      throw cases::Refusal(fmt::format(
          "fem-enthalpy moves liquid as long as some cells of it are left: at t = {:.6g} "
          "s there are too few of them beyond the solid",
          time));
    return first;
  }

  LiquidMotion::Entered LiquidMotion::move(Discretisation &mesh,
                                           std::vector<double> &enthalpy,
                                           std::vector<double> &enthalpy_before,
                                           double time)
  {
    const cases::ScopedTimer timer(seconds);
    ++calls;
    double solid = 0;
    for(std::size_t i = 0; i < enthalpy.size(); ++i)
      solid += mesh.volume[i] * solid_fraction(enthalpy[i]);
    const std::size_t first = first_to_move(mesh, enthalpy, time);
    const std::vector<double> old_ends = ends_of_cells(mesh.positions);
    const double anchor = mesh.positions[first - 1][0];
    const double wanted = density_ratio * length + (1 - density_ratio) * solid;
    const double stretch = (wanted - anchor) / (old_ends.back() - anchor);
    for(std::size_t i = first; i < mesh.positions.size(); ++i)
      mesh.positions[i][0] = anchor + stretch * (mesh.positions[i][0] - anchor);
    const std::vector<double> new_ends = ends_of_cells(mesh.positions);
    measure_cells(mesh);
    const std::size_t cell = first - 1; // whose upper end is the first to move
    return {remap(old_ends, new_ends, cell, enthalpy),
            remap(old_ends, new_ends, cell, enthalpy_before), cell};
  }

  void LiquidMotion::return_to_space(const Discretisation &mesh,
                                     cases::Snapshot &snapshot)
  {
    const std::size_t n = mesh.positions.size();
    place.resize(n);
    width.resize(n);
    share.resize(n);
    double thickness = 0;
    for(std::size_t i = 0; i < n; ++i)
    {
      const double solid = mesh.volume[i] * snapshot.solid_fraction[i];
      width[i] = solid + (mesh.volume[i] - solid) / density_ratio;
      share[i] = solid / width[i];
      thickness += solid;
    }
    for(std::size_t i = 0; i < n; ++i)
    {
      const double x = mesh.positions[i][0];
      place[i]
          = lowest + std::min(x, thickness) + std::max(x - thickness, 0.) / density_ratio;
    }
    snapshot.positions[0] = place;
    snapshot.weights = width;
    snapshot.solid_fraction = share;
  }

  cases::EffectCost LiquidMotion::cost() const
  {
    return {cases::Effect::liquid_motion, calls,
            static_cast<long>(sizeof(LiquidMotion) + 3 * place.size() * sizeof(double)),
            seconds};
  }
} // namespace meltfront::reference_fem
