#include <reference_fem/fitted/time/factorization.h>
#include <reference_fem/fitted/time/integrator.h>
#include <reference_fem/fitted/time/tests/toy_problems.h>

#include <cases/error.h>

#include <gtest/gtest.h>

#include <complex>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    dealii::Vector<double> one()
    {
      dealii::Vector<double> u(1);
      u[0] = 1;
      return u;
    }

    /** What the run to t = 1.5 in steps of 0.1 throws. */
    std::string message_of(const ConservationProblem &problem, const Scheme scheme)
    {
      IntegrationOptions options;
      options.scheme = scheme;
      options.method = "toy";
      options.time = [](double clock) { return 100 * clock; };
      Integrator integrator(problem, options);
      integrator.start(0, one());
      try
      {
        integrator.advance_to(1.5, 0.1);
      }
      catch(const cases::NumericalError &error)
      {
        EXPECT_EQ(error.method, "toy");
        EXPECT_GT(error.step, 1);
        EXPECT_NEAR(error.time, 100 * integrator.clock(), 1e-10);
        return error.what();
      }
      return {};
    }

    TEST(Failure, OfTheIterationNamesMethodStepAndTime)
    {
      for(const Scheme scheme : {Scheme::bdf3, Scheme::radau3, Scheme::radau5})
      {
        const std::string message = message_of(Runaway(1e300), scheme);
        EXPECT_NE(message.find("toy, step "), std::string::npos) << message;
      }
    }

    TEST(Failure, RepeatsTheObjectionOfTheProblem)
    {
      for(const Scheme scheme : {Scheme::bdf2, Scheme::radau5})
      {
        const std::string message = message_of(Runaway(5), scheme);
        EXPECT_NE(message.find("u is above its ceiling"), std::string::npos) << message;
      }
    }

    TEST(Failure, GetsAsFarAsHalvedStepsCan)
    {
      IntegrationOptions options;
      const Runaway problem(5);
      Integrator integrator(problem, options);
      integrator.start(0, one());
      EXPECT_THROW(integrator.advance_to(1.5, 0.3), cases::NumericalError);
      // u = 1/(1 - t) meets 5 at t = 0.8.
      EXPECT_NEAR(integrator.clock(), 0.8, 1e-2);
      EXPECT_GT(integrator.cost().halved, 0);
      EXPECT_LE(integrator.state()[0], 5.);
    }

    TEST(Failure, StartFromAStateWithoutAMeaning)
    {
      const Runaway problem(0.5);
      Integrator integrator(problem, {});
      EXPECT_THROW(integrator.start(0, one()), cases::NumericalError);
    }

    TEST(Failure, OfInput)
    {
      EXPECT_EQ(scheme_of("bdf4"), Scheme::bdf4);
      EXPECT_THROW(scheme_of("euler"), cases::InputError);
      const Runaway problem(5);
      IntegrationOptions options;
      options.scheme = Scheme::bdf2;
      options.tolerance = 1e-3;
      EXPECT_THROW(Integrator(problem, options), cases::InputError);
      Integrator integrator(problem, {});
      integrator.start(0, one());
      EXPECT_THROW(integrator.advance_to(-1, 0.1), cases::InputError);
      EXPECT_THROW(integrator.advance_to(1, 0), cases::InputError);
    }

    TEST(Factorisation, SolvesRealAndComplexSystemsAndSeesSingularOnes)
    {
      CompressedRows<double> real{{0, 2, 4}, {0, 1, 0, 1}, {2, 1, 0, 4}};
      Factorisation<double> real_factors;
      ASSERT_TRUE(real_factors.factorise(real));
      std::vector<double> x;
      real_factors.solve({4, 8}, x);
      EXPECT_NEAR(x[0], 1, 1e-15);
      EXPECT_NEAR(x[1], 2, 1e-15);
      real.values = {1, 2, 2, 4};
      EXPECT_FALSE(real_factors.factorise(real));
      real.values[0] = std::nan("");
      EXPECT_FALSE(real_factors.factorise(real));

      using Complex = std::complex<double>;
      CompressedRows<Complex> complex{{0, 2, 4}, {0, 1, 0, 1}, {{0, 1}, 1., 0., {1, 1}}};
      Factorisation<Complex> complex_factors;
      ASSERT_TRUE(complex_factors.factorise(complex));
      std::vector<Complex> z;
      complex_factors.solve({{0, 1}, {2, 0}}, z);
      EXPECT_NEAR(std::abs(z[1] - Complex(1, -1)), 0, 1e-15);
      EXPECT_NEAR(std::abs(z[0] - Complex(2, 1)), 0, 1e-15);
    }
  } // namespace
} // namespace meltfront::reference_fem::fitted
