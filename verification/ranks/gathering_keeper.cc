#include <cases/error.h>
#include <verification/ranks/agreement.h>
#include <verification/ranks/gathering_keeper.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace meltfront::verification
{
  namespace
  {
    /** How long the texts of all ranks are, and where each begins behind the others. */
    struct Lengths
    {
      std::vector<int> length, begin;

      explicit Lengths(const std::vector<std::size_t> &lengths)
      {
        // MPI counts bytes in int.
        if(std::accumulate(lengths.begin(), lengths.end(), std::size_t(0))
           > std::size_t(std::numeric_limits<int>::max()))
          throw cases::OutputError(
              "a checkpoint of several ranks holds 2 GB at most, and "
              "the state of this run is larger");
        int at = 0;
        for(const std::size_t size : lengths)
        {
          length.push_back(static_cast<int>(size));
          begin.push_back(std::exchange(at, at + static_cast<int>(size)));
        }
      }
    };

    /** The texts of all ranks, on the first one. */
    std::vector<std::string> gathered(MPI_Comm communicator, const std::string &own)
    {
      const Lengths of(dealii::Utilities::MPI::all_gather(communicator, own.size()));
      const bool first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      std::string all(first ? std::size_t(of.begin.back() + of.length.back()) : 0, ' ');
      MPI_Gatherv(own.data(), static_cast<int>(own.size()), MPI_CHAR, all.data(),
                  of.length.data(), of.begin.data(), MPI_CHAR, 0, communicator);
      std::vector<std::string> result;
      for(std::size_t rank = 0; first && rank < of.length.size(); ++rank)
        result.push_back(
            all.substr(std::size_t(of.begin[rank]), std::size_t(of.length[rank])));
      return result;
    }

    /** The texts that the first rank has in turn, and how long each is. */
    struct Joined
    {
      std::string text; ///< on the first rank
      Lengths of;

      Joined(MPI_Comm communicator, const std::vector<std::string> &texts)
        : of(dealii::Utilities::MPI::broadcast(communicator, lengths(texts)))
      {
        for(const std::string &one : texts)
          text += one;
      }

      static std::vector<std::size_t> lengths(const std::vector<std::string> &texts)
      {
        std::vector<std::size_t> result;
        for(const std::string &one : texts)
          result.push_back(one.size());
        return result;
      }
    };

    /** Each rank's own. */
    std::string scattered(MPI_Comm communicator, const Joined &all)
    {
      const auto rank = dealii::Utilities::MPI::this_mpi_process(communicator);
      std::string own(std::size_t(all.of.length[rank]), ' ');
      MPI_Scatterv(all.text.data(), all.of.length.data(), all.of.begin.data(), MPI_CHAR,
                   own.data(), all.of.length[rank], MPI_CHAR, 0, communicator);
      return own;
    }

    /** All, to each rank. */
    std::string handed_out(MPI_Comm communicator, Joined &&all)
    {
      const int length = all.of.begin.back() + all.of.length.back();
      all.text.resize(static_cast<std::size_t>(length));
      MPI_Bcast(all.text.data(), length, MPI_CHAR, 0, communicator);
      return std::move(all.text);
    }
  } // namespace

  GatheringKeeper::GatheringKeeper(MPI_Comm communicator, cases::StateKeeper *whole,
                                   PartObserver &part)
    : communicator(communicator)
    , whole(whole)
    , part(part)
  {
  }

  std::unique_ptr<std::istream> GatheringKeeper::state_to_resume()
  {
    std::vector<std::string> states;
    std::string state_of_part;
    together(communicator,
             [&]
             {
               const auto state = whole ? whole->state_to_resume() : nullptr;
               if(state)
                 boost::archive::binary_iarchive(*state) >> states >> state_of_part;
             });
    const auto before
        = dealii::Utilities::MPI::broadcast(communicator, unsigned(states.size()));
    if(before == 0)
      return nullptr;
    state_of_part = dealii::Utilities::MPI::broadcast(communicator, state_of_part);
    together(communicator, [&] { part.go_on_from(state_of_part); });
    Joined all(communicator, states);
    states = {};
    const bool as_many = before == dealii::Utilities::MPI::n_mpi_processes(communicator);
    return std::make_unique<std::istringstream>(
        as_many ? scattered(communicator, all)
                : handed_out(communicator, std::move(all)));
  }

  void GatheringKeeper::offer(long step, double time,
                              const std::function<void(std::ostream &)> &save)
  {
    const auto states_of_ranks = [&]
    {
      std::ostringstream own;
      together(communicator, [&] { save(own); });
      return gathered(communicator, std::move(own).str());
    };
    const auto tell = [this](bool due)
    { return dealii::Utilities::MPI::broadcast(communicator, due); };
    together(communicator,
             [&]
             {
               if(!whole)
               {
                 if(tell(false))
                   states_of_ranks();
                 return;
               }
               bool due = false;
               whole->offer(step, time,
                            [&](std::ostream &out)
                            {
                              due = tell(true);
                              const std::vector<std::string> states = states_of_ranks();
                              const std::string state_of_part = part.state();
                              boost::archive::binary_oarchive(out)
                                  << states << state_of_part;
                            });
               if(!due)
                 tell(false);
             });
  }
} // namespace meltfront::verification
