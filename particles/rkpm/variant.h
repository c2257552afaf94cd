#ifndef meltfront_particles_rkpm_variant_h
#define meltfront_particles_rkpm_variant_h

#include <string>
#include <vector>

namespace meltfront::particles::rkpm
{
  /**
   * Forms of the reproducing kernel approximation, N_I(x) = b(x)^T p w_I with the moments
   * M = sum_I p p^T w_I. There are two families: in the first the kernel moves with x and
   * is differentiated; in the second derivatives are those of the local polynomial, and
   * the kernel is frozen. Within a family all forms agree to round-off.
   */
  enum class Variant
  {
    /** p(x - x_I), kernel differentiated (Liu, Jun and Zhang 1995; Aluru 2000). */
    point_collocation,
    /** p(x_I), M b = p(x), kernel frozen at the particle (moving least squares with
     * diffuse derivatives: Nayroles, Touzot and Villon 1992). */
    fixed_point,
    /** p(x_I), M b = p(x), kernel differentiated (moving least squares: Lancaster and
     * Salkauskas 1981; Belytschko, Lu and Gu 1994). */
    moving,
    /** As point collocation, each neighbour with its own dilation. */
    multiple_fixed,
    /** p(x - x_I), M b^a = (-1)^|a| D^a p(0), kernel never differentiated (Wang et al.,
     * derivative-free reproducing kernel). */
    derivative_free
  };

  /** The words for the variants, in the order of the enumeration. */
  const std::vector<std::string> &variant_names();

  /** The word for a variant. */
  const std::string &variant_name(Variant variant);

  /** The variant that a word names. @throws cases::InputError for an unknown word. */
  Variant variant(const std::string &name);

  /** Whether a variant differentiates its kernel. */
  bool differentiates_kernel(Variant variant);

  /** Where the monomials p(x_I) of `fixed_point` and `moving` have their origin. */
  enum class Origin
  {
    point,   ///< at the point, scaled with the dilation: well conditioned
    absolute ///< at the origin of space, in metres, as printed: loses digits with the
             ///< order
  };
} // namespace meltfront::particles::rkpm

#endif
