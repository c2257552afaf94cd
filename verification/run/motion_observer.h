#ifndef meltfront_verification_run_motion_observer_h
#define meltfront_verification_run_motion_observer_h

#include <verification/run/run_observer.h>

#include <optional>

namespace meltfront::verification
{
  /**
   * Observes a run in which things move and no heat is conducted: particles of a solid,
   * or a front that a velocity carries along.
   *
   * It asks for the first step at or after each of Measurement::intermediate_times too. A
   * state that is not finite ends the run with a NumericalError. If it is animated, up to
   * 61 frames of at most 2000 particles are kept: 12 of them before the first
   * intermediate time, where there is one, since intermediate times stand where things
   * happen.
   */
  class MotionObserver : public RunObserver
  {
  public:
    /** As RunObserver. @param animated whether frames are kept throughout the run */
    MotionObserver(const cases::Case &c, const cases::Scene &simulated,
                   const std::string &method, cases::Observer *second = nullptr,
                   bool animated = false);

    void report(const std::string &name, double value) override;
    void keep_results(RunRecord &record) const override;
    Results quantities() const override;

  private:
    void start() override;
    bool asks_for(long step, double time) override;
    void look(const cases::Snapshot &snapshot) override;
    void see(Sighting sighting) override;
    bool picture_is_due(double time) const;
    double volume(const Sighting &sighting) const;
    void keep_frame(const cases::Snapshot &snapshot);
    void keep_picture(const cases::Snapshot &snapshot);

    std::vector<double> picture_times; ///< of the animation
    std::size_t next_picture = 0;
    std::optional<InterfaceComparison> comparison;
    std::vector<ParticleFrame> particle_frames, animation;
    Results told; ///< by the method
  };
} // namespace meltfront::verification

#endif
