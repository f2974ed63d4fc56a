#include <isochor/element/nodal_element.h>
#include <isochor/space/discretisation.h>

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria_iterator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    template <int dim>
    bool lexicographically_less(const dealii::Point<dim> &a, const dealii::Point<dim> &b)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (a[d] != b[d])
          return a[d] < b[d];
      return false;
    }

    /// One scalar field: its DoFHandler, and where each rank's share of nodes begins.
    template <int dim>
    class Field
    {
    public:
      Field(const dealii::Triangulation<dim> &triangulation, const ShapeFunctions<dim> &shape)
        : shape(shape)
        , dof_handler(triangulation)
        , on_cell(shape.n_nodes())
      {
        dof_handler.distribute_dofs(NodalElement<dim>(shape));
        begins.push_back(0);
        for (const auto n : dealii::Utilities::MPI::all_gather(triangulation.get_communicator(),
                                                               dof_handler.n_locally_owned_dofs()))
          begins.push_back(begins.back() + n);
      }

      /// Global nodes of a cell in the order of the shape functions. deal.II 9.4.1 numbers the
      /// two nodes of a cubic edge without regard to the cell's view of the edge (the same
      /// two numbers come in the same order from each cell around it), so the first is given to
      /// the end that comes first by coordinates, which all cells and ranks agree on.
      const std::vector<GlobalIndex> &
      nodes(const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
      {
        const typename dealii::DoFHandler<dim>::active_cell_iterator dof_cell(
            &cell->get_triangulation(), cell->level(), cell->index(), &dof_handler);
        dof_cell->get_dof_indices(on_cell);
        for (const auto &edge : shape.edge_nodes())
          if (lexicographically_less(cell->vertex(edge.vertices[1]),
                                     cell->vertex(edge.vertices[0])))
            std::swap(on_cell[edge.nodes[0]], on_cell[edge.nodes[1]]);
        return on_cell;
      }

      GlobalIndex n_nodes() const
      {
        return begins.back();
      }
      unsigned int owner(const GlobalIndex node) const
      {
        return std::upper_bound(begins.begin(), begins.end(), node) - begins.begin() - 1;
      }
      GlobalIndex begin(const unsigned int rank) const
      {
        return begins[rank];
      }

    private:
      const ShapeFunctions<dim> &shape;
      dealii::DoFHandler<dim>    dof_handler;
      std::vector<GlobalIndex>   begins;
      std::vector<GlobalIndex>   on_cell;
    };

    /// For each pressure node of the reference cell the displacement node nearest to it.
    template <int dim>
    std::vector<unsigned int> nearest_nodes(const ShapeFunctions<dim> &p_shape,
                                            const ShapeFunctions<dim> &x_shape)
    {
      std::vector<unsigned int> nearest;
      for (unsigned int j = 0; j < p_shape.n_nodes(); ++j)
        {
          unsigned int best          = 0;
          double       best_distance = std::numeric_limits<double>::max();
          for (unsigned int a = 0; a < x_shape.n_nodes(); ++a)
            {
              const double distance = p_shape.node(j).distance(x_shape.node(a));
              if (distance < best_distance - 1e-10)
                {
                  best          = a;
                  best_distance = distance;
                }
            }
          nearest.push_back(best);
        }
      return nearest;
    }

    template <int dim>
    void add_geometry(CellTables<dim>                                                 &cells,
                      const GeometryNodes<dim>                                        &geometry,
                      const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
    {
      if (geometry.order == 1)
        for (const unsigned int v : cell->vertex_indices())
          cells.geometry.push_back(cell->vertex(v));
      else
        {
          const auto first
              = geometry.points.begin() + std::size_t(cell->active_cell_index()) * cells.n_g;
          cells.geometry.insert(cells.geometry.end(), first, first + cells.n_g);
        }
      add_cell_geometry(cells);
    }
  } // namespace

  template <int dim>
  Discretisation<dim>::Discretisation(const dealii::Triangulation<dim, dim> &triangulation,
                                      const Element                         &element,
                                      const GeometryNodes<dim>              &geometry)
    : x_functions(make_shape_functions<dim>(element.kind, element.displacement))
    , p_functions(make_shape_functions<dim>(
          element.kind,
          element.pressure.value_or(FieldSpace{Family::discontinuous, 0})))
    , element(element)
    , x_shape(*x_functions)
    , p_shape(*p_functions)
  {
    if (triangulation.get_reference_cells().empty()
        || triangulation.get_reference_cells()
               != std::vector<dealii::ReferenceCell>{reference_cell<dim>(element.kind)})
      throw std::logic_error("the cells of the mesh are not those of the element");
    const MPI_Comm     communicator = triangulation.get_communicator();
    const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);

    Field<dim>                x_field(triangulation, x_shape);
    std::optional<Field<dim>> p_field;
    if (element.is_mixed())
      p_field.emplace(triangulation, p_shape);

    const auto p_begin
        = [&](const unsigned int r) { return p_field ? p_field->begin(r) : GlobalIndex(0); };
    const auto x_unknown
        = [&](const GlobalIndex node) { return dim * node + p_begin(x_field.owner(node)); };
    const auto p_unknown = [&](const GlobalIndex node) {
      return dim * x_field.begin(p_field->owner(node) + 1) + node;
    };
    const GlobalIndex first = dim * x_field.begin(rank) + p_begin(rank);
    const GlobalIndex last  = dim * x_field.begin(rank + 1) + p_begin(rank + 1);

    cells.kind = element.kind;
    cells.n_x  = x_shape.n_nodes();
    cells.n_p  = element.is_mixed() ? p_shape.n_nodes() : 0;
    cells.geometry_shape
        = make_shape_functions<dim>(element.kind, {Family::lagrange, geometry.order});
    cells.n_g = cells.geometry_shape->n_nodes();

    // Global unknowns of the cells: owned cells, then ghost cells that touch an owned unknown.
    std::vector<GlobalIndex> x_global, p_global;
    node_of_row.assign(last - first, 0);
    const auto hosts = nearest_nodes(p_shape, x_shape);

    // Pressures of one cell alone cannot join a displacement node that another rank may own.
    const bool own_p_nodes
        = element.has_discontinuous_pressure() && x_shape.n_interior_nodes() == 0;
    // Of the first pressure of this rank, minus its number among all pressures.
    const GlobalIndex first_p = dim * x_field.begin(rank + 1);

    const auto add_interior = [&](const GlobalIndex *x, const GlobalIndex *p) {
      if (element.has_bubble())
        interior_displacements.emplace_back(x[cells.n_x - 1] - first, dim);
      if (element.has_discontinuous_pressure())
        interior_pressures.emplace_back(p[0] - first, cells.n_p);
    };

    const auto add_cell = [&](const auto &cell) {
      const std::size_t x_size = x_global.size(), p_size = p_global.size();
      bool              touches = false;
      const auto       &x_nodes = x_field.nodes(cell);
      for (const GlobalIndex node : x_nodes)
        {
          x_global.push_back(x_unknown(node));
          touches |= x_global.back() >= first && x_global.back() < last;
        }
      if (p_field)
        for (const GlobalIndex node : p_field->nodes(cell))
          {
            p_global.push_back(p_unknown(node));
            touches |= p_global.back() >= first && p_global.back() < last;
          }
      if (cell->is_ghost() && !touches)
        {
          x_global.resize(x_size);
          p_global.resize(p_size);
          return;
        }

      if (cell->is_locally_owned())
        add_interior(x_global.data() + x_size, p_global.data() + p_size);
      for (unsigned int j = 0; j < cells.n_p; ++j)
        {
          const GlobalIndex row = p_global[p_size + j];
          if (row >= first && row < last)
            node_of_row[row - first]
                = own_p_nodes ? x_field.n_nodes() + (row - first_p) / cells.n_p : x_nodes[hosts[j]];
        }
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
          boundary_faces.push_back(
              {cells.n_cells, face, cell->face(face)->boundary_id(), cell->is_locally_owned()});
      add_geometry(cells, geometry, cell);
      ++cells.n_cells;
    };

    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        add_cell(cell);
    cells.n_owned = cells.n_cells;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_ghost())
        add_cell(cell);

    for (GlobalIndex node = x_field.begin(rank); node < x_field.begin(rank + 1); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        node_of_row[x_unknown(node) - first + c] = node;

    // Ghost entries: what these cells read and this rank does not own.
    std::vector<GlobalIndex> ghosts;
    for (const GlobalIndex unknown : x_global)
      if (unknown < first || unknown >= last)
        for (unsigned int c = 0; c < dim; ++c)
          ghosts.push_back(unknown + c);
    for (const GlobalIndex unknown : p_global)
      if (unknown < first || unknown >= last)
        ghosts.push_back(unknown);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());

    n_displacement_nodes = x_field.n_nodes();
    n_nodes     = n_displacement_nodes + (own_p_nodes ? p_field->n_nodes() / cells.n_p : 0);
    n_pressures = p_field ? p_field->n_nodes() : 0;
    n_owned_displacements = dim * (x_field.begin(rank + 1) - x_field.begin(rank));
    n_cells               = dealii::Utilities::MPI::sum(GlobalIndex(cells.n_owned), communicator);
    double cell_sizes     = 0;
    for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
      cell_sizes += std::pow(cells.determinant[cell], 1. / dim);
    mean_cell_size = dealii::Utilities::MPI::sum(cell_sizes, communicator) / double(n_cells);

    dealii::IndexSet owned(n_unknowns()), relevant(n_unknowns());
    owned.add_range(first, last);
    relevant.add_indices(ghosts.begin(), ghosts.end());
    partitioner
        = std::make_shared<dealii::Utilities::MPI::Partitioner>(owned, relevant, communicator);

    cells.n_owned_unknowns = last - first;
    const auto to_local    = [&](const GlobalIndex unknown) -> LocalIndex {
      if (unknown >= first && unknown < last)
        return unknown - first;
      return (last - first)
             + (std::lower_bound(ghosts.begin(), ghosts.end(), unknown) - ghosts.begin());
    };
    cells.x.resize(x_global.size());
    cells.p.resize(p_global.size());
    std::transform(x_global.begin(), x_global.end(), cells.x.begin(), to_local);
    std::transform(p_global.begin(), p_global.end(), cells.p.begin(), to_local);
  }

  template <int dim>
  unsigned int Discretisation<dim>::volume_degree() const
  {
    if (cells.all_affine)
      return std::max(1u, x_shape.degree());
    // The determinant of the map is of degree d (g - 1) on simplices, d g - 1 on hypercubes.
    const unsigned int g = cells.geometry_shape->degree();
    return x_shape.degree() + (element.kind == CellKind::simplex ? dim * (g - 1) : dim * g - 1);
  }

  template class Discretisation<2>;
  template class Discretisation<3>;
} // namespace isochor
