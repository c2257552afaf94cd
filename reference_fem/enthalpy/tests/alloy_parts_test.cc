#include <cases/error.h>
#include <reference_fem/enthalpy/anderson_mixing.h>
#include <reference_fem/enthalpy/mush_conduction.h>
#include <reference_fem/enthalpy/mush_newton.h>
#include <reference_fem/enthalpy/solute_diffusion.h>
#include <reference_fem/enthalpy/tests/support.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meltfront::reference_fem
{
  namespace
  {
    using namespace tests;

    /** Its melting temperature is not zero, so that it cannot drop out unnoticed. */
    cases::Material solvent()
    {
      cases::Material material;
      material.solid = {2.408, 2006, 1097};
      material.liquid = {0.498, 4180, 1097};
      material.latent_heat = 334400;
      material.melting_temperature = 273.15;
      return material;
    }

    cases::Alloy salt(double eutectic_excess, double crystal_density = 917)
    {
      cases::Alloy alloy;
      alloy.solutes.push_back({"salt", 42.28});
      alloy.eutectic_temperature = 273.15 + eutectic_excess;
      alloy.crystal_density = crystal_density;
      return alloy;
    }

    /** A node of an alloy with straight liquidus. */
    Composition lowered_by(double depression)
    {
      return {depression, depression};
    }

    constexpr double infinity = std::numeric_limits<double>::infinity();

    TEST(MushGraph, AgreesWithThePhaseDiagram)
    {
      const cases::Material material = solvent();
      for(const double eutectic : {-18., -infinity})
      {
        const MushGraph graph(material, salt(eutectic));
        const cases::PhaseDiagram diagram(material, salt(eutectic));
        for(const double concentration : {0., 1e-6, 0.14, 0.5})
          for(const double excess : {-40., -19.3, -17., -6.3, -0.7, 0.4, 20.})
          {
            const Composition node = lowered_by(42.28 * concentration);
            const double h = graph.enthalpy(excess, node) / 1097;
            EXPECT_NEAR(h, diagram.enthalpy(273.15 + excess, concentration), 1e-7);
            EXPECT_NEAR(graph.excess_at_enthalpy(1097 * h, node), excess,
                        1e-12 * std::abs(excess));
          }
      }
    }

    TEST(MushGraph, JumpsWhereTheRestFreezes)
    {
      const MushGraph graph(solvent(), salt(-18));
      const double left = 42.28 * 0.14 / 18;
      const Composition node = lowered_by(42.28 * 0.14), rich = lowered_by(30);
      EXPECT_EQ(graph.region(-18, node), MushRegion::held);
      const double jump = graph.enthalpy(-18, node) - graph.lower_enthalpy(-18);
      EXPECT_NEAR(jump, 1097 * left * (334400 - 18 * (4180. - 2006)), 1e-6);
      EXPECT_NEAR(graph.eutectic_liquid_fraction(node), left, 1e-15);
      const double half = graph.lower_enthalpy(-18) + jump / 2;
      EXPECT_EQ(graph.excess_at_enthalpy(half, node), -18);
      EXPECT_NEAR(graph.state(half, node).liquid_fraction, left / 2, 1e-13);
      // Without solute all freezes at the melting point; with too much, all at once.
      EXPECT_NEAR(graph.enthalpy(0, lowered_by(0)) - graph.lower_enthalpy(0),
                  1097. * 334400, 1e-6);
      EXPECT_EQ(graph.region(-18, rich), MushRegion::held);
      EXPECT_EQ(graph.region(-17.9, rich), MushRegion::liquid);
      EXPECT_EQ(graph.eutectic_liquid_fraction(rich), 1);
    }

    TEST(MushGraph, SlopeIsTheDerivative)
    {
      const MushGraph graph(solvent(), salt(-18));
      for(const Composition &node : {lowered_by(0), lowered_by(0.1), lowered_by(5.9)})
        for(const double excess : {-30., -16., -6.5, -1.3, 0.2, 9.})
        {
          const double d = 1e-4;
          const double quotient
              = (graph.enthalpy(excess + d, node) - graph.enthalpy(excess - d, node))
                / (2 * d);
          EXPECT_NEAR(graph.slope(excess, node), quotient, 1e-7 * quotient);
        }
    }

    TEST(MushGraph, ResolvesTheInclusionInEveryRegion)
    {
      const MushGraph graph(solvent(), salt(-18));
      const double volume = 0.3;
      for(const double stiffness : {1e2, 1e6, 1e9})
        for(const double depression : {0., 1e-9, 0.1, 5.9, 30.})
        {
          const Composition node = lowered_by(depression);
          for(const double excess : {-30., -17., -8., -0.3, -1e-6, 1e-6, 9.})
          {
            const double heat
                = volume * graph.enthalpy(excess, node) + stiffness * excess;
            EXPECT_NEAR(graph.resolve(heat, volume, stiffness, node), excess, 1e-9);
          }
          const double step = graph.jump(node);
          const double lower = graph.lower_enthalpy(step);
          for(const double share : {0., 0.4, 1.})
            EXPECT_NEAR(
                graph.resolve(
                    volume * (lower + share * (graph.enthalpy(step, node) - lower))
                        + stiffness * step,
                    volume, stiffness, node),
                step, 1e-12);
        }
    }

    TEST(MushConductivity, IsTheMeanOfTheMixture)
    {
      const cases::Material material = solvent();
      for(const double density : {917., 1097., 1300.})
        for(const double eutectic : {-18., -infinity})
        {
          const cases::Alloy alloy = salt(eutectic, density);
          const MushConductivity conductivity(material, alloy);
          const cases::PhaseDiagram diagram(material, alloy);
          for(const double concentration : {0.001, 0.14})
          {
            const auto at = [&](double excess) {
              return diagram.conductivity(
                  diagram.solid_fraction(273.15 + excess, concentration));
            };
            const std::vector<double> points{-60, -30, -18, -17.9, -7, -6, -1, 0.5, 20};
            for(const double low : points)
              for(const double high : points)
              {
                const double depression = 42.28 * concentration;
                // Piece by piece between the kinks.
                std::vector<double> ends{low, high};
                for(const double kink :
                    {-18., -depression, -depression / (1 - 917. / 1097)})
                  if(kink > low && kink < high)
                    ends.push_back(kink);
                std::sort(ends.begin(), ends.end());
                double integral = 0;
                for(std::size_t i = 1; i < ends.size(); ++i)
                  integral
                      += boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
                          at, ends[i - 1], ends[i], 12, 1e-12);
                if(low < high)
                {
                  EXPECT_NEAR(conductivity.mean(low, high, lowered_by(depression)),
                              integral / (high - low), 1e-9);
                  EXPECT_EQ(conductivity.mean(low, high, lowered_by(depression)),
                            conductivity.mean(high, low, lowered_by(depression)));
                }
              }
          }
          EXPECT_NEAR(conductivity.mean(-9, -9, lowered_by(5.9)),
                      diagram.conductivity(1 - 5.9 / 9), 1e-14);
          EXPECT_NEAR(conductivity.mean(-9, -9 + 1e-9, lowered_by(5.9)),
                      diagram.conductivity(1 - 5.9 / 9), 1e-7);
        }
      // Without solute: Kirchhoff's transform of the pure substance.
      const MushConductivity pure(material, salt(-18, 0));
      EXPECT_NEAR(pure.mean(-3, 1, lowered_by(0)), (3 * 2.408 + 1 * 0.498) / 4, 1e-14);
    }

    /** Concentration of one cosine in a slab of length 1: an eigenvector of the discrete
     * operator, 2 (1 - cos(pi h))/h^2 its eigenvalue. */
    TEST(SoluteDiffusion, DampsACosineAsTheDiscreteOperatorDoes)
    {
      const int n = 20;
      const double h = 1. / n, density = 1097, d = 0.3, c = 0.2, pi = std::numbers::pi;
      const Discretisation mesh
          = make_mesh(slab(solvent(), 1, 300, 0, 1), 1, n)->discretise();
      SoluteDiffusion diffusion(mesh, density, make_tridiagonal_solver);
      for(const double fraction : {1., 0.4})
      {
        std::vector<double> supply, fixed(n + 1, 0.), concentration(n + 1, 0.1);
        for(int i = 0; i <= n; ++i)
          supply.push_back(density * mesh.volume[i]
                           * (0.1 + 0.05 * std::cos(pi * mesh.positions[i][0])));
        diffusion.set_liquid(std::vector<double>(n + 1, fraction));
        diffusion.step(c, d, supply, fixed, concentration);
        const double damping = 1 / (1 + c * d * 2 * (1 - std::cos(pi * h)) / (h * h));
        for(int i = 0; i <= n; ++i)
          EXPECT_NEAR(concentration[i],
                      0.1 + damping * 0.05 * std::cos(pi * mesh.positions[i][0]), 1e-14);
      }
      EXPECT_EQ(diffusion.cost().calls, 2);
    }

    TEST(SoluteDiffusion, DoesNotPassSolidAndLosesNothing)
    {
      const int n = 20;
      const Discretisation mesh
          = make_mesh(slab(solvent(), 1, 300, 0, 1), 2, n)->discretise();
      const std::size_t nodes = mesh.volume.size();
      SoluteDiffusion diffusion(mesh, 1,
                                [](const ConductionMatrix &matrix) {
                                  return make_krylov_solver(matrix, Preconditioner::ssor);
                                });
      std::vector<double> liquid(nodes, 1), supply(nodes), fixed(nodes), result(nodes);
      double before = 0, after = 0, left = 0;
      for(std::size_t i = 0; i < nodes; ++i)
      {
        const double x = mesh.positions[i][0];
        if(std::abs(x - 0.5) < 1e-9)
          liquid[i] = 0;
        result[i] = x < 0.5 ? 0.3 * x : 0.;
        supply[i] = mesh.volume[i] * result[i];
        before += supply[i];
      }
      diffusion.set_liquid(liquid);
      diffusion.step(100, 10, supply, fixed, result);
      for(std::size_t i = 0; i < nodes; ++i)
      {
        after += mesh.volume[i] * result[i];
        if(mesh.positions[i][0] < 0.49)
        {
          left = left == 0 ? result[i] : left;
          EXPECT_NEAR(result[i], left, 1e-4); // long enough to be even
        }
        else
        {
          EXPECT_NEAR(result[i], 0, 1e-13);
        }
      }
      EXPECT_NEAR(after, before, 1e-15);
    }

    TEST(AndersonMixing, EndsALinearIterationAfterAsManyPassesAsItHasModes)
    {
      const Eigen::Vector3d rates(0.99, 0.9, 0.5), fixed(1, -2, 3);
      const auto map = [&](const Eigen::VectorXd &x) -> Eigen::VectorXd
      { return fixed + rates.cwiseProduct(x - fixed); };
      AndersonMixing mixing(3, 4);
      for(int run = 0; run < 2; ++run)
      {
        Eigen::VectorXd x = Eigen::Vector3d(5, 5, 5);
        mixing.restart();
        for(int pass = 0; pass < 4; ++pass)
          mixing.advance(x, map(x));
        EXPECT_NEAR((x - fixed).norm(), 0, 1e-9);
      }
    }

    TEST(AndersonMixing, KeepsWhatEveryPassConserves)
    {
      AndersonMixing mixing(4, 2);
      Eigen::VectorXd x = Eigen::Vector4d(1, 2, 3, 4);
      for(int pass = 0; pass < 9; ++pass)
      {
        // Neighbours exchange something, not linearly.
        Eigen::VectorXd mapped = x;
        for(int i = 0; i < 3; ++i)
        {
          const double flow = 0.1 * std::sin(x[i + 1] - x[i]);
          mapped[i] += flow;
          mapped[i + 1] -= flow;
        }
        mixing.advance(x, mapped);
        EXPECT_NEAR(x.sum(), 10, 1e-13);
      }
    }
  } // namespace
} // namespace meltfront::reference_fem
