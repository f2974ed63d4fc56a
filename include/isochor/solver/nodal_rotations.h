#pragma once

// How far the neighbourhood of each node has turned between two states. Bending and twisting bodies
// turn a lot and strain little, so that K(x) is close to R K(x_0) R^T, R the rotations of the nodes:
// factors of K(x_0) precondition K(x) well once vectors are turned back and forth. The warping
// of corotational methods (Mueller et al. 2002), here applied to a preconditioner.

#include <isochor/algebra/direct_solver.h>
#include <isochor/space/discretisation.h>
#include <isochor/space/prescribed_displacements.h>

namespace isochor
{
  template <int dim>
  class NodalRotations
  {
  public:
    /// Nodes with a prescribed component do not turn. References must outlive this.
    NodalRotations(const Discretisation<dim>          &discretisation,
                   const PrescribedDisplacements<dim> &prescribed);

    /// Rotations from now on are from @p state (ghosts up to date), none at it.
    void start(const Vector &state);

    /// Rotations from the state of start() to @p state (ghosts up to date).
    void update(const Vector &state);

    /// Displacements of each owned node: v = R v, or R^T v.
    void turn(Vector &vector) const;
    void turn_back(Vector &vector) const;

  private:
    using Tensor = dealii::Tensor<2, dim>;

    /// Rotation of the mean deformation gradient around each owned node.
    std::vector<Tensor> rotations(const Vector &state) const;

    const Discretisation<dim> &discretisation;
    std::vector<char>          is_held; ///< by owned node
    std::vector<Tensor>        at_start;
    std::vector<Tensor>        since; ///< empty: none
  };

  /// R A^-1 R^T, A the factored matrix: an approximate inverse of the matrix of the turned body.
  template <int dim>
  class TurnedSolver : public DirectSolver
  {
  public:
    TurnedSolver(std::unique_ptr<DirectSolver> solver, const NodalRotations<dim> &rotations)
      : solver(std::move(solver))
      , rotations(rotations)
    {
    }

    void analyse(const SparseMatrix             &matrix,
                 const std::vector<GlobalIndex> &node_of_row,
                 const GlobalIndex               n_nodes) override
    {
      solver->analyse(matrix, node_of_row, n_nodes);
    }
    double predicted_megabytes() const override
    {
      return solver->predicted_megabytes();
    }
    double predicted_flops() const override
    {
      return solver->predicted_flops();
    }
    Factorisation factor(const SparseMatrix &matrix) override
    {
      return solver->factor(matrix);
    }
    void solve(Vector &solution, const Vector &rhs) override
    {
      turned = rhs;
      rotations.turn_back(turned);
      solver->solve(solution, turned);
      rotations.turn(solution);
    }

  private:
    std::unique_ptr<DirectSolver> solver;
    const NodalRotations<dim>    &rotations;
    Vector                        turned;
  };
} // namespace isochor
