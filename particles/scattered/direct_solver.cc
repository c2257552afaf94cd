#include <cases/out_of_memory.h>
#include <particles/scattered/direct_solver.h>

#include <fmt/format.h>

#include <umfpack.h>

namespace meltfront::particles
{
  static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

  namespace
  {
    SuiteSparse_long *of(std::vector<std::int64_t> &indices)
    {
      return reinterpret_cast<SuiteSparse_long *>(indices.data());
    }

    const SuiteSparse_long *of(const std::vector<std::int64_t> &indices)
    {
      return reinterpret_cast<const SuiteSparse_long *>(indices.data());
    }
  } // namespace

  namespace
  {
    [[noreturn]] void tell_lack_of_memory(std::size_t unknowns)
    {
      throw cases::OutOfMemory(
          fmt::format("UMFPACK found none for the factors of {} unknowns", unknowns));
    }
  } // namespace

  DirectSolver::DirectSolver(const CompressedRows &matrix)
    : offsets(matrix.offsets.begin(), matrix.offsets.end())
    , columns(matrix.columns.begin(), matrix.columns.end())
    , coefficients(matrix.coefficients)
  {
    // UMFPACK takes columns: rows are those of the transpose, and solve() says so.
    const auto n = static_cast<SuiteSparse_long>(matrix.rows());
    double info[UMFPACK_INFO] = {};
    void *symbolic = nullptr;
    SuiteSparse_long status = umfpack_dl_symbolic(
        n, n, of(offsets), of(columns), coefficients.data(), &symbolic, nullptr, info);
    if(status == UMFPACK_OK)
      status = umfpack_dl_numeric(of(offsets), of(columns), coefficients.data(), symbolic,
                                  &numeric, nullptr, info);
    umfpack_dl_free_symbolic(&symbolic);
    if(status == UMFPACK_ERROR_out_of_memory)
      tell_lack_of_memory(matrix.rows());
    if(status != UMFPACK_OK)
      return;
    rcond = info[UMFPACK_RCOND];
    factor_fill = (info[UMFPACK_LNZ] + info[UMFPACK_UNZ]) / double(matrix.size());
  }

  DirectSolver::~DirectSolver()
  {
    umfpack_dl_free_numeric(&numeric);
  }

  bool DirectSolver::solve(std::span<const double> right_hand_side,
                           std::span<double> x) const
  {
    if(rcond == 0)
      return false;
    const SuiteSparse_long status
        = umfpack_dl_solve(UMFPACK_At, of(offsets), of(columns), coefficients.data(),
                           x.data(), right_hand_side.data(), numeric, nullptr, nullptr);
    if(status == UMFPACK_ERROR_out_of_memory)
      tell_lack_of_memory(x.size());
    return status == UMFPACK_OK;
  }
} // namespace meltfront::particles
