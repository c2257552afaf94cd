#ifndef meltfront_verification_report_page_page_style_h
#define meltfront_verification_report_page_page_style_h

#include <string>

namespace meltfront::verification
{
  /** The style sheet of the report: light and dark, screens from 390 pixels on, print. */
  std::string page_style();
} // namespace meltfront::verification

#endif
