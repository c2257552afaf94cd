#include <cases/case_file/criterion_parser.h>
#include <cases/error.h>
#include <verification/judge/finding_reader.h>

#include <fmt/format.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    using cases::PrmFile;
    using cases::PrmKind;

    constexpr int most_findings = 32;
    constexpr int most_pictures = 16;
    constexpr int most_evidence = 16;

    /** `CASES: METHOD: QUANTITY ...`; the case's name is cut off. */
    Evidence read_evidence(const PrmFile &prm, const std::string &here,
                           const std::string &key)
    {
      const std::string text = prm.get_text(here, key);
      const std::size_t colon = text.find(':');
      if(colon == std::string::npos)
        throw prm.error(here, key, "is not of the form CASE: METHOD: CRITERION");
      try
      {
        return {cases::trimmed(text.substr(0, colon)),
                cases::parse_criterion(cases::trimmed(text.substr(colon + 1)))};
      }
      catch(const cases::InputError &error)
      {
        throw prm.error(here, key, error.what());
      }
    }

    Finding read_finding(const PrmFile &prm, const std::string &here)
    {
      Finding finding;
      prm.require(here, "claim", "a finding is a sentence");
      finding.claim = prm.get_text(here, "claim");
      const std::vector<int> numbers = prm.given_numbers(here, "evidence");
      if(numbers.empty())
        throw prm.subsection_error(here, "has no 'evidence 1' that it could rest on");
      for(std::size_t i = 0; i < numbers.size(); ++i)
      {
        const std::string key = fmt::format("evidence {}", numbers[i]);
        if(numbers[i] != static_cast<int>(i) + 1)
          throw prm.error(here, key, fmt::format("comes without 'evidence {}'", i + 1));
        finding.evidence.push_back(read_evidence(prm, here, key));
      }
      try
      {
        pieces_of_claim(finding.claim, finding.evidence.size());
      }
      catch(const cases::InputError &error)
      {
        throw prm.error(here, "claim", error.what());
      }
      return finding;
    }

    Picture read_picture(const PrmFile &prm, const std::string &here)
    {
      for(const char *key : {"caption", "cases", "runs"})
        prm.require(here, key, "a picture says what it shows");
      Picture picture;
      picture.caption = prm.get_text(here, "caption");
      picture.cases = prm.get_text(here, "cases");
      picture.runs = cases::split_list(prm.get_text(here, "runs"), ';');
      picture.quantity = prm.get_text(here, "quantity");
      picture.against = prm.get_text(here, "against");
      return picture;
    }

    template <typename Thing, typename Read>
    std::vector<Thing> read_numbered(const PrmFile &prm, const char *name, int most,
                                     const Read &read)
    {
      std::vector<Thing> things;
      for(int i = 1; i <= most; ++i)
        if(const std::string here = fmt::format("{} {}", name, i); prm.opened(here))
          things.push_back(read(prm, here));
      return things;
    }
  } // namespace

  void declare_findings(PrmFile &prm)
  {
    for(int i = 1; i <= most_findings; ++i)
    {
      const std::string here = fmt::format("Finding {}", i);
      prm.declare(here, {"claim", PrmKind::text, "", "",
                         "What the runs show, one sentence; {2} stands for what "
                         "evidence 2 measured."});
      prm.declare_numbered(here,
                           {"evidence", PrmKind::text, "", "",
                            "CASE: METHOD: QUANTITY ... as in a case's criteria; "
                            "CASE may have * for any value of a varied key."},
                           most_evidence);
    }
    for(int i = 1; i <= most_pictures; ++i)
    {
      const std::string here = fmt::format("Picture {}", i);
      const auto declare = [&](const char *key, const char *value, const char *sentence) {
        prm.declare(here, {key, PrmKind::text, value, "", sentence});
      };
      declare("caption", "", "What is to be seen in the picture.");
      declare("cases", "", "A case; * for any value of a varied key.");
      declare("runs", "", "Labels, with semicolons; * for any value of an option.");
      declare("quantity", "front_rms", "Quantity of the table that is drawn.");
      declare("against", "h", "Quantity of the table over which it is drawn.");
    }
  }

  std::vector<Finding> read_findings(const PrmFile &prm)
  {
    return read_numbered<Finding>(prm, "Finding", most_findings, read_finding);
  }

  std::vector<Picture> read_pictures(const PrmFile &prm)
  {
    return read_numbered<Picture>(prm, "Picture", most_pictures, read_picture);
  }
} // namespace meltfront::verification
