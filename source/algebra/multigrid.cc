#include <isochor/algebra/multigrid.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>

#include <stdexcept>

namespace isochor
{
  struct Multigrid::Trilinos
  {
    std::unique_ptr<Epetra_CrsMatrix>         matrix;
    std::vector<double>                       modes; ///< one after the other; ML reads them later
    dealii::TrilinosWrappers::PreconditionAMG cycle;
  };

  Multigrid::Multigrid()  = default;
  Multigrid::~Multigrid() = default;

  namespace
  {
    Epetra_Map map_of(const SparseMatrix::Partitioner &partitioner,
                      const bool                       with_ghosts,
                      const Epetra_Comm               &comm)
    {
      std::vector<int> indices;
      for (LocalIndex i = 0; i < partitioner.locally_owned_size(); ++i)
        indices.push_back(int(partitioner.local_to_global(i)));
      if (with_ghosts)
        for (const auto i : partitioner.ghost_indices())
          indices.push_back(int(i));
      return Epetra_Map(-1, int(indices.size()), indices.data(), 0, comm);
    }

    std::unique_ptr<Epetra_CrsMatrix> copy(const SparseMatrix &matrix)
    {
      const Epetra_MpiComm comm(matrix.partitioner()->get_mpi_communicator());
      const Epetra_Map     rows    = map_of(*matrix.partitioner(), false, comm);
      const Epetra_Map     columns = map_of(*matrix.partitioner(), true, comm);
      const auto          &start   = matrix.row_start();

      std::vector<int> lengths, indices;
      for (std::size_t row = 0; row < matrix.n_rows(); ++row)
        lengths.push_back(int(start[row + 1] - start[row]));
      auto result = std::make_unique<Epetra_CrsMatrix>(Copy, rows, columns, lengths.data(), true);
      for (std::size_t row = 0; row < matrix.n_rows(); ++row)
        {
          indices.assign(&matrix.columns()[start[row]],
                         &matrix.columns()[start[row]] + lengths[row]);
          result->InsertMyValues(
              int(row), lengths[row], &matrix.values()[start[row]], indices.data());
        }
      result->FillComplete(rows, rows);
      return result;
    }
  } // namespace

  void Multigrid::build(const SparseMatrix                     &matrix,
                        const unsigned int                      n_components,
                        const std::vector<std::vector<double>> &modes)
  {
    trilinos         = std::make_unique<Trilinos>();
    trilinos->matrix = copy(matrix);
    for (const auto &mode : modes)
      trilinos->modes.insert(trilinos->modes.end(), mode.begin(), mode.end());

    // deal.II knows ML's defaults; the rest is ours.
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.smoother_type         = "Chebyshev"; // the same on any number of ranks
    data.smoother_sweeps       = 2;
    data.w_cycle               = true; // a little flatter in the mesh than a V-cycle, at no cost
    data.aggregation_threshold = 0.;   // dropping couplings parts the rows of a node
    Teuchos::ParameterList              parameters;
    std::unique_ptr<Epetra_MultiVector> unused;
    data.set_parameters(parameters, unused, *trilinos->matrix);
    parameters.set("PDE equations", int(n_components));
    parameters.set("null space: type", "pre-computed");
    parameters.set("null space: dimension", int(modes.size()));
    parameters.set("null space: vectors", trilinos->modes.data());
    parameters.set("ML output", 0);
    trilinos->cycle.initialize(*trilinos->matrix, parameters);
  }

  void Multigrid::apply(double *out, const double *in) const
  {
    const Epetra_Map   &map = trilinos->matrix->RowMap();
    const Epetra_Vector source(View, map, const_cast<double *>(in));
    Epetra_Vector       target(View, map, out);
    if (trilinos->cycle.trilinos_operator().ApplyInverse(source, target) != 0)
      throw std::runtime_error("the multigrid cycle failed");
  }
} // namespace isochor
