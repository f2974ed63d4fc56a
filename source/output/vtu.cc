#include <isochor/output/atomic_file.h>
#include <isochor/output/vtu.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace isochor
{
  template <int dim>
  class VtuSeries<dim>::Writer : public dealii::DataOutInterface<dim, dim>
  {
  public:
    using Patch = dealii::DataOutBase::Patch<dim, dim>;

    std::vector<Patch> patches;
    bool               higher_order = false; ///< quadratic hypercubes

    /// Texts of the files.
    std::string vtu(const double load, const unsigned int number)
    {
      using Flags = dealii::DataOutBase::VtkFlags;
      Flags flags;
      flags.time                     = load;
      flags.cycle                    = number;
      flags.print_date_and_time      = false; // a .vtu depends on the run alone
      flags.compression_level        = Flags::best_speed;
      flags.write_higher_order_cells = higher_order;
      flags.physical_units
          = {{"displacement", "m"}, {"pressure", "Pa"}, {"von Mises stress [Pa]", "Pa"}};
      this->set_flags(flags);
      std::ostringstream text;
      this->write_vtu(text);
      return std::move(text).str();
    }
    std::string pvtu(const std::vector<std::string> &pieces) const
    {
      std::ostringstream text;
      this->write_pvtu_record(text, pieces);
      return std::move(text).str();
    }

  private:
    const std::vector<Patch> &get_patches() const override
    {
      return patches;
    }
    std::vector<std::string> get_dataset_names() const override
    {
      std::vector<std::string> names(dim, "displacement");
      names.insert(names.end(), {"pressure", "J", "von Mises stress [Pa]"});
      return names;
    }
    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override
    {
      return {{0,
               dim - 1,
               "displacement",
               dealii::DataComponentInterpretation::component_is_part_of_vector}};
    }
  };

  namespace
  {
    /// In the order in which deal.II writes them: of simplices as a DoFHandler numbers them, and as
    /// VTK does; of hypercubes along the first coordinate first.
    template <int dim>
    std::vector<dealii::Point<dim>> output_points(const CellKind kind, const unsigned int degree)
    {
      const auto nodes = make_shape_functions<dim>(kind, {Family::lagrange, degree});
      std::vector<dealii::Point<dim>> points;
      for (unsigned int i = 0; i < nodes->n_nodes(); ++i)
        points.push_back(nodes->node(i));
      if (kind == CellKind::hypercube)
        std::sort(points.begin(), points.end(), [](const auto &a, const auto &b) {
          for (unsigned int d = dim; d-- > 0;)
            if (a[d] != b[d])
              return a[d] < b[d];
          return false;
        });
      return points;
    }
  } // namespace

  template <int dim>
  VtuSeries<dim>::VtuSeries(const Discretisation<dim> &discretisation,
                            const Material            &material,
                            std::filesystem::path      folder)
    : discretisation(discretisation)
    , fields(discretisation, material)
    , folder(std::move(folder))
    , writer(std::make_unique<Writer>())
    , n_cells(dealii::Utilities::MPI::all_gather(discretisation.communicator(),
                                                 discretisation.cells.n_owned))
  {
    // Cubics and bubbles are shown as quadratics and linears.
    const CellTables<dim> &cells  = discretisation.cells;
    const unsigned int     degree = std::min(
        2u, std::max(discretisation.element.displacement.degree, cells.geometry_shape->degree()));
    const auto reference_points = output_points<dim>(cells.kind, degree);
    points                      = fields.tabulate(reference_points);
    writer->higher_order        = cells.kind == CellKind::hypercube && degree == 2;

    writer->patches.resize(discretisation.cells.n_owned);
    for (unsigned int cell = 0; cell < discretisation.cells.n_owned; ++cell)
      {
        auto &patch                = writer->patches[cell];
        patch.reference_cell       = reference_cell<dim>(cells.kind);
        patch.patch_index          = cell;
        patch.n_subdivisions       = degree;
        patch.points_are_available = true; // or deal.II places no midpoints
        for (unsigned int v = 0; v < n_vertices(cells.kind, dim); ++v)
          patch.vertices[v] = cells.vertex(cell, v);
        patch.data.reinit(dim + 3 + dim, points.size());
        for (unsigned int i = 0; i < points.size(); ++i)
          {
            const auto position = discretisation.cells.position(cell, reference_points[i]);
            for (unsigned int d = 0; d < dim; ++d)
              patch.data(dim + 3 + d, i) = position[d];
          }
      }
  }

  template <int dim>
  VtuSeries<dim>::~VtuSeries() = default;

  template <int dim>
  const std::vector<dealii::DataOutBase::Patch<dim, dim>> &
  VtuSeries<dim>::fill_patches(const Vector &state)
  {
    std::vector<PointFields<dim>> at;
    for (unsigned int cell = 0; cell < discretisation.cells.n_owned; ++cell)
      {
        fields.evaluate(cell, points, state.begin(), at);
        auto &data = writer->patches[cell].data;
        for (unsigned int i = 0; i < at.size(); ++i)
          {
            for (unsigned int d = 0; d < dim; ++d)
              data(d, i) = at[i].displacement[d];
            data(dim, i)     = at[i].pressure;
            data(dim + 1, i) = at[i].J;
            data(dim + 2, i) = at[i].von_mises;
          }
      }
    return writer->patches;
  }

  template <int dim>
  void VtuSeries<dim>::write(const Vector &state, const double load, const unsigned int number)
  {
    const MPI_Comm     communicator = discretisation.communicator();
    const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks      = dealii::Utilities::MPI::n_mpi_processes(communicator);

    const std::string name  = "solution_" + dealii::Utilities::int_to_string(number, 4);
    const auto        piece = [&](const unsigned int r) {
      if (n_ranks == 1)
        return name + ".vtu";
      const unsigned int n_digits = dealii::Utilities::needed_digits(n_ranks - 1);
      return name + "." + dealii::Utilities::int_to_string(r, n_digits) + ".vtu";
    };

    state.update_ghost_values();
    collectively(communicator, [&]() {
      // VTK complains about the piece that deal.II writes for a rank without cells.
      if (n_cells[rank] > 0)
        {
          fill_patches(state);
          write_whole_file(folder / piece(rank), writer->vtu(load, number));
        }
    });

    // A record follows the files that it names.
    written_.emplace_back(load, n_ranks == 1 ? name + ".vtu" : name + ".pvtu");
    on_root_collectively(communicator, [&]() {
      if (n_ranks > 1)
        {
          std::vector<std::string> pieces;
          for (unsigned int r = 0; r < n_ranks; ++r)
            if (n_cells[r] > 0)
              pieces.push_back(piece(r));
          write_whole_file(folder / written_.back().second, writer->pvtu(pieces));
        }
      std::ostringstream pvd;
      dealii::DataOutBase::write_pvd_record(pvd, written_);
      write_whole_file(folder / "solution.pvd", pvd.str());
    });
  }

  template class VtuSeries<2>;
  template class VtuSeries<3>;
} // namespace isochor
