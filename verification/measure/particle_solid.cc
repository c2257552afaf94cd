#include <cases/reported_scalars.h>
#include <verification/measure/measure.h>

#include <fmt/format.h>

namespace meltfront::verification
{
  namespace
  {
    /** Particles that are solid at the intermediate times and at the end. */
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
    for(const cases::ReportedScalar &scalar :
        cases::reported_scalars()) // the method counts them
      list.push_back(hidden_quantity(scalar.name));
    for(int intermediate = 1; intermediate <= cases::most_intermediate_times;
        ++intermediate)
      list.push_back(hidden_quantity(fmt::format("solid_{}", intermediate)));
    return {list, MeasuredScenes::in_motion, start<ParticleSolid>};
  }
} // namespace meltfront::verification
