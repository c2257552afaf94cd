#ifndef meltfront_verification_app_manual_case_pages_h
#define meltfront_verification_app_manual_case_pages_h

#include <verification/report/page/markup.h>

namespace meltfront::verification
{
  /** Every case of the library with its picture, in words, and who runs it. */
  Markup case_pages();

  /** Every matrix of the library: what it is about, what it runs, what that takes. */
  Markup matrix_pages();
} // namespace meltfront::verification

#endif
