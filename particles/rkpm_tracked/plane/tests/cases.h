#ifndef meltfront_particles_rkpm_tracked_plane_tests_cases_h
#define meltfront_particles_rkpm_tracked_plane_tests_cases_h

#include <cases/tests/support/course.h>
#include <cases/tests/support/scenes.h>
#include <particles/rkpm_tracked/plane/heat.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::particles::rkpm_tracked
{
  using namespace test_support;

  /** Ice around a line sink between two rims with exact temperatures, R from 0.4 to 0.6;
   * k_s = 2, all else one, far away 0.5. */
  cases::Scene line_sink_annulus();

  /** Solid that grows into undercooled melt in a disk, R from 0.2 on; properties one. */
  cases::Scene frank_disk(double end_time);

  using PlaneFunction = std::function<double(const cases::Position &)>;

  /** An insulated box with a front where `front` is zero, negative in solid; properties
   * one. */
  cases::Scene insulated_box(const cases::Position &upper, const PlaneFunction &front,
                             const PlaneFunction &temperature, double end_time);

  /** The two disks of ice around two sinks of the case merging-disks. */
  cases::Scene merging_disks(double end_time);

  /** What is kept of a run's snapshots. */
  struct PlaneRecord : cases::Observer
  {
    struct Frame
    {
      double time, solid_area, defect, coldest, hottest, mean_radius, roundness;
      std::size_t front_points;
      double latent, sensible, through_walls, vanished;
    };

    bool wants(long, double) override
    {
      return true;
    }
    void observe(const cases::Snapshot &snapshot) override;
    void note(double time, const std::string &event) override;

    std::vector<Frame> frames;
    std::vector<std::string> notes;
    std::vector<double> temperature;
    std::array<std::vector<double>, 2> front; ///< points of the last frame
    cases::Cost cost;
  };

  /** Run the method in two dimensions. */
  PlaneRecord run_plane(const cases::Scene &scene, int n, const OptionTexts &options = {},
                        int threads = 1);

  /** A front around the origin with some points on a circle, solid inside. */
  PlaneFront circle(double radius, int points, const PlanePoint &centre = {0, 0});
} // namespace meltfront::particles::rkpm_tracked

#endif
