#include <reference_fem/cut/sparse_system.h>

#include <cases/out_of_memory.h>

#include <Eigen/SparseCholesky>
#include <fmt/format.h>

namespace meltfront::reference_fem::cut
{
  SparseSystem::SparseSystem(const BackgroundMesh &mesh, const std::vector<char> &active)
    : mesh(mesh)
    , taking_part(mesh.positions.size())
    , number(mesh.positions.size(), -1)
  {
    std::vector<char> wanted(number.size());
    for(std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if(active[cell])
        for(const unsigned int dof : mesh.cells[cell].dofs)
        {
          taking_part[dof] = 1;
          for(const auto &[free, weight] : mesh.expansion(dof))
            wanted[free] = 1;
        }
    int count = 0;
    for(std::size_t dof = 0; dof < number.size(); ++dof)
      if(wanted[dof])
        number[dof] = count++;
    load = LocalVector::Zero(count);
  }

  void SparseSystem::add(const std::vector<unsigned int> &dofs, const LocalMatrix &matrix)
  {
    for(std::size_t i = 0; i < dofs.size(); ++i)
      for(std::size_t j = 0; j < dofs.size(); ++j)
        for(const auto &[row, row_weight] : mesh.expansion(dofs[i]))
          for(const auto &[column, column_weight] : mesh.expansion(dofs[j]))
            if(number[row] >= number[column])
              triplets.emplace_back(
                  number[row], number[column],
                  row_weight * column_weight
                      * matrix(static_cast<long>(i), static_cast<long>(j)));
  }

  void SparseSystem::add(const std::vector<unsigned int> &dofs, const LocalVector &part)
  {
    for(std::size_t i = 0; i < dofs.size(); ++i)
      for(const auto &[row, weight] : mesh.expansion(dofs[i]))
        load[number[row]] += weight * part[static_cast<long>(i)];
  }

  bool SparseSystem::solve(Values &values) const
  {
    LocalVector solution;
    try
    {
      Eigen::SparseMatrix<double> matrix(load.size(), load.size());
      matrix.setFromTriplets(triplets.begin(), triplets.end());
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
      if(factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 0))
        return false;
      solution = factors.solve(load);
    }
    catch(const std::bad_alloc &)
    {
      throw cases::OutOfMemory(fmt::format(
          "sparse Cholesky found none for the factors of {} unknowns", load.size()));
    }
    for(std::size_t dof = 0; dof < number.size(); ++dof)
      if(number[dof] >= 0)
        values[dof] = solution[number[dof]];
    for(std::size_t dof = 0; dof < number.size(); ++dof)
      if(taking_part[dof] && number[dof] < 0)
      {
        values[dof] = 0;
        for(const auto &[free, weight] : mesh.expansion(static_cast<unsigned int>(dof)))
          values[dof] += weight * values[free];
      }
    return true;
  }
} // namespace meltfront::reference_fem::cut
