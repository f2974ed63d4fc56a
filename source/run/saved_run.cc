#include <isochor/core/text.h>
#include <isochor/run/saved_run.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <bit>
#include <sstream>

namespace isochor
{
  namespace
  {
    // What is saved, in this order. Checkpoints' format number must be counted up when it changes.
    // Each function saves or loads, as the archive does.

    template <typename Archive, typename... Values>
    void archive_all(Archive &archive, Values &...values)
    {
      (void(archive & values), ...);
    }

    /// @p body archives the value, if there is one.
    template <typename Archive, typename T, typename Body>
    void archive_optional(Archive &archive, std::optional<T> &value, const Body &body)
    {
      bool is_there = value.has_value();
      archive_all(archive, is_there);
      if (!is_there)
        value.reset();
      else
        body(value ? *value : value.emplace());
    }

    /// The share of this rank. @p layout: of the vector to be loaded, unless it was empty.
    template <typename Archive>
    void archive_vector(Archive &archive, Vector &vector, const Vector &layout)
    {
      bool                is_there = vector.size() > 0;
      std::vector<double> values(vector.begin(), vector.begin() + vector.locally_owned_size());
      archive_all(archive, is_there, values);
      if (!Archive::is_loading::value || !is_there)
        return;
      vector.reinit(layout.get_partitioner());
      if (values.size() != vector.locally_owned_size())
        throw std::runtime_error("a saved state of another size");
      std::copy(values.begin(), values.end(), vector.begin());
    }

    template <typename Archive>
    void archive_pivot_excess(Archive &archive, std::optional<long long> &excess)
    {
      archive_optional(archive, excess, [&](long long &value) { archive_all(archive, value); });
    }

    template <typename Archive>
    void archive_report(Archive &archive, MarchReport &report)
    {
      ResidualSize &size = report.size;
      archive_all(archive,
                  report.load,
                  report.load_steps,
                  report.failed_steps,
                  report.newton_iterations,
                  size.force,
                  size.constraint,
                  size.rounding,
                  size.min_jacobian,
                  size.value);
      archive_pivot_excess(archive, report.pivot_excess);
    }

    template <typename Archive>
    void archive_march(Archive &archive, MarchState &march, const Vector &layout)
    {
      archive_report(archive, march.report);
      archive_vector(archive, march.state, layout);
      archive_all(archive, march.next_step);
      archive_optional(archive, march.load_history, [&](MarchState::LoadHistory &history) {
        archive_vector(archive, history.before, layout);
        archive_all(archive, history.load_before, history.is_unstable);
      });
      archive_optional(archive, march.path_history, [&](MarchState::PathHistory &history) {
        archive_vector(archive, history.tangent, layout);
        archive_all(archive, history.tangent_load, history.displacement_scale);
      });
    }

    template <typename Archive>
    void archive_counts(Archive &archive, LinearStatistics &counts)
    {
      archive_all(archive,
                  counts.assemblies,
                  counts.factorisations,
                  counts.krylov_iterations,
                  counts.worst_residual,
                  counts.null_pivots,
                  counts.flops,
                  counts.megabytes,
                  counts.predicted_megabytes,
                  counts.gave_up_single_precision,
                  counts.note);
      archive_pivot_excess(archive, counts.pivot_excess);
    }

    template <typename Archive>
    void archive_run(Archive &archive, SavedRun &run, const Vector &layout)
    {
      archive_march(archive, run.march, layout);
      archive_counts(archive, run.linear);
      archive_counts(archive, run.nested.linear);
      archive_optional(archive, run.dual, [&](DualReport &dual) {
        archive_all(archive, dual.iterations, dual.to_one_percent, dual.to_hundredth_percent);
      });
      archive_all(archive,
                  run.nested.newton_iterations,
                  run.nested.remarks,
                  run.pictures,
                  run.seconds,
                  run.seconds_total,
                  run.peak_megabytes);
    }

    /// A number that changes with the cells of this rank, their vertices and their order.
    template <int dim>
    std::string fingerprint(const Discretisation<dim> &discretisation)
    {
      // FNV-1a of indices and of positions in single precision.
      std::uint64_t sum = 0xcbf29ce484222325;
      const auto    add = [&](const std::uint64_t word) { sum = (sum ^ word) * 0x100000001b3; };
      for (const LocalIndex unknown : discretisation.cells.x)
        add(unknown);
      for (const auto &point : discretisation.cells.geometry)
        for (unsigned int d = 0; d < dim; ++d)
          add(std::bit_cast<std::uint32_t>(static_cast<float>(point[d])));
      return std::to_string(sum);
    }

    template <int dim>
    Identity identity_of(const RunSettings &settings, const Discretisation<dim> &discretisation)
    {
      Identity identity              = settings.identity;
      identity["number of cells"]    = std::to_string(discretisation.n_cells);
      identity["number of unknowns"] = std::to_string(discretisation.n_unknowns());
      identity["the mesh"]           = fingerprint(discretisation);
      return identity;
    }
  } // namespace

  LinearStatistics joined(const LinearStatistics &earlier, const LinearStatistics &later)
  {
    LinearStatistics all = later;
    if (later.factorisations == 0)
      {
        all.pivot_excess = earlier.pivot_excess;
        all.null_pivots  = earlier.null_pivots;
        all.flops        = earlier.flops;
      }
    all.assemblies        = earlier.assemblies + later.assemblies;
    all.factorisations    = earlier.factorisations + later.factorisations;
    all.krylov_iterations = earlier.krylov_iterations + later.krylov_iterations;
    all.worst_residual    = std::max(earlier.worst_residual, later.worst_residual);
    all.megabytes         = std::max(earlier.megabytes, later.megabytes);
    all.gave_up_single_precision
        = earlier.gave_up_single_precision || later.gave_up_single_precision;
    return all;
  }

  template <int dim>
  RunCheckpoints::RunCheckpoints(const RunSettings         &settings,
                                 const Discretisation<dim> &discretisation)
    : communicator(settings.communicator)
    , interval(settings.checkpoint_interval)
    , files(communicator, settings.folder, identity_of(settings, discretisation))
  {
  }

  bool RunCheckpoints::is_due() const
  {
    // One clock decides for all ranks.
    return interval
           && dealii::Utilities::MPI::broadcast(communicator, since_last.total()) >= *interval;
  }

  void RunCheckpoints::save(SavedRun run)
  {
    std::ostringstream stream;
    {
      boost::archive::binary_oarchive archive(stream, boost::archive::no_header);
      archive_run(archive, run, run.march.state);
    }
    files.save(run.march.report.load_steps, std::move(stream).str());
    since_last = Stopwatch();
  }

  SavedRun RunCheckpoints::load(const Vector &layout, std::vector<std::string> &remarks)
  {
    const auto saved = files.load(remarks);
    if (!saved)
      return {};
    SavedRun run;
    collectively(communicator, [&]() {
      std::istringstream              stream(saved->contents);
      boost::archive::binary_iarchive archive(stream, boost::archive::no_header);
      archive_run(archive, run, layout);
    });
    remarks.push_back("continued from the state saved after load step "
                      + std::to_string(saved->number) + ", load factor "
                      + to_text(run.march.report.load));
    return run;
  }

  template RunCheckpoints::RunCheckpoints(const RunSettings &, const Discretisation<2> &);
  template RunCheckpoints::RunCheckpoints(const RunSettings &, const Discretisation<3> &);
} // namespace isochor
