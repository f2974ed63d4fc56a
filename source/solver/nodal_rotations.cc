#include <isochor/solver/nodal_rotations.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /// R of F = R U by Higham's iteration; the identity where F is inverted or not finite.
    template <int dim>
    dealii::Tensor<2, dim> rotation_of(const dealii::Tensor<2, dim> &F)
    {
      const auto identity = dealii::unit_symmetric_tensor<dim>();
      // Written so that NaN fails.
      if (!(dealii::determinant(F) > 0.))
        return dealii::Tensor<2, dim>(identity);
      dealii::Tensor<2, dim> R = F;
      for (unsigned int i = 0; i < 20; ++i)
        {
          const dealii::Tensor<2, dim> next   = 0.5 * (R + dealii::transpose(dealii::invert(R)));
          const double                 change = (next - R).norm();
          R                                   = next;
          if (change < 1e-10)
            return R;
        }
      return dealii::Tensor<2, dim>(identity);
    }

    template <int dim, typename Turn>
    void turn_nodes(Vector &vector, const std::size_t n_nodes, const Turn &turn)
    {
      for (std::size_t node = 0; node < n_nodes; ++node)
        {
          dealii::Tensor<1, dim> v;
          for (unsigned int c = 0; c < dim; ++c)
            v[c] = vector.local_element(node * dim + c);
          v = turn(node, v);
          for (unsigned int c = 0; c < dim; ++c)
            vector.local_element(node * dim + c) = v[c];
        }
    }
  } // namespace

  template <int dim>
  NodalRotations<dim>::NodalRotations(const Discretisation<dim>          &discretisation,
                                      const PrescribedDisplacements<dim> &prescribed)
    : discretisation(discretisation)
    , is_held(discretisation.n_owned_displacements / dim, 0)
  {
    for (const LocalIndex unknown : prescribed.unknowns())
      is_held[unknown / dim] = 1;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> NodalRotations<dim>::rotations(const Vector &state) const
  {
    // Cells around owned nodes are all known to this rank.
    const CellTables<dim>          &cells = discretisation.cells;
    std::vector<dealii::Point<dim>> nodes;
    for (unsigned int a = 0; a < cells.n_x; ++a)
      nodes.push_back(discretisation.x_shape.node(a));
    const GeometryTable<dim> geometry(cells, nodes);
    const ShapeTable<dim>    shape(discretisation.x_shape, nodes);

    std::vector<Tensor> sum(is_held.size());
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      {
        const LocalIndex *unknowns = &cells.x[cell * cells.n_x];
        for (unsigned int point = 0; point < cells.n_x; ++point)
          {
            if (unknowns[point] >= discretisation.n_owned_displacements)
              continue;
            Tensor gradient; // of the displacement on the reference cell
            for (unsigned int a = 0; a < cells.n_x; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                gradient[c] += state.local_element(unknowns[a] + c) * shape.gradient(point, a);
            const auto map = geometry.map(cell, point);
            sum[unknowns[point] / dim] += std::abs(map.determinant)
                                          * (Tensor(dealii::unit_symmetric_tensor<dim>())
                                             + gradient * Tensor(map.inverse));
          }
      }
    for (std::size_t node = 0; node < sum.size(); ++node)
      sum[node]
          = is_held[node] ? Tensor(dealii::unit_symmetric_tensor<dim>()) : rotation_of(sum[node]);
    return sum;
  }

  template <int dim>
  void NodalRotations<dim>::start(const Vector &state)
  {
    at_start = rotations(state);
    since.clear();
  }

  template <int dim>
  void NodalRotations<dim>::update(const Vector &state)
  {
    since = rotations(state);
    for (std::size_t node = 0; node < since.size(); ++node)
      since[node] = since[node] * dealii::transpose(at_start[node]);
  }

  template <int dim>
  void NodalRotations<dim>::turn(Vector &vector) const
  {
    turn_nodes<dim>(vector, since.size(), [&](const std::size_t node, const auto &v) {
      return since[node] * v;
    });
  }

  template <int dim>
  void NodalRotations<dim>::turn_back(Vector &vector) const
  {
    turn_nodes<dim>(vector, since.size(), [&](const std::size_t node, const auto &v) {
      return v * since[node];
    });
  }

  template class NodalRotations<2>;
  template class NodalRotations<3>;
} // namespace isochor
