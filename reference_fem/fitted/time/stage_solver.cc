#include <reference_fem/fitted/time/coefficients.h>
#include <reference_fem/fitted/time/stage_solver.h>

#include <algorithm>
#include <complex>
#include <limits>
#include <numeric>

namespace meltfront::reference_fem::fitted
{
  using Complex = std::complex<double>;

  SortedPattern::SortedPattern(const dealii::SparsityPattern &pattern)
    : row_starts{0}
  {
    for(unsigned int row = 0; row < pattern.n_rows(); ++row)
    {
      std::vector<int> in_row;
      for(auto entry = pattern.begin(row); entry != pattern.end(row); ++entry)
        in_row.push_back(static_cast<int>(entry->column()));
      std::vector<int> order(in_row.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(),
                [&](const int a, const int b) { return in_row[a] < in_row[b]; });
      destinations.resize(destinations.size() + order.size());
      for(std::size_t k = 0; k < order.size(); ++k)
      {
        destinations[row_starts.back() + order[k]]
            = row_starts.back() + static_cast<int>(k);
        columns.push_back(in_row[order[k]]);
      }
      row_starts.push_back(static_cast<int>(columns.size()));
    }
  }

  std::vector<double>
  SortedPattern::values(const dealii::SparseMatrix<double> &matrix) const
  {
    std::vector<double> result(columns.size());
    std::size_t k = 0;
    for(auto entry = matrix.begin(); entry != matrix.end(); ++entry)
      result[destinations[k++]] = entry->value();
    return result;
  }

  template <typename Number>
  void assemble_shifted(const SortedPattern &pattern, const Linearisation &linearisation,
                        const Number shift, const double step,
                        CompressedRows<Number> &matrix)
  {
    matrix.row_starts = pattern.row_starts;
    matrix.columns = pattern.columns;
    matrix.values.resize(pattern.columns.size());
    const std::vector<double> mass = pattern.values(linearisation.mass_jacobian),
                              flow = pattern.values(linearisation.flow_jacobian),
                              rate = pattern.values(linearisation.rate_jacobian);
    for(std::size_t k = 0; k < mass.size(); ++k)
      matrix.values[k] = shift * ((mass[k] - rate[k]) / step) - flow[k];
  }

  template void assemble_shifted(const SortedPattern &, const Linearisation &, double,
                                 double, CompressedRows<double> &);
  template void assemble_shifted(const SortedPattern &, const Linearisation &, Complex,
                                 double, CompressedRows<Complex> &);

  namespace
  {
    class ExactStageSolver : public StageSolver
    {
    public:
      ExactStageSolver(const ConservationProblem &problem, IntegrationCost &cost)
        : pattern(problem.sparsity())
        , cost(cost)
      {
      }

      bool prepare(const StageEquations &equations, const Stages &u) override
      {
        const unsigned int s = equations.n_stages();
        if(factorisations.size() < s)
        {
          factorisations.resize(s);
          matrices.resize(s);
        }
        CompressedRows<double> &matrix = matrices[s - 1];
        if(matrix.columns.empty())
          lay_out(s, matrix);
        fill(equations, u, matrix);
        cost.work += static_cast<long>(matrix.values.size());
        ++cost.factorisations;
        auto &factorisation = factorisations[s - 1];
        if(factorisation == nullptr)
          factorisation = std::make_unique<Factorisation<double>>();
        const bool success = factorisation->factorise(matrix);
        cost.work += factorisation->n_entries();
        return success;
      }

      void correct(const Stages &residual, Stages &correction) override
      {
        const std::size_t s = residual.size(), n = residual[0].size();
        std::vector<double> b(s * n), x;
        for(std::size_t i = 0; i < n; ++i)
          for(std::size_t j = 0; j < s; ++j)
            b[i * s + j] = -residual[j][i];
        factorisations[s - 1]->solve(b, x);
        cost.work += factorisations[s - 1]->n_entries();
        for(std::size_t i = 0; i < n; ++i)
          for(std::size_t j = 0; j < s; ++j)
            correction[j][i] = x[i * s + j];
      }

    private:
      /** The pattern with each entry replaced by a full block of s by s. */
      void lay_out(const unsigned int s, CompressedRows<double> &matrix) const
      {
        matrix.row_starts.assign(1, 0);
        for(std::size_t row = 0; row + 1 < pattern.row_starts.size(); ++row)
          for(unsigned int j = 0; j < s; ++j)
          {
            for(int k = pattern.row_starts[row]; k < pattern.row_starts[row + 1]; ++k)
              for(unsigned int l = 0; l < s; ++l)
                matrix.columns.push_back(pattern.columns[k] * s + l);
            matrix.row_starts.push_back(static_cast<int>(matrix.columns.size()));
          }
        matrix.values.resize(matrix.columns.size());
      }

