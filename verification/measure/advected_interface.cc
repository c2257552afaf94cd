#include <verification/measure/measure.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    /** A quantity of InterfaceErrors. */
    struct Part
    {
      const char *name;
      const char *heading;
      const char *unit;
      double InterfaceErrors::*value;
      Shown at_end, at_intermediate_time; ///< the first intermediate time
    };

    using enum Shown;
    constexpr Part parts[] = {
        {"volume_error", "volume", "relative", &InterfaceErrors::volume, always, always},
        {"front_l1", "front, L1", "h", &InterfaceErrors::front, always, always},
        {"shape_mismatch", "mismatch", "relative", &InterfaceErrors::mismatch, always,
         always},
        {"shape_missing", "missing", "relative", &InterfaceErrors::missing, when_asked,
         always},
        {"shape_extra", "extra", "relative", &InterfaceErrors::extra, when_asked, always},
        {"normal_rms", "normals, RMS", "degrees", &InterfaceErrors::normal, always,
         when_asked},
        {"curvature_rms", "curvature, RMS", "relative", &InterfaceErrors::curvature,
         always, when_asked}};

    /** InterfaceErrors of a front that is carried along, at the intermediate times and at
     * the end. */
    class AdvectedInterface : public Measure
    {
    public:
      using Measure::Measure;

      static bool asked_for(const MeasuredRun &run)
      {
        return run.carried;
      }

      void observe(const Sighting &sighting) override
      {
        const std::vector<std::string> suffixes = sighting.suffixes("_end");
        if(suffixes.empty() || !sighting.snapshot.level_set)
          return;
        const InterfaceErrors found = run.carried->errors(sighting.snapshot);
        for(const std::string &suffix : suffixes)
          for(const Part &part : parts)
            values[part.name + suffix] = found.*part.value;
      }
    };

    /** The volume's has a sign, and no order. */
    Quantity quantity(const Part &part, const char *suffix, const char *where,
                      Shown shown)
    {
      Quantity result
          = error_quantity(fmt::format("{}_{}", part.name, suffix),
                           fmt::format("{}, {}", part.heading, where), part.unit, shown);
      result.error = part.value != &InterfaceErrors::volume;
      return result;
    }
  } // namespace

  MeasureKind advected_interface()
  {
    std::vector<Quantity> list;
    for(const Part &part : parts)
      list.push_back(quantity(part, "end", "end", part.at_end));
    for(const Part &part : parts)
      list.push_back(quantity(part, "1", "time 1", part.at_intermediate_time));
    for(int intermediate = 2; intermediate <= cases::most_intermediate_times;
        ++intermediate)
      for(const Part &part : parts)
        list.push_back(hidden_quantity(fmt::format("{}_{}", part.name, intermediate)));
    return {list, MeasuredScenes::in_motion, start<AdvectedInterface>};
  }
} // namespace meltfront::verification
