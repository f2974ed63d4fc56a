#pragma once

// The runs that Element = auto makes of one scene, and what is known of each.

#include <isochor/run/accuracy_model.h>
#include <isochor/run/automatic.h>
#include <isochor/run/nested.h>

namespace isochor
{
  /// Hooke's law.
  inline constexpr Energy hookes_law = Energy::linear;

  /// One run, and what is thought of it.
  struct Attempt
  {
    Trial                 trial;
    const Element        *element = nullptr;
    std::optional<Energy> energy; ///< in the place of the scene's
    RunResult             result;
    std::string           words;    ///< element, edge length or blocks, energy
    std::optional<double> estimate; ///< relative error of the probe
    std::string           verdict;

    bool converged() const
    {
      return result.converged();
    }
  };

  /// Makes runs. Each begins with the last equilibrium that is kept, interpolated.
  template <int dim>
  class Trials
  {
  public:
    /// Throws UserError for a mesh that cannot be refined or a probe that is not there.
    Trials(const Scene<dim>       &scene,
           const Method           &method,
           const RunSettings      &settings,
           const AutomaticOptions &options);

    /// What is wanted of a run.
    struct Wish
    {
      const Element        *element    = nullptr;
      double                refinement = 1; ///< edge length of the scene's mesh / that of the run
      std::optional<Energy> energy;         ///< in the place of the scene's
      bool                  is_kept    = true; ///< the next runs begin with its equilibrium
      double                time_limit = 0;    ///< s; 0: the method's
    };

    /// Number of the new attempt, which is left out if its mesh is hardly finer than a coarser one.
    /// Collective.
    std::size_t make(const Wish &wish);

    const Attempt &operator[](const std::size_t k) const
    {
      return attempts[k];
    }
    Attempt &operator[](const std::size_t k)
    {
      return attempts[k];
    }
    std::size_t size() const
    {
      return attempts.size();
    }

    /// The finest converged run of the element and energy of run @p fine on a coarser mesh.
    std::optional<std::size_t> coarser_than(std::size_t fine) const;

    /// Estimates the error of run @p fine from itself and from the coarser ones, as far as they tell; of
    /// two estimates the smaller one counts.
    void estimate(std::size_t fine);

    /// Exponent of the unknowns in the refinement, up to run @p fine.
    double growth(std::size_t fine) const;

    /// Of the last equilibrium that was kept, over the diagonal of the box around the body.
    /// Collective.
    double largest_displacement() const;

    /// The result of Element = auto if run @p chosen is it: files in place, automatic.csv written.
    RunResult finish(std::size_t chosen);

    /// Is the load applied in several steps, from rest?
    bool goes_in_steps() const
    {
      return method.stepping.kind != Stepping::fixed || method.stepping.load_steps > 1;
    }

    /// s; 0: none.
    double time_limit() const
    {
      return method.time_limit;
    }

    const Scene<dim>       scene;
    const AutomaticOptions options;

  private:
    const std::string &probe() const; ///< name of the one that must be accurate
    std::string        words(const Wish &wish) const;
    std::optional<std::size_t>
    finest_below(double refinement, const Element &element, std::optional<Energy> energy) const;
    /// Those of @p numbers, one per column of @p result, that belong to the probe.
    std::vector<double> of_probe(const RunResult &result, const std::vector<double> &numbers) const;
    std::filesystem::path folder_of(std::size_t k) const;
    void                  write_table() const;
    std::string           table(std::size_t chosen) const;

    const Method             method;
    const RunSettings        settings;
    std::vector<Attempt>     attempts;
    SolvedBody<dim>          body; ///< what the next run begins with
    bool                     has_folder = false;
    std::optional<UserError> refusal; ///< the first
  };

  /// With so many significant digits.
  std::string rounded(double value, int digits);

  /// "1.2 %"
  std::string percent(double value);
} // namespace isochor
