#ifndef meltfront_verification_record_stored_case_h
#define meltfront_verification_record_stored_case_h

#include <cases/case.h>
#include <cases/case_file/vary_case.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace meltfront::verification
{
  /**
   * A case as it is stored beside its runs: by its text, from which it is read again, so
   * that a report needs no case file, and by what the text does not say.
   */
  struct StoredCase : cases::Case
  {
    std::string hash{}; ///< SHA-256 of the text
    std::string
        variation_of{}; ///< the case that a matrix varies to this one; empty: none
    cases::CaseSettings variation{}; ///< what the matrix gives other values

    const std::string &name() const
    {
      return scene.name;
    }
  };

  StoredCase stored_case(const cases::Case &c, const std::string &variation_of = "",
                         const cases::CaseSettings &variation = {});

  void to_json(nlohmann::json &json, const StoredCase &record);

  /** Reads the text. @throws InputError if it is no case file of this program */
  void from_json(const nlohmann::json &json, StoredCase &record);
} // namespace meltfront::verification

#endif
