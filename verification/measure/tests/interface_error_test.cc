#include <cases/shape.h>
#include <cases/velocity_field.h>
#include <verification/measure/formulas/exact_front.h>
#include <verification/measure/formulas/interface_error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace meltfront::verification
{
  namespace
  {
    using cases::Position;

    cases::Scene scene_of(int dimension, std::shared_ptr<const cases::Shape> shape,
                          std::shared_ptr<const cases::VelocityField> velocity)
    {
      cases::Scene scene;
      scene.problem = cases::ProblemKind::interface_advection;
      scene.domain.shape = cases::DomainShape::box;
      scene.domain.dimension = dimension;
      scene.domain.upper = {1, 1, dimension == 3 ? 1. : 0.};
      scene.interface = cases::InterfaceAdvection{shape, velocity};
      return scene;
    }

    std::shared_ptr<const cases::VelocityField> at_rest()
    {
      return std::make_shared<cases::RigidMotion>(Position{}, 0, Position{});
    }

    cases::Snapshot snapshot_of(int dimension, double time,
                                std::function<double(const Position &)> level_set)
    {
      cases::Snapshot snapshot;
      snapshot.dimension = dimension;
      snapshot.time = time;
      snapshot.level_set = std::move(level_set);
      return snapshot;
    }

    /** Points, normals and curvature of a circle as a method would give them. */
    struct Circle
    {
      Circle(const Position &centre, double radius, double curvature)
      {
        for(int i = 0; i < 50; ++i)
        {
          const double angle = 2 * std::numbers::pi * i / 50;
          x.push_back(centre[0] + radius * std::cos(angle));
          y.push_back(centre[1] + radius * std::sin(angle));
          normal_x.push_back(std::cos(angle));
          normal_y.push_back(std::sin(angle));
          bend.push_back(curvature);
        }
      }

      void put_into(cases::Snapshot &snapshot) const
      {
        snapshot.front = {x, y};
        snapshot.front_normal = {normal_x, normal_y};
        snapshot.front_curvature = bend;
      }

      std::vector<double> x, y, normal_x, normal_y, bend;
    };
  } // namespace

  TEST(InterfaceError, OfTheExactRegionIsNone)
  {
    const auto disk = std::make_shared<cases::Ball>(2, Position{0.5, 0.6, 0}, 0.2);
    const cases::Scene scene = scene_of(2, disk, at_rest());
    cases::Snapshot snapshot = snapshot_of(
        2, 0.7, [&](const Position &p) { return disk->signed_distance(p); });
    const Circle circle({0.5, 0.6, 0}, 0.2, 5);
    circle.put_into(snapshot);
    const InterfaceErrors errors = InterfaceComparison(scene, 0.02).errors(snapshot);
    EXPECT_EQ(errors.mismatch, 0);
    EXPECT_EQ(errors.front, 0);
    EXPECT_NEAR(errors.volume, 0, 1e-3); // samples of 0.002
    EXPECT_LT(errors.normal, 1e-3);
    EXPECT_NEAR(errors.curvature, 0, 1e-12);
  }

  TEST(InterfaceError, OfAShiftedDiskIsItsLune)
  {
    constexpr double radius = 0.2, shift = 0.004, spacing = 0.01;
    const auto disk = std::make_shared<cases::Ball>(2, Position{0.5, 0.5, 0}, radius);
    const cases::Ball shifted(2, {0.5 + shift, 0.5, 0}, radius);
    const cases::Scene scene = scene_of(2, disk, at_rest());
    cases::Snapshot snapshot = snapshot_of(
        2, 0, [&](const Position &p) { return shifted.signed_distance(p); });
    const Circle circle({0.5 + shift, 0.5, 0}, radius, 5.5);
    circle.put_into(snapshot);
    const InterfaceErrors errors = InterfaceComparison(scene, spacing).errors(snapshot);
    // Area between two circles whose centres are a little apart: 2 R d on either side.
    EXPECT_NEAR(errors.front, 2 * shift / std::numbers::pi / spacing, 0.01);
    EXPECT_NEAR(errors.missing, 2 * shift / std::numbers::pi / radius, 5e-4);
    EXPECT_NEAR(errors.extra, errors.missing, 5e-4);
    EXPECT_NEAR(errors.mismatch, errors.missing + errors.extra, 1e-15);
    // The normal of a disk at a point beside it turns by d sin(phi) / R.
    EXPECT_NEAR(errors.normal, shift / radius / std::sqrt(2.) * 180 / std::numbers::pi,
                0.02);
    EXPECT_NEAR(errors.curvature, 0.1, 1e-3);
  }

  TEST(InterfaceError, FollowsARigidMotion)
  {
    constexpr double quarter = std::numbers::pi / 2;
    const auto slotted
        = std::make_shared<cases::SlottedDisk>(Position{0.5, 0.75, 0}, 0.15, 0.05, 0.25);
    const auto turn
        = std::make_shared<cases::RigidMotion>(Position{}, 1, Position{0.5, 0.5, 0});
    const cases::Scene scene = scene_of(2, slotted, turn);
    // Turned by a quarter: what is at (x, y) was at (y, 1 - x).
    const cases::Snapshot turned
        = snapshot_of(2, quarter,
                      [&](const Position &p) {
                        return slotted->signed_distance({p[1], 1 - p[0], 0});
                      });
    const InterfaceComparison comparison(scene, 0.0125);
    EXPECT_LT(comparison.errors(turned).mismatch, 1e-4);
    const cases::Snapshot left_behind = snapshot_of(
        2, quarter, [&](const Position &p) { return slotted->signed_distance(p); });
    EXPECT_NEAR(comparison.errors(left_behind).mismatch, 2, 0.01);
    EXPECT_NEAR(comparison.errors(left_behind).missing, 1, 0.01);
  }

  TEST(InterfaceError, NormalsTurnWithTheMotion)
  {
    const auto disk = std::make_shared<cases::Ball>(2, Position{0.5, 0.75, 0}, 0.15);
    const auto turn
        = std::make_shared<cases::RigidMotion>(Position{}, 1, Position{0.5, 0.5, 0});
    const cases::Scene scene = scene_of(2, disk, turn);
    cases::Snapshot snapshot = snapshot_of(
        2, std::numbers::pi / 2,
        [](const Position &p) { return 0.15 - std::hypot(p[0] - 0.25, p[1] - 0.5); });
    const Circle circle({0.25, 0.5, 0}, 0.15, 1 / 0.15);
    circle.put_into(snapshot);
    const InterfaceErrors errors = InterfaceComparison(scene, 0.02).errors(snapshot);
    EXPECT_LT(errors.normal, 1e-3);
    EXPECT_LT(errors.mismatch, 1e-3);
  }

  TEST(InterfaceError, OfAPlaneIsItsShiftInSpacings)
  {
    const auto plane = std::make_shared<cases::HalfSpace>(0.402);
    const cases::Scene scene = scene_of(2, plane, at_rest());
    const cases::Snapshot snapshot
        = snapshot_of(2, 0, [](const Position &p) { return 0.412 - p[0]; });
    const InterfaceErrors errors = InterfaceComparison(scene, 0.02).errors(snapshot);
    EXPECT_NEAR(errors.front, 0.5, 1e-9);
    EXPECT_EQ(errors.missing, 0);
    EXPECT_GT(errors.volume, 0);
    EXPECT_TRUE(std::isnan(errors.curvature)); // no point of a front is there
  }

  TEST(InterfaceError, DrawnOutByAVortexTheRegionIsThatOfThePaths)
  {
    const auto disk = std::make_shared<cases::Ball>(2, Position{0.5, 0.75, 0}, 0.15);
    const auto vortex = std::make_shared<cases::SingleVortex>(4);
    const cases::Scene scene = scene_of(2, disk, vortex);
    const auto exact = [&](const Position &p)
    { return disk->signed_distance(vortex->carried(p, 1, 0, 2)); };
    const InterfaceComparison comparison(scene, 0.05);
    const InterfaceErrors errors = comparison.errors(snapshot_of(2, 1, exact));
    EXPECT_LT(errors.mismatch, 5e-3);
    EXPECT_TRUE(std::isnan(errors.normal));
    const auto old = [&](const Position &p) { return disk->signed_distance(p); };
    EXPECT_GT(comparison.errors(snapshot_of(2, 1, old)).mismatch, 0.5);
    // After the period everything is back.
    EXPECT_LT(comparison.errors(snapshot_of(2, 4, old)).mismatch, 1e-12);
  }

  TEST(InterfaceError, InSpace)
  {
    const auto ball = std::make_shared<cases::Ball>(3, Position{0.35, 0.35, 0.35}, 0.15);
    const auto deformation = std::make_shared<cases::CubeDeformation>(3);
    const cases::Scene scene = scene_of(3, ball, deformation);
    const auto same = [&](const Position &p) { return ball->signed_distance(p); };
    const InterfaceComparison comparison(scene, 0.05);
    const InterfaceErrors back = comparison.errors(snapshot_of(3, 3, same));
    EXPECT_EQ(back.mismatch, 0);
    EXPECT_NEAR(back.volume, 0, 0.01);
    const InterfaceErrors half = comparison.errors(snapshot_of(3, 1.5, same));
    EXPECT_NEAR(half.volume, 0, 0.02);
    EXPECT_TRUE(std::isnan(half.mismatch));
  }

  TEST(ExactFront, IsTheEdgeAtItsPlaceInPiecesThatStayTogether)
  {
    const auto disk = std::make_shared<cases::Ball>(2, Position{0.5, 0.75, 0}, 0.15);
    const auto vortex = std::make_shared<cases::SingleVortex>(4);
    const cases::Scene scene = scene_of(2, disk, vortex);
    double length = 0;
    for(const FrontPiece &piece : exact_front_pieces(scene, 0, 1))
    {
      length += std::hypot(piece.end[0] - piece.begin[0], piece.end[1] - piece.begin[1]);
      EXPECT_NEAR(disk->signed_distance(piece.begin), 0, 1e-5);
    }
    EXPECT_NEAR(length, disk->surface(), 1e-3);
    for(const FrontPiece &piece : exact_front_pieces(scene, 1, 0.01))
    {
      EXPECT_LE(std::hypot(piece.end[0] - piece.begin[0], piece.end[1] - piece.begin[1]),
                0.01);
      EXPECT_NEAR(disk->signed_distance(vortex->carried(piece.begin, 1, 0, 2)), 0, 1e-5);
    }
  }
} // namespace meltfront::verification
