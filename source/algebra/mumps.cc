#include <isochor/algebra/mumps.h>
#include <isochor/algebra/nested_dissection.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace isochor
{
  namespace
  {
    constexpr int job_initialise = -1, job_end = -2, job_analyse = 1, job_factor = 2, job_solve = 3;

    /// A pivot below this times the largest entry of the scaled matrix is taken for zero. Measured:
    /// a free body's rigid modes leave 1e-14 to 1e-10, so some may go uncounted; the smallest pivot
    /// of a clamped beam is above 1e-5 at slenderness 100 and above 1e-8 at 400.
    /// In single precision rounding alone makes pivots of 1e-7.
    template <typename number>
    constexpr number null_pivot_threshold = std::is_same_v<number, double> ? 1e-12 : 1e-6;
    constexpr int    max_enlargements     = 6;

    // MUMPS' documentation numbers the entries of its control arrays from 1.
    template <typename Struct>
    auto &icntl(Struct &mumps, const int k)
    {
      return mumps.icntl[k - 1];
    }
    template <typename Struct>
    int infog(const Struct &mumps, const int k)
    {
      return mumps.infog[k - 1];
    }

    void call_mumps(DMUMPS_STRUC_C &mumps)
    {
      dmumps_c(&mumps);
    }
    void call_mumps(SMUMPS_STRUC_C &mumps)
    {
      smumps_c(&mumps);
    }

    /// Columns that MUMPS factors together, KEEP(4:6), half and a third of what it takes by itself:
    /// LDL^T updates the columns of a panel one by one. Measured (OpenBLAS, AVX2 and AVX-512, 3 to
    /// 34 GFlop, both precisions): 5 to 18 % less time for a factorisation.
    template <typename Struct>
    void set_panels(Struct &mumps)
    {
      mumps.keep[4 - 1] = 16;
      mumps.keep[5 - 1] = 8;
      mumps.keep[6 - 1] = 8;
    }

    bool workspace_too_small(const int error)
    {
      return error == -8 || error == -9 || error == -14 || error == -15 || error == -17
             || error == -19 || error == -20;
    }

    template <typename Struct>
    std::string in_words(const Struct &mumps)
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

  template <typename number>
  Mumps<number>::Mumps(MPI_Comm communicator)
    : communicator(communicator)
  {
    mumps.sym          = 2;
    mumps.par          = 1;
    mumps.comm_fortran = MPI_Comm_c2f(communicator);
    mumps.job          = job_initialise;
    call_mumps(mumps);
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
    icntl(mumps, 20)  = 10; // and its right-hand sides
    icntl(mumps, 21)  = 1;  // solutions stay where they are computed
    icntl(mumps, 24)  = 1;  // detect null pivots
    icntl(mumps, 28)  = 1;  // sequential analysis
    mumps.cntl[3 - 1] = null_pivot_threshold<number>;
    set_panels(mumps);
  }

  template <typename number>
  Mumps<number>::~Mumps()
  {
    int finalised = 0;
    MPI_Finalized(&finalised);
    if (!finalised)
      call(job_end);
  }

  template <typename number>
  void Mumps<number>::call(const int job)
  {
    mumps.job = job;
    call_mumps(mumps);
  }

  template <typename number>
  void Mumps<number>::set_structure(const SparseMatrix &matrix)
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

  template <typename number>
  void Mumps<number>::set_values(const SparseMatrix &matrix)
  {
    const double *source = matrix.values().data();
    number       *target = values.data();
    for (const auto &[one, other] : pairs)
      *target++ = number(.5 * (source[one] + source[other]));
    for (const std::size_t k : halves)
      *target++ = number(.5 * source[k]);
  }

  template <typename number>
  void Mumps<number>::analyse(const SparseMatrix             &matrix,
                              const std::vector<GlobalIndex> &node_of_row,
                              const GlobalIndex               n_nodes)
  {
    AssertDimension(node_of_row.size(), matrix.n_rows());
    factored = false;
    if (matrix.partitioner()->size() >= std::size_t(std::numeric_limits<int>::max()))
      throw std::runtime_error("too many unknowns for MUMPS' 32-bit indices");

    partitioner = matrix.partitioner();
    owned_rows.resize(matrix.n_rows());
    std::iota(owned_rows.begin(), owned_rows.end(), int(partitioner->local_range().first) + 1);
    rhs_part.resize(std::max<std::size_t>(owned_rows.size(), 1));
    mumps.nrhs         = 1;
    mumps.nloc_rhs     = owned_rows.size();
    mumps.lrhs_loc     = rhs_part.size();
    mumps.irhs_loc     = owned_rows.data();
    mumps.rhs_loc      = rhs_part.data();
    const bool is_root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;

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

  template <typename number>
  double Mumps<number>::predicted_megabytes() const
  {
    return infog(mumps, 17);
  }

  template <typename number>
  double Mumps<number>::predicted_flops() const
  {
    return mumps.rinfog[1 - 1];
  }

  template <typename number>
  Factorisation Mumps<number>::factor(const SparseMatrix &matrix)
  {
    AssertDimension(mumps.n, int(matrix.partitioner()->size()));
    factored = false;
    solution_rows.clear();
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

  template <typename number>
  void Mumps<number>::solve(Vector &solution, const Vector &rhs)
  {
    if (!factored)
      throw std::logic_error("MUMPS: solve without a successful factorisation");
    // A float holds 1e-38 to 1e38: the size of the right-hand side must not matter.
    double size = 1.;
    if constexpr (std::is_same_v<number, float>)
      {
        size = rhs.linfty_norm();
        if (!(size > 0.) || !std::isfinite(size))
          size = 1.;
      }
    for (std::size_t i = 0; i < owned_rows.size(); ++i)
      rhs_part[i] = number(rhs.local_element(i) / size);

    const bool is_first = solution_rows.empty();
    if (is_first)
      {
        solution_rows.resize(std::max(1, mumps.info[23 - 1]));
        solution_part.resize(solution_rows.size());
        mumps.lsol_loc = solution_rows.size();
        mumps.isol_loc = solution_rows.data();
        mumps.sol_loc  = solution_part.data();
      }
    call(job_solve);
    if (infog(mumps, 1) < 0)
      throw std::runtime_error("solution with the factors failed: " + in_words(mumps));
    if (is_first)
      locate_solution();

    scattered = 0.;
    for (std::size_t k = 0; k < places.size(); ++k)
      scattered.local_element(places[k]) = solution_part[k];
    scattered.compress(dealii::VectorOperation::add);
    solution.zero_out_ghost_values();
    for (std::size_t i = 0; i < owned_rows.size(); ++i)
      solution.local_element(i) = size * scattered.local_element(i);
  }

  template <typename number>
  void Mumps<number>::locate_solution()
  {
    const std::size_t        n = mumps.info[23 - 1];
    std::vector<GlobalIndex> foreign;
    for (std::size_t k = 0; k < n; ++k)
      if (const GlobalIndex row = solution_rows[k] - 1; !partitioner->in_local_range(row))
        foreign.push_back(row);
    dealii::IndexSet ghosts(partitioner->size());
    std::sort(foreign.begin(), foreign.end());
    ghosts.add_indices(foreign.begin(), foreign.end());
    const auto places_of = std::make_shared<const SparseMatrix::Partitioner>(
        partitioner->locally_owned_range(), ghosts, communicator);
    scattered.reinit(places_of);
    places.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      places[k] = places_of->global_to_local(solution_rows[k] - 1);
  }

  template class Mumps<double>;
  template class Mumps<float>;
} // namespace isochor
