#ifndef meltfront_particles_rkpm_tracked_line_problem_h
#define meltfront_particles_rkpm_tracked_line_problem_h

#include <cases/material.h>
#include <cases/scene.h>
#include <cases/wall_law.h>
#include <particles/rkpm_tracked/tracking_options.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  /** What holds at an end of the line. */
  struct LineWall
  {
    cases::BoundaryKind kind = cases::BoundaryKind::insulated;
    /** Temperature, heat flux into the domain (W/m^2) or ambient temperature; where it
     * jumps, what it comes from. */
    std::function<double(double time)> value{};
    std::function<double(double time)> value_after{}; ///< what it jumps to
    /** The mean over a time of a flux, else empty. */
    std::function<double(double begin, double end)> mean_flux{};
    cases::Boundary law{}; ///< of walls that exchange heat

    bool radiates() const
    {
      return kind == cases::BoundaryKind::radiation;
    }

    bool fixed() const
    {
      return kind == cases::BoundaryKind::fixed_temperature;
    }
  };

  /** A Stefan problem in one coordinate: T_t + u T_x = a (T_xx + (d - 1)/x T_x) + f/(rho
   * c) in each phase, T = T_m on fronts, which move with the Stefan speed. */
  struct LineProblem
  {
    cases::Symmetry symmetry = cases::Symmetry::planar;
    cases::Material material;
    std::vector<double> nodes; ///< ascending, the first and last on the walls (m)
    double spacing = 0;        ///< distance of nodes, where no wall makes it finer (m)
    std::array<double, 2> wall_spacing{}; ///< beside walls that make it finer, else 0 (m)
    std::vector<double> jumps;            ///< of the temperature at the start (m)
    double jump_spacing = 0;              ///< distance of nodes beside them (m)
    double spacing_growth
        = 0; ///< with the distance from walls and jumps that make it finer
    std::array<LineWall, 2> walls;
    bool axis = false; ///< the lower end is an axis or a centre, no wall
    std::function<double(double x, double time)> volumetric_source; ///< W/m^3, or empty
    /** The mean over a time of the heat released (W/m^3). */
    std::function<double(double x, double begin, double end)> mean_release;
    std::vector<double> breakpoints; ///< at which steps begin anew (s)
    std::vector<double> step_ends;   ///< cases::step_ends(), breakpoints too
    Displaced displaced = Displaced::liquid;
    Form form = Form::balances;
    bool metastable = false; ///< phases beyond the melting temperature are meant

    /** Whether rows are balances of cells, which lose no heat, rather than collocation.
     */
    bool balanced() const
    {
      return form == Form::balances;
    }

    /** Distance of nodes about a place (m): from what it is beside a wall, or where the
     * temperature jumps at the start, it grows with the distance. */
    double spacing_at(double x) const
    {
      double result = spacing;
      for(const std::size_t side : {0, 1})
        if(wall_spacing[side] > 0)
          result = std::min(
              result,
              wall_spacing[side]
                  + spacing_growth
                        * std::abs(x - (side == 0 ? nodes.front() : nodes.back())));
      for(const double jump : jumps)
        result = std::min(result, jump_spacing + spacing_growth * std::abs(x - jump));
      return result;
    }

    /** d - 1: 0, 1 or 2. */
    int curvature_terms() const
    {
      return symmetry == cases::Symmetry::planar        ? 0
             : symmetry == cases::Symmetry::cylindrical ? 1
                                                        : 2;
    }

    const cases::PhaseProperties &phase(bool solid) const
    {
      return solid ? material.solid : material.liquid;
    }

    /** Mass per volume that a front which moves by one unit changes from one phase into
     * the other (kg/m^3): the density of the phase at rest. */
    double front_density() const
    {
      return phase(displaced == Displaced::liquid).density;
    }

    /** Speed of a phase's matter over that of the front, at the front. */
    double displacement(bool solid) const
    {
      const bool moves = solid == (displaced == Displaced::solid);
      return moves ? 1 - front_density() / phase(solid).density : 0.;
    }
  };

  /** How a line problem is solved. */
  struct LineSettings
  {
    int basis_order = 2;
    double dilation = 2.6;               ///< over the spacing
    double interpolation_distance = 0.1; ///< over the spacing
    int time_order = 2;                  ///< of backward differentiation, 1 to 3
  };

  /** The state at a time. */
  struct LineState
  {
    double time = 0;
    bool solid_first = true;           ///< phase at the lower end
    std::vector<double> fronts;        ///< ascending (m)
    std::vector<double> speed;         ///< of the fronts (m/s)
    std::vector<double> temperature;   ///< at the nodes
    std::array<double, 2> wall_flux{}; ///< heat that comes in through the walls (W/m^2)
    /** Where rows are balances: what each node stands for in its phase, and the heat that
     * has come in through the walls, both in the measure of the scene. */
    std::vector<double> cells;
    double taken = 0; ///< J

    /** Phases lie between fronts and walls, in this order. */
    std::size_t n_intervals() const
    {
      return fronts.size() + 1;
    }

    bool solid(std::size_t interval) const
    {
      return solid_first == (interval % 2 == 0);
    }

    /** The interval in which a place lies; a front belongs to the one above it. */
    std::size_t interval_of(double x) const
    {
      std::size_t interval = 0;
      while(interval < fronts.size() && x >= fronts[interval])
        ++interval;
      return interval;
    }
  };
} // namespace meltfront::particles::rkpm_tracked

#endif
