#include <particles/sph/ranks/rank_exchange.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include <algorithm>
#include <vector>

namespace meltfront::particles
{
  namespace
  {
    using Map = Tpetra::Map<int, long long>;
    using Import = Tpetra::Import<int, long long>;
    using Vector = Tpetra::Vector<double, int, long long>;
    using Communicator = Teuchos::Comm<int>;

    Teuchos::RCP<const Communicator> communicator_of(int ranks)
    {
      return Teuchos::rcp(
          new Teuchos::MpiComm<int>(ranks > 1 ? MPI_COMM_WORLD : MPI_COMM_SELF));
    }

    class TpetraExchange : public RankExchange
    {
    public:
      TpetraExchange(int ranks, const OwnParticles &own,
                     std::span<const std::uint32_t> numbers)
        : begin(own.begin)
        , n_own(own.size())
        , communicator(communicator_of(ranks))
        , own_map(Teuchos::rcp(new Map(own.all, n_own, 0, communicator)))
        , halo_map(map_of_others(numbers))
        , import(own_map, halo_map)
        , halo(halo_map)
      {
      }

      /** The source is a view of the own values: only what is sent is copied. */
      void refresh(std::span<double> values) override
      {
        const Vector::dual_view_type::t_dev view(values.data() + begin, n_own, 1);
        const Vector source(own_map, Vector::dual_view_type(view, view));
        halo.doImport(source, import, Tpetra::REPLACE);
        const auto received = halo.getLocalViewHost(Tpetra::Access::ReadOnly);
        const double *first = received.data();
        std::copy(first, first + begin, values.begin());
        std::copy(first + begin, first + received.extent(0),
                  values.begin() + static_cast<std::ptrdiff_t>(begin + n_own));
        ++n_exchanges;
      }

      double total(const ExactSum &own) override
      {
        const ExactSum::Packed part = own.packed();
        ExactSum::Packed sum{};
        reduce(Teuchos::REDUCE_SUM, part.size(), part.data(), sum.data());
        return ExactSum(sum).value();
      }

      void take_largest(std::span<double> values) override
      {
        const std::vector<double> own(values.begin(), values.end());
        reduce(Teuchos::REDUCE_MAX, own.size(), own.data(), values.data());
      }

      long exchanges() const override
      {
        return n_exchanges;
      }

      long reductions() const override
      {
        return n_reductions;
      }

      std::size_t sent() const override
      {
        return import.getNumExportIDs();
      }

      int ranks() const override
      {
        return communicator->getSize();
      }

    private:
      Teuchos::RCP<const Map> map_of_others(std::span<const std::uint32_t> numbers) const
      {
        std::vector<long long> others(numbers.begin(), numbers.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(begin),
                     others.begin() + static_cast<std::ptrdiff_t>(begin + n_own));
        return Teuchos::rcp(
            new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                    Teuchos::ArrayView<const long long>(others), 0, communicator));
      }

      template <typename Number>
      void reduce(Teuchos::EReductionType how, std::size_t count, const Number *own,
                  Number *all)
      {
        Teuchos::reduceAll<int, Number>(*communicator, how, static_cast<int>(count), own,
                                        all);
        ++n_reductions;
      }

      std::size_t begin, n_own;
      Teuchos::RCP<const Communicator> communicator;
      Teuchos::RCP<const Map> own_map, halo_map;
      Import import;
      Vector halo; ///< values of others
      long n_exchanges = 0, n_reductions = 0;
    };
  } // namespace

  int rank_among(int ranks)
  {
    return communicator_of(ranks)->getRank();
  }

  std::shared_ptr<RankExchange> make_rank_exchange(int ranks, const OwnParticles &own,
                                                   std::span<const std::uint32_t> numbers)
  {
    return std::make_shared<TpetraExchange>(ranks, own, numbers);
  }
} // namespace meltfront::particles
