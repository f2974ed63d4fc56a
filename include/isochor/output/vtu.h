#pragma once

// VTU files of the fields for ParaView, one per load step, and a PVD file that lists them with
// their load factors.

#include <isochor/measure/cell_fields.h>

#include <deal.II/base/data_out_base.h>

#include <filesystem>

namespace isochor
{
  template <int dim>
  class VtuSeries
  {
  public:
    /// Files go to @p folder, which exists; nothing is written yet. @p discretisation must outlive
    /// this. Collective.
    VtuSeries(const Discretisation<dim> &discretisation,
              const Material            &material,
              std::filesystem::path      folder);
    ~VtuSeries();

    /// Write solution_0003.vtu for @p number 3 (on several ranks one solution_0003.0.vtu, ... for
    /// each that has cells, and solution_0003.pvtu that joins them), then solution.pvd, which
    /// lists the files of all calls so far with their @p load factors. Each file is whole at any
    /// moment. Cells are at their reference positions; they are linear for displacements of degree
    /// 1, else quadratic. Point data, in single precision and by cell, so that jumps between cells
    /// show: "displacement" (m, three components), "pressure" (Pa, positive in tension), "J",
    /// "von Mises stress [Pa]". Updates the ghosts of @p state. Throws UserError naming the file
    /// that cannot be written. Collective.
    void write(const Vector &state, double load, unsigned int number);

    /// Load factors and files of the calls so far, and how to go on from them in a later run.
    const std::vector<std::pair<double, std::string>> &written() const
    {
      return written_;
    }
    void resume(const std::vector<std::pair<double, std::string>> &earlier)
    {
      written_ = earlier;
    }

    /// What the next file would hold: one patch per owned cell, data rows u_x, u_y, (u_z,) p, J,
    /// von Mises stress, then the positions; columns are the vertices, then the edge midpoints
    /// in VTK's order. @p state with ghosts.
    const std::vector<dealii::DataOutBase::Patch<dim, dim>> &fill_patches(const Vector &state);

  private:
    class Writer;

    const Discretisation<dim>                  &discretisation;
    const CellFields<dim>                       fields;
    typename CellFields<dim>::Points            points;
    const std::filesystem::path                 folder;
    std::unique_ptr<Writer>                     writer;
    std::vector<unsigned int>                   n_cells;  ///< of each rank
    std::vector<std::pair<double, std::string>> written_; ///< load factor, file
  };
} // namespace isochor
