#include "trials.h"

#include <isochor/core/text.h>
#include <isochor/mesh/generator.h>
#include <isochor/mesh/geo_constant.h>
#include <isochor/output/results_csv.h>
#include <isochor/output/table.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

namespace isochor
{
  namespace
  {
    namespace fs = std::filesystem;

    /// With its edge length in the place of the .geo file's own, which need not be read again.
    template <int dim>
    Scene<dim> sized(Scene<dim> scene)
    {
      scene.mesh.size = edge_length(scene.mesh).value_or(0.);
      return scene;
    }

    MeshRequest refined(MeshRequest request, const double refinement)
    {
      request.size /= refinement;
      for (unsigned int &blocks : request.cells)
        blocks = std::max(1l, std::lround(blocks * refinement));
      return request;
    }

    std::string values_text(const Trial &trial)
    {
      std::string text;
      for (const double value : trial.values)
        text += (text.empty() ? "" : " ") + csv_number(value);
      return text;
    }

    template <int dim>
    void check(const Scene<dim> &scene, const AutomaticOptions &options)
    {
      if (!is_generator(scene.mesh.source) && !(scene.mesh.size > 0))
        throw UserError(
            "Method/Element: auto chooses the mesh size, too, and '" + scene.mesh.source
            + "' has one mesh only; allowed: a generator, or a .geo file with a constant "
              "'size' or a Scene/Mesh size");
      std::vector<std::string> names;
      for (const auto &probe : scene.probes)
        names.push_back(probe.name);
      if (names.empty())
        throw UserError(
            "Method/Element: auto needs a figure that must be accurate; allowed: at least "
            "one entry in Scene/Probes");
      if (!options.probe.empty() && std::ranges::find(names, options.probe) == names.end())
        throw UserError("Method/Accuracy of: no probe is named '" + options.probe
                        + "'; this scene has " + listed(names));
    }
  } // namespace

