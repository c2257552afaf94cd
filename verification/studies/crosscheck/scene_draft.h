#ifndef meltfront_verification_studies_crosscheck_scene_draft_h
#define meltfront_verification_studies_crosscheck_scene_draft_h

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** A case file in the making: its keys and values, in the order in which they were set,
   * and the ways in which the case can be made simpler. */
  class SceneDraft
  {
  public:
    /**
     * Set a key of a subsection (`Scene/Walls/x_min`; empty: the file's own), anew or in
     * place of an earlier value.
     * @param simpler values that say less than this one, the simplest first
     */
    void set(const std::string &subsection, const std::string &key,
             const std::string &value, const std::vector<std::string> &simpler = {});

    /** The value of a key, empty if it is not set. */
    std::string value(const std::string &subsection, const std::string &key) const;

    bool has(const std::string &subsection) const;

    /** Take out a subsection with those in it, or one key. */
    void remove(const std::string &subsection);
    void remove(const std::string &subsection, const std::string &key);

    /** The text of the case file; each line of `comment` stands at its top behind a #. */
    std::string text(const std::string &comment = "") const;

    /**
     * The drafts that are one step simpler: an effect, a wall or a property of the liquid
     * taken out, a simpler value. Some may be no valid cases.
     */
    std::vector<SceneDraft> simpler() const;

  private:
    struct Entry
    {
      std::string subsection, key, value;
      std::vector<std::string> simpler;
    };

    std::vector<Entry> entries;
  };
} // namespace meltfront::verification

#endif
