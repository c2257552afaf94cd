#include <reference_fem/cut/heat_problem.h>

#include <reference_fem/cut/quadrature.h>

/** What heat a state of HeatProblem holds, and what was released between two. */
namespace meltfront::reference_fem::cut
{
  /** Between two states, by the quadrature that the equations have (J/m). */
  double HeatProblem::heat_released(const State &state, const State &before) const
  {
    double heat = 0;
    const BackgroundMesh &mesh = *state.mesh;
    const auto add = [&](unsigned int cell, const std::vector<VolumePoint> &points)
    {
      for(const VolumePoint &point : points)
        heat += point.weight
                * (*released)(position(mesh.cells[cell].real(point.unit)), before.time,
                              state.time);
    };
    for(const Phase phase : phases)
    {
      for(unsigned int number = 0; number < mesh.cells.size(); ++number)
        if(CutGeometry::is(state.geometry->location[number], phase)
           && mesh.place[number] == Place::inside)
          add(number, whole_cell(mesh.cells[number]));
      state.geometry->visit_parts(mesh, phase, add);
    }
    return heat * (state.time - before.time);
  }

  double HeatProblem::sink_wall_power(const State &state) const
  {
    double sum = 0;
    for(const WallPoint &wall : state.geometry->walls)
      if(wall.phase == Phase::solid)
        sum += wall.point.weight * scene.material.solid.conductivity
               * (sinks.gradient(wall.position, state.time) * wall.point.normal);
    return sum;
  }

  double HeatProblem::temperature(const State &state, Phase phase, unsigned int number,
                                  const Point &unit) const
  {
    const Cell &cell = state.mesh->cells[number];
    const double value
        = field_value(*state.mesh, cell, state.unknown[index(phase)], unit);
    return phase == Phase::solid ? value + sinks.value(cell.real(unit), state.time)
                                 : value;
  }

  double HeatProblem::sensible_heat(const State &state) const
  {
    double sum = 0;
    const BackgroundMesh &mesh = *state.mesh;
    const double melting = scene.material.melting_temperature;
    for(const Phase phase : phases)
    {
      double heat = 0;
      for(unsigned int number = 0; number < mesh.cells.size(); ++number)
      {
        const Cell &cell = mesh.cells[number];
        if(!CutGeometry::is(state.geometry->location[number], phase)
           || mesh.place[number] != Place::inside)
          continue;
        for(const VolumePoint &point : whole_cell(cell))
          heat += point.weight
                  * (field_value(mesh, cell, state.unknown[index(phase)], point.unit)
                     - melting);
        if(phase == Phase::solid)
          heat += sinks.integral(cell.lower, cell.size, state.time);
      }
      state.geometry->visit_parts(
          mesh, phase,
          [&](unsigned int cell, const std::vector<VolumePoint> &points)
          {
            for(const VolumePoint &point : points)
              heat += point.weight
                      * (temperature(state, phase, cell, point.unit) - melting);
          });
      sum += properties(phase).volumetric_heat_capacity() * heat;
    }
    return sum;
  }

  double HeatProblem::latent_heat(const State &state) const
  {
    return scene.material.solid.density * scene.material.latent_heat
           * state.geometry->area(Phase::liquid);
  }

  bool HeatProblem::in_solid(const State &state, const Point &point) const
  {
    for(std::size_t number = 0; number < state.mesh->cells.size(); ++number)
    {
      const Point unit = state.mesh->cells[number].unit(point);
      if(unit[0] >= 0 && unit[0] <= 1 && unit[1] >= 0 && unit[1] <= 1
         && state.geometry->location[number] == Location::solid)
        return true;
    }
    return false;
  }
} // namespace meltfront::reference_fem::cut
