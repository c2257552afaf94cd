#ifndef meltfront_reference_fem_fitted_time_tests_toy_problems_h
#define meltfront_reference_fem_fitted_time_tests_toy_problems_h

#include <reference_fem/fitted/conservation_problem.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <cmath>
#include <functional>

namespace meltfront::reference_fem::fitted
{
  /** Base of the toys: a full pattern, everything of size one, no objections. */
  class ToyProblem : public ConservationProblem
  {
  public:
    explicit ToyProblem(const unsigned int n_unknowns, const unsigned int bandwidth = 100)
      : n(n_unknowns)
    {
      dealii::DynamicSparsityPattern dynamic(n, n);
      for(unsigned int i = 0; i < n; ++i)
        for(unsigned int j = 0; j < n; ++j)
          if((i > j ? i - j : j - i) <= bandwidth)
            dynamic.add(i, j);
      pattern.copy_from(dynamic);
    }

    unsigned int size() const override
    {
      return n;
    }

    const dealii::SparsityPattern &sparsity() const override
    {
      return pattern;
    }

    dealii::Vector<double> scale(const dealii::Vector<double> &) const override
    {
      dealii::Vector<double> ones(n);
      ones = 1.;
      return ones;
    }

    std::string reason_invalid(const dealii::Vector<double> &) const override
    {
      return {};
    }

  protected:
    unsigned int n;
    dealii::SparsityPattern pattern;
  };

  /**
   * One of each kind of row, with u = g(t), h = sqrt(1 + t), z = u h^2, w = 1/h,
   * q = 2 (h - 1):
   *   (u + u^3/3)' = (1 + g^2) g' - stiffness (u - g)
   *   (h^2)'       = 1/2 + h h'
   *   0            = z - u h^2
   *   (w h - q)'   = -w      heat at a wall, less its account
   *   q'           = w       the account: w h, the sum of both, is an invariant
   */
  class FiveRows : public ToyProblem
  {
  public:
    explicit FiveRows(const double stiffness)
      : ToyProblem(5)
      , stiffness(stiffness)
    {
    }

    std::function<double(double)> g = [](double t) { return std::cos(2 * t); };
    std::function<double(double)> g_rate = [](double t) { return -2 * std::sin(2 * t); };

    dealii::Vector<double> exact(const double t) const
    {
      const double h = std::sqrt(1 + t);
      dealii::Vector<double> u(5);
      u[0] = g(t);
      u[1] = h;
      u[2] = g(t) * h * h;
      u[3] = 1 / h;
      u[4] = 2 * (h - 1);
      return u;
    }

    void evaluate(const double t, const dealii::Vector<double> &u,
                  const dealii::Vector<double> &rate, dealii::Vector<double> &mass,
                  dealii::Vector<double> &flow) const override
    {
      mass[0] = u[0] + u[0] * u[0] * u[0] / 3;
      flow[0] = (1 + g(t) * g(t)) * g_rate(t) - stiffness * (u[0] - g(t));
      mass[1] = u[1] * u[1];
      flow[1] = 0.5 + u[1] * rate[1];
      mass[2] = 0;
      flow[2] = u[2] - u[0] * u[1] * u[1];
      mass[3] = u[3] * u[1] - u[4];
      flow[3] = -u[3];
      mass[4] = u[4];
      flow[4] = u[3];
    }

    void linearise(const double t, const dealii::Vector<double> &u,
                   const dealii::Vector<double> &rate, dealii::Vector<double> &mass,
                   dealii::Vector<double> &flow,
                   dealii::SparseMatrix<double> &mass_jacobian,
                   dealii::SparseMatrix<double> &flow_jacobian,
                   dealii::SparseMatrix<double> &rate_jacobian) const override
    {
      evaluate(t, u, rate, mass, flow);
      mass_jacobian.set(0, 0, 1 + u[0] * u[0]);
      flow_jacobian.set(0, 0, -stiffness);
      mass_jacobian.set(1, 1, 2 * u[1]);
      flow_jacobian.set(1, 1, rate[1]);
      rate_jacobian.set(1, 1, u[1]);
      flow_jacobian.set(2, 2, 1);
      flow_jacobian.set(2, 0, -u[1] * u[1]);
      flow_jacobian.set(2, 1, -2 * u[0] * u[1]);
      mass_jacobian.set(3, 3, u[1]);
      mass_jacobian.set(3, 1, u[3]);
      mass_jacobian.set(3, 4, -1);
      flow_jacobian.set(3, 3, -1);
      mass_jacobian.set(4, 4, 1);
      flow_jacobian.set(4, 3, 1);
    }

