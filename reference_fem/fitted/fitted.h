#ifndef meltfront_reference_fem_fitted_fitted_h
#define meltfront_reference_fem_fitted_fitted_h

#include <cases/method.h>

#include <memory>

namespace meltfront::reference_fem
{
  /**
   * The method `fem-fitted`: finite elements on a mesh that moves with the front, whose
   * nodes on the front hold its place as an unknown. See README.md.
   */
  std::unique_ptr<cases::Method> make_fem_fitted();
} // namespace meltfront::reference_fem

#endif
