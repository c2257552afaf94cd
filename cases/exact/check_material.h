#ifndef meltfront_cases_exact_check_material_h
#define meltfront_cases_exact_check_material_h

#include <cases/material.h>

#include <string>

namespace meltfront::cases
{
  /** @throws InputError naming the first property that is not a positive number, or where
   * properties depend on temperature. */
  void check_material(const Material &material, const std::string &solution);

  /** @throws InputError where solid and liquid differ in density. */
  void require_equal_densities(const Material &material, const std::string &solution);
} // namespace meltfront::cases

#endif
