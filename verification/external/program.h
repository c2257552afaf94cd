#ifndef meltfront_verification_external_program_h
#define meltfront_verification_external_program_h

#include <string>
#include <vector>

namespace meltfront::verification::external
{
  /** The names by which a program finds the request and, if its command asks for it by
   * name, the file for its answer. */
  inline constexpr const char *request_file = "/dev/fd/0";
  inline constexpr const char *answer_file = "/dev/fd/3";

  /** A file without a name: it is gone with its last user, however that ends. */
  class UnnamedFile
  {
  public:
    /** @throws cases::OutputError if it cannot be made. */
    UnnamedFile();
    ~UnnamedFile();
    UnnamedFile(const UnnamedFile &) = delete;
    UnnamedFile &operator=(const UnnamedFile &) = delete;

    int descriptor() const
    {
      return file;
    }

    /** By which this process can open it. */
    std::string path() const;

    double bytes() const;

    /** @throws cases::OutputError */
    void write(const std::string &text);

  private:
    int file;
  };

  /** How a program ended, and what it and the processes that it waited for took. */
  struct ProgramEnd
  {
    bool too_much = false; ///< it was stopped, for it wrote more than it may
    int exit_status = 0, signal = 0;
    double wall = 0, cpu = 0; ///< s

    /** `ended with status 3`, `crashed (Segmentation fault)`; empty for status 0. */
    std::string problem() const;
  };

  /**
   * Run a program to its end, in a process group of its own.
   *
   * The program reads `request` as its standard input. Its answer is its standard output,
   * or file 3 if its command names that; what else it writes goes to `messages`. When it
   * ends, or when this process does in whatever way, all processes of its group are
   * killed: a small process that watches over it outlives both. Only what leaves the
   * group (setsid) escapes.
   *
   * @param words the program, as find_program() takes it, and its arguments
   * @param named_answer whether the answer goes to file 3
   * @param most_bytes of answer and messages each
   * @throws cases::Refusal if there is no such program,
   * @throws cases::OutputError if no process can be started
   */
  ProgramEnd run_program(const std::vector<std::string> &words,
                         const UnnamedFile &request, const UnnamedFile &answer,
                         const UnnamedFile &messages, bool named_answer,
                         double most_bytes);
} // namespace meltfront::verification::external

#endif
