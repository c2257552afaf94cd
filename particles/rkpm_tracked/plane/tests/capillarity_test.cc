#include "cases.h"

#include <cases/error.h>
#include <particles/rkpm_tracked/rkpm_tracked.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meltfront;
using namespace meltfront::particles::rkpm_tracked;

namespace
{
  constexpr double coefficient = 0.01, radius = 0.4, rim = 1;

  /** A body of solid in an annulus of liquid, all at the temperature at which a disk of
   * that radius neither melts nor grows; the solid's middle is part of it. */
  cases::Scene capillary_disk(double amplitude, int mode, double heat_capacity,
                              double end_time)
  {
    cases::Scene scene;
    scene.symmetry = cases::Symmetry::none;
    scene.domain.shape = cases::DomainShape::ball;
    scene.domain.dimension = 2;
    scene.domain.radius = rim;
    scene.end_time = end_time;
    scene.material.gibbs_thomson_coefficient = coefficient;
    for(cases::PhaseProperties *phase : {&scene.material.solid, &scene.material.liquid})
      phase->specific_heat_capacity = heat_capacity;
    scene.initial.front = cases::Field{
        "", [=](const cases::Position &p, double)
        {
          const double phi = std::atan2(p[1], p[0]);
          return std::hypot(p[0], p[1]) - radius * (1 + amplitude * std::cos(mode * phi));
        }};
    // Harmonic, to first order in the amplitude.
    scene.initial.temperature = cases::Field{
        "", [=](const cases::Position &p, double)
        {
          const double r = std::hypot(p[0], p[1]) / radius,
                       q = std::pow(radius / rim, 2 * mode),
                       shape
                       = r < 1 ? std::pow(r, mode)
                               : (std::pow(r, -mode) - q * std::pow(r, mode)) / (1 - q);
          return -coefficient / radius
                 * (1
                    + amplitude * (mode * mode - 1) * shape
                          * std::cos(mode * std::atan2(p[1], p[0])));
        }};
    cases::Boundary wall;
    wall.kind = cases::BoundaryKind::fixed_temperature;
    wall.value = cases::Field::uniform(-coefficient / radius);
    scene.boundaries[static_cast<std::size_t>(cases::Side::outer)] = wall;
    return scene;
  }

  /** Amplitude of a mode of the front about the origin, over its mean radius. */
  double amplitude_of(const PlaneRecord &record, int mode)
  {
    const auto &x = record.front[0], &y = record.front[1];
    double mean = 0, sum = 0;
    for(std::size_t p = 0; p < x.size(); ++p)
      mean += std::hypot(x[p], y[p]) / static_cast<double>(x.size());
    for(std::size_t p = 0; p < x.size(); ++p)
      sum += 2 * (std::hypot(x[p], y[p]) - mean) * std::cos(mode * std::atan2(y[p], x[p]))
             / static_cast<double>(x.size());
    return sum / mean;
  }

  /** A disk at its own melting temperature stays. */
  TEST(PlaneCapillarity, DiskInEquilibriumStays)
  {
    for(const int n : {20, 40})
    {
      const PlaneRecord record
          = run_plane(capillary_disk(0, 1, 1, 0.05), n, {{"steps", "8"}});
      EXPECT_NEAR(record.frames.back().mean_radius, radius, 1e-12);
      EXPECT_LT(record.frames.back().roundness, 1e-12);
    }
  }

  /**
   * Ripples decay as capillarity has it. Where heat is conducted far faster than the
   * front moves, temperatures are harmonic: T' = -Gamma (m^2 - 1)/R^2 a on the front,
   * (r/R)^m inside, outside with the rim at b (Mullins and Sekerka 1963, without growth)
   *
   *   da/dt = -Gamma m (m^2 - 1)/(rho L R^3) (k_s + k_l (1 + q)/(1 - q)) a,
   *   q = (R/b)^(2m).
   */
  TEST(PlaneCapillarity, RipplesDecayAtTheirRate)
  {
    for(const int mode : {2, 3})
    {
      const double q = std::pow(radius / rim, 2 * mode);
      const double rate = coefficient * mode * (mode * mode - 1)
                          / (radius * radius * radius) * (1 + (1 + q) / (1 - q));
      const double start = 0.02;
      const auto error = [&](int n)
      {
        const PlaneRecord record = run_plane(capillary_disk(start, mode, 1e-3, 1 / rate),
                                             n, {{"steps", "24"}});
        return std::abs(std::log(amplitude_of(record, mode) / start) + 1);
      };
      const double coarse = error(32), fine = error(48);
      EXPECT_LT(fine, 0.025) << mode;
      EXPECT_LT(fine, 0.6 * coarse) << mode;
    }
  }

  /** What is unstable without capillarity stays round with it. */
  TEST(PlaneCapillarity, UndercooledGrowthStaysRound)
  {
    cases::Scene scene = frank_disk(0.12);
    const PlaneRecord without = run_plane(scene, 40);
    scene.material.gibbs_thomson_coefficient = 0.01;
    const PlaneRecord with = run_plane(scene, 40);
    EXPECT_LT(with.frames.back().roundness, 0.5 * without.frames.back().roundness);
    EXPECT_LT(with.frames.back().roundness, 4e-3);
    // Both say what is unstable, and the one from which length on.
    ASSERT_EQ(without.notes.size(), 1u);
    EXPECT_NE(without.notes[0].find("for want of a Gibbs-Thomson"), std::string::npos);
    ASSERT_EQ(with.notes.size(), 1u);
    EXPECT_NE(with.notes[0].find("spacings"), std::string::npos);
  }

  TEST(PlaneCapillarity, LineRefusesIt)
  {
    cases::Scene scene = frank_disk(0.05);
    scene.material.gibbs_thomson_coefficient = 0.01;
    EXPECT_THROW(run_plane(scene, 20, {{"dimension", "1"}}), cases::Refusal);
  }
} // namespace
