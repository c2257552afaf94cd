#ifndef meltfront_particles_rkpm_tracked_tests_watched_run_h
#define meltfront_particles_rkpm_tracked_tests_watched_run_h

#include <particles/rkpm_tracked/line/tests/cases.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meltfront::particles::rkpm_tracked
{
  /** A stepper with what it says, and what it passed through. */
  struct Watched
  {
    Watched(const LineProblem &problem, const LineSettings &settings, double span = 120,
            double first_step = 1e-6, double cfl = 0.5)
      : problem(problem)
      , stepper(problem, settings, {cfl, first_step, span, 1e-14},
                [this](double, const std::string &event) { notes.push_back(event); })
    {
    }

    void advance(double target)
    {
      stepper.advance(target,
                      [this](const LineState &)
                      {
                        const LineState &state = stepper.state();
                        for(const double value : state.temperature)
                        {
                          ASSERT_TRUE(std::isfinite(value));
                          lowest = std::min(lowest, value);
                          highest = std::max(highest, value);
                        }
                        fronts.push_back(state.fronts.empty() ? 0.
                                                              : state.fronts.front());
                      });
    }

    /** How often the front turned back by more than round-off. */
    int reversals() const
    {
      int result = 0;
      double direction = 0;
      for(std::size_t i = 1; i < fronts.size(); ++i)
      {
        const double move = fronts[i] - fronts[i - 1];
        if(std::abs(move) < 1e-9)
          continue;
        result += move * direction < 0;
        direction = move;
      }
      return result;
    }

    bool noted(const std::string &words) const
    {
      return std::ranges::any_of(notes, [&](const std::string &note)
                                 { return note.find(words) != std::string::npos; });
    }

    const LineProblem &problem;
    LineStepper stepper;
    std::vector<std::string> notes;
    std::vector<double> fronts;
    double lowest = 1e300, highest = -1e300;
  };

  inline LineProblem dirichlet_slab(const cases::Material &material, int n)
  {
    return unit_slab(
        material, n, [](double) { return hot; }, [](double) { return cold; });
  }

  /** Straight temperatures on both sides of a front. */
  inline LineState straight_state(const LineProblem &problem, double front)
  {
    LineState state;
    state.solid_first = false;
    state.fronts = {front};
    for(const double x : problem.nodes)
      state.temperature.push_back(x < front
                                      ? hot - (hot - 430) * x / front
                                      : 430 - (430 - cold) * (x - front) / (1 - front));
    return state;
  }
} // namespace meltfront::particles::rkpm_tracked

#endif
