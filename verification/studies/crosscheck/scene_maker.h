#ifndef meltfront_verification_studies_crosscheck_scene_maker_h
#define meltfront_verification_studies_crosscheck_scene_maker_h

#include <verification/studies/crosscheck/random_course.h>
#include <verification/studies/crosscheck/random_stream.h>
#include <verification/studies/crosscheck/random_substance.h>
#include <verification/studies/crosscheck/scene_draft.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Makes one scene, part by part; each part finds what those before it chose. */
  class SceneMaker
  {
  public:
    SceneMaker(std::uint64_t seed, int index, int dimension);

    SceneDraft make();

  private:
    enum class Problem
    {
      pure, ///< a pure substance that melts or freezes
      alloy,
      heat, ///< no phase changes
      steady
    };

    /** The subsection that several parts write. */
    static constexpr const char *initial = "Scene/Initial state";

    bool changes_phase() const;

    /** About the time in which a front crosses a part of the domain, or heat spreads. */
    void choose_duration();

    /** The melting temperature and so much more. */
    double warmer(double shares) const;

    /** In a steady scene nothing depends on time. */
    Course over_time(double from, double to);

    double random_sign();

    // In random_domain.cc:
    void choose_domain();

    /** Make a box in the plane the half section of a body. */
    bool turn_about_axis();
    bool round() const;
    bool plane_or_less() const;
    std::string radius_or_x() const;
    std::string list(const std::array<double, 3> &values) const;
    std::vector<std::string> sides() const;

    // In random_material.cc:

    /** An alloy has one density, and heat of melting down to its coldest mush, which is
     * less than 20 scales below the melting point. */
    void make_alloy_of_substance();

    void choose_material();
    void choose_inclusion();
    void choose_solute();

    /** Let conductivities and heat capacities depend on temperature, by tables. */
    void vary_properties();

    /** Let it melt over a range of temperatures. */
    void spread_melting();

    // In random_motion.cc:

    /** Let the densities differ: solid about the origin, or a wall there that is cold,
     * and liquid beyond it, which leaves through the other wall. */
    void displace_liquid();

    // In random_start.cc:
    void choose_start();

    /** Solid on one side of a plane, a circle or a sphere, with linear profiles. */
    void choose_start_with_front(int kind, double sign, double from, double to);

    /** Let two bodies touch at the start: solid and liquid at its front, or two parts of
     * one phase. */
    void let_bodies_touch();

    // In random_bends.cc:

    /** Give what starts with a front one that is bent: an ellipse, two disks, a wave. */
    void bend_front();

    /** Bound disks, and what a smooth outline bounds, by a polygon in place of it. */
    void bound_by_polygon();
    std::vector<std::array<double, 2>> polygon(double size);

    /** Less than zero on the near side, about a distance. */
    std::string bent_level();

    /** Let what walls of bodies in the plane and in space prescribe vary along them, as
     * well as over time. */
    void vary_along_walls();
    std::string patch(const std::string &along);

    // In random_walls.cc:
    void choose_walls();
    void choose_wall(const std::string &here, const std::string &side);
    void exchange_heat(const std::string &here);

    /** Let walls of an alloy exchange heat with surroundings more often than others do.
     */
    void surround_alloy();
    void radiate(const std::string &here, double coefficient);
    void hold(const std::string &here, const std::string &side);

    /** More often than not on the other side of the melting point than the start. */
    double wall_temperature();

    // In random_sources.cc:
    void choose_sources();
    void choose_volumetric_source();
    void move_sources();

    RandomStream random;
    int dimension;
    Problem problem;
    Substance substance;
    SceneDraft draft;
    std::string shape, symmetry, coordinate;
    int shape_dimension = 1;
    double first = 0, last = 1; ///< of the coordinate
    std::array<double, 3> upper{};
    double duration = 1;
    double start_sign = 0;  ///< 1 liquid, -1 solid, 0 both
    bool unbounded = false; ///< something drives temperatures without a bound
    bool held = false;      ///< a wall holds the temperature
  };
} // namespace meltfront::verification

#endif