  private:
    double stiffness;
  };

  /**
   * Nonlinear conduction on a unit interval in finite volumes, (u + u^2/2)' = u'' + 10
   * inside, u = 1 + sin(t) and u = 1 at the ends.
   */
  class Conduction : public ToyProblem
  {
  public:
    explicit Conduction(const unsigned int n_points)
      : ToyProblem(n_points, 1)
    {
    }

    void evaluate(const double t, const dealii::Vector<double> &u,
                  const dealii::Vector<double> &, dealii::Vector<double> &mass,
                  dealii::Vector<double> &flow) const override
    {
      const double h = 1. / (n - 1);
      for(unsigned int i = 1; i + 1 < n; ++i)
      {
        mass[i] = h * (u[i] + u[i] * u[i] / 2);
        flow[i] = (u[i - 1] - 2 * u[i] + u[i + 1]) / h + 10 * h;
      }
      mass[0] = mass[n - 1] = 0;
      flow[0] = 1 + std::sin(t) - u[0];
      flow[n - 1] = 1 - u[n - 1];
    }

    void linearise(const double t, const dealii::Vector<double> &u,
                   const dealii::Vector<double> &rate, dealii::Vector<double> &mass,
                   dealii::Vector<double> &flow,
                   dealii::SparseMatrix<double> &mass_jacobian,
                   dealii::SparseMatrix<double> &flow_jacobian,
                   dealii::SparseMatrix<double> &) const override
    {
      evaluate(t, u, rate, mass, flow);
      const double h = 1. / (n - 1);
      for(unsigned int i = 1; i + 1 < n; ++i)
      {
        mass_jacobian.set(i, i, h * (1 + u[i]));
        flow_jacobian.set(i, i - 1, 1 / h);
        flow_jacobian.set(i, i, -2 / h);
        flow_jacobian.set(i, i + 1, 1 / h);
      }
      flow_jacobian.set(0, 0, -1);
      flow_jacobian.set(n - 1, n - 1, -1);
    }
  };

  /** u' = u^2, which runs away from u(0) = 1 at t = 1; u may be forbidden to pass a
   * ceiling before. */
  class Runaway : public ToyProblem
  {
  public:
    explicit Runaway(const double ceiling)
      : ToyProblem(1)
      , ceiling(ceiling)
    {
    }

    void evaluate(double, const dealii::Vector<double> &u, const dealii::Vector<double> &,
                  dealii::Vector<double> &mass,
                  dealii::Vector<double> &flow) const override
    {
      mass[0] = u[0];
      flow[0] = u[0] * u[0];
    }

    void linearise(const double t, const dealii::Vector<double> &u,
                   const dealii::Vector<double> &rate, dealii::Vector<double> &mass,
                   dealii::Vector<double> &flow,
                   dealii::SparseMatrix<double> &mass_jacobian,
                   dealii::SparseMatrix<double> &flow_jacobian,
                   dealii::SparseMatrix<double> &) const override
    {
      evaluate(t, u, rate, mass, flow);
      mass_jacobian.set(0, 0, 1);
      flow_jacobian.set(0, 0, 2 * u[0]);
    }

    std::string reason_invalid(const dealii::Vector<double> &u) const override
    {
      return u[0] > ceiling ? "u is above its ceiling" : "";
    }

  private:
    double ceiling;
  };
} // namespace meltfront::reference_fem::fitted

#endif
