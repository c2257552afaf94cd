#ifndef meltfront_verification_app_methods_h
#define meltfront_verification_app_methods_h

#include <cases/method.h>

#include <memory>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Every method there is, in the order of tables. */
  const std::vector<std::unique_ptr<cases::Method>> &methods();

  /** @throws cases::InputError for an unknown name, with the nearest one. */
  const cases::Method &method_named(const std::string &name);
} // namespace meltfront::verification

#endif
