#ifndef meltfront_verification_plugins_plugins_h
#define meltfront_verification_plugins_plugins_h

#include <cases/method.h>

#include <memory>
#include <string>
#include <vector>

namespace meltfront::verification
{
  using MethodList = std::vector<std::unique_ptr<cases::Method>>;

  /**
   * Add the methods of a plugin, a shared library with the entry point of
   * cases/plugin.h, which stays loaded. Records of their runs name the file's hash
   * (record/provenance.h), so that a plugin that was changed is run anew.
   * @throws cases::InputError in one sentence, with the file's name, for a file that is
   * none, one that was compiled with another interface, that throws, brings no method, or
   * one whose name there is already or is no word
   */
  void add_plugin(const std::string &file, MethodList &methods);
} // namespace meltfront::verification

#endif
