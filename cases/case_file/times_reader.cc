#include <cases/case_file/times_reader.h>

#include <fmt/format.h>

namespace meltfront::cases
{
  namespace
  {
    constexpr const char *time_keys[] = {"start time", "end time"};
    constexpr const char *front_keys[] = {"start front", "end front"};

    bool times_by_fronts(const PrmFile &prm)
    {
      return prm.given("Scene", front_keys[0]) || prm.given("Scene", front_keys[1]);
    }

    /** Both fronts are given, ascend, and are those of Neumann's solution. */
    void check_fronts(const PrmFile &prm)
    {
      for(const char *key : time_keys)
        prm.forbid("Scene", key, "the scene begins and ends by its front");
      for(const char *key : front_keys)
      {
        prm.require("Scene", key, "'start front' and 'end front' belong together");
        if(prm.get_text("Exact solution", "kind") != "neumann")
          prm.forbid("Scene", key, "only Neumann's solution tells the time of a front");
      }
      const double start = prm.get_number("Scene", front_keys[0]),
                   end = prm.get_number("Scene", front_keys[1]);
      if(!(start < end))
        throw prm.error(
            "Scene", front_keys[1],
            fmt::format("({}) must lie beyond 'start front' ({})", end, start));
    }
  } // namespace

  void read_times(const PrmFile &prm, Scene &scene)
  {
    if(times_by_fronts(prm))
    {
      check_fronts(prm); // the times are known once the exact solution is
      return;
    }
    if(scene.problem == ProblemKind::poisson)
    {
      for(const char *key : time_keys)
        prm.forbid("Scene", key, "the scene is steady");
      return;
    }
    scene.start_time = prm.get_number("Scene", "start time");
    scene.end_time = prm.get_number("Scene", "end time");
    if(!(scene.start_time < scene.end_time))
      throw prm.error("Scene", "end time",
                      fmt::format("({}) must come after 'start time' ({})",
                                  scene.end_time, scene.start_time));
  }

  void take_times_from_fronts(const PrmFile &prm, const KnownSolution &known,
                              Scene &scene)
  {
    if(!times_by_fronts(prm))
      return;
    const auto time_of = [&](const char *key)
    {
      const double ratio = prm.get_number("Scene", key) / known.solution->front(1);
      return ratio * ratio;
    };
    scene.start_time = time_of(front_keys[0]);
    scene.end_time = time_of(front_keys[1]);
  }
} // namespace meltfront::cases
