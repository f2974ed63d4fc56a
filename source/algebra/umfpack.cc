#include <isochor/algebra/umfpack.h>
#include <isochor/core/error.h>

#include <deal.II/base/mpi.h>

#include <umfpack.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /// Smallest over largest pivot of the scaled matrix below which it is taken for singular.
    constexpr double null_pivot_threshold = 1e-12;
    constexpr int    n_scaling_sweeps     = 3;

    using Long = SuiteSparse_long;
    static_assert(sizeof(Long) == sizeof(std::int64_t));
    const Long *as_long(const std::vector<std::int64_t> &numbers)
    {
      return reinterpret_cast<const Long *>(numbers.data());
    }

    std::string in_words(const int status)
    {
      switch (status)
        {
          case UMFPACK_WARNING_singular_matrix:
            return "the matrix is singular";
          case UMFPACK_ERROR_out_of_memory:
            return "out of memory";
          default:
            return "UMFPACK failed (status " + std::to_string(status) + ")";
        }
    }
  } // namespace

  Umfpack::Umfpack(MPI_Comm communicator)
    : control(UMFPACK_CONTROL)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks > 1)
      throw UserError("UMFPACK works on one MPI rank only, this run has " + std::to_string(n_ranks)
                      + ": choose MUMPS or run without mpirun");
    umfpack_dl_defaults(control.data());
    control[UMFPACK_SCALE]  = UMFPACK_SCALE_NONE; // ours is symmetric
    control[UMFPACK_IRSTEP] = 0;                  // checked_solve refines with the true matrix
  }

  Umfpack::~Umfpack()
  {
    free_numeric();
    umfpack_dl_free_symbolic(&symbolic);
  }

  void Umfpack::free_numeric()
  {
    umfpack_dl_free_numeric(&numeric);
    numeric = nullptr;
  }

  void
  Umfpack::analyse(const SparseMatrix &matrix, const std::vector<GlobalIndex> &, const GlobalIndex)
  {
    free_numeric();
    umfpack_dl_free_symbolic(&symbolic);
    symbolic = nullptr;

    // Compressed rows of A are compressed columns of A^T.
    row_start.assign(matrix.row_start().begin(), matrix.row_start().end());
    columns.assign(matrix.columns().begin(), matrix.columns().end());
    const Long n = matrix.n_rows();
    scaled_rhs.resize(n);
    scaled_solution.resize(n);
    const int status = umfpack_dl_symbolic(
        n, n, as_long(row_start), as_long(columns), nullptr, &symbolic, control.data(), nullptr);
    if (status != UMFPACK_OK)
      throw std::runtime_error("analysis of the sparsity pattern failed: " + in_words(status));
  }

  void Umfpack::set_values(const SparseMatrix &matrix)
  {
    // Ruiz' sweeps: the largest entry of each row goes to one.
    values = matrix.values();
    scaling.assign(matrix.n_rows(), 1.);
    std::vector<double> factor(matrix.n_rows());
    for (int sweep = 0; sweep < n_scaling_sweeps; ++sweep)
      {
        for (std::size_t row = 0; row < factor.size(); ++row)
          {
            double largest = 0;
            for (auto k = row_start[row]; k < row_start[row + 1]; ++k)
              largest = std::max(largest, std::abs(values[k]));
            factor[row] = largest > 0 ? 1. / std::sqrt(largest) : 1.;
          }
        for (std::size_t row = 0; row < factor.size(); ++row)
          {
            scaling[row] *= factor[row];
            for (auto k = row_start[row]; k < row_start[row + 1]; ++k)
              values[k] *= factor[row] * factor[columns[k]];
          }
      }
  }

  Factorisation Umfpack::factor(const SparseMatrix &matrix)
  {
    AssertDimension(row_start.size(), matrix.n_rows() + 1);
    free_numeric();
    Factorisation result;
    for (const double value : matrix.values())
      if (!std::isfinite(value))
        {
          result.failure = "the matrix has entries that are not finite";
          return result;
        }

    set_values(matrix);
    std::vector<double> info(UMFPACK_INFO);
    const int           status = umfpack_dl_numeric(as_long(row_start),
                                          as_long(columns),
                                          values.data(),
                                          symbolic,
                                          &numeric,
                                          control.data(),
                                          info.data());
    if (status == UMFPACK_OK || status == UMFPACK_WARNING_singular_matrix)
      {
        std::vector<double> pivots(matrix.n_rows());
        umfpack_dl_get_numeric(nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               pivots.data(),
                               nullptr,
                               nullptr,
                               numeric);
        double largest = 0;
        for (const double pivot : pivots)
          largest = std::max(largest, std::abs(pivot));
        for (const double pivot : pivots)
          if (!(std::abs(pivot) > null_pivot_threshold * largest))
            ++result.null_pivots;
        if (result.null_pivots > 0)
          result.failure = "the matrix is singular: " + std::to_string(result.null_pivots)
                           + (result.null_pivots == 1 ? " null pivot" : " null pivots");
      }
    else
      result.failure = in_words(status);

    result.succeeded = result.failure.empty();
    if (result.succeeded)
      {
        result.flops     = info[UMFPACK_FLOPS];
        result.megabytes = info[UMFPACK_NUMERIC_SIZE] * info[UMFPACK_SIZE_OF_UNIT] / 1e6;
      }
    else
      free_numeric();
    return result;
  }

  void Umfpack::solve(Vector &solution, const Vector &rhs)
  {
    if (!numeric)
      throw std::logic_error("UMFPACK: solve without a successful factorisation");
    for (std::size_t row = 0; row < scaling.size(); ++row)
      scaled_rhs[row] = scaling[row] * rhs.local_element(row);
    const int status = umfpack_dl_solve(UMFPACK_Aat,
                                        as_long(row_start),
                                        as_long(columns),
                                        values.data(),
                                        scaled_solution.data(),
                                        scaled_rhs.data(),
                                        numeric,
                                        control.data(),
                                        nullptr);
    if (status != UMFPACK_OK)
      throw std::runtime_error("solution with the factors failed: " + in_words(status));
    for (std::size_t row = 0; row < scaling.size(); ++row)
      solution.local_element(row) = scaling[row] * scaled_solution[row];
  }
} // namespace isochor
