// What a plugin of another version shows: nothing but its first word may be looked at.
extern "C"
{
  struct OldPlugin
  {
    const char *interface;
    void (*methods)();
  };
  extern const OldPlugin meltfront_plugin;
  const OldPlugin meltfront_plugin{"meltfront 0.0.9, headers 0123456789ab", nullptr};
}
