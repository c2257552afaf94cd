#include <verification/fuzz/mutation.h>
#include <verification/fuzz/trials.h>

#include <cases/error.h>

#include <fmt/format.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <new>

namespace meltfront::verification
{
  namespace
  {
    /** What a process that reads texts tells the one that watches it. */
    struct Board
    {
      std::atomic<unsigned long> done; ///< texts
      std::array<char, 500> problem;   ///< of the text under way; empty: none
    };

    std::string text_of(const FileKind &kind, unsigned long seed)
    {
      std::mt19937_64 random(seed);
      return mutated(kind.originals[seed % kind.originals.size()], kind.originals,
                     random);
    }

    /** What is wrong with how a text was read; empty: nothing. */
    std::string problem_of(const FileKind &kind, const std::string &text)
    {
      const auto require_message = [](const std::exception &error)
      { return *error.what() != 0 ? "" : "an error without a message"; };
      try
      {
        kind.read(text);
        return {};
      }
      catch(const cases::InputError &error)
      {
        return require_message(error);
      }
      catch(const cases::OutputError &error)
      {
        return require_message(error);
      }
      catch(const cases::Refusal &error)
      {
        return require_message(error);
      }
      catch(const std::exception &error)
      {
        return fmt::format("an exception: {}", error.what());
      }
    }

    void limit_memory_of_reader()
    {
      constexpr rlim_t most = 4ul << 30;
      const rlimit limit{most, most};
      setrlimit(RLIMIT_AS, &limit);
    }

    void limit_time_of_text(int seconds)
    {
      rusage used;
      getrusage(RUSAGE_SELF, &used);
      const rlim_t until = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec
                                               + seconds + 1);
      const rlimit limit{until, RLIM_INFINITY};
      setrlimit(RLIMIT_CPU, &limit);
    }

    [[noreturn]] void read_texts(const FileKind &kind, unsigned long first,
                                 unsigned long end, int seconds, Board &board)
    {
#ifndef MELTFRONT_SANITIZE
      limit_memory_of_reader();
#endif
      for(unsigned long seed = first; seed < end; ++seed)
      {
        limit_time_of_text(seconds);
        const std::string problem = problem_of(kind, text_of(kind, seed));
        if(!problem.empty())
        {
          std::strncpy(board.problem.data(), problem.c_str(), board.problem.size() - 1);
          _exit(1);
        }
        ++board.done;
      }
      _exit(0);
    }

    std::string end_in_words(int status, const Board &board)
    {
      if(board.problem[0] != 0)
        return board.problem.data();
      if(WIFSIGNALED(status))
        return WTERMSIG(status) == SIGXCPU
                   ? std::string("takes too long")
                   : fmt::format("a crash: {}", strsignal(WTERMSIG(status)));
      return fmt::format("the program ends by itself, with status {}",
                         WEXITSTATUS(status));
    }
  } // namespace

  std::vector<Offence> offences(const FileKind &kind, unsigned long first_seed,
                                unsigned long count, int seconds)
  {
    void *shared = mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if(shared == MAP_FAILED)
      throw cases::OutputError("there is no memory to share with a process");
    Board &board = *new(shared) Board;
    std::vector<Offence> result;
    for(unsigned long seed = first_seed; seed < first_seed + count;)
    {
      board.done = 0;
      board.problem = {};
      const pid_t reader = fork();
      if(reader == 0)
        read_texts(kind, seed, first_seed + count, seconds, board);
      int status = 0;
      waitpid(reader, &status, 0);
      seed += board.done;
      if(seed == first_seed + count)
        break;
      result.push_back(
          {kind.name, end_in_words(status, board), text_of(kind, seed), seed});
      ++seed;
    }
    munmap(shared, sizeof(Board));
    return result;
  }
} // namespace meltfront::verification
