#include <reference_fem/cut/conservative/linear_system.h>

#include <cases/out_of_memory.h>

#include <Eigen/UmfPackSupport>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meltfront::reference_fem::cut::conservative
{
  namespace
  {
    using Matrix = Eigen::SparseMatrix<double>;

    LocalVector scales(const Matrix &matrix, bool of_rows)
    {
      LocalVector largest = LocalVector::Zero(matrix.cols());
      for(int column = 0; column < matrix.outerSize(); ++column)
        for(Matrix::InnerIterator entry(matrix, column); entry; ++entry)
        {
          double &most = largest[of_rows ? entry.row() : entry.col()];
          most = std::max(most, std::abs(entry.value()));
        }
      for(double &value : largest)
        value = value > 0 ? 1 / value : 1;
      return largest;
    }
  } // namespace

  LocalVector solve(long unknowns, const std::vector<Eigen::Triplet<double>> &entries,
                    const LocalVector &load)
  {
    try
    {
      Matrix matrix(unknowns, unknowns);
      matrix.setFromTriplets(entries.begin(), entries.end());
      const LocalVector rows = scales(matrix, true);
      matrix = rows.asDiagonal() * matrix;
      const LocalVector columns = scales(matrix, false);
      matrix = matrix * columns.asDiagonal();
      const Eigen::UmfPackLU<Matrix> factors(matrix);
      if(factors.info() != Eigen::Success)
        throw std::runtime_error("the matrix of a stage is singular");
      const LocalVector scaled = rows.cwiseProduct(load);
      LocalVector solution = factors.solve(scaled);
      solution = columns.cwiseProduct(solution);
      if(!solution.allFinite())
        throw std::runtime_error("the solution of a stage is not finite");
      return solution;
    }
    catch(const std::bad_alloc &)
    {
      throw cases::OutOfMemory(
          fmt::format("UMFPACK found none for the factors of {} unknowns", unknowns));
    }
  }
} // namespace meltfront::reference_fem::cut::conservative
