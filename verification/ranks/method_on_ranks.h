#ifndef meltfront_verification_ranks_method_on_ranks_h
#define meltfront_verification_ranks_method_on_ranks_h

#include <cases/shared_run.h>

namespace meltfront::verification
{
  /** A method as it is on several ranks: its runs are those that the ranks share. */
  class MethodOnRanks : public cases::Method
  {
  public:
    /** @throws cases::Refusal of a method whose runs ranks cannot share */
    MethodOnRanks(const cases::Method &method, int ranks);

    std::vector<cases::Capabilities> capabilities() const override;
    std::vector<cases::OptionDeclaration> option_declarations() const override;
    std::map<std::string, std::string>
    further_provenance(const cases::Options &options) const override;
    cases::Demand demand(const cases::Scene &scene, const cases::EffectSet &effects,
                         const cases::Resolution &resolution) const override;

    /** Of the run that was set up last, while it lasts. */
    cases::RankPart part() const
    {
      return run->part();
    }

  protected:
    std::unique_ptr<cases::Run>
    set_up(const cases::Scene &scene, const cases::EffectSet &effects,
           const cases::Resolution &resolution) const override;

  private:
    const cases::Method &method;
    const cases::SharedMethod &shared;
    int ranks;
    mutable const cases::SharedRun *run = nullptr;
  };
} // namespace meltfront::verification

#endif
