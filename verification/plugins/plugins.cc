#include <cases/error.h>
#include <cases/plugin.h>
#include <verification/plugins/plugins.h>
#include <verification/record/hash.h>
#include <verification/record/provenance.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string_view>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    [[noreturn]] void refuse(const std::string &file, const std::string &reason)
    {
      throw cases::InputError(fmt::format("--plugin {}: {}", file, reason));
    }

    /** What the loader says of a file, without the file's name before it. */
    std::string loader_error(const std::string &path)
    {
      std::string said = dlerror();
      if(said.starts_with(path + ": "))
        said.erase(0, path.size() + 2);
      return said;
    }

    const cases::Plugin &loaded(const std::string &file)
    {
      const std::string path = std::filesystem::absolute(file).string();
      if(!std::filesystem::is_regular_file(path))
        refuse(file, "there is no such file");
      // It stays: its methods' code is there.
      void *library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
      if(library == nullptr)
        refuse(file, fmt::format("cannot be loaded as a shared library: {}",
                                 loader_error(path)));
      const auto *plugin
          = static_cast<const cases::Plugin *>(dlsym(library, "meltfront_plugin"));
      if(plugin == nullptr)
        refuse(file, "is no plugin of meltfront: it lacks the entry point that the line "
                     "MELTFRONT_PLUGIN(...) of cases/plugin.h makes");
      return *plugin;
    }

    /** What it calls its methods by must be one word in labels and settings. */
    void check_name(const std::string &file, const std::string &name,
                    const MethodList &methods)
    {
      const auto in_a_word = [](char c)
      {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')
               || c == '-' || c == '_';
      };
      if(name.empty() || !std::ranges::all_of(name, in_a_word))
        refuse(file, fmt::format("its method '{}' is to be named by letters, digits, '-' "
                                 "and '_'",
                                 name));
      if(std::ranges::any_of(methods,
                             [&](const auto &there) { return there->name() == name; }))
        refuse(file, fmt::format("brings a method '{}', and there is one of that name "
                                 "already",
                                 name));
    }

    MethodList methods_of(const std::string &file, const cases::Plugin &plugin)
    {
      MethodList methods;
      try
      {
        methods = plugin.methods();
        std::erase(methods, nullptr);
        for(const auto &method : methods)
        {
          method->capabilities();
          const cases::Options defaults(method->option_declarations());
        }
      }
      catch(const std::exception &error)
      {
        refuse(file,
               fmt::format("fails when its methods are asked for: {}", error.what()));
      }
      catch(...)
      {
        refuse(file, "throws what is no std::exception when its methods are asked for");
      }
      if(methods.empty())
        refuse(file, "brings no method");
      return methods;
    }
  } // namespace

  void add_plugin(const std::string &file, MethodList &methods)
  {
    const cases::Plugin &plugin = loaded(file);
    constexpr std::string_view here = MELTFRONT_INTERFACE;
    if(plugin.interface == nullptr || plugin.interface != here)
      refuse(file, fmt::format("was compiled with another meltfront ({}) than this one "
                               "({}); compile it again with this one's headers",
                               plugin.interface ? plugin.interface : "unnamed", here));
    for(auto &method : methods_of(file, plugin))
    {
      check_name(file, method->name(), methods);
      note_plugin(method->name(), sha256_of_file(file));
      methods.push_back(std::move(method));
    }
  }
} // namespace meltfront::verification
