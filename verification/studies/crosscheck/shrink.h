#ifndef meltfront_verification_studies_crosscheck_shrink_h
#define meltfront_verification_studies_crosscheck_shrink_h

#include <verification/studies/crosscheck/scene_draft.h>

#include <functional>

namespace meltfront::verification
{
  /** How much may be spent on making a scene smaller. */
  struct ShrinkBudget
  {
    int trials = 40;
    double seconds = 120;
  };

  /**
   * The simplest draft that still shows what the given one shows: each step of
   * SceneDraft::simpler() is taken for which `shows` holds, until none is left or the
   * budget is spent. Drafts that `shows` throws an InputError for are no cases.
   */
  SceneDraft shrunk(const SceneDraft &draft,
                    const std::function<bool(const SceneDraft &)> &shows,
                    const ShrinkBudget &budget = {});
} // namespace meltfront::verification

#endif
