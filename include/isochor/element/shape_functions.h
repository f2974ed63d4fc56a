#pragma once

// Scalar shape functions on a reference cell, and where their nodes sit.

#include <isochor/core/reference_cell.h>

#include <memory>

namespace isochor
{
  template <int dim>
  class ShapeFunctions
  {
  public:
    virtual ~ShapeFunctions() = default;

    virtual CellKind kind() const = 0;

    /// Highest degree of a polynomial among the functions; per coordinate on hypercubes.
    virtual unsigned int degree() const = 0;

    /// The same on a face.
    virtual unsigned int trace_degree() const
    {
      return degree();
    }

    /// Nodes come in the order in which a deal.II DoFHandler lists the DoFs of a cell: vertices,
    /// edges, faces (3D), interior.
    virtual unsigned int n_nodes() const = 0;

    /// Reference position of node @p i. The functions of a discontinuous linear field are not
    /// attached to points; theirs is the centre.
    virtual dealii::Point<dim> node(unsigned int i) const = 0;

    virtual double value(unsigned int i, const dealii::Point<dim> &xi) const = 0;

    virtual dealii::Tensor<1, dim> gradient(unsigned int i, const dealii::Point<dim> &xi) const = 0;

    /// Nodes on face @p face_no, in ascending order.
    virtual std::vector<unsigned int> nodes_on_face(unsigned int face_no) const = 0;

    /// Number of nodes on each vertex, inside each edge, face, cell.
    virtual std::vector<unsigned int> nodes_per_object() const = 0;

    /// The two nodes inside each edge of the cubic with the edge's two vertices, each node
    /// paired with the vertex it is nearer to; empty for all others. See Field for why.
    struct EdgeNodes
    {
      std::array<unsigned int, 2> vertices;
      std::array<unsigned int, 2> nodes;
    };
    virtual const std::vector<EdgeNodes> &edge_nodes() const
    {
      static const std::vector<EdgeNodes> none;
      return none;
    }

    /// Are the functions those of one cell alone, zero outside it?
    bool is_discontinuous() const
    {
      return nodes_per_object().back() == n_nodes();
    }

    /// The nodes inside the cell come last: their number.
    unsigned int n_interior_nodes() const
    {
      return nodes_per_object().back();
    }
  };

  /// Families of shape functions.
  enum class Family
  {
    lagrange,     ///< continuous, degree 1 to 3 on simplices, 1 to 2 on hypercubes
    bubble,       ///< linear, and the product of all barycentric coordinates (simplices)
    discontinuous ///< polynomials of total degree 0 or 1 on each cell
  };

  struct FieldSpace
  {
    Family       family;
    unsigned int degree;
  };

  /// Throws std::logic_error for what does not exist.
  template <int dim>
  std::unique_ptr<const ShapeFunctions<dim>> make_shape_functions(CellKind          kind,
                                                                  const FieldSpace &space);
} // namespace isochor
