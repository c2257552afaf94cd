#include <verification/judge/consensus.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace meltfront::verification;

TEST(Consensus, SmallestBarOfTheLargestGroup)
{
  const std::vector<AnswerInterval> answers{
      {1.00, .05, true}, {1.02, .01, true}, {1.03, .02, true}, {1.50, .001, true}};
  const Consensus consensus = consensus_of(answers);
  EXPECT_TRUE(consensus.agreed);
  EXPECT_EQ(consensus.support, 3);
  EXPECT_EQ(consensus.value, 1.02);
  EXPECT_EQ(consensus.bar, .01);
  EXPECT_LT(consensus.distance_in_bars[0], 1);
  EXPECT_EQ(consensus.distance_in_bars[1], 0);
  EXPECT_GT(consensus.distance_in_bars[3], 1);
}

TEST(Consensus, NoneWhereNoTwoAgree)
{
  const std::vector<AnswerInterval> answers{{1, .1, true}, {2, .2, true}};
  const Consensus consensus = consensus_of(answers);
  EXPECT_FALSE(consensus.agreed);
  EXPECT_TRUE(consensus.contradictory());
  EXPECT_NEAR(consensus.value, (.9 + 2.2) / 2, 1e-15);
  EXPECT_NEAR(consensus.bar, (2.2 - .9) / 2, 1e-15);
}

TEST(Consensus, NoneBetweenTwoGroupsOfOneSize)
{
  const std::vector<AnswerInterval> answers{
      {1, .1, true}, {1.05, .1, true}, {2, .1, true}, {2.05, .1, true}};
  EXPECT_FALSE(consensus_of(answers).agreed);
}

TEST(Consensus, WhatDoesNotConvergeTakesNoPart)
{
  const std::vector<AnswerInterval> answers{
      {1, .1, true}, {1.01, .1, true}, {5, 10, false}};
  const Consensus consensus = consensus_of(answers);
  EXPECT_EQ(consensus.support, 2);
  EXPECT_TRUE(std::isnan(consensus.distance_in_bars[2]));
}

TEST(Consensus, OneAnswerIsNotConfirmed)
{
  const Consensus consensus = consensus_of(std::vector<AnswerInterval>{{1, .1, true}});
  EXPECT_FALSE(consensus.agreed);
  EXPECT_EQ(consensus.value, 1);
  EXPECT_NEAR(consensus.bar, .1, 1e-15);
  EXPECT_EQ(consensus_of({}).support, 0);
}

TEST(Consensus, WhatDoesNotConvergeContradictsNobody)
{
  const Consensus consensus
      = consensus_of(std::vector<AnswerInterval>{{1, .1, true}, {5, .1, false}});
  EXPECT_FALSE(consensus.agreed);
  EXPECT_FALSE(consensus.contradictory());
  EXPECT_EQ(consensus.taking_part, 1);
}
