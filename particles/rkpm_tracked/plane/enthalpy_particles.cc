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

  void EnthalpyParticles::fit(PlaneFront &front, bool solid_beyond) const
  {
    const double h = nodes.spacing, radius = reach * h;
    for(int pass = 0; pass < fitting_passes; ++pass)
    {
      const FrontIndex index(front, solid_beyond, h);
      std::vector<double> missing(position.size(), 0.);
      for(std::size_t i = 0; i < position.size(); ++i)
      {
        const double distance = index.signed_distance(position[i], radius);
        const double side = std::sqrt(area[i]), step = side / across_cell;
        double solid = distance < 0 ? 1 : 0;
        if(std::abs(distance) < side)
        {
          solid = 0;
          for(int s = 0; s < across_cell * across_cell; ++s)
          {
            const PlanePoint offset(s % across_cell + 0.5 - across_cell / 2.,
                                    s / across_cell + 0.5 - across_cell / 2.);
            solid += std::clamp(
                         0.5
                             - index.signed_distance(position[i] + step * offset, radius)
                                   / step,
                         0., 1.)
                     / (across_cell * across_cell);
          }
        }
        // What is not of one phase farther away is no business of this front.
        if(std::abs(distance) < radius)
          missing[i] = area[i] * (share[i] - solid);
      }
      const PlaneBins front_bins(front.position, h);
      std::vector<double> way(front.size(), 0.);
      for(std::size_t c = 0; c < front.curves(); ++c)
        for(std::size_t p = front.offsets[c]; p < front.offsets[c + 1]; ++p)
        {
          if(nodes.wall_distance(front.position[p]) < 0)
            continue;
          double area_missing = 0, length = 0;
          bins.visit(front.position[p], radius,
                     [&](std::uint32_t i, double square) {
                       area_missing += missing[i] * kernel(square / (radius * radius));
                     });
          front_bins.visit(front.position[p], radius,
                           [&](std::uint32_t q, double square)
                           {
                             if(nodes.wall_distance(front.position[q]) < 0
                                || front.normal[q].dot(front.normal[p]) < 0)
                               return;
                             const std::size_t curve
                                 = std::ranges::upper_bound(front.offsets, q)
                                   - front.offsets.begin() - 1;
                             length += (front.position[front.next(curve, q)]
                                        - front.position[front.previous(curve, q)])
                                           .norm()
                                       / 2 * kernel(square / (radius * radius));
                           });
          way[p] = std::clamp(area_missing / length, -farthest_fit * h, farthest_fit * h);
        }
      for(std::size_t p = 0; p < front.size(); ++p)
        front.position[p] -= way[p] * front.normal[p];
      update_geometry(front);
    }
  }

  double EnthalpyParticles::temperature(const PlanePoint &place, bool solid,
                                        const PlaneFront &front,
                                        const PlaneBins &front_bins) const
  {
    const double melting = scene.material.melting_temperature;
    struct Point
    {
      PlanePoint offset;
      double weight, excess;
    };
    std::vector<Point> points;
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
    const auto count = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd matrix(count, 6);
    Eigen::VectorXd values(count);
    for(Eigen::Index row = 0; row < count; ++row)
    {
      const auto &[offset, weight, excess] = points[static_cast<std::size_t>(row)];
      matrix.row(row) << weight, weight * offset.x(), weight * offset.y(),
          weight * offset.x() * offset.x(), weight * offset.x() * offset.y(),
          weight * offset.y() * offset.y();
      values[row] = weight * excess;
    }
    const double excess = matrix.completeOrthogonalDecomposition().solve(values)[0];
    return melting + (solid ? std::min(excess, 0.) : std::max(excess, 0.));
  }
} // namespace meltfront::particles::rkpm_tracked
