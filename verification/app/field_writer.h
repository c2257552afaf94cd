#ifndef meltfront_verification_app_field_writer_h
#define meltfront_verification_app_field_writer_h

#include <cases/method.h>

#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /**
   * An observer that writes the fields of a run for ParaView: one `.vtu` file a frame
   * (particles as points, meshes as cells) with temperature, solid fraction and volume,
   * and `fields.pvd`, the collection over time.
   */
  class FieldWriter : public cases::Observer
  {
  public:
    /**
     * Write `frames` frames equidistant in time, and the initial state, into a directory
     * that exists; frames of an earlier run there are removed.
     */
    FieldWriter(const std::string &directory, double start_time, double end_time,
                int frames);

    bool wants(long step, double time) override;

    /** @throws cases::OutputError if a file cannot be written. */
    void observe(const cases::Snapshot &snapshot) override;

  private:
    void write_collection() const;

    std::string directory;
    double start_time;
    double end_time;
    int frames;
    int next_frame = 0;
    std::vector<std::pair<double, std::string>> written;
  };
} // namespace meltfront::verification

#endif
