#ifndef meltfront_cases_exact_tests_materials_h
#define meltfront_cases_exact_tests_materials_h

#include <cases/material.h>

#include <gtest/gtest.h>

#include <cmath>

namespace meltfront::cases
{
  /** Ice and water with the data of the sink tests, normalised to T_m = 0. */
  inline Material water(double ice_density = 1000)
  {
    return {{2.2, 2090, ice_density}, {0.591, 4190, 1000}, 333500, 0};
  }

  /** All properties one, melting at 1. */
  inline Material unit_material()
  {
    Material material;
    material.melting_temperature = 1;
    return material;
  }

  /** The wall temperature that gives lambda = 1/2 in unit_material() under liquid at 1.2.
   */
  inline constexpr double unit_wall = 0.190602422788870409;

  inline void expect_relative(double value, double expected, double tolerance)
  {
    EXPECT_LE(std::abs(value - expected), tolerance * std::abs(expected))
        << value << " against " << expected << ", relative "
        << (value - expected) / expected;
  }
} // namespace meltfront::cases

#endif
