#ifndef meltfront_verification_run_temperature_probes_h
#define meltfront_verification_run_temperature_probes_h

#include <cases/exact_solution.h>
#include <cases/scene.h>
#include <cases/snapshot.h>
#include <verification/record/run_record.h>

#include <utility>
#include <vector>

namespace meltfront::verification
{
  /** Least and largest coordinate of a scene that depends on one (m). */
  std::pair<double, double> coordinate_range(const cases::Scene &scene,
                                             const cases::ExactSolution *exact);

  /**
   * Temperatures at places that are the same for every method and resolution: the middles
   * of 20 equal parts of the coordinate of a scene that depends on one (symmetric, or
   * with such an exact solution), else of 5 x 5 parts of a domain in the plane and 3 x 3
   * x 3 in space, as far as they lie inside.
   *
   * Along a coordinate the temperature is that of the polynomial through the six sites
   * around the place on its side of the front (fewer where there are fewer); sites of
   * runs in the plane and in space are averaged over shells first. In the plane and in
   * space it is that of the quadratic fitted to the sites nearby, of the phase of the
   * nearest.
   *
   * @param coordinates of the sites (x or r, m)
   * @param exact or null
   * @param spacing of the sites (m)
   */
  std::vector<TemperatureProbe> read_probes(const cases::Scene &scene,
                                            const cases::Snapshot &snapshot,
                                            const std::vector<double> &coordinates,
                                            const cases::ExactSolution *exact,
                                            double spacing);

  /** What a snapshot says of a place. */
  struct PlaceReading
  {
    double temperature = 0;
    double solid_fraction = 0;
  };

  /**
   * Temperature and solid fraction at any places of the domain. The temperature is read
   * as by read_probes(), of a smooth one to the third order in the spacing within a phase
   * (to the sixth along a coordinate), on walls by going on from the sites next to them.
   * The solid fraction is linear between the sites along a coordinate, and elsewhere
   * their mean with weights that fall to zero at 2.5 spacings: of the first order, within
   * 0 to 1.
   */
  std::vector<PlaceReading> read_places(const cases::Scene &scene,
                                        const cases::Snapshot &snapshot, double spacing,
                                        const std::vector<cases::Position> &places);
} // namespace meltfront::verification

#endif
