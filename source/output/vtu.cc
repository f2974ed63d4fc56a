#include <isochor/output/atomic_file.h>
#include <isochor/output/vtu.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <sstream>

namespace isochor
{
  template <int dim>
  class VtuSeries<dim>::Writer : public dealii::DataOutInterface<dim, dim>
  {
  public:
    using Patch = dealii::DataOutBase::Patch<dim, dim>;

    std::vector<Patch> patches;

    /// Texts of the files.
    std::string vtu(const double load, const unsigned int number)
    {
      using Flags = dealii::DataOutBase::VtkFlags;
      Flags flags;
      flags.time                = load;
      flags.cycle               = number;
      flags.print_date_and_time = false; // a .vtu depends on the run alone
      flags.compression_level   = Flags::best_speed;
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
    // deal.II orders the edges of a simplex as VTK does. Cubics are shown as quadratics.
    const unsigned int         degree = std::min(2u, discretisation.x_shape.degree());
    const LagrangeSimplex<dim> nodes(degree);

    std::vector<dealii::Point<dim>> reference_points;
    for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
      reference_points.push_back(nodes.node(i));
    points = fields.tabulate(reference_points);

    writer->patches.resize(discretisation.cells.n_owned);
    for (unsigned int cell = 0; cell < discretisation.cells.n_owned; ++cell)
      {
        auto &patch                = writer->patches[cell];
        patch.reference_cell       = dealii::ReferenceCells::get_simplex<dim>();
        patch.patch_index          = cell;
        patch.n_subdivisions       = degree;
        patch.points_are_available = true; // or deal.II places no midpoints
        for (unsigned int v = 0; v <= dim; ++v)
          patch.vertices[v] = discretisation.cells.vertices[cell * (dim + 1) + v];
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
    written.emplace_back(load, n_ranks == 1 ? name + ".vtu" : name + ".pvtu");
    on_root_collectively(communicator, [&]() {
      if (n_ranks > 1)
        {
          std::vector<std::string> pieces;
          for (unsigned int r = 0; r < n_ranks; ++r)
            if (n_cells[r] > 0)
              pieces.push_back(piece(r));
          write_whole_file(folder / written.back().second, writer->pvtu(pieces));
        }
      std::ostringstream pvd;
      dealii::DataOutBase::write_pvd_record(pvd, written);
      write_whole_file(folder / "solution.pvd", pvd.str());
    });
  }

  template class VtuSeries<2>;
  template class VtuSeries<3>;
} // namespace isochor
