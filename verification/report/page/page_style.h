#ifndef meltfront_verification_report_page_page_style_h
#define meltfront_verification_report_page_page_style_h

#include <verification/report/page/markup.h>

#include <string>

namespace meltfront::verification
{
  /** The head of a page, with the style sheet: light and dark, screens from 390 pixels
   * on, print. */
  Markup page_head(const std::string &title);
} // namespace meltfront::verification

#endif