  std::string rounded(const double value, const int digits)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
  }

  std::string percent(const double value)
  {
    return rounded(100. * value, 2) + " %";
  }

  template <int dim>
  Trials<dim>::Trials(const Scene<dim>       &scene,
                      const Method           &method,
                      const RunSettings      &settings,
                      const AutomaticOptions &options)
    : scene(sized(scene))
    , options(options)
    , method(method)
    , settings(settings)
  {
    check(this->scene, options);
  }

  template <int dim>
  const std::string &Trials<dim>::probe() const
  {
    return options.probe.empty() ? scene.probes.front().name : options.probe;
  }

  template <int dim>
  std::size_t Trials<dim>::make(const Wish &wish)
  {
    Scene<dim> run_scene = scene;
    run_scene.mesh       = refined(scene.mesh, wish.refinement);
    if (wish.energy)
      {
        run_scene.material.energy            = *wish.energy;
        run_scene.material.volumetric_strain = usual_volumetric_strain(*wish.energy);
      }
    Method run_method        = method;
    run_method.element       = *wish.element;
    run_method.nested_levels = 0;
    if (wish.time_limit > 0 && !(method.time_limit > 0 && method.time_limit < wish.time_limit))
      run_method.time_limit = wish.time_limit;

    RunSettings run_settings   = settings;
    run_settings.folder        = folder_of(attempts.size());
    run_settings.vtu           = std::min(settings.vtu, VtuOutput::final_state);
    run_settings.show_steps    = false;
    run_settings.restart       = false;
    run_settings.most_unknowns = 0; // it is the study's grid that has a limit
    const auto coarse          = finest_below(wish.refinement, *wish.element, wish.energy);
    if (coarse)
      run_settings.least_unknowns = least_unknowns_of_finer(attempts[*coarse].trial.unknowns, dim);
    run_settings.estimates_error_of = [this](const std::string &name) {
      return name == probe() || (settings.estimates_error_of && settings.estimates_error_of(name));
    };
    run_settings.checkpoint_interval.reset();
    run_settings.before_output = [&]() {
      if (!has_folder)
        settings.before_output();
      has_folder = true;
      on_root_collectively(settings.communicator,
                           [&]() { fs::create_directories(run_settings.folder); });
    };

    const Stopwatch stopwatch;
    Attempt         attempt;
    attempt.trial.element    = wish.element->name;
    attempt.trial.degree     = wish.element->displacement.degree;
    attempt.trial.refinement = wish.refinement;
    attempt.element          = wish.element;
    attempt.energy           = wish.energy;
    attempt.words            = words(wish);
    try
      {
        attempt.result = run(run_scene,
                             run_method,
                             run_settings,
                             body.mesh ? &body : nullptr,
                             wish.is_kept ? &body : nullptr);
      }
    catch (const UserError &error)
      {
        if (!refusal)
          refusal = error;
        attempt.result.status = refused;
        attempt.result.reason = error.what();
      }
    if (coarse && attempt.result.status == left_out)
      attempts[*coarse].trial.refinement = wish.refinement; // no coarser than this one, it seems
    attempt.trial.unknowns = attempt.result.unknowns;
    // What is refused or left out took its time, too.
    if (!(attempt.result.seconds_total > 0))
      attempt.result.seconds_total
          = dealii::Utilities::MPI::max(stopwatch.total(), settings.communicator);
    attempt.trial.seconds = attempt.result.seconds_total;
    if (attempt.converged())
      attempt.trial.values = of_probe(attempt.result, attempt.result.probe_values);
    else
      attempt.verdict = attempt.result.status + ": " + attempt.result.reason;
    attempts.push_back(std::move(attempt));
    const Attempt &made = attempts.back();
    if (settings.show_steps && dealii::Utilities::MPI::this_mpi_process(settings.communicator) == 0)
      std::cout << "  tried " << made.words << ": " << made.result.unknowns << " unknowns, "
                << to_text(std::round(1e3 * made.trial.seconds) / 1e3) << " s, "
                << made.result.status << std::endl;
    return attempts.size() - 1;
  }

  template <int dim>
  std::optional<std::size_t> Trials<dim>::finest_below(const double                refinement,
                                                       const Element              &element,
                                                       const std::optional<Energy> energy) const
  {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < attempts.size(); ++k)
      if (attempts[k].element == &element && attempts[k].converged() && attempts[k].energy == energy
          && attempts[k].trial.refinement < refinement
          && (!found || attempts[k].trial.refinement > attempts[*found].trial.refinement))
        found = k;
    return found;
  }

  template <int dim>
  std::optional<std::size_t> Trials<dim>::coarser_than(const std::size_t fine) const
  {
    const Attempt &attempt = attempts[fine];
    return finest_below(attempt.trial.refinement, *attempt.element, attempt.energy);
  }

  template <int dim>
  void Trials<dim>::estimate(const std::size_t fine)
  {
    Attempt &attempt = attempts[fine];
    if (const auto coarse = coarser_than(fine))
      {
        const auto coarsest = coarser_than(*coarse);
        // What a mesh hardly finer cannot tell is still known of the coarser one.
        const auto from_these = error_by_refinement(coarsest ? &attempts[*coarsest].trial : nullptr,
                                                    attempts[*coarse].trial,
                                                    attempt.trial,
                                                    dim);
        attempt.estimate = from_these ? from_these : attempts[*coarse].estimate;
      }
    // Of linear elements the other one tells a tenth of the error or all of it.
    if (attempt.element->displacement.degree > 1 && !attempt.result.estimated_errors.empty())
      if (const auto own = error_by_recovery(
              of_probe(attempt.result, attempt.result.estimated_errors), attempt.trial.values))
        attempt.estimate = std::min(attempt.estimate.value_or(*own), *own);
  }

  template <int dim>
  double Trials<dim>::largest_displacement() const
  {
    if (!body.mesh)
      return 0;
    const Discretisation<dim> &discretisation = *body.discretisation;
    double                     largest        = 0;
    for (LocalIndex i = 0; i < discretisation.n_owned_displacements; i += dim)
      {
        double squared = 0;
        for (unsigned int c = 0; c < dim; ++c)
          squared += std::pow(body.state.local_element(i + c), 2);
        largest = std::max(largest, squared);
      }
    std::vector<double> extent(2 * dim, -std::numeric_limits<double>::max());
    for (const auto &point : discretisation.cells.geometry)
      for (unsigned int d = 0; d < dim; ++d)
        {
          extent[d]       = std::max(extent[d], point[d]);
          extent[dim + d] = std::max(extent[dim + d], -point[d]);
        }
    extent.push_back(largest);
    dealii::Utilities::MPI::max(extent, settings.communicator, extent);
    double diagonal = 0;
    for (unsigned int d = 0; d < dim; ++d)
      diagonal += std::pow(extent[d] + extent[dim + d], 2);
    return std::sqrt(extent.back() / diagonal);
  }

  template <int dim>
  double Trials<dim>::growth(const std::size_t fine) const
  {
    const auto coarse = coarser_than(fine);
    return coarse ? growth_of_unknowns(attempts[*coarse].trial, attempts[fine].trial, dim) : dim;
  }

  template <int dim>
  std::vector<double> Trials<dim>::of_probe(const RunResult           &result,
                                            const std::vector<double> &numbers) const
  {
    const std::string  &name = probe();
    std::vector<double> own;
    for (std::size_t k = 0; k < result.probe_columns.size(); ++k)
      if (const std::string &column = result.probe_columns[k].name;
          column == name || column.starts_with(name + " "))
        own.push_back(numbers[k]);
    return own;
  }

  template <int dim>
  std::string Trials<dim>::words(const Wish &wish) const
  {
    const MeshRequest mesh = refined(scene.mesh, wish.refinement);
    std::string       text(wish.element->name);
    text += mesh.cells.empty() ? ", mesh size " + rounded(mesh.size, 3) + " m" : ", cells";
    for (const unsigned int blocks : mesh.cells)
      text += " " + std::to_string(blocks);
    if (!wish.energy)
      return text;
    return text
           + (*wish.energy == hookes_law ? ", small strain"
                                         : ", " + energy_names.name(*wish.energy));
  }

  template <int dim>
  fs::path Trials<dim>::folder_of(const std::size_t k) const
  {
    return settings.folder / ("trial_" + std::to_string(k + 1));
  }

  template <int dim>
  RunResult Trials<dim>::finish(const std::size_t chosen)
  {
    if (attempts[chosen].result.status == refused)
      throw UserError(*refusal);
    Attempt &attempt = attempts[chosen];
    if (attempt.verdict.empty())
      attempt.verdict = "chosen";
    RunResult       result = attempt.result;
    AutomaticReport report;
    report.choice         = attempt.words;
    report.accuracy       = options.accuracy;
    report.estimate       = attempt.estimate;
    report.trials         = attempts.size();
    report.seconds_chosen = result.seconds_total;
    report.table          = table(chosen);
    result.seconds_total  = 0;
    for (const Attempt &other : attempts)
      result.seconds_total += other.result.seconds_total;
    if (result.converged() && !(attempt.estimate && *attempt.estimate <= options.accuracy))
      result.warnings.push_back(
          "the accuracy of " + percent(options.accuracy)
          + " is not reached: the error is estimated "
          + (attempt.estimate ? "as " + percent(*attempt.estimate) : "by nothing")
          + "; begin with a smaller Scene/Mesh size (or more Cells), or allow a larger error");
    result.automatic = report;
    if (has_folder)
      {
        write_table();
        on_root_collectively(settings.communicator, [&]() {
          if (fs::exists(folder_of(chosen)))
            for (const auto &file : fs::directory_iterator(folder_of(chosen)))
              fs::rename(file.path(), settings.folder / file.path().filename());
          for (std::size_t k = 0; k < attempts.size(); ++k)
            fs::remove_all(folder_of(k));
        });
      }
    return result;
  }

  template <int dim>
  std::string Trials<dim>::table(const std::size_t chosen) const
  {
    std::vector<std::vector<std::string>> rows;
    for (const Attempt &attempt : attempts)
      rows.push_back({attempt.words,
                      std::to_string(attempt.result.unknowns),
                      csv_number(attempt.trial.seconds),
                      values_text(attempt.trial),
                      attempt.estimate ? percent(*attempt.estimate) : "",
                      attempt.verdict});
    return format_table(
               {"tried", "unknowns", "seconds", probe(), "estimated error", "verdict"}, rows, 70)
           + "chosen: " + attempts[chosen].words + "\n";
  }

  template <int dim>
  void Trials<dim>::write_table() const
  {
    ResultsCsv csv(settings.communicator, settings.folder / "automatic.csv");
    for (const Attempt &attempt : attempts)
      {
        ResultRow row
            = {{"element", attempt.trial.element},
               {"refinement", csv_number(attempt.trial.refinement)},
               {"strain", attempt.energy == hookes_law ? "small" : "finite"},
               {"run", attempt.words},
               {"unknowns", std::to_string(attempt.result.unknowns)},
               {"newton iterations", std::to_string(attempt.result.march.newton_iterations)},
               {"seconds", csv_number(attempt.trial.seconds)}};
        row.emplace_back("values", values_text(attempt.trial));
        row.emplace_back("estimated error", attempt.estimate ? csv_number(*attempt.estimate) : "");
        row.emplace_back("verdict", attempt.verdict);
        csv.add(row);
      }
  }

  template class Trials<2>;
  template class Trials<3>;
} // namespace isochor
