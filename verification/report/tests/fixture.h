#ifndef meltfront_verification_report_tests_fixture_h
#define meltfront_verification_report_tests_fixture_h

#include <verification/judge/matrix_result.h>
#include <verification/record/temporary_directory.h>

#include <string>

namespace meltfront::verification::fixture
{
  /** A finished run whose front error is exactly `factor` h^`order`, h = 1/n, and whose
   * CPU time is `seconds` at n = 20 and grows with n squared. */
  RunRecord run(const std::string &case_name, const std::string &label, int n,
                double factor, double order, double seconds);

  StoredCase plane_case(const std::string &name);

  StoredCase sink_case(const std::string &name);

  /** What a wall prescribes, by its words. */
  void set_wall(StoredCase &record, cases::Side side, cases::BoundaryKind kind,
                const std::string &expression);

  /**
   * Two cases and three methods: exact orders, a failed and a refused run, a run with NaN
   * in all of its results, two seeds, titles and messages full of `<>&"'`, criteria that
   * hold and fail, printed values, hard cases.
   */
  MatrixResult matrix();

  /** A directory of its own, removed at the end. */
  class Directory
  {
  public:
    std::string path() const;
    /** A file in it; fails the test if there is none. */
    std::string read(const std::string &file) const;
    bool has(const std::string &file) const;

  private:
    TemporaryDirectory directory;
  };

  /** How often a text occurs in another. */
  std::size_t count(const std::string &in, const std::string &what);
} // namespace meltfront::verification::fixture

#endif
