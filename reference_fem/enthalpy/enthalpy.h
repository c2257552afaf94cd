#ifndef meltfront_reference_fem_enthalpy_enthalpy_h
#define meltfront_reference_fem_enthalpy_enthalpy_h

#include <cases/method.h>

#include <memory>

namespace meltfront::reference_fem
{
  /**
   * The method `fem-enthalpy`: linear finite elements with lumped masses, the enthalpy as
   * the unknown on its exact graph, truncated nonsmooth Newton, backward Euler or BDF2,
   * in one, two and three dimensions. See README.md.
   */
  std::unique_ptr<cases::Method> make_fem_enthalpy();
} // namespace meltfront::reference_fem

#endif
