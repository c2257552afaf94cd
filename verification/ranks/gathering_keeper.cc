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

    /** Each rank's own of the texts that the first one has. */
    std::string scattered(MPI_Comm communicator, const std::vector<std::string> &texts)
    {
      std::string all;
      std::vector<std::size_t> lengths;
      for(const std::string &text : texts)
      {
        all += text;
        lengths.push_back(text.size());
      }
      const Lengths of(dealii::Utilities::MPI::broadcast(communicator, lengths));
      const auto rank = dealii::Utilities::MPI::this_mpi_process(communicator);
      std::string own(std::size_t(of.length[rank]), ' ');
      MPI_Scatterv(all.data(), of.length.data(), of.begin.data(), MPI_CHAR, own.data(),
                   of.length[rank], MPI_CHAR, 0, communicator);
      return own;
    }
  } // namespace

  GatheringKeeper::GatheringKeeper(MPI_Comm communicator, cases::StateKeeper *whole,
                                   LoggedObserver &part)
    : communicator(communicator)
    , whole(whole)
    , part(part)
  {
  }

  std::unique_ptr<std::istream> GatheringKeeper::state_to_resume()
  {
    std::vector<std::string> states;
    together(communicator,
             [&]
             {
               const auto state = whole ? whole->state_to_resume() : nullptr;
               if(state)
                 boost::archive::binary_iarchive(*state) >> states;
             });
    const bool resumes = dealii::Utilities::MPI::broadcast(communicator, !states.empty());
    if(!resumes)
    {
      together(communicator, [this] { part.go_on_behind(0); });
      return nullptr;
    }
    auto own = std::make_unique<std::istringstream>(scattered(communicator, states));
    together(communicator,
             [&]
             {
               std::uintmax_t observed_bytes = 0;
               boost::archive::binary_iarchive(*own) >> observed_bytes;
               part.go_on_behind(observed_bytes);
             });
    return own;
  }

  void GatheringKeeper::offer(long step, double time,
                              const std::function<void(std::ostream &)> &save)
  {
    const auto states_of_ranks = [&]
    {
      std::ostringstream own;
      together(communicator,
               [&]
               {
                 const std::uintmax_t observed_bytes = part.bytes();
                 boost::archive::binary_oarchive(own) << observed_bytes;
                 save(own);
               });
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
                              boost::archive::binary_oarchive(out) << states;
                            });
               if(!due)
                 tell(false);
             });
  }
} // namespace meltfront::verification
