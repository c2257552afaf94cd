#include <cases/error.h>
#include <verification/ranks/method_on_ranks.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    const cases::SharedMethod &shared_form(const cases::Method &method, int ranks)
    {
      if(const auto *shared = dynamic_cast<const cases::SharedMethod *>(&method))
        return *shared;
      throw cases::Refusal(
          fmt::format("{} runs on one rank, not on {}", method.name(), ranks));
    }
  } // namespace

  MethodOnRanks::MethodOnRanks(const cases::Method &method, int ranks)
    : Method(method.name(), method.summary(), method.corrected_form())
    , method(method)
    , shared(shared_form(method, ranks))
    , ranks(ranks)
  {
  }

  std::vector<cases::Capabilities> MethodOnRanks::capabilities() const
  {
    return {shared.capabilities_on_ranks()};
  }

  std::vector<cases::OptionDeclaration> MethodOnRanks::option_declarations() const
  {
    return method.option_declarations();
  }

  std::map<std::string, std::string>
  MethodOnRanks::further_provenance(const cases::Options &options) const
  {
    return method.further_provenance(options);
  }

  cases::Demand MethodOnRanks::demand(const cases::Scene &scene,
                                      const cases::EffectSet &effects,
                                      const cases::Resolution &resolution) const
  {
    return shared.demand_on_ranks(scene, effects, resolution, ranks);
  }

  std::unique_ptr<cases::Run>
  MethodOnRanks::set_up(const cases::Scene &scene, const cases::EffectSet &effects,
                        const cases::Resolution &resolution) const
  {
    auto result = shared.set_up_on_ranks(scene, effects, resolution, ranks);
    run = result.get();
    return result;
  }
} // namespace meltfront::verification
