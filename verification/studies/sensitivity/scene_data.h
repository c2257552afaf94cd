#ifndef meltfront_verification_studies_sensitivity_scene_data_h
#define meltfront_verification_studies_sensitivity_scene_data_h

#include <cases/case.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A datum of a scene: what a key of its case says, or one number of several. */
  struct Datum
  {
    std::string key;   ///< with its subsections: `Scene/Material/latent heat`
    std::string name;  ///< without `Scene/`, with `[2]` for the second of several numbers
    std::string value; ///< as the case says it
    /** What a relative change refers to: the number itself; of temperatures the range of
     * initial and wall temperatures (their zero is arbitrary); of places the domain's
     * side; 1 of an expression, which is multiplied by 1 + s as a whole. */
    double scale = 1;
    std::string of_scale{}; ///< `of itself`, `of the range 12 K`, `of the side 0.1 m`

    /** The value with a relative change of s, as a case file takes it. */
    std::string changed(double s) const;

    enum class Kind
    {
      number,
      component, ///< one of several numbers, `index`
      shifted,   ///< an expression of a temperature: s times the scale is added
      scaled     ///< any other expression
    };
    Kind kind = Kind::number;
    std::size_t index = 0;
  };

  /**
   * The data of a case's scene: every number, and every expression of a temperature,
   * flux, power or property, that the case sets in domain, material, initial state,
   * walls, sources and inclusion. Constants of nature, numbers of dimensions and keys
   * that belong to effects which the case file switches off are none; tables of
   * properties are left out.
   * @param left_out gets a sentence for every key that could be varied in principle and
   * is not
   */
  std::vector<Datum> data_of(const cases::Case &c, std::vector<std::string> &left_out);
} // namespace meltfront::verification

#endif
