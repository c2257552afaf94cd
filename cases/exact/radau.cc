#include <cases/error.h>
#include <cases/exact/lagrange_points.h>
#include <cases/exact/radau.h>

#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>

namespace meltfront::cases::spectral
{
  namespace
  {
    /** Zeros of P_s - P_(s-1) on [0, 1]: the Radau abscissae, the last one 1. */
    Eigen::VectorXd radau_abscissae(int stages)
    {
      const auto polynomial = [&](double x)
      {
        return boost::math::legendre_p(stages, 2 * x - 1)
               - boost::math::legendre_p(stages - 1, 2 * x - 1);
      };
      std::vector<double> zeros;
      const int samples = 40 * stages;
      for(int i = 0; i + 1 < samples; ++i)
      {
        const double left = static_cast<double>(i) / samples,
                     right = static_cast<double>(i + 1) / samples;
        if(polynomial(left) * polynomial(right) > 0)
          continue;
        std::uintmax_t iterations = 100;
        const auto bracket = boost::math::tools::toms748_solve(
            polynomial, left, right, boost::math::tools::eps_tolerance<double>(),
            iterations);
        zeros.push_back((bracket.first + bracket.second) / 2);
      }
      zeros.push_back(1);
      return Eigen::Map<Eigen::VectorXd>(zeros.data(), stages);
    }

    /** a_ij, the integral of the j-th Lagrange polynomial up to c_i, through the shifted
     * Legendre polynomials, whose primitives are (P_(k+1) - P_(k-1))/(2 (2 k + 1)). */
    Eigen::MatrixXd coefficient_matrix(const Eigen::VectorXd &abscissae)
    {
      const int stages = static_cast<int>(abscissae.size());
      Eigen::MatrixXd values(stages, stages), primitives(stages, stages);
      for(int i = 0; i < stages; ++i)
      {
        const double x = 2 * abscissae[i] - 1;
        for(int k = 0; k < stages; ++k)
        {
          values(i, k) = boost::math::legendre_p(k, x);
          const double below = k == 0 ? -1 : boost::math::legendre_p(k - 1, x);
          primitives(i, k)
              = (boost::math::legendre_p(k + 1, x) - below) / (2 * (2 * k + 1));
        }
      }
      return primitives * values.inverse();
    }

    double scaled_norm(const Eigen::MatrixXd &values, const Eigen::VectorXd &scale)
    {
      return (scale.cwiseInverse().asDiagonal() * values).cwiseAbs().maxCoeff();
    }

    /** By central differences: exact up to round-off in components in which the rate is
     * quadratic. */
    Eigen::MatrixXd numerical_jacobian(const StiffProblem &problem, double time,
                                       const Eigen::VectorXd &state,
                                       const Eigen::VectorXd &scale)
    {
      const Eigen::Index size = state.size();
      Eigen::MatrixXd jacobian(size, size);
      Eigen::VectorXd shifted = state, above(size), below(size);
      for(Eigen::Index j = 0; j < size; ++j)
      {
        const double shift = 1e-4 * scale[j];
        shifted[j] = state[j] + shift;
        problem.rate(time, shifted, above);
        shifted[j] = state[j] - shift;
        problem.rate(time, shifted, below);
        shifted[j] = state[j];
        jacobian.col(j) = (above - below) / (2 * shift);
      }
      return jacobian;
    }
  } // namespace

  Eigen::VectorXd Trajectory::value(const Piece &piece, double time) const
  {
    return piece.states
           * interpolation_weights(abscissae, weights,
                                   (time - piece.start) / piece.length);
  }

  Eigen::VectorXd Trajectory::state(double time) const
  {
    const auto after
        = std::upper_bound(pieces.begin(), pieces.end(), time,
                           [](double t, const Piece &piece) { return t < piece.start; });
    return value(after == pieces.begin() ? *after : *std::prev(after), time);
  }

  double Trajectory::end() const
  {
    return pieces.back().start + pieces.back().length;
  }

  RadauIntegrator::RadauIntegrator(int stages)
    : stages(stages)
    , abscissae(radau_abscissae(stages))
    , inverse(coefficient_matrix(abscissae).inverse())
  {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(inverse);
    eigenvalues = solver.eigenvalues();
    eigenvectors = solver.eigenvectors();
    from_eigenvector = eigenvectors.inverse();
    predictor = interpolation_weights(abscissae, barycentric_weights(abscissae), 0);
  }

