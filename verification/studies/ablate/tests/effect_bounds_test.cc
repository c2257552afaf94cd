#include <cases/domain_measure.h>
#include <cases/effect_bounds.h>
#include <cases/scene_heat.h>
#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <reference_fem/enthalpy/enthalpy.h>
#include <verification/studies/ablate/tests/random_scene.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

using namespace meltfront;
using namespace meltfront::verification::tests;

namespace
{
  /** All states of a run. */
  struct States : cases::Observer
  {
    std::vector<double> weights, time;
    std::vector<std::vector<double>> temperature, solid;

    bool wants(long, double) override
    {
      return true;
    }

    void observe(const cases::Snapshot &snapshot) override
    {
      weights.assign(snapshot.weights.begin(), snapshot.weights.end());
      time.push_back(snapshot.time);
      temperature.emplace_back(snapshot.temperature.begin(), snapshot.temperature.end());
      solid.emplace_back(snapshot.solid_fraction.begin(), snapshot.solid_fraction.end());
    }
  };

  States states_of(const cases::Scene &scene)
  {
    const auto method = reference_fem::make_fem_enthalpy();
    const cases::Resolution resolution = test_support::resolution_of(
        *method, scene.domain.dimension == 1 ? 48 : 12, {{"steps", "100"}});
    States states;
    method->solve(scene, cases::effects_called_for(scene), resolution, states);
    return states;
  }

  /** By how much two runs differ at most, as EffectBound measures it. */
  struct Change
  {
    double front = 0, temperature = 0;

    double largest() const
    {
      return std::max(front, temperature);
    }
  };

  double radius_of(const cases::Scene &scene, double volume)
  {
    return scene.domain.round()
               ? cases::enclosing_coordinate(scene.symmetry, std::max(volume, 0.))
               : volume / cases::volume_of(scene.domain);
  }

  Change change_between(const cases::Scene &scene, const States &one, const States &other)
  {
    const cases::TemperatureBounds given = cases::given_temperatures(scene);
    const double volume = cases::volume_of(scene.domain);
    Change change;
    EXPECT_EQ(one.time.size(), other.time.size());
    for(std::size_t k = 0; k < std::min(one.time.size(), other.time.size()); ++k)
    {
      double solid = 0, solid_of_other = 0, difference = 0;
      for(std::size_t i = 0; i < one.weights.size(); ++i)
      {
        solid += one.weights[i] * one.solid[k][i];
        solid_of_other += one.weights[i] * other.solid[k][i];
        difference
            += one.weights[i] * std::abs(one.temperature[k][i] - other.temperature[k][i]);
      }
      change.front = std::max(change.front, std::abs(radius_of(scene, solid)
                                                     - radius_of(scene, solid_of_other))
                                                / scene.domain.side());
      change.temperature = std::max(change.temperature,
                                    difference / volume / (given.upper - given.lower));
    }
    return change;
  }

  cases::Scene simulated(const cases::Scene &scene)
  {
    return cases::simulated_scene(scene, cases::effects_called_for(scene));
  }

  cases::Scene without(const cases::Scene &scene, cases::Effect effect)
  {
    cases::Scene less = scene;
    less.effect_choices[effect] = cases::EffectChoice::off;
    return simulated(less);
  }

  /** Long study by hand: MELTFRONT_BOUND_SCENES=2000. */
  int number_of_scenes()
  {
    const char *wanted = std::getenv("MELTFRONT_BOUND_SCENES");
    return wanted ? std::atoi(wanted) : 200;
  }

  struct Tally
  {
    int bounds = 0, finite = 0;
    std::vector<double> sharpness{}; ///< bound over true change
  };
} // namespace

TEST(EffectBounds, NoRandomSceneChangesByMoreThanTheBound)
{
  std::map<std::string, Tally> tallies;
  for(int index = 0; index < number_of_scenes(); ++index)
  {
    const cases::Scene scene = random_weak_scene(19, index);
    const cases::Scene full = simulated(scene);
    const States with = states_of(full);
    const cases::EffectSet effects = cases::effects_called_for(scene);
    for(const cases::EffectDecision &decision : effects.decisions())
    {
      if(!decision.on || decision.effect == cases::Effect::phase_change)
        continue;
      Tally &tally = tallies[cases::to_string(decision.effect)];
      ++tally.bounds;
      const cases::Scene less = without(scene, decision.effect);
      const cases::EffectBound bound
          = cases::bound_of_effect(decision.effect, full, less);
      if(!std::isfinite(bound.largest()))
        continue;
      ++tally.finite;
      const Change change = change_between(full, with, states_of(less));
      // Newton's iteration ends at 1e-9 or so.
      EXPECT_LE(change.front, bound.front + 1e-8)
          << index << " " << cases::to_string(decision.effect) << " " << bound.words;
      EXPECT_LE(change.temperature, bound.temperature + 1e-8)
          << index << " " << cases::to_string(decision.effect) << " " << bound.words;
      if(change.largest() > 1e-7)
        tally.sharpness.push_back(bound.largest() / change.largest());
    }
  }
  for(auto &[effect, tally] : tallies)
  {
    std::ranges::sort(tally.sharpness);
    const std::size_t count = tally.sharpness.size();
    fmt::print(
        "{:<24} {:>4} scenes, {:>4} with a bound; bound over change: least {:.3g}, "
        "median {:.3g}, of {}\n",
        effect, tally.bounds, tally.finite, count ? tally.sharpness.front() : cases::nan,
        count ? tally.sharpness[count / 2] : cases::nan, count);
  }
}

TEST(EffectBounds, WhatIsLeftOutTogetherChangesLessThanTheTolerance)
{
  constexpr double tolerance = 1e-2;
  int on = 0, left_out = 0, scenes = 0;
  double largest = 0;
  for(int index = 0; index < number_of_scenes(); ++index)
  {
    const cases::Scene scene = random_weak_scene(23, index);
    const cases::Scene full = simulated(scene);
    const cases::EffectSet effects = cases::effects_within(scene, tolerance);
    int here = 0;
    for(const cases::EffectDecision &decision : effects.decisions())
    {
      here += decision.reason.starts_with("left out");
      on += decision.on || decision.reason.starts_with("left out");
    }
    left_out += here;
    if(here == 0)
      continue;
    ++scenes;
    const double change
        = change_between(full, states_of(full),
                         states_of(cases::simulated_scene(scene, effects)))
              .largest();
    EXPECT_LE(change, tolerance) << index;
    largest = std::max(largest, change);
  }
  fmt::print("{} of {} effects left out, in {} of {} scenes; largest change {:.3g}\n",
             left_out, on, scenes, number_of_scenes(), largest);
  EXPECT_GT(left_out, on / 6); // the bounds are no empty promises
  EXPECT_GT(scenes, number_of_scenes() / 3);
}
