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
  // Checkpoints' format number must be counted up when these change.

  template <typename Archive>
  void serialize(Archive &archive, ResidualSize &size, unsigned int)
  {
    archive &size.force &size.constraint &size.rounding &size.min_jacobian &size.value;
  }

  template <typename Archive>
  void serialize(Archive &archive, MarchReport &report, unsigned int)
  {
    archive &report.load &report.load_steps &report.failed_steps &report.newton_iterations &report
        .size;
  }

  template <typename Archive>
  void serialize(Archive &archive, LinearStatistics &counts, unsigned int)
  {
    bool      is_known = counts.pivot_excess.has_value();
    long long excess   = counts.pivot_excess.value_or(0);
    archive &counts.assemblies &counts.factorisations &counts.krylov_iterations &counts
        .worst_residual &is_known &excess &counts.null_pivots &counts.flops &counts
        .megabytes &counts.gave_up_single_precision;
    counts.pivot_excess = is_known ? std::optional(excess) : std::nullopt;
  }

  /// All but vectors, whose layout the archive does not know.
  template <typename Archive>
  void serialize(Archive &archive, SavedRun &run, unsigned int)
  {
    archive &run.march.report &run.march.numbers &run.pictures &run.linear &run.seconds &run
        .seconds_total &run.peak_megabytes;
  }

  namespace
  {
    /// The share of this rank.
    std::string to_bytes(const SavedRun &run)
    {
      std::vector<std::vector<double>> values;
      for (const Vector &vector : run.march.vectors)
        values.emplace_back(vector.begin(), vector.begin() + vector.locally_owned_size());
      std::ostringstream stream;
      {
        boost::archive::binary_oarchive archive(stream, boost::archive::no_header);
        archive << run << values;
      }
      return std::move(stream).str();
    }

    SavedRun from_bytes(const std::string &bytes, const Vector &layout)
    {
      SavedRun                         run;
      std::vector<std::vector<double>> values;
      {
        std::istringstream              stream(bytes);
        boost::archive::binary_iarchive archive(stream, boost::archive::no_header);
        archive >> run >> values;
      }
      for (const std::vector<double> &of_vector : values)
        {
          Vector &vector = run.march.vectors.emplace_back(layout.get_partitioner());
          if (of_vector.size() != vector.locally_owned_size())
            throw std::runtime_error("a saved state of another size");
          std::copy(of_vector.begin(), of_vector.end(), vector.begin());
        }
      return run;
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
    LinearStatistics all  = later.factorisations > 0 ? later : earlier;
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

  void RunCheckpoints::save(const SavedRun &run)
  {
    files.save(run.march.report.load_steps, to_bytes(run));
    since_last = Stopwatch();
  }

  SavedRun RunCheckpoints::load(const Vector &layout, std::vector<std::string> &remarks)
  {
    const auto saved = files.load(remarks);
    if (!saved)
      return {};
    SavedRun run;
    collectively(communicator, [&]() { run = from_bytes(saved->contents, layout); });
    remarks.push_back("continued from the state saved after load step "
                      + std::to_string(saved->number) + ", load factor "
                      + to_text(run.march.report.load));
    return run;
  }

  template RunCheckpoints::RunCheckpoints(const RunSettings &, const Discretisation<2> &);
  template RunCheckpoints::RunCheckpoints(const RunSettings &, const Discretisation<3> &);
} // namespace isochor
