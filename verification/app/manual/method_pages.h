#ifndef meltfront_verification_app_manual_method_pages_h
#define meltfront_verification_app_manual_method_pages_h

#include <verification/report/page/markup.h>

namespace meltfront::verification
{
  /** Of every method: what it is and solves, what it takes, its options, and the figures
   * that the committed runs of results/reference reached. */
  Markup method_pages();

  /** Effects, with the methods that simulate them. */
  Markup effect_table();
} // namespace meltfront::verification

#endif
