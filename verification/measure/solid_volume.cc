#include <verification/measure/formulas/run_statistics.h>
#include <verification/measure/measure.h>

#include <fmt/format.h>

#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    /** The volume that is solid at the end and at the intermediate times, there
     * interpolated between steps; the farthest that it fell back, over its net change. */
    class SolidVolume : public Measure
    {
    public:
      using Measure::Measure;

      void observe(const Sighting &sighting) override
      {
        times.push_back(sighting.snapshot.time);
        volumes.push_back(sighting.solid_volume);
        if(run.scene.changes_phase())
          course.add(sighting.solid_volume);
        if(sighting.at_end)
          values["solid_volume_end"] = sighting.solid_volume;
      }

      Results results() const override
      {
        Results all = values;
        const std::vector<double> &intermediate_times
            = run.the_case.measurement.intermediate_times;
        const double tolerance = 1e-9 * (run.scene.end_time - run.scene.start_time);
        for(std::size_t i = 0; i < intermediate_times.size(); ++i)
          all[fmt::format("solid_volume_{}", i + 1)]
              = interpolated(times, volumes, intermediate_times[i], tolerance);
        const double net = course.net_advance();
        if(net != 0)
          all["solid_volume_backsteps"]
              = course.largest_backstep(net < 0) / std::abs(net);
        return all;
      }

    private:
      std::vector<double> times, volumes;
      FrontCourse course;
    };

    Quantity difference(const std::string &name, const std::string &where)
    {
      Quantity quantity = error_quantity(name, "solid's error, " + where, "volume");
      quantity.from_reference = true;
      return quantity;
    }
  } // namespace

  MeasureKind solid_volume_over_time()
  {
    std::vector<Quantity> list = with_differences(
        value_quantity("solid_volume_end", "solid, end", "volume", Shown::without_exact));
    list[0].digits = 8;
    list[1] = difference("solid_volume_end_error", "end");
    list[2].heading = "the same in error bars";
    list[2].shown = Shown::always;
    for(int intermediate = 1; intermediate <= cases::most_intermediate_times;
        ++intermediate)
    {
      auto at_intermediate_time = with_differences(
          hidden_quantity(fmt::format("solid_volume_{}", intermediate)));
      at_intermediate_time[1] = difference(at_intermediate_time[1].name,
                                           fmt::format("time {}", intermediate));
      list.insert(list.end(), at_intermediate_time.begin(), at_intermediate_time.end());
    }
    list.push_back(difference("solid_volume_rms_error", "RMS"));
    list.push_back(value_quantity("solid_volume_backsteps", "solid's backsteps",
                                  "relative", Shown::without_exact));
    return {list, MeasuredScenes::with_heat, start<SolidVolume>};
  }
} // namespace meltfront::verification
