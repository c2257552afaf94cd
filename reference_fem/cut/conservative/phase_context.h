#ifndef meltfront_reference_fem_cut_conservative_phase_context_h
#define meltfront_reference_fem_cut_conservative_phase_context_h

#include <reference_fem/cut/conservative/phase_operators.h>

#include <vector>

namespace meltfront::reference_fem::cut::conservative
{
  /** What the terms of one phase are assembled from and into. */
  struct PhaseAssembly::Context
  {
    int unknown(unsigned int node) const
    {
      return frame.temperature[index(phase)][node];
    }

    /** Of the pass before, by node. */
    const Values &guessed() const
    {
      return guess.temperatures[index(phase)];
    }

    Phase phase;
    const StepFrame &frame;
    const Front &front;
    const StageTime &stage;
    const Guess &guess;
    bool follow;
    const cases::PhaseProperties &material;
    bool singular; ///< the unknown lacks the singular part of sources
    PhaseOperators &result;
    std::vector<char> squares;         ///< by square: it is a SquareElement
    std::vector<Curvature> curvatures; ///< by triangle that needs it, else zero
  };
} // namespace meltfront::reference_fem::cut::conservative

#endif
