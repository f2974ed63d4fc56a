#include <isochor/space/interpolation.h>
#include <isochor/space/point_location.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <map>

namespace isochor
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    // Of the reference cell: how far outside it its functions are still trusted.
    constexpr double furthest_continuation = 0.25;

    template <int dim>
    struct Node
    {
      dealii::Point<dim> position;
      LocalIndex         unknown; ///< of a displacement: of its first component
      bool               is_pressure;
    };

    template <int dim>
    std::vector<Node<dim>> owned_nodes(const Discretisation<dim> &discretisation)
    {
      const CellTables<dim> &cells = discretisation.cells;
      std::vector<char>      is_known(cells.n_owned_unknowns, 0);
      std::vector<Node<dim>> nodes;
      const auto             add = [&](const std::size_t              cell,
                           const ShapeFunctions<dim>     &shape,
                           const std::vector<LocalIndex> &unknowns,
                           const unsigned int             n_per_cell,
                           const unsigned int             n,
                           const bool                     is_pressure) {
        for (unsigned int a = 0; a < n; ++a)
          if (const LocalIndex unknown = unknowns[cell * n_per_cell + a];
              unknown < cells.n_owned_unknowns && !is_known[unknown])
            {
              is_known[unknown] = 1;
              nodes.push_back({cells.position(cell, shape.node(a)), unknown, is_pressure});
            }
      };
      // A bubble is the last function of a cell; the first of a discontinuous pressure is constant.
      const unsigned int n_x = cells.n_x - (discretisation.element.has_bubble() ? 1 : 0);
      const unsigned int n_p = discretisation.element.has_discontinuous_pressure() ? 1 : cells.n_p;
      for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
        {
          add(cell, discretisation.x_shape, cells.x, cells.n_x, n_x, false);
          add(cell, discretisation.p_shape, cells.p, cells.n_p, n_p, true);
        }
      return nodes;
    }

    /// What a rank answers: how deep in the body the point is, and displacement and pressure there.
    template <int dim>
    constexpr unsigned int answer_size = 1 + dim + 1;

    template <int dim>
    void answer(const Discretisation<dim> &discretisation,
                const PointLocation<dim>  &location,
                const Vector              &state,
                const dealii::Point<dim>  &point,
                std::vector<double>       &answers)
    {
      const CellTables<dim> &cells = discretisation.cells;
      const std::size_t      begin = answers.size();
      answers.resize(begin + answer_size<dim>, 0.);
      const auto place = location.locate(point);
      if (!place)
        {
          answers[begin] = -std::numeric_limits<double>::max();
          return;
        }
      answers[begin] = place->depth;
      auto xi        = place->xi;
      if (place->depth < -furthest_continuation)
        {
          // Back towards the centre, from which the depth falls linearly.
          const auto   centre    = reference_centre<dim>(cells.kind);
          const double at_centre = depth(cells.kind, centre);
          xi                     = centre
               + (at_centre + furthest_continuation) / (at_centre - place->depth) * (xi - centre);
        }
      for (unsigned int a = 0; a < cells.n_x; ++a)
        for (unsigned int c = 0; c < dim; ++c)
          answers[begin + 1 + c] += discretisation.x_shape.value(a, xi)
                                    * state.local_element(cells.x[place->cell * cells.n_x + a] + c);
      for (unsigned int j = 0; j < cells.n_p; ++j)
        answers[begin + 1 + dim] += discretisation.p_shape.value(j, xi)
                                    * state.local_element(cells.p[place->cell * cells.n_p + j]);
    }

    /// The box around the owned cells of each rank, with a margin of one cell.
    template <int dim>
    std::vector<dealii::BoundingBox<dim>> rank_boxes(const Discretisation<dim> &discretisation)
    {
      const CellTables<dim> &cells = discretisation.cells;
      std::vector<double>    mine(2 * dim, -std::numeric_limits<double>::max());
      for (std::size_t i = 0; i < std::size_t(cells.n_owned) * cells.n_g; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          {
            mine[d]       = std::max(mine[d], -cells.geometry[i][d]);
            mine[dim + d] = std::max(mine[dim + d], cells.geometry[i][d]);
          }
      std::vector<dealii::BoundingBox<dim>> boxes;
      for (const auto &theirs : MPI::all_gather(discretisation.communicator(), mine))
        {
          dealii::Point<dim> lower, upper;
          for (unsigned int d = 0; d < dim; ++d)
            {
              lower[d] = -theirs[d] - discretisation.mean_cell_size;
              upper[d] = theirs[dim + d] + discretisation.mean_cell_size;
            }
          boxes.emplace_back(std::make_pair(lower, upper));
        }
      return boxes;
    }

    template <int dim>
    double distance(const dealii::BoundingBox<dim> &box, const dealii::Point<dim> &point)
    {
      double squared = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double out
              = std::max({box.lower_bound(d) - point[d], point[d] - box.upper_bound(d), 0.});
          squared += out * out;
        }
      return std::sqrt(squared);
    }

    /// some_to_some that also takes what a rank sends to itself.
    std::map<unsigned int, std::vector<double>>
    exchange(MPI_Comm communicator, std::map<unsigned int, std::vector<double>> to_send)
    {
      const unsigned int rank     = MPI::this_mpi_process(communicator);
      auto               own      = to_send.extract(rank);
      auto               received = MPI::some_to_some(communicator, to_send);
      if (!own.empty())
        received.insert(std::move(own));
      return received;
    }
  } // namespace

  template <int dim>
  void set_displacements(
      const Discretisation<dim>                                               &discretisation,
      const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> &displacement,
      Vector                                                                  &state)
  {
    for (const Node<dim> &node : owned_nodes(discretisation))
      if (!node.is_pressure)
        {
          const auto u = displacement(node.position);
          for (unsigned int c = 0; c < dim; ++c)
            state.local_element(node.unknown + c) = u[c];
        }
  }

  template <int dim>
  void interpolate(const Discretisation<dim> &coarse,
                   const Vector              &from,
                   const Discretisation<dim> &fine,
                   Vector                    &to)
  {
    const MPI_Comm               communicator = fine.communicator();
    const std::vector<Node<dim>> nodes        = owned_nodes(fine);
    const auto                   boxes        = rank_boxes(coarse);

    std::map<unsigned int, std::vector<std::size_t>> asked; // which nodes of which rank
    std::map<unsigned int, std::vector<double>>      questions;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      {
        std::vector<double> distances;
        for (const auto &box : boxes)
          distances.push_back(distance(box, nodes[n].position));
        const double nearest = *std::min_element(distances.begin(), distances.end());
        for (unsigned int rank = 0; rank < boxes.size(); ++rank)
          if (distances[rank] <= nearest)
            {
              asked[rank].push_back(n);
              for (unsigned int d = 0; d < dim; ++d)
                questions[rank].push_back(nodes[n].position[d]);
            }
      }

    const PointLocation<dim>                    location(coarse.cells);
    std::map<unsigned int, std::vector<double>> answers;
    for (const auto &[rank, coordinates] : exchange(communicator, std::move(questions)))
      for (std::size_t i = 0; i < coordinates.size(); i += dim)
        {
          dealii::Point<dim> point;
          for (unsigned int d = 0; d < dim; ++d)
            point[d] = coordinates[i + d];
          answer(coarse, location, from, point, answers[rank]);
        }

    to = 0.;
    std::vector<double> deepest(nodes.size(), -std::numeric_limits<double>::infinity());
    for (const auto &[rank, values] : exchange(communicator, std::move(answers)))
      for (std::size_t i = 0; i < asked[rank].size(); ++i)
        {
          const std::size_t n     = asked[rank][i];
          const double     *value = &values[i * answer_size<dim>];
          if (!(value[0] > deepest[n]))
            continue;
          deepest[n] = value[0];
          if (nodes[n].is_pressure)
            to.local_element(nodes[n].unknown) = value[1 + dim];
          else
            for (unsigned int c = 0; c < dim; ++c)
              to.local_element(nodes[n].unknown + c) = value[1 + c];
        }
    to.update_ghost_values();
  }

  template void
  set_displacements(const Discretisation<2> &,
                    const std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &)> &,
                    Vector &);
  template void
  set_displacements(const Discretisation<3> &,
                    const std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &)> &,
                    Vector &);
  template void
  interpolate(const Discretisation<2> &, const Vector &, const Discretisation<2> &, Vector &);
  template void
  interpolate(const Discretisation<3> &, const Vector &, const Discretisation<3> &, Vector &);
} // namespace isochor
