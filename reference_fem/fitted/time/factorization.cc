#include <reference_fem/fitted/time/factorization.h>

#include <umfpack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <new>
#include <type_traits>

namespace meltfront::reference_fem::fitted
{
  namespace
  {
    // UMFPACK takes columns where the matrix has rows: it factorises the transpose, and
    // solves with the transpose of that.

    const double *data(const std::vector<double> &values)
    {
      return values.data();
    }

    const double *data(const std::vector<std::complex<double>> &values)
    {
      return reinterpret_cast<const double *>(values.data());
    }

    template <typename Number>
    constexpr bool is_real = std::is_same_v<Number, double>;

    template <typename Number>
    int analyze(const CompressedRows<Number> &matrix, void **symbolic)
    {
      const int n = matrix.n_rows();
      if constexpr(is_real<Number>)
        return umfpack_di_symbolic(n, n, matrix.row_starts.data(), matrix.columns.data(),
                                   data(matrix.values), symbolic, nullptr, nullptr);
      else
        return umfpack_zi_symbolic(n, n, matrix.row_starts.data(), matrix.columns.data(),
                                   data(matrix.values), nullptr, symbolic, nullptr,
                                   nullptr);
    }

    /** A matrix whose factors do not fit into memory is not singular: another step would
     * not help. */
    bool succeeded(const int status)
    {
      if(status == UMFPACK_ERROR_out_of_memory)
        throw std::bad_alloc();
      return status == UMFPACK_OK;
    }
  } // namespace

  template <typename Number>
  bool Factorisation<Number>::factorise(const CompressedRows<Number> &new_matrix)
  {
    free_numeric();
    matrix = &new_matrix;
    const bool finite
        = std::all_of(matrix->values.begin(), matrix->values.end(),
                      [](const Number &value) { return std::isfinite(std::abs(value)); });
    if(!finite)
      return false;
    if(symbolic == nullptr && !succeeded(analyze(*matrix, &symbolic)))
      return false;

    std::array<double, UMFPACK_INFO> info{};
    int status = UMFPACK_OK;
    if constexpr(is_real<Number>)
      status = umfpack_di_numeric(matrix->row_starts.data(), matrix->columns.data(),
                                  data(matrix->values), symbolic, &numeric, nullptr,
                                  info.data());
    else
      status = umfpack_zi_numeric(matrix->row_starts.data(), matrix->columns.data(),
                                  data(matrix->values), nullptr, symbolic, &numeric,
                                  nullptr, info.data());
    entries = static_cast<long>(info[UMFPACK_LNZ] + info[UMFPACK_UNZ]);
    return succeeded(status);
  }

  template <typename Number>
  void Factorisation<Number>::solve(const std::vector<Number> &b,
                                    std::vector<Number> &x) const
  {
    x.resize(b.size());
    // Refinement would double the cost, and Newton's method refines anyway.
    std::array<double, UMFPACK_CONTROL> control{};
    if constexpr(is_real<Number>)
    {
      umfpack_di_defaults(control.data());
      control[UMFPACK_IRSTEP] = 0;
      umfpack_di_solve(UMFPACK_Aat, matrix->row_starts.data(), matrix->columns.data(),
                       data(matrix->values), x.data(), b.data(), numeric, control.data(),
                       nullptr);
    }
    else
    {
      umfpack_zi_defaults(control.data());
      control[UMFPACK_IRSTEP] = 0;
      umfpack_zi_solve(UMFPACK_Aat, matrix->row_starts.data(), matrix->columns.data(),
                       data(matrix->values), nullptr,
                       reinterpret_cast<double *>(x.data()), nullptr, data(b), nullptr,
                       numeric, control.data(), nullptr);
    }
  }

  template <typename Number>
  void Factorisation<Number>::free_numeric()
  {
    if(numeric == nullptr)
      return;
    if constexpr(is_real<Number>)
      umfpack_di_free_numeric(&numeric);
    else
      umfpack_zi_free_numeric(&numeric);
  }

  template <typename Number>
  Factorisation<Number>::~Factorisation()
  {
    free_numeric();
    if(symbolic == nullptr)
      return;
    if constexpr(is_real<Number>)
      umfpack_di_free_symbolic(&symbolic);
    else
      umfpack_zi_free_symbolic(&symbolic);
  }

  template class Factorisation<double>;
  template class Factorisation<std::complex<double>>;
} // namespace meltfront::reference_fem::fitted
