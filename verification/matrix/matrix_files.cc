#include <cases/case_file/criterion_parser.h>
#include <cases/error.h>
#include <verification/judge/criteria.h>
#include <verification/judge/reference.h>
#include <verification/matrix/matrix_files.h>
#include <verification/record/json_values.h>
#include <verification/record/label.h>
#include <verification/record/provenance.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace meltfront::verification
{
  namespace
  {
    using nlohmann::json;

    json bound_of(const CriterionResult &criterion)
    {
      if(std::isinf(criterion.lower))
        return json_of(criterion.upper);
      if(std::isinf(criterion.upper))
        return json_of(criterion.lower);
      return {json_of(criterion.lower), json_of(criterion.upper)};
    }

    const char *relation_of(const CriterionResult &criterion)
    {
      if(std::isinf(criterion.lower))
        return "<=";
      return std::isinf(criterion.upper) ? ">=" : "in";
    }

    /** A criterion of the matrix joins those that the case itself brings. */
    void add_criterion(MatrixResult &result, const std::string &case_name,
                       const std::string &text)
    {
      if(is_family(case_name))
        result.family_criteria.push_back({case_name, cases::parse_criterion(text)});
      for(StoredCase &record : result.cases)
        if(record.name() == case_name)
          record.criteria.push_back(cases::parse_criterion(text));
    }

    /** The record of a planned run, or one that says that it is missing. */
    RunRecord read_run(const std::string &directory, const json &planned)
    {
      const std::string path = directory + "/" + planned.at("file").get<std::string>();
      if(std::filesystem::exists(path))
        return read_json(path).get<RunRecord>();
      RunRecord record;
      record.case_name = planned.at("case");
      record.method = planned.at("method");
      record.label = planned.at("label");
      record.n = whole_number_in<int>(planned.at("n"));
      record.seed = whole_number_in<std::uint64_t>(planned.at("seed"));
      record.threads = whole_number_in<int>(planned.at("threads"));
      record.message = "it has not been run yet";
      return record;
    }
  } // namespace

  void write_plan(const std::string &directory, const Matrix &matrix,
                  const std::vector<StoredCase> &cases,
                  const std::vector<PlannedRun> &runs, const std::string &program_version)
  {
    json names = json::array(), list = json::array(), criteria = json::array();
    for(const StoredCase &record : cases)
    {
      write_json(fmt::format("{}/cases/{}.json", directory, record.name()), record);
      names.push_back(record.name());
    }
    for(const MatrixCriterion &one : matrix.criteria)
      criteria.push_back({{"case", one.case_name}, {"text", one.criterion.text}});
    for(const PlannedRun &run : runs)
      list.push_back({{"case", run.case_name},
                      {"method", run.method},
                      {"label", run.label},
                      {"n", run.resolution.n},
                      {"seed", run.resolution.seed},
                      {"threads", run.resolution.threads},
                      {"file", run.file()}});
    write_json(directory + "/matrix.json", {{"name", matrix.name},
                                            {"title", matrix.title},
                                            {"description", matrix.description},
                                            {"remarks", matrix.remarks},
                                            {"hard_cases", matrix.hard_cases},
                                            {"date", current_date()},
                                            {"program_version", program_version},
                                            {"cases", names},
                                            {"criteria", criteria},
                                            {"findings", matrix.findings},
                                            {"pictures", matrix.pictures},
                                            {"runs", list}});
  }

  void write_summary(const std::string &directory, const MatrixResult &result)
  {
    json criteria = json::array();
    for(const CriterionResult &criterion : result.criteria)
      criteria.push_back({{"case", criterion.case_name},
                          {"method", criterion.method},
                          {"quantity", criterion.quantity},
                          {"value", json_of(criterion.value)},
                          {"bound", bound_of(criterion)},
                          {"relation", relation_of(criterion)},
                          {"passed", criterion.passed},
                          {"remark", criterion.remark},
                          {"expected_failure", criterion.expected_failure}});
    json findings = json::array();
    for(const FindingResult &finding : result.findings)
      findings.push_back({{"claim", claim_text(finding)}, {"holds", finding.holds()}});
    json stability = json::array();
    for(const StabilityVerdict &verdict : result.stability)
    {
      json measures = json::array();
      for(const StabilityMeasure &measure : verdict.measures)
        measures.push_back({{"name", measure.name},
                            {"value", json_of(measure.value)},
                            {"bound", measure.bound}});
      stability.push_back({{"case", verdict.case_name},
                           {"method", verdict.label},
                           {"n", verdict.n},
                           {"verdict", verdict.verdict},
                           {"reason", verdict.reason},
                           {"measures", measures}});
    }
    write_json(directory + "/summary.json", {{"matrix", result.name},
                                             {"date", result.date},
                                             {"program_version", result.program_version},
                                             {"passed", result.passed},
                                             {"criteria", criteria},
                                             {"findings", findings},
                                             {"stability", stability},
                                             {"omissions", result.omissions}});
  }

  MatrixResult load_matrix_result(const std::string &directory)
  {
    const std::string path = directory + "/matrix.json";
    try
    {
      const json matrix = read_json(path);
      MatrixResult result;
      result.name = matrix.at("name");
      result.title = matrix.at("title");
      result.description = matrix.at("description");
      result.remarks = matrix.value("remarks", std::vector<std::string>());
      result.hard_cases = matrix.at("hard_cases");
      result.date = matrix.at("date");
      result.program_version = matrix.at("program_version");
      if(matrix.contains("findings")) // older plans lack them
      {
        matrix.at("findings").get_to(result.claims);
        matrix.at("pictures").get_to(result.pictures);
      }
      for(const auto &name : matrix.at("cases"))
        result.cases.push_back(
            read_json(fmt::format("{}/cases/{}.json", directory, name.get<std::string>()))
                .get<StoredCase>());
      if(matrix.contains("criteria")) // older plans leave them to the cases
        for(const auto &criterion : matrix.at("criteria"))
          add_criterion(result, criterion.at("case"), criterion.at("text"));
      for(const auto &run : matrix.at("runs"))
        result.runs.push_back(read_run(directory, run));
      compare_with_references(result);
      evaluate(result);
      return result;
    }
    catch(const json::exception &error)
    {
      throw cases::OutputError(
          fmt::format("{} or a record beside it is not as this program writes it: {}",
                      directory, error.what()));
    }
  }
} // namespace meltfront::verification
