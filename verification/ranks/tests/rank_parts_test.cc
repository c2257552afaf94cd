// On one rank and on two.

#include <cases/error.h>
#include <verification/ranks/agreement.h>
#include <verification/ranks/whole_snapshot.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace meltfront::verification
{
  namespace
  {
    int rank()
    {
      return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
    }

    int n_ranks()
    {
      return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    }
  } // namespace

  // Of a strip of cells each rank has some, in the order from the last rank to the first,
  // so that what comes first on a rank is not first in the whole.
  TEST(WholeSnapshot, IsTheSameHoweverItIsShared)
  {
    constexpr int n_x = 7;
    std::array<std::vector<double>, 3> positions;
    std::vector<double> weights, temperature, solid_fraction;
    std::vector<std::uint64_t> numbers;
    std::vector<unsigned int> cells;
    const auto owner = [&](int column)
    { return n_ranks() - 1 - std::min(column * n_ranks() / n_x, n_ranks() - 1); };
    std::vector<std::pair<int, int>> own, others; // columns and rows
    for(int x = n_x; x >= 0; --x)
      for(int y = 1; y >= 0; --y)
        if(owner(std::min(x, n_x - 1)) == rank())
          own.emplace_back(x, y);
        else
          others.emplace_back(x, y);
    const std::size_t n_own = own.size();
    own.insert(own.end(), others.begin(), others.end());
    for(std::size_t i = 0; i < own.size(); ++i)
    {
      const auto [x, y] = own[i];
      positions[0].push_back(x);
      positions[1].push_back(y);
      weights.push_back(i < n_own ? 0.25 + x : 0);
      temperature.push_back(10. * x + y);
      solid_fraction.push_back(y);
      numbers.push_back(static_cast<std::uint64_t>(x + (n_x + 1) * y));
    }
    for(int x = n_x - 1; x >= 0; --x)
      if(owner(x) == rank())
        for(const int corner : {0, 1, 2, 3})
          cells.push_back(static_cast<unsigned int>(
              std::ranges::find(own, std::pair(x + corner % 2, corner / 2))
              - own.begin()));

    cases::Snapshot snapshot;
    snapshot.dimension = 2;
    for(int d = 0; d < 2; ++d)
      snapshot.positions[d] = positions[d];
    snapshot.weights = weights;
    snapshot.temperature = temperature;
    snapshot.solid_fraction = solid_fraction;
    snapshot.cells = cells;
    WholeSnapshot gatherer(MPI_COMM_WORLD);
    // The second time the mesh is at hand.
    for(int repeat = 0; repeat < 2; ++repeat)
    {
      const cases::Snapshot whole = gatherer.gather(snapshot, {n_own, numbers});
      if(rank() > 0)
        continue;
      ASSERT_EQ(whole.temperature.size(), 2u * (n_x + 1));
      for(unsigned int i = 0; i < whole.temperature.size(); ++i)
      {
        const double x = i % (n_x + 1), y = i / (n_x + 1);
        EXPECT_EQ(whole.positions[0][i], x);
        EXPECT_EQ(whole.positions[1][i], y);
        EXPECT_EQ(whole.weights[i], 0.25 + x);
        EXPECT_EQ(whole.temperature[i], 10 * x + y);
        EXPECT_EQ(whole.solid_fraction[i], y);
      }
      ASSERT_EQ(whole.cells.size(), 4u * n_x);
      for(unsigned int c = 0; c < n_x; ++c)
        for(const unsigned int corner : {0u, 1u, 2u, 3u})
          EXPECT_EQ(whole.cells[4 * c + corner],
                    c + corner % 2 + (n_x + 1) * (corner / 2));
    }
  }

  TEST(Agreement, WhatFailsOnOneRankEndsAll)
  {
    const int failing = n_ranks() - 1;
    const auto fail_there = [&]
    {
      if(rank() == failing)
        throw cases::OutputError("the disk is full");
    };
    if(rank() == failing)
    {
      EXPECT_THROW(together(MPI_COMM_WORLD, fail_there), cases::OutputError);
    }
    else
    {
      EXPECT_THROW(together(MPI_COMM_WORLD, fail_there), OtherRankFailed);
    }
    EXPECT_NO_THROW(together(MPI_COMM_WORLD, [] {}));
  }

  TEST(Agreement, DoesNotWaitForEver)
  {
    MPI_Comm communicator;
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    if(rank() == 0)
    {
      EXPECT_EQ(meet(communicator, 0.05), n_ranks() == 1);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    if(rank() > 0)
    {
      EXPECT_TRUE(meet(communicator, 60));
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
} // namespace meltfront::verification

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
