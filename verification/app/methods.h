#ifndef meltfront_verification_app_methods_h
#define meltfront_verification_app_methods_h

#include <verification/plugins/plugins.h>

#include <string>
#include <vector>

namespace meltfront::verification
{
  /** Every method there is, in the order of tables. */
  const MethodList &methods();

  /** Add the methods of plugins, in their order, after all others: before any of them is
   * asked for. @throws cases::InputError as add_plugin() */
  void add_plugins(const std::vector<std::string> &files);

  /** Their files, absolute paths. */
  const std::vector<std::string> &plugin_files();

  /** @throws cases::InputError for an unknown name, with the nearest one. */
  const cases::Method &method_named(const std::string &name);
} // namespace meltfront::verification

#endif
