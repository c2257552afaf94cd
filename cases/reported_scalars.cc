#include <cases/reported_scalars.h>

#include <fmt/format.h>

namespace meltfront::cases
{
  const std::vector<ReportedScalar> &reported_scalars()
  {
    static const std::vector<ReportedScalar> list = []
    {
      std::vector<ReportedScalar> all{
          {"first_break", "step at which a bond of the start is missing"},
          {"first_fluid", "step from 1000 on at which a particle is fluid"},
          {"unheated_from", "step from which no particle is within the source's reach"},
          {"all_fluid_at", "step at which no solid particle is left"},
          {"least_solid", "fewest solid particles from step 1000 on"},
          {"fluid_end", "fluid particles at the end"},
          {"bonds_kept", "bonds of the start that the end has"},
          {"whole_until_broken", "steps until the first bond breaks, or all of them"},
          {"all_solid_end", "share of runs in which all are solid at the end"},
          {"all_fluid", "share of runs in which all were fluid at one look"},
          {"base_buckled", "share of runs in which the lowest row has left the base"},
          {"left_lobe_longer", "share of runs that spread farther to the left"},
          {"lowest_x", "where the leftmost particle ends"},
          {"highest_x", "where the rightmost particle ends"},
          {"highest_y", "highest that a particle came at any look"},
          {"kinetic_energy_end", "kinetic energy of all particles at the end"},
          {"mean_temperature_end", "mean over the particles of their temperature"},
          {"energy_error", "largest change of the energy at any look"},
          {"corner_1_temperature", "temperature of the first corner at its last bond"},
          {"corner_2_temperature", "temperature of the second corner at its last bond"},
          {"corner_1_step", "step at which the first corner loses its last triangle"},
          {"corner_2_step", "step at which the second corner loses its last triangle"}};
      for(int particle = 1; particle <= most_named_particles; ++particle)
        all.push_back(
            {fmt::format("fluid_end_{}", particle),
             fmt::format("share of runs in which particle {} is fluid at the end",
                         particle)});
      return all;
    }();
    return list;
  }
} // namespace meltfront::cases
