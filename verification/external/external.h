#ifndef meltfront_verification_external_external_h
#define meltfront_verification_external_external_h

#include <cases/method.h>

#include <memory>

namespace meltfront::verification
{
  /** Any program that speaks the protocol of README.md, as a method. */
  std::unique_ptr<cases::Method> make_external();
} // namespace meltfront::verification

#endif
