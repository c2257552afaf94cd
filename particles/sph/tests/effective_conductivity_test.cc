#include <cases/error.h>
#include <particles/sph/conduction_rows.h>
#include <particles/sph/effective_conductivity.h>
#include <particles/sph/sph.h>
#include <particles/sph/tests/scenes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::particles::testing
{
  namespace
  {
    using std::numbers::pi;

    cases::Scene decaying_wave(double end_time)
    {
      cases::Scene scene = unit_box(2, unit_material(0), 0, end_time);
      scene.initial.temperature
          = field_of([](const cases::Position &p) { return std::sin(pi * p[0]); });
      return scene;
    }

    SphParameters disorder(double jitter, double smoothing_length)
    {
      SphParameters p;
      p.dimension = 2;
      p.layout = LatticeLayout::cell_centred;
      p.n = 64;
      p.seed = 3;
      p.smoothing_length = smoothing_length;
      p.jitter = jitter;
      return p;
    }

    double conductivity_of(double jitter, double smoothing_length, bool corrected)
    {
      const cases::Scene scene = decaying_wave(1);
      const Discretisation dis(scene, disorder(jitter, smoothing_length));
      return effective_conductivity(dis, ConductionRows(dis, corrected).rows);
    }

    TEST(EffectiveConductivity, OfALatticeIsThatOfItsSecondMoment)
    {
      EXPECT_NEAR(conductivity_of(0, 1.3, true), 1, 1e-12);
      EXPECT_NEAR(conductivity_of(0, 1.3, false), 1.010543, 1e-6);
    }

    /** Rate at which sin(pi x) decays, over that of the material. */
    double rate_of_decay(const std::string &jitter, const std::string &smoothing_length)
    {
      constexpr double end_time = 0.05;
      const auto amplitude = [](const Outcome &outcome)
      {
        double sum = 0;
        for(std::size_t i = 0; i < outcome.temperature.size(); ++i)
          sum += outcome.temperature[i] * std::sin(pi * outcome.position_x[i]);
        return sum;
      };
      const auto after = [&](double time)
      {
        return amplitude(run(*make_sph(), {decaying_wave(time), nullptr}, 64,
                             {{"jitter", jitter},
                              {"smoothing_length", smoothing_length},
                              {"moment_correction", "false"}},
                             3));
      };
      return std::log(after(end_time) / after(2 * end_time)) / (pi * pi * end_time);
    }

    // Waves see the particles' conductivity, not that of the material.
    TEST(EffectiveConductivity, IsWhatAWaveDecaysWith)
    {
      for(const auto &[jitter, length] :
          {std::pair{"0.2", "1.3"}, {"0.3", "1.3"}, {"0.4", "1.5"}})
      {
        const double found = conductivity_of(std::stod(jitter), std::stod(length), false);
        EXPECT_LE(found, 1.005);
        EXPECT_NEAR(found, rate_of_decay(jitter, length), 0.012) << jitter;
      }
    }

    TEST(EffectiveConductivity, RandomParticlesAreRefused)
    {
      for(const std::string length : {"1.3", "2"})
        EXPECT_THROW(run(*make_sph(), {decaying_wave(0.1), nullptr}, 20,
                         {{"arrangement", "random"}, {"smoothing_length", length}}),
                     cases::Refusal);
    }
  } // namespace
} // namespace meltfront::particles::testing
