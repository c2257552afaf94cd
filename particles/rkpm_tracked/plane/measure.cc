#include <particles/rkpm_tracked/plane/measure.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meltfront::particles::rkpm_tracked
{
  namespace
  {
    /** Spacings from a sink within which its singular part is summed over points. */
    constexpr double sink_reach = 3;

    /** Spacings from the front from which on a node's temperature begins to tell the heat
     * of its area, where the expansions about the front cease to do so at cut_reach; and
     * those between which its Laplacian begins to count, when all its neighbours are of
     * its phase. By degrees, as heat that jumps would be made up for by the balance. */
    constexpr double uncut = 0.75, surrounded_from = 1.5, surrounded_at = 2.1;

    constexpr int most_shifts = 20;

    /** Spacings within which a node's neighbours tell the slope of the temperature. */
    constexpr double slope_reach = 1.6;
    /** Determinant over the square of the trace: of neighbours nearly on a line less. */
    constexpr double least_spread = 0.05;

    /** A point of a cut area. */
    struct Sample
    {
      std::uint32_t node;
      double distance; ///< negative in solid
      double weight;
      PlanePoint place;
    };

    /** From 0 to 1 between two distances. */
    double ramp(double distance, double from, double to)
    {
      const double share = std::clamp((distance - from) / (to - from), 0., 1.);
      return share * share * (3 - 2 * share);
    }

    /** Temperature of the front as last solved for, near a place. */
    double front_temperature(const PlaneState &state, const PlanePoint &place,
                             const cases::Material &material)
    {
      const long nearest = state.expansion_bins.nearest(place);
      return nearest < 0 ? material.melting_temperature
                         : state.expansion[0].value[nearest];
    }

    /**
     * By how much the mean over a node's area differs from the node's own temperature:
     * the slope that fits the neighbours of its phase best, over the distance to the
     * centroid, as areas beside walls lie to one side of their nodes; and of a node that
     * neighbours surround the Laplacian over the area's second moment, that of a square.
     */
    double mean_beyond_node(const PlaneNodes &nodes, const PlaneState &state,
                            const std::vector<double> &temperature, std::size_t i,
                            double distance)
    {
      const PlanePoint &place = nodes.position[i];
      Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
      PlanePoint change(0, 0), directions(0, 0);
      double bend = 0; // sum of (1/2) r.H.r/r^2 and of slope.r/r^2
      int count = 0;
      bool surrounded = nodes.wall_of_node[i] < 0;
      nodes.bins.visit(place, slope_reach * nodes.spacing,
                       [&](std::uint32_t other, double squared)
                       {
                         if(other == i)
                           return;
                         if(state.phase[other] != state.phase[i])
                         {
                           surrounded = false;
                           return;
                         }
                         const PlanePoint way = nodes.position[other] - place;
                         const double rise = temperature[other] - temperature[i];
                         spread += way * way.transpose() / squared;
                         change += way * rise / squared;
                         directions += way / squared;
                         bend += rise / squared;
                         ++count;
                       });
      const double trace = spread.trace();
      if(!(spread.determinant() > least_spread * trace * trace))
        return 0;
      const PlanePoint slope = spread.inverse() * change;
      const double laplacian
          = surrounded ? 4 * (bend - slope.dot(directions)) / count : 0;
      return slope.dot(nodes.centroid[i] - place)
             + nodes.weight[i] / 24 * laplacian
                   * ramp(distance / nodes.spacing, surrounded_from, surrounded_at);
    }

    /** Share of a sample's area that is solid. */
    double share(double distance, double width)
    {
      return std::clamp(0.5 - distance / width, 0., 1.);
    }
  } // namespace

  double enclosed_solid_area(const cases::Scene &scene, const PlaneNodes &nodes,
                             const PlaneState &state, bool solid_beyond)
  {
    const cases::Domain &domain = scene.domain;
    double enclosed = 0;
    for(std::size_t c = 0; c < state.front.curves(); ++c)
    {
      for(std::size_t p = state.front.offsets[c]; p < state.front.offsets[c + 1]; ++p)
        if(nodes.wall_distance(state.front.position[p]) < 0)
          return std::numeric_limits<double>::quiet_NaN();
      enclosed += signed_area(state.front, c);
    }
    double area = solid_beyond ? nodes.area + enclosed : enclosed;
    if(domain.shape == cases::DomainShape::shell)
    {
      const FrontIndex index(state.front, solid_beyond, nodes.spacing);
      const double hole = std::numbers::pi * domain.inner_radius * domain.inner_radius;
      const bool solid_hole = index.solid(PlanePoint(0, 0));
      if(solid_hole && !solid_beyond)
        area -= hole;
      if(!solid_hole && solid_beyond)
        area += hole;
    }
    return area;
  }

  PlaneMeasure measure(const cases::Scene &scene, const PlaneNodes &nodes,
                       const PlaneHeat &heat, const PlaneState &state)
  {
    const cases::Material &material = scene.material;
    const double h = nodes.spacing, width = nodes.sample_spacing;
    PlaneMeasure result;
    result.temperature.resize(nodes.size());
    result.solid_fraction.resize(nodes.size());
    const bool solid_beyond = heat.settings.solid_beyond;
    const FrontIndex index(state.front, solid_beyond, h);
    std::vector<Sample> samples;
    std::vector<double> distances(nodes.size()), by_node(nodes.size());
    double whole = 0;
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      result.temperature[i] = state.phase[i] == NodePhase::front
                                  ? front_temperature(state, nodes.position[i], material)
                                  : heat.temperature(state, i);
      const double distance = index.signed_distance(nodes.position[i], surrounded_at * h);
      distances[i] = std::abs(distance);
      by_node[i] = state.phase[i] == NodePhase::front
                       ? 0
                       : ramp(distances[i] / h, uncut, cut_reach);
      if(distances[i] >= cut_reach * h)
      {
        result.solid_fraction[i] = distance < 0 ? 1 : 0;
        whole += distance < 0 ? nodes.weight[i] : 0;
        continue;
      }
      const std::size_t begin = nodes.sample_offsets[i],
                        end = nodes.sample_offsets[i + 1];
      for(std::size_t s = begin; s < end; ++s)
        samples.push_back({static_cast<std::uint32_t>(i),
                           index.signed_distance(nodes.samples[s], cut_reach * h),
                           nodes.weight[i] / static_cast<double>(end - begin),
                           nodes.samples[s]});
    }
    // One shift makes the parts' sum what the curves enclose.
    const double wanted = enclosed_solid_area(scene, nodes, state, solid_beyond);
    double shift = 0;
    for(int pass = 0; pass < most_shifts && std::isfinite(wanted); ++pass)
    {
      double sum = whole, slope = 0;
      for(const Sample &sample : samples)
      {
        const double part = share(sample.distance - shift, width);
        sum += sample.weight * part;
        slope += part > 0 && part < 1 ? sample.weight / width : 0;
      }
      if(slope == 0 || std::abs(wanted - sum) <= 1e-15 * nodes.area)
        break;
      shift += std::clamp((wanted - sum) / slope, -width / 2, width / 2);
    }
    result.solid_area = whole;
    const auto add_heat = [&](bool solid, double area, double excess)
    {
      const auto &phase = solid ? material.solid : material.liquid;
      result.sensible += phase.volumetric_heat_capacity() * area * excess;
    };
    for(const Sample &sample : samples)
    {
      const double part = share(sample.distance - shift, width);
      result.solid_fraction[sample.node] += sample.weight * part;
      result.solid_area += sample.weight * part;
      const long nearest = state.expansion_bins.nearest(sample.place);
      if(nearest < 0)
        continue;
      const PlanePoint offset = sample.place - state.expanded_about[nearest];
      for(const bool solid : {false, true})
      {
        const double area
            = sample.weight * (solid ? part : 1 - part) * (1 - by_node[sample.node]);
        if(area > 0)
          add_heat(solid, area,
                   state.expansion[solid].at(nearest, offset)
                       + (solid ? heat.sinks.value(sample.place, state.time) : 0)
                       - material.melting_temperature);
      }
    }
    for(std::size_t i = 0; i < nodes.size(); ++i)
    {
      if(distances[i] < cut_reach * h)
        result.solid_fraction[i] = nodes.weight[i] > 0
                                       ? result.solid_fraction[i] / nodes.weight[i]
                                       : (state.phase[i] == NodePhase::solid ? 1 : 0);
      if(by_node[i] == 0)
        continue;
      const bool solid = state.phase[i] == NodePhase::solid;
      double excess
          = result.temperature[i] - material.melting_temperature
            + mean_beyond_node(nodes, state, result.temperature, i, distances[i]);
      double near = std::numeric_limits<double>::infinity();
      for(const PlanePoint &place : heat.sinks.places)
        near = std::min(near, (place - nodes.position[i]).norm());
      if(solid && near < sink_reach * h)
      {
        double mean = 0;
        const std::span<const PlanePoint> samples = nodes.samples_of(i);
        for(const PlanePoint &sample : samples)
          mean += heat.sinks.value(sample, state.time)
                  / static_cast<double>(samples.size());
        excess = state.unknown[i] + mean - material.melting_temperature;
      }
      add_heat(solid, by_node[i] * nodes.weight[i], excess);
    }
    result.latent = material.solid.density * material.latent_heat
                    * (nodes.area - result.solid_area);
    return result;
  }
} // namespace meltfront::particles::rkpm_tracked
