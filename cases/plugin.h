#ifndef meltfront_cases_plugin_h
#define meltfront_cases_plugin_h

#include <cases/method.h>
#include <cases/plugin_interface.h>

#include <memory>
#include <vector>

namespace meltfront::cases
{
  /** What a plugin, a shared library with methods of its own, shows of itself. */
  struct Plugin
  {
    /** The interface that it was compiled with, MELTFRONT_INTERFACE. It stands first and
     * needs no other header: it is read before anything else is believed. */
    const char *interface;
    /** Its methods. What this throws becomes the sentence that the plugin is refused
     * with.
     */
    std::vector<std::unique_ptr<Method>> (*methods)();
  };
} // namespace meltfront::cases

#define MELTFRONT_TEXT_OF(value) #value
#define MELTFRONT_TEXT(value) MELTFRONT_TEXT_OF(value)

/** What a plugin and the program that loads it must share: version, headers
 * (MELTFRONT_HEADERS of the generated plugin_interface.h), the compiler's layout of
 * objects and that of the standard library's containers. */
#ifdef _GLIBCXX_DEBUG
#define MELTFRONT_CONTAINERS "debugging containers"
#else
#define MELTFRONT_CONTAINERS "containers " MELTFRONT_TEXT(_GLIBCXX_USE_CXX11_ABI)
#endif
#define MELTFRONT_INTERFACE                                                              \
  MELTFRONT_HEADERS ", ABI " MELTFRONT_TEXT(__GXX_ABI_VERSION) ", " MELTFRONT_CONTAINERS

/**
 * The entry point of a plugin, once in one of its source files, outside of any namespace.
 * @param make_methods function without arguments that returns a
 * std::vector<std::unique_ptr<meltfront::cases::Method>>
 */
#define MELTFRONT_PLUGIN(make_methods)                                                   \
  extern "C"                                                                             \
  {                                                                                      \
    extern const meltfront::cases::Plugin meltfront_plugin;                              \
    const meltfront::cases::Plugin meltfront_plugin{MELTFRONT_INTERFACE, make_methods};  \
  }

#endif
