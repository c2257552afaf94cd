#ifndef meltfront_verification_measure_checks_given_heat_h
#define meltfront_verification_measure_checks_given_heat_h

#include <cases/scene.h>
#include <verification/measure/checks/scene_quadrature.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** The integral of a power over time, by Gauss's rule of three points between the times
   * at which the power may jump or bend, and sixty-four more. */
  class HeatOverTime
  {
  public:
    /**
     * @param power W, W/m or W/m^2
     * @param breakpoints times at which it may jump or bend (s)
     */
    HeatOverTime(std::function<double(double time)> power, double start, double end,
                 const std::vector<double> &breakpoints);

    /** Heat from the start to a time between start and end. */
    double operator()(double time) const;

    /** Heat over the whole time where all of it counts as positive. */
    double gross() const
    {
      return all;
    }

  private:
    std::function<double(double)> power;
    std::vector<double> ends, sums; ///< of the intervals; heat up to them
    double all = 0;
  };

  /**
   * The heat that the data of a scene give to it in the course of time, in the measure of
   * the scene, without a solution of it: quadrature of its fluxes over walls and of the
   * heat released over the domain.
   */
  class GivenHeat
  {
  public:
    explicit GivenHeat(const cases::Scene &scene);

    /** Why the heat through walls is not known from the data; empty if it is. */
    std::string unknown_walls;
    /** Why the heat of sources and of release is not known; empty if it is. */
    std::string unknown_sources;

    /** Whether a flux, or the release, varies in space or time, so that methods integrate
     * it by quadratures of their own. */
    bool walls_vary = false, sources_vary = false;

    /** Heat in through all walls from the start to a time. */
    double through_walls(double time) const;

    /** Heat of point sources and heat released from the start to a time. */
    double from_sources(double time) const;

    /** What of either kind enters and leaves in the whole time. */
    double gross_walls() const;
    double gross_sources() const;

  private:
    std::vector<QuadraturePoint> points_for(
        const cases::Field &field, double measure,
        const std::function<std::vector<QuadraturePoint>(int divisions)> &points) const;
    void add_walls();
    void add_release();

    const cases::Scene &scene;
    std::vector<HeatOverTime> walls;
    std::optional<HeatOverTime> released;
    double gross_of_points = 0;
  };
} // namespace meltfront::verification

#endif