  bool RadauIntegrator::solve_stages(const StiffProblem &problem, double time,
                                     double length, const Eigen::MatrixXd &jacobian,
                                     const Eigen::VectorXd &scale, double tolerance,
                                     Eigen::MatrixXd &states) const
  {
    const Eigen::Index size = jacobian.rows();
    // Conjugate eigenvalues come in pairs with conjugate solutions: one of each will do.
    std::vector<int> solved;
    std::vector<Eigen::PartialPivLU<Eigen::MatrixXcd>> factors;
    for(int i = 0; i < stages; ++i)
      if(eigenvalues[i].imag() >= 0)
      {
        solved.push_back(i);
        Eigen::MatrixXcd matrix = -jacobian.cast<std::complex<double>>();
        matrix.diagonal().array() += eigenvalues[i] / length;
        factors.emplace_back(matrix);
      }

    Eigen::MatrixXd residual(size, stages);
    Eigen::VectorXd rate(size);
    double last_update = std::numeric_limits<double>::infinity();
    const int most_iterations = 30;
    for(int iteration = 0; iteration < most_iterations; ++iteration)
    {
      for(int i = 0; i < stages; ++i)
      {
        if(!problem.admissible(states.col(i + 1)))
          return false;
        problem.rate(time + abscissae[i] * length, states.col(i + 1), rate);
        residual.col(i) = rate;
      }
      const Eigen::MatrixXd increments
          = states.rightCols(stages).colwise() - states.col(0);
      residual -= increments * inverse.transpose() / length;

      const Eigen::MatrixXcd transformed = residual * from_eigenvector.transpose();
      Eigen::MatrixXd update = Eigen::MatrixXd::Zero(size, stages);
      for(std::size_t k = 0; k < solved.size(); ++k)
      {
        const int i = solved[k];
        const double multiplicity = eigenvalues[i].imag() > 0 ? 2 : 1;
        const Eigen::VectorXcd part = factors[k].solve(transformed.col(i));
        update += multiplicity * (part * eigenvectors.col(i).transpose()).real();
      }
      states.rightCols(stages) += update;

      const double size_of_update = scaled_norm(update, scale);
      if(!std::isfinite(size_of_update))
        return false;
      // Converged, or at round-off: an update that no longer shrinks but is harmless.
      const double contraction = size_of_update / last_update;
      if(size_of_update <= 1e-3 * tolerance
         || (contraction > 0.3 && size_of_update <= 0.1 * tolerance))
        return true;
      if(contraction > 0.9 && iteration > 2)
        return false;
      last_update = size_of_update;
    }
    return false;
  }

  Trajectory RadauIntegrator::integrate(const StiffProblem &problem,
                                        const Eigen::VectorXd &initial, double start,
                                        double end, double tolerance) const
  {
    Trajectory result;
    result.abscissae.resize(stages + 1);
    result.abscissae << 0, abscissae;
    result.weights = barycentric_weights(result.abscissae);

    Eigen::VectorXd state = initial;
    problem.observe(0, start, state);
    double time = start, length = 1e-3 * (end - start);
    while(time < end)
    {
      const bool last = length >= 0.999999 * (end - time);
      if(last)
        length = end - time;
      if(length < 1e-13 * std::max(std::abs(time), end - start))
        throw NumericalError(problem.name, result.steps(), time, "the time step",
                             "cannot be made small enough");
      const long most_steps = 5000;
      if(result.steps() == most_steps)
        throw NumericalError(problem.name, most_steps, time, "the number of steps",
                             "is at its limit before the end");
      const Eigen::VectorXd scale = problem.scale(state);
      Eigen::MatrixXd states(state.size(), stages + 1);
      states.col(0) = state;
      for(int i = 1; i <= stages; ++i)
        states.col(i) = state;
      if(!result.pieces.empty() && length <= 3 * result.pieces.back().length)
        for(int i = 1; i <= stages; ++i)
        {
          const Eigen::VectorXd guess
              = result.value(result.pieces.back(), time + result.abscissae[i] * length);
          if(problem.admissible(guess))
            states.col(i) = guess;
        }
      const Eigen::MatrixXd jacobian = numerical_jacobian(problem, time, state, scale);
      if(!solve_stages(problem, time, length, jacobian, scale, tolerance, states))
      {
        length /= 4;
        continue;
      }
      const double error
          = scaled_norm(states.rightCols(stages) * predictor - state, scale) / tolerance;
      const double factor
          = std::clamp(0.9 * std::pow(std::max(error, 1e-10), -1. / stages), 0.2, 3.);
      if(error > 1)
      {
        length *= factor;
        continue;
      }
      result.pieces.push_back({time, length, states});
      time = last ? end : time + length;
      state = states.col(stages);
      problem.observe(result.steps(), time, state);
      if(problem.finished && problem.finished(time, state))
        break;
      length *= factor;
    }
    return result;
  }
} // namespace meltfront::cases::spectral
