#ifndef meltfront_cases_case_file_alloy_reader_h
#define meltfront_cases_case_file_alloy_reader_h

#include <cases/case_file/prm_file.h>
#include <cases/scene.h>

#include <string>
#include <vector>

namespace meltfront::cases
{
  /** Declare the keys of solutes and alloys: of the material and of the initial state. */
  void declare_alloy(PrmFile &prm);

  /** Key of the initial state that gives the concentration of a solute. */
  const char *concentration_key(std::size_t solute);

  /**
   * Read the solutes, if the file opens `Scene/Material/Solute 1`, and what they begin
   * with; of an exact initial state complete_scene() knows the concentrations.
   * @throws InputError
   */
  void read_alloy(const PrmFile &prm, Scene &scene);

  /**
   * At sampled points, mass fractions must be at least 0 and less than 1, the liquidus
   * above the eutectic temperature, and the liquid that is left at the lowest temperature
   * of the scene within what the phase diagram knows. An effect of solutes that is
   * switched on must have what it acts on.
   * @throws InputError
   */
  void check_alloy(const PrmFile &prm, const Scene &scene,
                   const std::vector<Position> &points);
} // namespace meltfront::cases

#endif
