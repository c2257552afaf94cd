#ifndef meltfront_verification_app_manual_markdown_h
#define meltfront_verification_app_manual_markdown_h

#include <verification/report/page/markup.h>

#include <string>

namespace meltfront::verification
{
  /**
   * Markdown (CommonMark with tables, read by cmark-gfm) as a part of a page. HTML in it
   * is left out. Links to other files of the repository, which a page by itself does not
   * have, become plain words; pictures are left out.
   *
   * @param level that its first level of headings gets, 2 to 6
   * @param with_title whether a heading of the first level that opens the text is kept
   */
  Markup markdown(const std::string &source, int level, bool with_title = true);

  /** The text of a file of the source tree, by its path in it.
   * @throws cases::OutputError if it cannot be read */
  std::string source_text(const std::string &path);
} // namespace meltfront::verification

#endif
