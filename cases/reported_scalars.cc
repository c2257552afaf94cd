#include <cases/particle_solid.h>
#include <cases/reported_scalars.h>

#include <fmt/format.h>

#include <utility>

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
          {"corner_2_step", "step at which the second corner loses its last triangle"},
          {"heat_from_bath", "heat that the bath has given, per particle"},
          {"light_absorbed", "energy that light has given, per particle"},
          {"light_caught", "share of a point's light that particles caught; of rays the "
                           "mean width or area that caught them"},
          {"energy_defect", "change of the energy less heat and light, over the larger "
                            "of what was given and what breaks a bond, per particle"},
          {"height_end", "height of the highest particle at the end"},
          {"width_end", "from the leftmost to the rightmost particle at the end"},
          {"shortest_bond_end", "shortest bond at the end"},
          {"longest_bond_end", "longest bond at the end"},
          {"partners_of_most_end",
           "number of nearest partners that most particles have over the last stage"},
          {"peak_1", "first maximum of the pair correlation over the last stage, over "
                     "the distance at which a pair rests"},
          {"peak_2", "second maximum over the first"},
          {"peak_3", "third maximum over the first"},
          {"peak_4", "fourth maximum over the first"}};
      for(int stage = 1; stage <= most_stages; ++stage)
        for(const auto &[name, meaning] :
            {std::pair{"temperature", "temperature by kinetic energy"},
             {"energy", "energy of a particle"},
             {"lindemann", "root mean square change of a bond's length over its length "
                           "(Berry's form of Lindemann's)"},
             {"partners", "number of nearest partners"},
             {"hexatic_order", "order of partners about a particle of the plane: 1 in a "
                               "crystal"},
             {"warmer_above", "temperature of the particles above the mean height less "
                              "that of those below it"},
             {"fluid_above_solid", "mean height of the fluid particles less that of the "
                                   "solid ones, at looks at which there are both"},
             {"energy_changed",
              "energy of a particle less that in the last earlier stage "
              "in a bath of the same temperature"},
             {"heat_capacity", "energy over temperature from the stage before"},
             {"latent_heat", "energy of a particle from the stage before, less what the "
                             "mean of the heat capacities before and after takes"}})
          all.push_back({fmt::format("{}_stage_{}", name, stage),
                         fmt::format("{}, over stage {}", meaning, stage)});
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
