#ifndef meltfront_verification_matrix_case_record_h
#define meltfront_verification_matrix_case_record_h

#include <cases/case.h>
#include <verification/matrix/alloy_record.h>
#include <verification/matrix/moving_record.h>

#include <nlohmann/json_fwd.hpp>

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /** What the report says of a case: stored beside the runs, so that a report needs no
   * case file. */
  struct CaseRecord
  {
    std::string name;
    std::string title;
    std::string description;
    std::vector<std::string> tags;
    std::vector<std::string> limits;
    std::string units;    ///< `SI` or `normalised`
    std::string symmetry; ///< planar, cylindrical, spherical, none
    std::string shape;    ///< slab, box, ball, shell, outline
    int dimension = 1;
    cases::Position lower{}, upper{};
    double radius = 0;
    double inner_radius = 0; ///< of a shell
    /** Points along an outline (m) and its length that n divides; else empty and 0. */
    std::vector<double> outline_x, outline_y;
    double reference_length = 0;
    cases::Material material;
    std::optional<AlloyRecord> alloy;
    std::optional<MovingRecord> moving;  ///< where no heat is conducted
    std::string initial_state;           ///< in words and numbers
    std::vector<std::string> boundaries; ///< `x_min: fixed temperature -10`
    std::vector<cases::Position> source_positions;
    std::vector<std::string> sources; ///< `at (0, 0): -148.45 W/m`
    double start_time = 0, end_time = 1;
    bool steady = false;        ///< poisson: no time passes
    bool changes_phase = true;  ///< else there is no front
    std::string heat_release;   ///< formula; empty: none
    std::string inclusion;      ///< where, and its conductivity; empty: none
    std::string exact;          ///< description of the exact solution; empty: none
    double front_exact_end = 0; ///< exact front at the end time (NaN: none)
    /** Heat capacity of the phase at the wall x = 0 times that wall's difference from the
     * melting point, over the latent heat; NaN without a plane exact solution. */
    double stefan_number = std::numeric_limits<double>::quiet_NaN();
    std::string variation_of; ///< the case that a matrix varies to this one; empty: none
    /** Keys with their subsections, and the values that the matrix gives them. */
    std::vector<std::pair<std::string, std::string>> variation;
    std::optional<cases::Reference> reference; ///< where there is no exact solution
    cases::Measurement measurement;
    std::vector<cases::Criterion> criteria;
    std::vector<cases::PrintedValue> printed;
    std::map<std::string, std::string> printed_figures; ///< by cases::figure_names
    std::string text, hash;                             ///< the case file and its SHA-256
  };

  CaseRecord make_case_record(const cases::Case &c);

  void to_json(nlohmann::json &json, const CaseRecord &record);
  void from_json(const nlohmann::json &json, CaseRecord &record);
} // namespace meltfront::verification

#endif
