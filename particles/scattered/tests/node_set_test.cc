#include <cases/error.h>
#include <particles/scattered/node_set.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace meltfront;
using namespace meltfront::particles;

namespace
{
  cases::Scene box(int dimension)
  {
    cases::Scene scene;
    scene.domain.shape
        = dimension == 1 ? cases::DomainShape::slab : cases::DomainShape::box;
    scene.domain.dimension = dimension;
    scene.domain.lower = {-1, 0, 0};
    scene.domain.upper = {1, dimension > 1 ? 1. : 0., dimension > 2 ? 0.5 : 0.};
    for(int s = 0; s < 2 * dimension; ++s)
      scene.boundaries[s] = cases::Boundary();
    return scene;
  }

  double total(const NodeSet &nodes)
  {
    return std::accumulate(nodes.weights.begin(), nodes.weights.end(), 0.);
  }
} // namespace

TEST(NodeSet, ALatticeWithNodesOnItsWalls)
{
  for(const int dimension : {1, 2, 3})
  {
    const NodeSet nodes
        = arrange_nodes(box(dimension), 8, NodeArrangement::lattice, 0, 1, "test");
    EXPECT_EQ(nodes.size(), dimension == 1 ? 9U : dimension == 2 ? 45U : 135U);
    EXPECT_EQ(nodes.inner.size(), dimension == 1 ? 7U : dimension == 2 ? 21U : 21U);
    EXPECT_NEAR(total(nodes), dimension == 3 ? 1. : 2., 1e-14);
    EXPECT_DOUBLE_EQ(nodes.spacing, 0.25);
    EXPECT_EQ(nodes.point(0)[0], -1);
    EXPECT_EQ(nodes.sides[0], dimension == 1 ? 1 : dimension == 2 ? 5 : 21);
  }
}

TEST(NodeSet, InnerNodesMoveAndWallsStay)
{
  const cases::Scene scene = box(2);
  const NodeSet lattice
      = arrange_nodes(scene, 10, NodeArrangement::lattice, 0, 1, "test");
  const NodeSet jittered
      = arrange_nodes(scene, 10, NodeArrangement::jittered, 0.25, 7, "test");
  const NodeSet again
      = arrange_nodes(scene, 10, NodeArrangement::jittered, 0.25, 7, "test");
  const NodeSet random = arrange_nodes(scene, 10, NodeArrangement::random, 0, 7, "test");
  EXPECT_EQ(jittered.positions.position[0], again.positions.position[0]);
  double moved = 0;
  for(std::size_t i = 0; i < lattice.size(); ++i)
    for(int d = 0; d < 2; ++d)
    {
      const double by = jittered.point(i)[d] - lattice.point(i)[d];
      EXPECT_LE(std::abs(by), 0.25 * 0.2 * (1 + 1e-12));
      moved += std::abs(by);
      if(lattice.sides[i] != 0)
      {
        EXPECT_EQ(jittered.point(i)[d], lattice.point(i)[d]);
        EXPECT_EQ(random.point(i)[d], lattice.point(i)[d]);
      }
      EXPECT_GE(random.point(i)[d], scene.domain.lower[d]);
      EXPECT_LE(random.point(i)[d], scene.domain.upper[d]);
    }
  EXPECT_GT(moved, 1);
}

TEST(NodeSet, NodesNearTheSurfaceOfAnInclusionAreMovedOntoIt)
{
  cases::Scene scene = box(2);
  scene.inclusion = cases::Inclusion{{"", [](const cases::Position &p, double)
                                      { return std::hypot(p[0], p[1] - 0.5) - 0.3; }},
                                     5};
  const NodeSet nodes
      = arrange_nodes(scene, 40, NodeArrangement::jittered, 0.2, 3, "test");
  int on_surface = 0;
  for(std::size_t i = 0; i < nodes.size(); ++i)
  {
    const cases::Position p = nodes.point(i);
    const double distance = std::hypot(p[0], p[1] - 0.5) - 0.3;
    switch(nodes.region[i])
    {
    case Region::interface:
      ++on_surface;
      EXPECT_NEAR(distance, 0, 1e-9);
      break;
    case Region::inside:
      EXPECT_LE(distance, -0.5 * nodes.spacing * (1 - 1e-9));
      break;
    default:
      EXPECT_GE(distance, 0.5 * nodes.spacing * (1 - 1e-9));
    }
  }
  EXPECT_NEAR(on_surface, 2 * M_PI * 0.3 / nodes.spacing,
              0.35 * 2 * M_PI * 0.3 / nodes.spacing);
}

TEST(NodeSet, WallsThatMeet)
{
  cases::Scene scene = box(2);
  scene.boundaries[0]
      = cases::Boundary{cases::BoundaryKind::flux, cases::Field::uniform(3)};
  scene.boundaries[2] = cases::Boundary{cases::BoundaryKind::heat_transfer,
                                        cases::Field::uniform(5), false, 2};
  scene.boundaries[3]
      = cases::Boundary{cases::BoundaryKind::fixed_temperature, cases::Field::uniform(7)};
  const NodeSet nodes = arrange_nodes(scene, 4, NodeArrangement::lattice, 0, 1, "test");
  const WallCondition corner = wall_condition(scene, nodes, 0);
  EXPECT_FALSE(corner.fixed);
  EXPECT_EQ(corner.direction, (std::array<double, 3>{-1, -1, 0}));
  EXPECT_EQ(corner.transfer, 2);
  const GivenValues given(scene);
  const LinearStep now = steady_step(0);
  EXPECT_EQ(corner.value({}, now, given), 13);
  const WallCondition held = wall_condition(scene, nodes, nodes.size() - 1);
  EXPECT_TRUE(held.fixed);
  EXPECT_EQ(held.value({}, now, given), 7);
  const WallCondition side = wall_condition(scene, nodes, 2);
  EXPECT_EQ(side.direction, (std::array<double, 3>{0, -1, 0}));
  EXPECT_EQ(side.value({}, now, given), 10);
}

TEST(NodeSet, OtherDomainsAreRefused)
{
  cases::Scene scene = box(2);
  scene.boundaries[0]->kind = cases::BoundaryKind::periodic;
  scene.boundaries[1]->kind = cases::BoundaryKind::periodic;
  EXPECT_THROW(arrange_nodes(scene, 4, NodeArrangement::lattice, 0, 1, "test"),
               cases::Refusal);
  scene = box(2);
  scene.domain.shape = cases::DomainShape::ball;
  EXPECT_THROW(arrange_nodes(scene, 4, NodeArrangement::lattice, 0, 1, "test"),
               cases::Refusal);
  EXPECT_THROW(arrange_nodes(box(1), 1, NodeArrangement::lattice, 0, 1, "test"),
               cases::Refusal);
}
