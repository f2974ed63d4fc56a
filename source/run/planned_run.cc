#include "planned_run.h"

#include <isochor/run/automatic.h>
#include <isochor/run/plane_scene.h>
#include <isochor/run/results_folder.h>

#include <algorithm>

namespace isochor
{
  void declare_parameters(dealii::ParameterHandler &prm)
  {
    Scene<3>::declare(prm);
    Method::declare(prm);
    AutomaticOptions::declare(prm);
    OutputOptions::declare(prm);
    StudyOptions::declare(prm);
  }

  void read_run(dealii::ParameterHandler &prm,
                const Invocation         &invocation,
                const Assignments        &assignments)
  {
    declare_parameters(prm);
    std::vector<std::string> overrides = invocation.overrides;
    for (const auto &[path, value] : assignments)
      overrides.push_back(path + "=" + value);
    read_parameter_file(prm, invocation.file, overrides);
  }

  namespace
  {
    /// What a state depends on: the scene and what discretises it. How it is solved may change.
    Identity identity_of(dealii::ParameterHandler &prm)
    {
      Identity identity = values_of(prm, {"Scene", "Method"});
      std::erase_if(identity, [](const auto &entry) {
        return entry.first.starts_with("Method/") && entry.first != "Method/Element"
               && entry.first != "Method/Stabilisation"
               && entry.first != "Method/Compliance matrix";
      });
      return identity;
    }

    template <int dim>
    RunResult
    run_planned(dealii::ParameterHandler &prm, const Invocation &invocation, RunSettings settings);

    /// The body of @p prm, computed in two dimensions.
    RunResult run_plane(dealii::ParameterHandler &prm,
                        const Invocation         &invocation,
                        const RunSettings        &settings,
                        const PlaneScene         &plane)
    {
      prm.enter_subsection("Scene");
      for (const auto &[key, value] : plane.values)
        prm.set(key, value);
      prm.leave_subsection();
      RunResult result = run_planned<2>(prm, invocation, settings);
      give_depth(result, plane.depth);
      if (result.automatic)
        result.automatic->choice += ", plane strain";
      return result;
    }

    template <int dim>
    RunResult
    run_planned(dealii::ParameterHandler &prm, const Invocation &invocation, RunSettings settings)
    {
      const auto scene
          = Scene<dim>::parse(prm, std::filesystem::absolute(invocation.file).parent_path());
      const auto method = Method::parse(prm);
      const auto output = OutputOptions::parse(prm);
      settings.vtu      = output.vtu;
      settings.inf_sup |= output.inf_sup;
      if (output.error_estimates)
        settings.estimates_error_of = [](const std::string &) { return true; };
      settings.iterations          = output.iterations;
      settings.checkpoint_interval = output.checkpoint_interval;
      settings.identity            = identity_of(prm);
      if (method.chooses_element)
        {
          if (const auto plane = dim == 3 ? plane_scene(prm) : std::nullopt)
            return run_plane(prm, invocation, settings, *plane);
          return run_automatic(scene, method, settings, AutomaticOptions::parse(prm));
        }
      return run(scene, method, settings);
    }
  } // namespace

  RunResult run_planned(const Invocation  &invocation,
                        const Assignments &assignments,
                        const RunSettings &settings)
  {
    dealii::ParameterHandler prm;
    read_run(prm, invocation, assignments);
    if (dimension_of(prm) == 2)
      return run_planned<2>(prm, invocation, settings);
    return run_planned<3>(prm, invocation, settings);
  }
} // namespace isochor
