#include <cases/outcomes.h>
#include <verification/measure/measure.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    /** Particles that are solid at the marks and at the end. */
    class ParticleSolid : public Measure
    {
    public:
      using Measure::Measure;

      static bool asked_for(const MeasuredRun &run)
      {
        return run.scene.particle_solid.has_value();
      }

      void observe(const Sighting &sighting) override
      {
        for(const std::string &suffix : sighting.suffixes("_end"))
          values["solid" + suffix] = sighting.solid_volume;
      }
    };
  } // namespace

  /** The table of an ensemble has its own columns. */
  MeasureKind particle_solid()
  {
    std::vector<Quantity> list{hidden_quantity("solid_end")};
    for(const cases::Outcome &outcome : cases::outcomes()) // the method counts them
      list.push_back(hidden_quantity(outcome.name));
    for(int mark = 1; mark <= cases::most_marks; ++mark)
      list.push_back(hidden_quantity(fmt::format("solid_{}", mark)));
    return {list, MeasuredScenes::in_motion, start<ParticleSolid>};
  }
} // namespace meltfront::verification
