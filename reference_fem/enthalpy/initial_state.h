#ifndef meltfront_reference_fem_enthalpy_initial_state_h
#define meltfront_reference_fem_enthalpy_initial_state_h

#include <cases/scene.h>
#include <reference_fem/enthalpy/mesh.h>

#include <vector>

namespace meltfront::reference_fem
{
  /**
   * Enthalpy per volume (J/m^3) of the nodes at the start.
   *
   * Where the scene states its front at the start, or starts from an exact solution with
   * one, a node that is free takes the average over the volume it stands for, each phase
   * up to the front: point values would misplace the front by up to half a cell. The
   * average is made of the simulated material and the initial temperature, so that it
   * stays right where an effect is taken out of the scene. Elsewhere the point value is
   * taken.
   */
  std::vector<double> initial_enthalpy(const cases::Scene &scene, const Mesh &mesh,
                                       const Discretisation &discretisation,
                                       const std::vector<char> &free);
} // namespace meltfront::reference_fem

#endif
