#ifndef meltfront_verification_studies_crosscheck_state_course_h
#define meltfront_verification_studies_crosscheck_state_course_h

#include <cases/method.h>
#include <cases/scene.h>
#include <verification/measure/formulas/run_statistics.h>
#include <verification/measure/formulas/site_coordinates.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Times of a run, from its start to its end, at which methods are compared: the k-th
   * is k/course_intervals of the duration. */
  inline constexpr int course_intervals = 24;

  /** What is compared of a run: quantities by name at the times of the course, NaN where
   * there was no snapshot or the quantity is not defined. */
  struct StateCourse
  {
    std::map<std::string, std::vector<double>> quantities;
    /** By how much some may be misread; of the same times. */
    std::map<std::string, std::vector<double>> misreadings;
    double lowest = 0, highest = 0; ///< temperature of all sites at all snapshots
  };

  void to_json(nlohmann::json &json, const StateCourse &course);
  void from_json(const nlohmann::json &json, StateCourse &course);

  /**
   * Follows a run and reads from each snapshot, by sums over the sites with their weights
   * w, what every method can be asked for:
   *
   * solid fraction: sum of w f over sum of w;
   * heat: sum of w rho (c (T - T_m) + L (1 - f)), with c = f c_s + (1 - f) c_l, over sum
   * of w; of substances whose phases have one density;
   * temperature, and solid fraction, `near x = k/m`: means with the weights
   * w B(x), B Bernstein's polynomials of degree m (3 along a line, else 2) in each
   * coordinate, or in the radius of a scene that is symmetric about a point or an axis.
   *
   * Along a coordinate, a site beside a wall of given temperature stands for matter up to
   * the wall, where a layer of the other phase may be that no site shows: the mean
   * temperature may be misread by half the site's weight times its distance (K) from the
   * wall's temperature, of a site of both phases that of melting if that is larger; the
   * solid fraction, of a site that shows nothing of the wall's phase, by half its weight;
   * the heat by both. Where the sites of a round domain have another volume than it, and
   * where the method's own book lacks heat, all quantities may be misread by the relative
   * difference times their scale: of the volume; of the lacking heat over all that lies
   * between coldest solid and warmest liquid. (A front whose layer takes up less heat
   * than it should by E goes too far by the volume E/(rho (L + c dT)).)
   *
   * Without change of phase there are temperatures only. Values at the times of the
   * course are interpolated by cubics between the steps around them.
   */
  class CourseObserver : public cases::Observer
  {
  public:
    explicit CourseObserver(const cases::Scene &scene);

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;
    void observe(const cases::Snapshot &snapshot) override;

    StateCourse course() const;

  private:
    /** What a site beside a wall of given temperature does not tell, per volume. */
    struct Hidden
    {
      double temperature = 0; ///< K
      double solid = 0;       ///< solid fraction
      double heat = 0;        ///< J/m^3
    };

    std::vector<std::pair<cases::Side, double>> walls_along_line() const;
    std::optional<double> wall_beside(double time, double x) const;
    double front_at_wall(const cases::Snapshot &snapshot, std::span<const double> middles,
                         double wall) const;
    Hidden hidden_at(const cases::Snapshot &snapshot, std::size_t site, double x) const;
    void add_means(const cases::Snapshot &snapshot, const std::string &coordinate,
                   std::span<const double> values, double lower, double upper,
                   std::span<const Hidden> hidden);
    void add(const std::string &name, double value);
    double share_lacking(const cases::Snapshot &snapshot, double of_sites) const;
    double heat_scale() const;

    cases::Scene scene;
    SiteCoordinates coordinates;
    SnapshotTimes intermediate_times;
    std::vector<double> times;
    std::map<std::string, std::vector<double>> values;  ///< one for each of the times
    std::map<std::string, std::vector<double>> misread; ///< the same
    double lowest, highest;
    double spacing = 0;
    double volume;            ///< of the domain
    double share_misread = 0; ///< of what the snapshot's sites and book lack
    double beside_front = 0;  ///< K, of temperatures while a front stands at a wall
  };
} // namespace meltfront::verification

#endif
