#include <cases/numbers.h>
#include <cases/wall_law.h>
#include <verification/measure/formulas/site_coordinates.h>
#include <verification/measure/measure.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    /** Spacings from a wall: the site nearest to it stands for what is at the wall. */
    constexpr double reach_of_wall = 0.75;
    /** Of a spacing: sites no farther from a wall lie on it and see what begins there. */
    constexpr double on_wall = 1e-6;

    /** Defects of budgets that are none. */
    constexpr double round_off = 1e-9;

    /** Where a wall of a slab, a box or a round domain is nearest to a point, and how far
     * (m). */
    struct NearestOfWall
    {
      cases::Position place{};
      double distance = 0;
    };

    NearestOfWall nearest_of_wall(const cases::Domain &domain, cases::Side side,
                                  const cases::Position &point)
    {
      NearestOfWall nearest{point};
      if(domain.round())
      {
        const double own = std::hypot(point[0], point[1], point[2]);
        const double radius
            = side == cases::Side::inner ? domain.inner_radius : domain.radius;
        for(double &coordinate : nearest.place)
          coordinate *= own > 0 ? radius / own : 0;
        nearest.distance = std::abs(own - radius);
        return nearest;
      }
      const auto number = static_cast<std::size_t>(side);
      const std::size_t direction = number / 2;
      const double plane
          = number % 2 == 0 ? domain.lower[direction] : domain.upper[direction];
      nearest.place[direction] = plane;
      nearest.distance = std::abs(point[direction] - plane);
      return nearest;
    }

    /** How much of the other phase may be at walls where no site shows it: half of what a
     * site stands for that is nearest to a wall on the other side of the melting
     * temperature; where the wall prescribes the heat no more than the site's own
     * sensible heat can have melted or frozen. And what is left of bodies that the method
     * itself took out, and what the heat melts that its budget lacks. */
    class UnseenLayers : public Measure
    {
    public:
      using Measure::Measure;

      static bool asked_for(const MeasuredRun &run)
      {
        const cases::Scene &scene = run.scene;
        return scene.changes_phase() && !scene.alloy && !scene.material.melting_range;
      }

      void observe(const Sighting &sighting) override
      {
        if(!sighting.at_end)
          return;
        Layer all;
        // A method that tracks fronts knows of layers that its sites do not show.
        if(sighting.snapshot.front[0].empty() && !run.scene.domain.irregular())
          for(const cases::Side side : run.scene.sides())
            add_wall(sighting.snapshot, side, all);
        all.volume += sighting.snapshot.vanished_volume + missing(sighting.snapshot.heat);
        values["solid_volume_unseen"] = all.volume;
        values["heat_unseen"] = all.heat;
        values["front_unseen"] = moved_by(all.volume, sighting.front.latent_heat);
      }

    private:
      struct Layer
      {
        double volume = 0, heat = 0; ///< in the measure of the scene
      };

      /** What the heat that a budget lacks, or has too much, would melt. */
      double missing(const cases::HeatBudget &heat) const
      {
        const cases::Material &material = run.scene.material;
        const double volume = std::abs(heat.imbalance())
                              / (material.solid.density * material.latent_heat);
        return heat.conservative && heat.defect() > round_off ? volume : 0;
      }

      /** By how much a volume moves the front out of where it is (m). */
      double moved_by(double volume, double front) const
      {
        using std::numbers::pi;
        const double from = std::isfinite(front) ? front : 0;
        switch(run.scene.symmetry)
        {
        case cases::Symmetry::planar:
          return volume;
        case cases::Symmetry::cylindrical:
          return std::sqrt(from * from + volume / pi) - from;
        case cases::Symmetry::spherical:
          return std::cbrt(from * from * from + 3 * volume / (4 * pi)) - from;
        default:
          return cases::nan;
        }
      }

      void add_wall(const cases::Snapshot &snapshot, cases::Side side, Layer &all) const
      {
        const cases::Boundary &wall = run.scene.boundary(side);
        if(wall.kind != cases::BoundaryKind::fixed_temperature
           && !cases::prescribes_heat(wall.kind))
          return;
        Layer of_wall;
        for(std::size_t i = 0; i < snapshot.weights.size(); ++i)
        {
          const NearestOfWall nearest
              = nearest_of_wall(run.scene.domain, side, site_position(snapshot, i));
          if(!(snapshot.weights[i] > 0) || nearest.distance > reach_of_wall * run.spacing)
            continue;
          if(nearest.distance <= on_wall * run.spacing)
            return;
          add_site(snapshot, i, wall, nearest, of_wall);
        }
        all.volume += of_wall.volume;
        all.heat += of_wall.heat;
      }

      void add_site(const cases::Snapshot &snapshot, std::size_t site,
                    const cases::Boundary &wall, const NearestOfWall &nearest,
                    Layer &of_wall) const
      {
        const cases::Material &material = run.scene.material;
        const double melting = material.melting_temperature,
                     temperature = snapshot.temperature[site],
                     fraction = snapshot.solid_fraction[site];
        if(fraction > 0 && fraction < 1)
          return;
        const bool solid = fraction == 1;
        const cases::PhaseProperties &own = solid ? material.solid : material.liquid,
                                     &other = solid ? material.liquid : material.solid;
        // A phase beyond its melting temperature is kept from changing by something else.
        if(solid ? temperature > melting : temperature < melting)
          return;
        const double given = wall.value(nearest.place, snapshot.time);
        const bool held = wall.kind == cases::BoundaryKind::fixed_temperature;
        const double resistance = nearest.distance / own.conductivity_at(temperature);
        const double at_wall
            = held ? given
                   : temperature
                         + resistance
                               * cases::heat_through_layer(wall, given, temperature,
                                                           resistance)
                                     .flux;
        if(solid ? at_wall <= melting : at_wall >= melting)
          return;
        double volume = snapshot.weights[site] / 2;
        if(!held)
          volume = std::min(volume,
                            snapshot.weights[site] * own.heat_capacity_at(temperature)
                                * std::abs(temperature - melting) / material.latent_heat);
        of_wall.volume += volume;
        if(held)
          of_wall.heat
              += volume * other.density
                 * (material.latent_heat
                    + other.heat_capacity_at(at_wall) * std::abs(at_wall - melting) / 2);
      }
    };
  } // namespace

  MeasureKind unseen_layers()
  {
    return {{hidden_quantity("solid_volume_unseen"), hidden_quantity("heat_unseen"),
             hidden_quantity("front_unseen")},
            MeasuredScenes::with_heat,
            start<UnseenLayers>};
  }
} // namespace meltfront::verification
