#ifndef meltfront_verification_run_checkpoint_observation_log_h
#define meltfront_verification_run_checkpoint_observation_log_h

#include <cases/method.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace meltfront::verification
{
  /**
   * All that a run tells its observer, written to a file as it happens, so that it can be
   * told to another observer, which then knows what the first one knew. An array that is
   * the same as in the snapshot before is written once.
   *
   * Only what a mesh or particles hand out is kept: no level set (Snapshot::level_set).
   */
  class ObservationLog
  {
  public:
    /** Begin a file, or go on behind so many bytes of one; the rest of it is cut off.
     * @throws cases::OutputError if it cannot be written or is shorter than that */
    explicit ObservationLog(const std::string &file, std::uintmax_t kept_bytes = 0);

    void begin(const cases::RunDescription &description);
    void step(long step, double time); ///< asked by Observer::wants
    void snapshot(const cases::Snapshot &snapshot);
    void note(double time, const std::string &event);
    void report(const std::string &name, double value);

    /** How long the file is, with all that was told in it.
     * @throws cases::OutputError if it could not all be written */
    std::uintmax_t bytes();

    /** Tell an observer what the first bytes of a file hold. @throws cases::OutputError
     * if it cannot be read */
    static void tell(const std::string &file, std::uintmax_t bytes,
                     cases::Observer &observer);

  private:
    template <typename Write>
    void write(char kind, const Write &write_rest);

    std::string file;
    std::ofstream out;
    std::vector<std::string> last_hashes; ///< of the arrays of the snapshot before
  };
} // namespace meltfront::verification

#endif
