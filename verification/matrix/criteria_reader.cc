#include <cases/case_file/criterion_parser.h>
#include <cases/error.h>
#include <cases/options.h>
#include <verification/judge/criteria.h>
#include <verification/matrix/criteria_reader.h>
#include <verification/measure/measure.h>
#include <verification/record/label.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace meltfront::verification
{
  namespace
  {
    using cases::Criterion;
    using cases::Statistic;

    const std::string acceptance = "Acceptance";
    constexpr int most_criteria = 40;

    using Labels = std::map<std::string, std::set<int>>;

    /** Hold a criterion against the n at which a matrix runs what it is about.
     * @throws InputError with the reason alone. */
    void require_resolutions(const Criterion &criterion, const std::set<int> &n)
    {
      if(criterion.statistic == Statistic::order
         || criterion.statistic == Statistic::worst)
      {
        const std::size_t fewest = criterion.statistic == Statistic::order ? 4 : 1;
        const auto count = std::ranges::count_if(
            n, [&criterion](int one)
            { return one >= criterion.n_from && one <= criterion.n_to; });
        if(static_cast<std::size_t>(count) < fewest)
          throw cases::InputError(fmt::format(
              "asks for the {} of '{}', which needs {} resolutions; of n = {} it has {}",
              criterion.statistic == Statistic::order ? "order" : "worst",
              criterion.method, fewest, fmt::join(n, ", "), count));
      }
      else if(!n.contains(criterion.n))
        throw cases::InputError(
            fmt::format("asks for n = {}, at which no block runs '{}'; there are n = {}",
                        criterion.n, criterion.method, fmt::join(n, ", ")));
    }

    /** @throws InputError with the reason alone. */
    void require_runs(const Criterion &criterion, const Labels &labels)
    {
      const bool any = criterion.method == cases::any_method;
      std::vector<std::string> names;
      std::set<int> n;
      for(const auto &[label, resolutions] : labels)
      {
        names.push_back(label);
        if(any || label_matches(criterion.method, label))
          n.insert(resolutions.begin(), resolutions.end());
      }
      if(n.empty())
        throw cases::InputError(fmt::format(
            "is on '{}', which no block of the matrix runs at this case; the nearest is "
            "'{}'",
            criterion.method,
            cases::nearest_name(canonical_label(criterion.method), names)));
      require_resolutions(criterion, n);
      if(criterion.statistic == Statistic::failure)
        return;
      try
      {
        require_quantity(criterion.quantity);
      }
      catch(const cases::InputError &error)
      {
        throw cases::InputError(fmt::format("cannot be judged: {}", error.what()));
      }
    }

    /** What the matrix runs of a case, or of each of a family. */
    std::vector<Labels> labels_of(const cases::PrmFile &prm, const std::string &name,
                                  const Matrix &matrix)
    {
      std::vector<Labels> members;
      std::vector<std::string> names;
      for(const PlannedCase &planned : planned_cases(matrix))
      {
        names.push_back(planned.name);
        if(planned.name == name || in_family(name, planned.name))
          members.push_back(planned_labels(matrix, planned));
      }
      if(!members.empty())
        return members;
      throw prm.subsection_error(
          acceptance + "/" + name,
          fmt::format("names no case that the matrix runs; the nearest is '{}'",
                      cases::nearest_name(name.substr(0, 200), names)));
    }

    /** At least one of the members has to be run. @throws InputError with the reason
     * alone. */
    void require_runs(const Criterion &criterion, const std::vector<Labels> &members)
    {
      for(std::size_t i = 0; i < members.size(); ++i)
        try
        {
          return require_runs(criterion, members[i]);
        }
        catch(const cases::InputError &)
        {
          if(i + 1 == members.size())
            throw;
        }
    }

    MatrixCriterion read_criterion(const cases::PrmFile &prm, const std::string &name,
                                   const std::string &key,
                                   const std::vector<Labels> &members)
    {
      const std::string here = acceptance + "/" + name;
      try
      {
        MatrixCriterion one{name, cases::parse_criterion(prm.get_text(here, key)),
                            cases::trimmed(prm.error(here, key, "").what())};
        if(is_family(name) && one.criterion.method == cases::any_method)
          throw cases::InputError("is on any method: of a family, name one");
        require_runs(one.criterion, members);
        return one;
      }
      catch(const cases::InputError &error)
      {
        throw prm.error(here, key, error.what());
      }
    }
  } // namespace

  void declare_criteria(cases::PrmFile &prm)
  {
    prm.declare_in_each(
        acceptance, "CASE",
        {"criterion", cases::PrmKind::text, "", "",
         "METHOD: QUANTITY at n=N <= BOUND, and so on, as in a case file; "
         "METHOD[KEY=VALUE,...] for a method with options."},
        most_criteria);
  }

  std::vector<MatrixCriterion> read_criteria(const cases::PrmFile &prm,
                                             const Matrix &matrix)
  {
    std::vector<MatrixCriterion> criteria;
    for(const std::string &name : prm.subsections_of(acceptance))
    {
      const std::vector<Labels> members = labels_of(prm, name, matrix);
      for(const int i : prm.given_numbers(acceptance + "/" + name, "criterion"))
      {
        const MatrixCriterion one
            = read_criterion(prm, name, fmt::format("criterion {}", i), members);
        for(const MatrixCriterion &before : criteria)
          if(before.case_name == name && bound_the_same(before.criterion, one.criterion))
            throw cases::InputError(fmt::format("{} sets the bound of '{}' a second time",
                                                one.place, before.criterion.text));
        criteria.push_back(one);
      }
    }
    return criteria;
  }

  bool bound_the_same(const Criterion &one, const Criterion &other)
  {
    return canonical_label(one.method) == canonical_label(other.method)
           && quantity_text(one) == quantity_text(other)
           && ((std::isfinite(one.lower) && std::isfinite(other.lower))
               || (std::isfinite(one.upper) && std::isfinite(other.upper)));
  }
} // namespace meltfront::verification
