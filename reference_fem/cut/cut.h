#ifndef meltfront_reference_fem_cut_cut_h
#define meltfront_reference_fem_cut_cut_h

#include <cases/method.h>

#include <memory>

namespace meltfront::reference_fem
{
  /**
   * The method `fem-cut`: a fixed mesh that the front, a level set, cuts; Nitsche's
   * condition on it, ghost penalty, each phase on its own elements. Fronts merge and
   * split. Two dimensions. See README.md.
   */
  std::unique_ptr<cases::Method> make_fem_cut();
} // namespace meltfront::reference_fem

#endif
