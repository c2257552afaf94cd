#include <cases/error.h>
#include <verification/ranks/agreement.h>
#include <verification/ranks/ranks.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>

namespace meltfront::verification
{
  int started_ranks()
  {
    for(const char *name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
      if(const char *value = std::getenv(name))
        return std::max(1, std::atoi(value));
    return 1;
  }

  struct RankSession::Started
  {
    Started(int &argc, char **&argv)
      : mpi(argc, argv, 1)
      , rank(static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)))
      , error_output(dup(STDERR_FILENO))
    {
      MPI_Comm_dup(MPI_COMM_WORLD, &meeting);
      if(rank == 0)
        return;
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
      close(nowhere);
    }

    ~Started()
    {
      MPI_Comm_free(&meeting);
    }

    dealii::Utilities::MPI::MPI_InitFinalize mpi;
    int rank;
    MPI_Comm meeting = MPI_COMM_NULL; ///< messages of its own
    int error_output;                 ///< also where standard error goes nowhere
  };

  RankSession::RankSession(int &argc, char **&argv)
    : started(std::make_unique<Started>(argc, argv))
  {
  }

  RankSession::RankSession()
  {
    static char name[] = "meltfront";
    static char *words[] = {name, nullptr};
    int argc = 1;
    char **argv = words;
    started = std::make_unique<Started>(argc, argv);
  }

  RankSession::~RankSession() = default;

  int RankSession::rank() const
  {
    return started->rank;
  }

  int RankSession::size() const
  {
    return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  }

  std::string RankSession::on_first(const std::function<std::string()> &what) const
  {
    enum Kind
    {
      done,
      bad_input,
      refused,
      unwritten
    };
    std::tuple<int, std::string> end{done, ""};
    if(rank() == 0)
      try
      {
        end = {done, what()};
      }
      catch(const cases::InputError &error)
      {
        end = {bad_input, error.what()};
      }
      catch(const cases::Refusal &error)
      {
        end = {refused, error.what()};
      }
      catch(const std::exception &error)
      {
        end = {unwritten, error.what()};
      }
    const auto [kind, text] = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, end);
    switch(kind)
    {
    case done:
      return text;
    case bad_input:
      throw cases::InputError(text);
    case refused:
      throw cases::Refusal(text);
    default:
      throw cases::OutputError(text);
    }
  }

  void RankSession::end_together(const std::string &sentence, int status) const
  {
    constexpr double patience = 10, for_ever = 1e9; // s
    if(!meet(started->meeting, sentence.empty() ? for_ever : patience))
      abort(rank() == 0 ? "" : sentence, status);
  }

  void RankSession::abort(const std::string &sentence, int status) const
  {
    std::fflush(stdout);
    if(!sentence.empty())
      dprintf(started->error_output, "meltfront: %s\n", sentence.c_str());
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);
  }
} // namespace meltfront::verification
