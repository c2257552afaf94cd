#include <cases/error.h>
#include <verification/matrix/matrix.h>
#include <verification/measure/measure.h>
#include <verification/record/label.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    void require_case(const std::vector<PlannedCase> &planned, const std::string &pattern)
    {
      std::vector<std::string> names;
      for(const PlannedCase &one : planned)
        if(label_matches(pattern, one.name))
          return;
        else
          names.push_back(one.name);
      throw cases::InputError(
          fmt::format("the matrix has no case '{}'; the nearest is '{}'", pattern,
                      cases::nearest_name(pattern, names)));
    }

    /** Calls check() and says of what its complaint is. */
    template <typename Check>
    void checked(const Matrix &matrix, const char *kind, const std::string &which,
                 const Check &check)
    {
      try
      {
        check();
      }
      catch(const cases::InputError &error)
      {
        throw cases::InputError(fmt::format("matrix '{}', {} '{}': {}", matrix.name, kind,
                                            which, error.what()));
      }
    }
  } // namespace

  void check_findings(const Matrix &matrix, const MethodLookup &methods)
  {
    const std::vector<PlannedCase> planned = planned_cases(matrix);
    for(const Finding &finding : matrix.findings)
      for(const Evidence &evidence : finding.evidence)
        checked(matrix, "evidence", evidence.criterion.text,
                [&]
                {
                  require_case(planned, evidence.cases);
                  check_label(evidence.criterion.method, methods);
                  if(evidence.criterion.statistic != cases::Statistic::failure)
                    require_quantity(evidence.criterion.quantity);
                });
    for(const Picture &picture : matrix.pictures)
      checked(matrix, "picture", picture.caption,
              [&]
              {
                require_case(planned, picture.cases);
                for(const std::string &label : picture.runs)
                  check_label(label, methods);
                require_quantity(picture.quantity);
                require_quantity(picture.against);
              });
  }
} // namespace meltfront::verification
