#ifndef meltfront_verification_report_chapters_scene_words_h
#define meltfront_verification_report_chapters_scene_words_h

#include <cases/scene.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  // What a scene prescribes, in words and numbers.

  /** `fixed temperature -10`. */
  std::string words(const cases::Boundary &boundary);

  /** The same in the room beside a wall: `T = -10`. */
  std::string short_words(const cases::Boundary &boundary);

  /** `x_min: fixed temperature -10`, for each side. */
  std::vector<std::string> wall_words(const cases::Scene &scene);

  /** `at (0, 0): -148.45 W/m`, for each source. */
  std::vector<std::string> source_words(const cases::Scene &scene);

  std::string words(const cases::InitialState &state);

  std::string words(const cases::Inclusion &inclusion);
} // namespace meltfront::verification

#endif
