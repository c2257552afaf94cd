#ifndef meltfront_verification_run_checkpoint_checkpoint_folder_h
#define meltfront_verification_run_checkpoint_checkpoint_folder_h

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace meltfront::verification
{
  /** A state that a run can go on from. */
  struct Checkpoint
  {
    long step = 0;
    double time = 0;                   ///< s
    std::uintmax_t observed_bytes = 0; ///< of the observations that lead to it
    long kept = 0;                     ///< checkpoints until then
    int resumptions = 0;               ///< of the run until then
    std::string state;                 ///< as Run wrote it
  };

  /**
   * The files of a run that can be resumed, in a folder of its own: `request.json`, what
   * was asked for and by which program; `observed.bin`, what the run told its observer
   * (ObservationLog); `state.bin`, the last Checkpoint, whole or not there, since it is
   * written under another name first.
   */
  class CheckpointFolder
  {
  public:
    /** Of the run whose files are in a directory. */
    static CheckpointFolder in(const std::string &directory);

    bool holds_run() const;

    /**
     * Begin anew.
     * @param request null: of a run that keeps no checkpoints
     * @throws cases::InputError if an unfinished run's checkpoint lies there
     * @throws cases::OutputError
     */
    void begin(const nlohmann::json &request) const;

    /** What was asked for. @throws cases::InputError if there is no run to resume, or if
     * another build of the program began it (`program` of both is told) */
    nlohmann::json request(const nlohmann::json &program) const;

    /** @throws cases::OutputError if it cannot be written; the one before stays then */
    void write(const Checkpoint &checkpoint) const;

    /** The last one, if any. @throws cases::InputError if the file is damaged, or is
     * another run's */
    std::optional<Checkpoint> last() const;

    /** What the run told its observer. */
    std::string observations() const;

    void remove() const;

  private:
    explicit CheckpointFolder(std::string path);

    std::string request_hash() const;

    std::string path;
  };
} // namespace meltfront::verification

#endif
