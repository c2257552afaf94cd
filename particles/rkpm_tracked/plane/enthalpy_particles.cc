#include <particles/rkpm_tracked/plane/enthalpy_particles.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Of the kernel, in spacings of the nodes. */
    constexpr double reach = 2;

    /** Passes that fit a front to the particles' solid, and the farthest way in one. */
    constexpr int fitting_passes = 6;
    constexpr double farthest_fit = 0.5; ///< spacings

    /** Samples across a particle's cell. */
    constexpr int across_cell = 4;

    /** A particle is of one phase that has no more of the other than this. */
    constexpr double traces = 1e-9;

    /** Of the fit of temperatures: its first radius in spacings, the factor by which that
     * grows until there are so many points, and how often at most. */
    constexpr double fit_reach = 1.6, wider = 1.25;
    constexpr std::size_t points_of_fit = 12;
    constexpr int most_widenings = 8;

    /** The biweight, of the square of the distance over the radius. */
    double kernel(double square)
    {
      return square < 1 ? (1 - square) * (1 - square) : 0;
    }

    /** Share of a square cell that a front cuts, from samples of it. */
    double solid_share(const FrontIndex &index, const PlanePoint &middle, double area)
    {
      const double side = std::sqrt(area), step = side / across_cell;
      const double distance = index.signed_distance(middle, side);
      if(std::abs(distance) >= side)
        return distance < 0 ? 1 : 0;
      double sum = 0;
      for(int j = 0; j < across_cell; ++j)
        for(int i = 0; i < across_cell; ++i)
        {
          const PlanePoint place = middle + step * PlanePoint(i + 0.5, j + 0.5)
                                   - side / 2 * PlanePoint(1, 1);
          sum += std::clamp(0.5 - index.signed_distance(place, side) / step, 0., 1.);
        }
      return sum / (across_cell * across_cell);
    }

    /** What a parabola is fitted to: the place over the kernel's radius, the square root
     * of the weight, the value. */
    struct FitPoint
    {
      PlanePoint offset;
      double weight, value;
    };

    /** At no offset, of the parabola that fits best; the least one if many do. */
    double value_of_parabola(const std::vector<FitPoint> &points)
    {
      const auto count = static_cast<Eigen::Index>(points.size());
      Eigen::MatrixXd matrix(count, 6);
      Eigen::VectorXd values(count);
      for(Eigen::Index row = 0; row < count; ++row)
      {
        const auto &[at, weight, value] = points[static_cast<std::size_t>(row)];
        matrix.row(row) << weight, weight * at.x(), weight * at.y(),
            weight * at.x() * at.x(), weight * at.x() * at.y(), weight * at.y() * at.y();
        values[row] = weight * value;
      }
      return matrix.completeOrthogonalDecomposition().solve(values)[0];
    }
  } // namespace

  EnthalpyParticles::EnthalpyParticles(const cases::Scene &scene, const PlaneNodes &nodes,
                                       const cases::Snapshot &snapshot)
    : scene(scene)
    , nodes(nodes)
    , area(snapshot.weights.begin(), snapshot.weights.end())
    , share(snapshot.solid_fraction.begin(), snapshot.solid_fraction.end())
    , value(snapshot.temperature.begin(), snapshot.temperature.end())
  {
    for(std::size_t i = 0; i < area.size(); ++i)
    {
      position.emplace_back(snapshot.positions[0][i], snapshot.positions[1][i]);
      solid_area += area[i] * share[i];
    }
    bins = PlaneBins(position, reach * nodes.spacing);
  }

  /** The place within the domain that is nearest to one. */
  PlanePoint EnthalpyParticles::within(const PlanePoint &place) const
  {
    const cases::Domain &domain = scene.domain;
    if(!domain.round())
      return place.cwiseMax(nodes.lower).cwiseMin(nodes.upper);
    const double radius = place.norm();
    return radius > 0 ? PlanePoint(std::clamp(radius, domain.inner_radius, domain.radius)
                                   / radius * place)
                      : PlanePoint(domain.inner_radius, 0);
  }

  double EnthalpyParticles::level(const PlanePoint &place) const
  {
    const double radius = reach * nodes.spacing;
    double solid = 0, whole = 0;
    bins.visit(within(place), radius,
               [&](std::uint32_t i, double square)
               {
                 const double weight = area[i] * kernel(square / (radius * radius));
                 solid += weight * share[i];
                 whole += weight;
               });
    return 0.5 - solid / whole;
  }

  /** Solid of each particle that a front does not go round (m^2); what is not of one
   * phase farther from it is no business of this front. */
  std::vector<double> EnthalpyParticles::solid_missing(const FrontIndex &index) const
  {
    const double radius = reach * nodes.spacing;
    std::vector<double> result(position.size(), 0.);
    for(std::size_t i = 0; i < position.size(); ++i)
    {
      const double distance = index.signed_distance(position[i], radius);
      if(std::abs(distance) < radius)
        result[i] = area[i] * (share[i] - solid_share(index, position[i], area[i]));
    }
    return result;
  }

  void EnthalpyParticles::fit(PlaneFront &front, bool solid_beyond) const
  {
    const double h = nodes.spacing, square_of_radius = std::pow(reach * h, 2);
    for(int pass = 0; pass < fitting_passes; ++pass)
    {
      const std::vector<double> missing
          = solid_missing(FrontIndex(front, solid_beyond, h));
      std::vector<double> lengths(front.size(), 0.), ways(front.size(), 0.);
      for(std::size_t c = 0; c < front.curves(); ++c)
        for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
          if(nodes.wall_distance(front.position[p]) >= 0)
            lengths[p] = (front.position[front.next(c, p)]
                          - front.position[front.previous(c, p)])
                             .norm()
                         / 2;
      const PlaneBins front_bins(front.position, h);
      for(std::size_t p = 0; p < front.size(); ++p)
      {
        if(lengths[p] == 0)
          continue;
        double solid = 0, length = 0;
        bins.visit(front.position[p], reach * h,
                   [&](std::uint32_t i, double square)
                   { solid += missing[i] * kernel(square / square_of_radius); });
        front_bins.visit(front.position[p], reach * h,
                         [&](std::uint32_t q, double square)
                         {
                           if(front.normal[q].dot(front.normal[p]) > 0)
                             length += lengths[q] * kernel(square / square_of_radius);
                         });
        ways[p] = std::clamp(solid / length, -farthest_fit * h, farthest_fit * h);
      }
      for(std::size_t p = 0; p < front.size(); ++p)
        front.position[p] -= ways[p] * front.normal[p];
      update_geometry(front);
    }
  }

  double EnthalpyParticles::temperature(const PlanePoint &place, bool solid,
                                        const PlaneFront &front,
                                        const PlaneBins &front_bins) const
  {
    const double melting = scene.material.melting_temperature;
    std::vector<FitPoint> points;
    double radius = fit_reach * nodes.spacing;
    for(int i = 0; i <= most_widenings; ++i, radius *= wider)
    {
      points.clear();
      const auto take = [&](const PlanePoint &at, double square, double excess)
      {
        const double weight = kernel(square / (radius * radius));
        if(weight > 0)
          points.push_back({(at - place) / radius, std::sqrt(weight), excess});
      };
      bins.visit(place, radius,
                 [&](std::uint32_t j, double square)
                 {
                   if((solid ? 1 - share[j] : share[j]) <= traces)
                     take(position[j], square, value[j] - melting);
                 });
      front_bins.visit(place, radius,
                       [&](std::uint32_t p, double square)
                       {
                         if(front.active[p])
                           take(front.position[p], square, 0);
                       });
      if(points.size() >= points_of_fit)
        break;
    }
    if(points.empty())
      return melting;
    const double excess = value_of_parabola(points);
    return melting + (solid ? std::min(excess, 0.) : std::max(excess, 0.));
  }
} // namespace meltfront::particles::rkpm_tracked
