#include <isochor/algebra/mumps.h>
#include <isochor/algebra/nested_dissection.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    constexpr int job_initialise = -1, job_end = -2, job_analyse = 1, job_factor = 2, job_solve = 3;

    /// A pivot below this times the largest entry of the scaled matrix is taken for zero. Measured:
    /// a free body's rigid modes leave 1e-14 to 1e-10, so some may go uncounted; the smallest pivot
    /// of a clamped beam is above 1e-5 at slenderness 100 and above 1e-8 at 400.
    constexpr double null_pivot_threshold = 1e-12;
    constexpr int    max_enlargements     = 6;

    // MUMPS' documentation numbers the entries of its control arrays from 1.
    int &icntl(DMUMPS_STRUC_C &mumps, const int k)
    {
      return mumps.icntl[k - 1];
    }
    int infog(const DMUMPS_STRUC_C &mumps, const int k)
    {
      return mumps.infog[k - 1];
    }

    bool workspace_too_small(const int error)
    {
      return error == -8 || error == -9 || error == -14 || error == -15 || error == -17
             || error == -19 || error == -20;
    }

    std::string in_words(const DMUMPS_STRUC_C &mumps)
    {
      const int   error = infog(mumps, 1);
      std::string text;
      if (error == -6 || error == -10)
        text = "the matrix is singular";
      else if (error == -7 || error == -13)
        text = "out of memory";
      else if (workspace_too_small(error))
        text = "the workspace is too small, even enlarged";
      else
        text = "MUMPS failed";
      return text + " (MUMPS error " + std::to_string(error) + ", "
             + std::to_string(infog(mumps, 2)) + ")";
    }
  } // namespace

  Mumps::Mumps(MPI_Comm communicator)
    : communicator(communicator)
  {
    mumps.sym          = 2;
    mumps.par          = 1;
    mumps.comm_fortran = MPI_Comm_c2f(communicator);
    mumps.job          = job_initialise;
    dmumps_c(&mumps);
    if (infog(mumps, 1) < 0)
      throw std::runtime_error("MUMPS cannot start: " + in_words(mumps));

    for (const int stream : {1, 2, 3})
      icntl(mumps, stream) = 0; // no output at all
    icntl(mumps, 4)   = 0;
    icntl(mumps, 7)   = 1;  // elimination order given in perm_in
    icntl(mumps, 12)  = 1;  // and taken as it is
    icntl(mumps, 13)  = 1;  // no ScaLAPACK at the root: it would not count negative pivots
    icntl(mumps, 14)  = 30; // per cent more workspace than predicted, for delayed pivots
    icntl(mumps, 18)  = 3;  // each rank gives its entries
    icntl(mumps, 24)  = 1;  // detect null pivots
    icntl(mumps, 28)  = 1;  // sequential analysis
    mumps.cntl[3 - 1] = null_pivot_threshold;
  }

  Mumps::~Mumps()
  {
    int finalised = 0;
    MPI_Finalized(&finalised);
    if (!finalised)
      call(job_end);
  }

  void Mumps::call(const int job)
  {
    mumps.job = job;
    dmumps_c(&mumps);
  }

  void Mumps::set_structure(const SparseMatrix &matrix)
  {
    const auto       &partitioner = *matrix.partitioner();
    const std::size_t n_owned     = matrix.n_rows();
    rows.clear();
    columns.clear();
    pairs.clear();
    halves.clear();

    // Rows come in ascending order, so the transposes in any one row are met in the order of its
    // columns: one mark per row follows them.
    const auto              &start = matrix.row_start();
    std::vector<std::size_t> transpose(n_owned);
    for (std::size_t row = 0; row < n_owned; ++row)
      for (std::size_t k = start[row]; k < start[row + 1]; ++k)
        {
          const LocalIndex column = matrix.columns()[k];
          if (column > row)
            break;
          if (column == row)
            transpose[row] = k;
          if (transpose[column] >= start[column + 1] || matrix.columns()[transpose[column]] != row)
            throw std::logic_error("MUMPS needs a symmetric pattern with all diagonal entries");
          rows.push_back(partitioner.local_to_global(row) + 1);
          columns.push_back(partitioner.local_to_global(column) + 1);
          pairs.emplace_back(k, transpose[column]++);
        }
    for (std::size_t row = 0; row < n_owned; ++row)
      for (std::size_t k = start[row]; k < start[row + 1]; ++k)
        if (matrix.columns()[k] >= n_owned)
          {
            // The other rank gives the other half, MUMPS adds them up.
            const int mine   = partitioner.local_to_global(row) + 1;
            const int theirs = partitioner.local_to_global(matrix.columns()[k]) + 1;
            rows.push_back(std::max(mine, theirs));
            columns.push_back(std::min(mine, theirs));
            halves.push_back(k);
          }
    values.resize(rows.size());

    mumps.nnz_loc = rows.size();
    mumps.irn_loc = rows.data();
    mumps.jcn_loc = columns.data();
    mumps.a_loc   = values.data();
  }

  void Mumps::set_values(const SparseMatrix &matrix)
  {
    const double *source = matrix.values().data();
    double       *target = values.data();
    for (const auto &[one, other] : pairs)
      *target++ = .5 * (source[one] + source[other]);
    for (const std::size_t k : halves)
      *target++ = .5 * source[k];
  }

  void Mumps::analyse(const SparseMatrix             &matrix,
                      const std::vector<GlobalIndex> &node_of_row,
                      const GlobalIndex               n_nodes)
  {
    AssertDimension(node_of_row.size(), matrix.n_rows());
    factored = false;
    if (matrix.partitioner()->size() >= std::size_t(std::numeric_limits<int>::max()))
      throw std::runtime_error("too many unknowns for MUMPS' 32-bit indices");

    const int mine = matrix.n_rows();
    counts         = dealii::Utilities::MPI::all_gather(communicator, mine);
    offsets        = dealii::Utilities::MPI::all_gather(
        communicator, static_cast<int>(matrix.partitioner()->local_range().first));
    const bool is_root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    dense.resize(is_root ? matrix.partitioner()->size() : 0);

    place = nested_dissection(matrix, node_of_row, n_nodes);
    for (int &p : place)
      ++p;
    set_structure(matrix);
    mumps.n       = matrix.partitioner()->size();
    mumps.perm_in = is_root ? place.data() : nullptr;
    call(job_analyse);
    if (infog(mumps, 1) < 0)
      throw std::runtime_error("analysis of the sparsity pattern failed: " + in_words(mumps));
  }

  Factorisation Mumps::factor(const SparseMatrix &matrix)
  {
    AssertDimension(mumps.n, int(matrix.partitioner()->size()));
    factored = false;
    set_values(matrix);

    Factorisation result;
    // MUMPS may search for a pivot forever among NaNs.
    bool finite = true;
    for (const double value : values)
      finite = finite && std::isfinite(value);
    if (!dealii::Utilities::MPI::logical_or(!finite, communicator))
      {
        call(job_factor);
        for (int i = 0; i < max_enlargements && workspace_too_small(infog(mumps, 1)); ++i)
          {
            icntl(mumps, 14) *= 2;
            call(job_factor);
          }
        if (infog(mumps, 1) < 0)
          result.failure = in_words(mumps);
        result.null_pivots = infog(mumps, 1) < 0 ? 0 : infog(mumps, 28);
        if (result.null_pivots > 0)
          result.failure = "the matrix is singular: " + std::to_string(result.null_pivots)
                           + (result.null_pivots == 1 ? " null pivot" : " null pivots");
      }
    else
      result.failure = "the matrix has entries that are not finite";

    factored = result.succeeded = result.failure.empty();
    if (result.succeeded)
      {
        result.negative_pivots = infog(mumps, 12);
        result.flops           = mumps.rinfog[3 - 1];
        result.megabytes       = infog(mumps, 19);
      }
    return result;
  }

  void Mumps::solve(Vector &solution, const Vector &rhs)
  {
    if (!factored)
      throw std::logic_error("MUMPS: solve without a successful factorisation");
    const int n_owned = rhs.locally_owned_size();
    MPI_Gatherv(rhs.begin(),
                n_owned,
                MPI_DOUBLE,
                dense.data(),
                counts.data(),
                offsets.data(),
                MPI_DOUBLE,
                0,
                communicator);
    mumps.rhs  = dense.data();
    mumps.nrhs = 1;
    mumps.lrhs = mumps.n;
    call(job_solve);
    if (infog(mumps, 1) < 0)
      throw std::runtime_error("solution with the factors failed: " + in_words(mumps));
    solution.zero_out_ghost_values();
    MPI_Scatterv(dense.data(),
                 counts.data(),
                 offsets.data(),
                 MPI_DOUBLE,
                 solution.begin(),
                 n_owned,
                 MPI_DOUBLE,
                 0,
                 communicator);
  }
} // namespace isochor
