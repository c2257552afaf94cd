#ifndef meltfront_reference_fem_cut_tests_cut_support_h
#define meltfront_reference_fem_cut_tests_cut_support_h

#include <cases/exact/line_sink.h>
#include <cases/method.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <memory>
#include <vector>

namespace meltfront::reference_fem::tests
{
  /** The first moment of the solid at the end, with x + 2 y (m^3). */
  double moment_of_solid(const Course &course);

  /** Whether the solid only grows. */
  bool grows(const Course &course);

  /** A run of `fem-cut`, by the extension unless the options name a scheme. */
  Course run_cut(const cases::Scene &scene, int n, const OptionTexts &options = {});

  /** Time at which the runs of sink_in_disk() end (s). */
  inline constexpr double end_of_sink = 475000;

  /** A line sink on the axis of a disk of warm water with the exact rim. */
  cases::Scene sink_in_disk(const std::shared_ptr<const cases::LineSink> &exact);

  /** Root mean square over the steps of the front's error, read from the solid's area,
   * over the exact radius at the end. */
  double front_error(const Course &course, const cases::LineSink &exact);

  /** Disks of ice, each with the logarithmic profile of its sink, in insulated liquid at
   * the melting temperature and above. */
  cases::Scene disks(const std::vector<cases::Position> &places, double duration,
                     const cases::Position &lower = {-1, -0.5, 0},
                     const cases::Position &upper = {1, 0.5, 0});
} // namespace meltfront::reference_fem::tests

#endif