      void fill(const StageEquations &equations, const Stages &u,
                CompressedRows<double> &matrix)
      {
        const unsigned int s = equations.n_stages();
        std::vector<std::vector<double>> mass(s), flow(s), rate(s);
        Linearisation linearisation(equations.problem());
        for(unsigned int j = 0; j < s; ++j)
        {
          equations.linearise(j, u, linearisation);
          mass[j] = pattern.values(linearisation.mass_jacobian);
          flow[j] = pattern.values(linearisation.flow_jacobian);
          rate[j] = pattern.values(linearisation.rate_jacobian);
        }
        dealii::FullMatrix<double> coupling = equations.coupling();
        coupling /= equations.step();
        std::size_t position = 0;
        for(std::size_t row = 0; row + 1 < pattern.row_starts.size(); ++row)
          for(unsigned int j = 0; j < s; ++j)
            for(int k = pattern.row_starts[row]; k < pattern.row_starts[row + 1]; ++k)
              for(unsigned int l = 0; l < s; ++l)
                matrix.values[position++] = coupling(j, l) * (mass[l][k] - rate[j][k])
                                            - (j == l ? flow[j][k] : 0.);
      }

      SortedPattern pattern;
      IntegrationCost &cost;
      /** By the number of stages: BDF starts with Radau steps. */
      std::vector<CompressedRows<double>> matrices;
      std::vector<std::unique_ptr<Factorisation<double>>> factorisations;
    };

    class FrozenStageSolver : public StageSolver
    {
    public:
      FrozenStageSolver(const ConservationProblem &problem, IntegrationCost &cost)
        : pattern(problem.sparsity())
        , cost(cost)
        , linearisation(problem)
      {
      }

      bool prepare(const StageEquations &equations, const Stages &u) override
      {
        const unsigned int s = equations.n_stages();
        step = equations.step();
        if(modes == nullptr || s != modes->values.size())
          modes = std::make_unique<Eigendecomposition>(equations.coupling());
        equations.linearise(s / 2, u, linearisation);
        bool success = true;
        for(unsigned int j = 0; j < s; ++j)
          if(modes->values[j].imag() == 0)
            success = factorise(modes->values[j].real(), real_matrix, real_factors)
                      && success;
          else if(modes->values[j].imag() > 0)
            success
                = factorise(modes->values[j], complex_matrix, complex_factors) && success;
        return success;
      }

      void correct(const Stages &residual, Stages &correction) override
      {
        const std::size_t s = residual.size(), n = residual[0].size();
        for(auto &stage : correction)
          stage = 0.;
        std::vector<double> real_b(n), real_x;
        std::vector<Complex> complex_b(n), complex_x;
        for(std::size_t e = 0; e < s; ++e)
          if(modes->values[e].imag() == 0)
          {
            for(std::size_t i = 0; i < n; ++i)
              real_b[i] = -component(residual, e, i).real();
            real_factors.solve(real_b, real_x);
            cost.work += real_factors.n_entries();
            for(std::size_t j = 0; j < s; ++j)
              for(std::size_t i = 0; i < n; ++i)
                correction[j][i] += modes->vectors(j, e).real() * real_x[i];
          }
          else if(modes->values[e].imag() > 0)
          {
            for(std::size_t i = 0; i < n; ++i)
              complex_b[i] = -component(residual, e, i);
            complex_factors.solve(complex_b, complex_x);
            cost.work += complex_factors.n_entries();
            for(std::size_t j = 0; j < s; ++j)
              for(std::size_t i = 0; i < n; ++i)
                correction[j][i] += 2 * (modes->vectors(j, e) * complex_x[i]).real();
          }
      }

    private:
      template <typename Number>
      bool factorise(const Number shift, CompressedRows<Number> &matrix,
                     Factorisation<Number> &factors)
      {
        assemble_shifted(pattern, linearisation, shift, step, matrix);
        const bool success = factors.factorise(matrix);
        ++cost.factorisations;
        cost.work += static_cast<long>(matrix.values.size()) + factors.n_entries();
        return success;
      }

      /** Of the stages' residuals at an unknown, along an eigenvector. */
      Complex component(const Stages &residual, const std::size_t e,
                        const std::size_t i) const
      {
        Complex sum = 0;
        for(std::size_t j = 0; j < residual.size(); ++j)
          sum += modes->inverse(e, j) * residual[j][i];
        return sum;
      }

      SortedPattern pattern;
      IntegrationCost &cost;
      Linearisation linearisation;
      double step = 0;
      std::unique_ptr<Eigendecomposition> modes; ///< of B
      CompressedRows<double> real_matrix;
      CompressedRows<Complex> complex_matrix;
      Factorisation<double> real_factors;
      Factorisation<Complex> complex_factors;
    };
  } // namespace

  std::unique_ptr<StageSolver> make_exact_stage_solver(const ConservationProblem &problem,
                                                       IntegrationCost &cost)
  {
    return std::make_unique<ExactStageSolver>(problem, cost);
  }

  std::unique_ptr<StageSolver>
  make_frozen_stage_solver(const ConservationProblem &problem, IntegrationCost &cost)
  {
    return std::make_unique<FrozenStageSolver>(problem, cost);
  }
} // namespace meltfront::reference_fem::fitted
