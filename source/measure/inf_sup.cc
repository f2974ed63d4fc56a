#include <isochor/algebra/mumps.h>
#include <isochor/element/cell_quadrature.h>
#include <isochor/measure/inf_sup.h>
#include <isochor/space/matrix_pattern.h>

#include <deal.II/lac/parpack_solver.h>
#include <deal.II/lac/solver_control.h>

#include <cmath>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    /// Adds the scalar or vector blocks of a cell to a matrix.
    template <int dim>
    class BlockWriter
    {
    public:
      BlockWriter(const CellTables<dim> &cells, const CellOffsets &offsets, SparseMatrix &matrix)
        : cells(cells)
        , offsets(offsets)
        , row_start(matrix.row_start())
        , values(matrix.values())
      {
      }

      /// Entry of local nodes @p r and @p s, components @p i and @p k; pressure nodes follow the
      /// displacement nodes.
      void add(const std::size_t  cell,
               const unsigned int r,
               const unsigned int i,
               const unsigned int s,
               const unsigned int k,
               const double       value)
      {
        const LocalIndex head = r < cells.n_x ? cells.x[cell * cells.n_x + r]
                                              : cells.p[cell * cells.n_p + r - cells.n_x];
        if (head < cells.n_owned_unknowns)
          values[row_start[head + i] + offsets.row(cell, r)[s] + k] += value;
      }

    private:
      const CellTables<dim>          &cells;
      const CellOffsets              &offsets;
      const std::vector<std::size_t> &row_start;
      std::vector<double>            &values;
    };

    /// dPhi/dF at a point.
    template <int dim>
    dealii::Tensor<2, dim> volumetric_gradient(const VolumetricStrain        strain,
                                               const dealii::Tensor<2, dim> &grad_u)
    {
      Deformation deformation;
      for (int i = 0; i < 3; ++i)
        for (int J = 0; J < 3; ++J)
          deformation.F[3 * i + J]
              = batch((i == J ? 1. : 0.) + (i < dim && J < dim ? grad_u[i][J] : 0.));
      deformation.complete();
      const VolumetricResponse response = evaluate(strain, deformation);
      dealii::Tensor<2, dim>   gradient;
      for (int i = 0; i < dim; ++i)
        for (int J = 0; J < dim; ++J)
          gradient[i][J] = response.gradient[3 * i + J][0];
      return gradient;
    }

    /// The matrices of the test.
    template <int dim>
    class System
    {
    public:
      System(const Discretisation<dim>          &discretisation,
             const PrescribedDisplacements<dim> &prescribed,
             const VolumetricStrain              strain,
             const double                        stabilisation,
             const Vector                       &state)
        : discretisation(discretisation)
        , solver(discretisation.communicator())
        , offsets(make_pattern(discretisation, saddle))
        , mass(saddle)
      {
        assemble(strain, stabilisation, state);
        // Held displacements are no test functions.
        Vector rhs = discretisation.make_vector(), gap(rhs);
        gap.update_ghost_values();
        prescribed.apply(saddle, rhs, gap);
        shifted = saddle;
        solver.analyse(saddle, discretisation.node_of_row, discretisation.n_nodes);
      }

      bool is_finite() const
      {
        double sum = 0;
        for (const double value : saddle.values())
          sum += value * 0.;
        return dealii::Utilities::MPI::sum(sum, discretisation.communicator()) == 0.;
      }

      /// Factor [A B^T; B -S + sigma M]; returns the number of eigenvalues below @p sigma, by
      /// Sylvester's law of inertia.
      std::size_t factor(const double sigma)
      {
        for (std::size_t k = 0; k < saddle.values().size(); ++k)
          shifted.values()[k] = saddle.values()[k] + sigma * mass.values()[k];
        const Factorisation factorisation = solver.factor(shifted);
        if (!factorisation.succeeded)
          throw std::runtime_error("inf-sup test, beta^2 = " + std::to_string(sigma) + ": "
                                   + factorisation.failure);
        return discretisation.n_pressures - *factorisation.negative_pivots;
      }

      /// The eigenvalue next above the shift @p sigma that was factored last, if no other is above it
      /// and nearer.
      double eigenvalue_above(const double sigma)
      {
        using Solver = dealii::PArpackSolver<Vector>;
        dealii::SolverControl control(1000, 1e-8);
        Solver                arpack(control,
                      discretisation.communicator(),
                      typename Solver::AdditionalData(
                          std::min<GlobalIndex>(20, discretisation.n_pressures - 1),
                          Solver::algebraically_largest,
                          true));
        arpack.set_shift(sigma);
        Vector start = discretisation.make_vector();
        for (LocalIndex i = discretisation.n_owned_displacements; i < start.locally_owned_size();
             ++i)
          start.local_element(i)
              = 1. + std::sin(double(discretisation.partitioner->local_to_global(i)));
        arpack.reinit(start);
        arpack.set_initial_vector(start);

        const Mass                        mass_operator{*this};
        const Inverse                     inverse{*this};
        std::vector<std::complex<double>> values(1);
        std::vector<Vector>               vectors(1, start);
        arpack.solve(mass_operator, mass_operator, inverse, values, vectors, 1);
        return values[0].real();
      }

      /// Does a constant pressure act on no free displacement?
      bool has_hydrostatic_mode() const
      {
        Vector one = discretisation.make_vector(), force(one);
        for (std::size_t cell = 0; cell < discretisation.cells.n_cells; ++cell)
          for (unsigned int j = 0; j < discretisation.cells.n_p; ++j)
            // The first function of a discontinuous linear pressure is its mean.
            if (discretisation.p_shape.value(j, discretisation.p_shape.node(j)) != 0.)
              one.local_element(discretisation.cells.p[cell * discretisation.cells.n_p + j]) = 1.;
        saddle.vmult(force, one);
        double largest = 0, size = 0;
        for (LocalIndex i = 0; i < discretisation.n_owned_displacements; ++i)
          {
            largest = std::max(largest, std::abs(force.local_element(i)));
            for (std::size_t k = saddle.row_start()[i]; k < saddle.row_start()[i + 1]; ++k)
              if (one.local_element(saddle.columns()[k]) != 0.)
                size = std::max(size, std::abs(saddle.values()[k]));
          }
        const MPI_Comm communicator = discretisation.communicator();
        return dealii::Utilities::MPI::max(largest, communicator)
               <= 1e-10 * dealii::Utilities::MPI::max(size, communicator);
      }

    private:
      /// For ARPACK: M, and (Schur complement - sigma M)^-1, on pressures alone.
      struct Mass
      {
        System &system;
        void    vmult(Vector &dst, const Vector &src) const
        {
          system.mass.vmult(dst, src);
        }
      };
      struct Inverse
      {
        System &system;
        void    vmult(Vector &dst, const Vector &src) const
        {
          Vector rhs(src);
          rhs *= -1.;
          system.solver.solve(dst, rhs);
          for (LocalIndex i = 0; i < system.discretisation.n_owned_displacements; ++i)
            dst.local_element(i) = 0.;
        }
      };

      /// Pressures are measured in units that make M as large as A, which are of different powers of
      /// the cell size: pivots of sigma M would be taken for rounding otherwise. The eigenvalues do
      /// not change.
      double pressure_unit() const
      {
        return 5. / discretisation.mean_cell_size;
      }

      void assemble(const VolumetricStrain strain, const double stabilisation, const Vector &state)
      {
        const CellTables<dim> &cells      = discretisation.cells;
        const auto             quadrature = cell_quadrature<dim>(
            cells.kind,
            std::max(discretisation.quadrature_degree(), 2 * discretisation.p_shape.degree()));
        const GeometryTable<dim> geometry(cells, quadrature.get_points());
        const ShapeTable<dim>    x_shape(discretisation.x_shape, quadrature.get_points());
        const ShapeTable<dim>    p_shape(discretisation.p_shape, quadrature.get_points());
        const double             unit = pressure_unit();

        BlockWriter<dim>                    to_saddle(cells, offsets, saddle);
        BlockWriter<dim>                    to_mass(cells, offsets, mass);
        std::vector<dealii::Tensor<1, dim>> gradient(cells.n_x);
        std::vector<double>                 p_value(cells.n_p);
        for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
          {
            std::vector<double> M(cells.n_p * cells.n_p, 0.), m(cells.n_p, 0.);
            double              volume = 0;
            for (unsigned int q = 0; q < quadrature.size(); ++q)
              {
                const auto   map = geometry.map(cell, q);
                const double dV  = map.determinant * quadrature.weight(q);
                for (unsigned int j = 0; j < cells.n_p; ++j)
                  p_value[j] = unit * p_shape.value(q, j);
                dealii::Tensor<2, dim> grad_u;
                for (unsigned int a = 0; a < cells.n_x; ++a)
                  {
                    gradient[a] = x_shape.gradient(q, a) * map.inverse;
                    for (unsigned int i = 0; i < dim; ++i)
                      grad_u[i]
                          += state.local_element(cells.x[cell * cells.n_x + a] + i) * gradient[a];
                  }
                const auto d_phi = volumetric_gradient(strain, grad_u);

                for (unsigned int a = 0; a < cells.n_x; ++a)
                  {
                    for (unsigned int b = 0; b < cells.n_x; ++b)
                      for (unsigned int i = 0; i < dim; ++i)
                        to_saddle.add(cell, a, i, b, i, dV * (gradient[a] * gradient[b]));
                    const auto normal = d_phi * gradient[a];
                    for (unsigned int j = 0; j < cells.n_p; ++j)
                      for (unsigned int i = 0; i < dim; ++i)
                        {
                          const double B = dV * p_value[j] * normal[i];
                          to_saddle.add(cell, a, i, cells.n_x + j, 0, B);
                          to_saddle.add(cell, cells.n_x + j, 0, a, i, B);
                        }
                  }
                volume += dV;
                for (unsigned int j = 0; j < cells.n_p; ++j)
                  {
                    m[j] += dV * p_value[j];
                    for (unsigned int k = 0; k < cells.n_p; ++k)
                      M[j * cells.n_p + k] += dV * p_value[j] * p_value[k];
                  }
              }
            for (unsigned int j = 0; j < cells.n_p; ++j)
              for (unsigned int k = 0; k < cells.n_p; ++k)
                {
                  const double M_jk = M[j * cells.n_p + k];
                  to_mass.add(cell, cells.n_x + j, 0, cells.n_x + k, 0, M_jk);
                  if (discretisation.element.is_stabilised)
                    to_saddle.add(cell,
                                  cells.n_x + j,
                                  0,
                                  cells.n_x + k,
                                  0,
                                  -stabilisation * (M_jk - m[j] * m[k] / volume));
                }
          }
      }

      const Discretisation<dim> &discretisation;
      Mumps<double> solver;
      SparseMatrix               saddle; ///< [A B^T; B -S]
      CellOffsets                offsets;
      SparseMatrix               mass; ///< M in the pressure block
      SparseMatrix               shifted;
    };
  } // namespace

  template <int dim>
  std::optional<InfSup> inf_sup(const Discretisation<dim>          &discretisation,
                                const PrescribedDisplacements<dim> &prescribed,
                                const VolumetricStrain              volumetric_strain,
                                const double                        stabilisation,
                                const Vector                       &state)
  {
    if (discretisation.n_pressures == 0)
      return {};
    state.update_ghost_values();
    System<dim> system(discretisation, prescribed, volumetric_strain, stabilisation, state);
    if (!system.is_finite())
      return {};

    InfSup            result;
    const std::size_t zeros     = system.factor(zero_beta_squared);
    result.has_hydrostatic_mode = system.has_hydrostatic_mode();
    result.spurious_modes       = zeros - std::min<std::size_t>(zeros, result.has_hydrostatic_mode);
    if (zeros == discretisation.n_pressures)
      return result; // no displacement feels any pressure

    // Bracket the smallest beta^2 that is not zero, then let ARPACK find it from below. It is no
    // larger than d. No step by tens: round numbers may be eigenvalues.
    double below = zero_beta_squared;
    for (double above = 9.7 * below; system.factor(above) == zeros; above *= 9.7)
      {
        if (above > 1e3)
          throw std::runtime_error("inf-sup test: no eigenvalue was found");
        below = above;
      }
    system.factor(below);
    result.constant = std::sqrt(system.eigenvalue_above(below));
    return result;
  }

  template std::optional<InfSup> inf_sup(const Discretisation<2> &,
                                         const PrescribedDisplacements<2> &,
                                         VolumetricStrain,
                                         double,
                                         const Vector &);
  template std::optional<InfSup> inf_sup(const Discretisation<3> &,
                                         const PrescribedDisplacements<3> &,
                                         VolumetricStrain,
                                         double,
                                         const Vector &);
} // namespace isochor
