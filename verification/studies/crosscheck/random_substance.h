#ifndef meltfront_verification_studies_crosscheck_random_substance_h
#define meltfront_verification_studies_crosscheck_random_substance_h

#include <verification/studies/crosscheck/random_stream.h>
#include <verification/studies/crosscheck/scene_draft.h>

namespace meltfront::verification
{
  /** The numbers of a scene that its parts share. */
  struct Substance
  {
    double solid_conductivity = 1, liquid_conductivity = 1;
    double solid_capacity = 1, liquid_capacity = 1; ///< per mass
    double solid_density = 1, liquid_density = 1;
    double latent_heat = 0;
    double melting_temperature = 0;
    double temperature_scale = 1; ///< how far temperatures lie from the melting point
    double length = 1;            ///< of the domain
    bool si = false;

    /** Geometric mean of the phases' diffusivities. */
    double diffusivity() const;

    /** Geometric mean of the phases' conductivities. */
    double conductivity() const;
  };

  /** A substance of unit scales, or one like a metal, water or wax; its phases alike or
   * not, Stefan numbers from 1e-2 to 1e2. */
  Substance random_substance(RandomStream &random, bool changes_phase);

  /** Four significant digits, so that what a file says is what was meant. */
  double rounded(double value);

  /** The number in the words of a file. */
  std::string words(double value, int digits = 4);

  /** Write its keys. */
  void write_substance(const Substance &substance, bool changes_phase, SceneDraft &draft);
} // namespace meltfront::verification

#endif
