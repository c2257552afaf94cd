#ifndef meltfront_cases_case_file_exact_construction_h
#define meltfront_cases_case_file_exact_construction_h

#include <cases/case_file/key_builders.h>
#include <cases/case_file/prm_file.h>
#include <cases/error.h>
#include <cases/scene.h>

#include <fmt/format.h>

#include <memory>

namespace meltfront::cases
{
  /** Construct a solution; what it complains of gets file, line and key. */
  template <typename Solution, typename... Arguments>
  std::shared_ptr<const Solution> construct(const PrmFile &prm,
                                            const Arguments &...arguments)
  {
    const auto located = [&prm](const std::exception &error)
    {
      return prm.error(exact_keys, "kind",
                       fmt::format("gives no solution: {}", error.what()));
    };
    try
    {
      return std::make_shared<const Solution>(arguments...);
    }
    catch(const InputError &error)
    {
      throw located(error);
    }
    catch(const NumericalError &error)
    {
      throw located(error);
    }
  }

  /** The temperature far away: as given, else the initial one. */
  double far_temperature(const PrmFile &prm, const Scene &scene);
} // namespace meltfront::cases

#endif
