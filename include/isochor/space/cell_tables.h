#pragma once

// What kernels read of the cells that this rank computes: indices of unknowns and geometry.

#include <isochor/core/types.h>
#include <isochor/element/shape_table.h>

namespace isochor
{
  /// The reference body at a point of a cell.
  template <int dim>
  struct PointMap
  {
    dealii::Tensor<2, dim> jacobian;    ///< d X / d xi
    dealii::Tensor<2, dim> inverse;     ///< d xi / d X, 1/m
    double                 determinant; ///< of the jacobian; times quadrature weight: dV
  };

  /// Tables of the cells this rank computes, owned cells first.
  template <int dim>
  struct CellTables
  {
    CellKind     kind    = CellKind::simplex;
    unsigned int n_owned = 0;
    unsigned int n_cells = 0;
    unsigned int n_x     = 0; ///< displacement nodes per cell
    unsigned int n_p     = 0; ///< pressure nodes per cell, 0 for displacement elements
    unsigned int n_g     = 0; ///< geometry nodes per cell; the vertices come first

    /// [cell * n_x + a]: local index of component 0 of displacement node a; component c is at
    /// + c. For cubics, the two nodes of an edge are already in the order of the shape functions.
    std::vector<LocalIndex> x;
    /// [cell * n_p + j]: local index of pressure node j.
    std::vector<LocalIndex> p;

    /// Shape functions of the geometry.
    std::shared_ptr<const ShapeFunctions<dim>> geometry_shape;
    /// [cell * n_g + i]: reference position of the geometry nodes, m.
    std::vector<dealii::Point<dim>> geometry;
    /// Is the map from the reference cell affine? So are all straight simplices.
    std::vector<char> is_affine;
    bool              all_affine = true;
    /// Of affine cells: [(cell * dim + k) * dim + J] = d xi_k / d X_J, 1/m; of others at the centre.
    std::vector<double> inverse_jacobian;
    /// det dX / d xi > 0, m^dim, of affine cells; of others at the centre.
    std::vector<double> determinant;

    LocalIndex n_owned_unknowns = 0;

    const dealii::Point<dim> &vertex(const std::size_t cell, const unsigned int v) const
    {
      return geometry[cell * n_g + v];
    }
    /// [k][J] as in inverse_jacobian.
    const double *inverse(const std::size_t cell) const
    {
      return &inverse_jacobian[cell * dim * dim];
    }

    /// Reference position of a point of the reference cell.
    dealii::Point<dim> position(std::size_t cell, const dealii::Point<dim> &xi) const;

    PointMap<dim> map(std::size_t cell, const dealii::Point<dim> &xi) const;
  };

  /// CellTables::map at fixed points of the reference cell, tabulated.
  template <int dim>
  class GeometryTable
  {
  public:
    /// @p cells must outlive this.
    GeometryTable(const CellTables<dim> &cells, const std::vector<dealii::Point<dim>> &points);

    PointMap<dim> map(std::size_t cell, unsigned int point) const;

    /// The determinant alone.
    double determinant(std::size_t cell, unsigned int point) const
    {
      return cells.is_affine[cell] ? cells.determinant[cell] : map(cell, point).determinant;
    }

    dealii::Point<dim> position(std::size_t cell, unsigned int point) const;

  private:
    const CellTables<dim> &cells;
    ShapeTable<dim>        shape;
  };

  /// Add the geometry of a cell whose nodes have been appended to cells.geometry.
  template <int dim>
  void add_cell_geometry(CellTables<dim> &cells);
} // namespace isochor
