#ifndef meltfront_verification_app_field_writer_h
#define meltfront_verification_app_field_writer_h

#include <verification/ranks/part_observer.h>

#include <string>
#include <utility>
#include <vector>

namespace meltfront::verification
{
  /**
   * An observer that writes the fields of a run for ParaView: one `.vtu` file a frame
   * (particles as points, meshes as cells) with those of temperature, solid fraction,
   * volume and velocity that the snapshot has, and `fields.pvd`, the collection over
   * time. Where the front is carried along and no sites are shown, the points are those
   * of the front, with its curvature. Bonds between solid particles are lines in files of
   * their own, `bonds.pvd`, since a file holds cells of one dimension.
   */
  class FieldWriter : public PartObserver
  {
  public:
    /** Which of the ranks that share a run this writer is for, and whether it may go on
     * from a state, so that earlier frames are left until it is told. */
    struct Piece
    {
      int rank = 0, ranks = 1;
      bool goes_on = false;
    };

    /**
     * Write `frames` frames equidistant in time, and the initial state, into a directory
     * that exists; frames of an earlier run there are removed.
     * @param bond solid particles nearer than this are joined by a line; 0: none
     * @param piece of several ranks, each writes its part of a frame, and the first one a
     * `.pvtu` file that names them all. It removes earlier frames, too: make it first
     */
    FieldWriter(const std::string &directory, double start_time, double end_time,
                int frames, double bond, Piece piece);
    FieldWriter(const std::string &directory, double start_time, double end_time,
                int frames, double bond = 0)
      : FieldWriter(directory, start_time, end_time, frames, bond, {})
    {
    }

    void begin(const cases::RunDescription &description) override;
    bool wants(long step, double time) override;

    /** @throws cases::OutputError if a file cannot be written. */
    void observe(const cases::Snapshot &snapshot) override;

    std::string state() const override;
    void go_on_from(const std::string &state) override;

  private:
    using Frames = std::vector<std::pair<double, std::string>>; ///< times and files

    void remove_other_frames() const;

    /** Write one file of a collection; the collection is whole after each. */
    template <typename Write>
    void write(const std::string &collection, Frames &list,
               const cases::Snapshot &snapshot, const Write &write_frame) const;

    std::string directory;
    double start_time;
    double end_time;
    int frames;
    double bond;
    Piece piece;
    int next_frame = 0;
    Frames written, bonds_written;
  };
} // namespace meltfront::verification

#endif
