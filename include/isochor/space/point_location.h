#pragma once

// Which cell a point of the reference body lies in, and where in it.

#include <isochor/space/cell_tables.h>

#include <memory>
#include <optional>

namespace isochor
{
  /// Where in the reference cell @p point is, by Newton's method; exact after one step if the cell
  /// is affine. Far away if the iteration leaves the cell.
  template <int dim>
  dealii::Point<dim>
  reference_point(const CellTables<dim> &cells, std::size_t cell, const dealii::Point<dim> &point);

  /// Distance from the nearest side of the reference cell, by its coordinates; negative outside.
  template <int dim>
  double depth(CellKind kind, const dealii::Point<dim> &xi);

  /// A search tree over the owned cells of a rank.
  template <int dim>
  class PointLocation
  {
  public:
    /// @p cells must outlive this.
    explicit PointLocation(const CellTables<dim> &cells);
    ~PointLocation();

    struct Place
    {
      LocalIndex         cell;
      dealii::Point<dim> xi;
      double             depth; ///< of xi
    };

    /// The cell that @p point is deepest in or, if it is in none, least far out of among those
    /// nearby. None if this rank owns no cell. Not collective.
    std::optional<Place> locate(const dealii::Point<dim> &point) const;

  private:
    struct Tree; // keeps boost out of this header

    const CellTables<dim>            &cells;
    const std::unique_ptr<const Tree> tree;
  };
} // namespace isochor
