#pragma once

// Reference tables for integrals over boundary faces, per face number of the reference cell.

#include <isochor/space/discretisation.h>

#include <deal.II/base/tensor.h>

namespace isochor
{
  /// Shape functions of the displacement and of the geometry at the quadrature points of one face.
  /// The face is parametrised by s in the reference cell of dimension dim - 1.
  template <int dim>
  struct FaceTable
  {
    struct At
    {
      dealii::Point<dim>  xi;     ///< in the reference cell
      double              weight; ///< adds up to the volume of the reference face
      std::vector<double> value;  ///< [n] of nodes[n]
      /// [n][m] = dN / ds_m, m < dim - 1
      std::vector<std::array<double, dim - 1>> derivative;
      /// The same of geometry_nodes.
      std::vector<double>                      geometry_value;
      std::vector<std::array<double, dim - 1>> geometry_derivative;
    };
    std::vector<unsigned int>                   nodes; ///< displacement nodes on the face
    std::vector<unsigned int>                   geometry_nodes;
    std::vector<At>                             points;
    std::array<dealii::Tensor<1, dim>, dim - 1> tangents; ///< d xi / d s_m
    double                                      sign = 1; ///< makes the normal point outward
  };

  template <int dim>
  class FaceTables
  {
  public:
    /// Exact to @p degree on the face; by default enough for pressure on cubics.
    FaceTables(const Discretisation<dim> &discretisation, unsigned int degree);

    const FaceTable<dim> &operator[](const unsigned int face_no) const
    {
      return tables[face_no];
    }

    /// Degree that integrates N n da of a deformed face exactly: k + (dim - 1) (k - 1) + 1, k the
    /// degree of the deformed position.
    static unsigned int exact_degree(const Discretisation<dim> &discretisation);

  private:
    std::vector<FaceTable<dim>> tables;
  };

  /// Geometry of a deformed face at one point: position x and the vector n da / ds, m^(dim - 1).
  template <int dim>
  struct FacePoint
  {
    dealii::Point<dim>                          reference_position;
    dealii::Tensor<1, dim>                      displacement;
    std::array<dealii::Tensor<1, dim>, dim - 1> tangents; ///< dx / ds_m, deformed
    dealii::Tensor<1, dim>                      normal;   ///< outward, times da / ds, deformed
    double                                      reference_area; ///< dA / ds
  };

  /// @p values: local array of a state vector with ghosts; nullptr: undeformed.
  template <int dim>
  FacePoint<dim> evaluate_face(const CellTables<dim>             &cells,
                               const BoundaryFace                &face,
                               const FaceTable<dim>              &table,
                               const typename FaceTable<dim>::At &at,
                               const double                      *values);
} // namespace isochor
