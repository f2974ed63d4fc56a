#include <isochor/core/text.h>
#include <isochor/material/advice.h>
#include <isochor/run/warnings.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    // Above this ratio of kappa to mu (nu = 0.475), linear simplices lose more than a few percent.
    constexpr double stiff_volume = 20.;

    std::string stable_elements(const CellKind kind)
    {
      return listed(element_names(
          [&](const Element &element) { return element.is_stable && element.kind == kind; }));
    }

    class Sentences
    {
    public:
      template <typename... Parts>
      void add(const Parts &...parts)
      {
        std::ostringstream text;
        text.precision(3);
        (text << ... << parts);
        sentences.push_back(text.str());
      }

      std::vector<std::string> sentences;
    };

    void say_stability(Sentences       &out,
                       const RunResult &result,
                       const Element   &element,
                       const double     poisson_ratio)
    {
      const std::string stable = stable_elements(element.kind);
      for (const auto &[test, when] : {std::pair(&result.inf_sup_at_rest, "at rest"),
                                       std::pair(&result.inf_sup_at_end, "in the final state")})
        if (*test && (*test)->spurious_modes > 0)
          out.add((*test)->spurious_modes,
                  " pressure modes are spurious ",
                  when,
                  ": no displacement of ",
                  element.name,
                  " feels them on this mesh; do not trust the pressures, choose ",
                  stable);

      const auto excess = result.march.pivot_excess.value_or(0);
      if (excess > 0)
        out.add("the equilibrium is not stable: ",
                excess,
                " negative pivots too many; the body would buckle or snap into another shape");
      if (excess < 0 || result.linear.null_pivots > 0)
        out.add("the pressure is not determined: ",
                result.linear.null_pivots,
                " null pivots (spurious pressure modes) of ",
                element.name,
                " on this mesh; choose ",
                stable,
                poisson_ratio == 0.5 ? ", or a Poisson ratio a little below 0.5" : "");
    }

    void say_pressure(Sentences &out, const RunResult &result, const Element &element)
    {
      if (result.oscillation.value_or(0) <= 0.5)
        return;
      if (element.is_stable)
        out.add("the pressure changes much from cell to cell (CB = ",
                *result.oscillation,
                "): the mesh is too coarse for the pressures of ",
                element.name);
      else
        out.add("the pressure oscillates (CB = ",
                *result.oscillation,
                "): trust the displacements of ",
                element.name,
                ", not its pressures; for pressures choose ",
                stable_elements(element.kind));
    }

    void say_crushed(Sentences &out, const RunResult &result, const Material &material)
    {
      // A cell may well lose some volume where pressures are weak, or all of them where the body does.
      constexpr double acceptable   = 0.5;
      const Moduli     m            = moduli(material);
      const double     min_jacobian = result.march.size.min_jacobian;
      if (result.march.load_steps == 0 || m.kappa <= stiff_volume * m.mu
          || make_distortional_energy(material.energy, m)->is_linear()
          || min_jacobian >= acceptable * std::min(1., result.volume_ratio))
        return;
      out.add("cells are nearly crushed: J falls to ",
              min_jacobian,
              ", where a Poisson ratio of ",
              to_text(material.poisson_ratio),
              " keeps it near 1, and in the mean it is ",
              to_text(result.volume_ratio),
              "; the mesh is too coarse there for so large a deformation, or the load too big: do "
              "not trust stresses and pressures near those cells");
    }

    void say_locking(Sentences &out, const Element &element, const Material &material)
    {
      const bool constant_strain = element.kind == CellKind::simplex
                                   && element.displacement.family == Family::lagrange
                                   && element.displacement.degree == 1
                                   && (!element.is_mixed() || element.has_discontinuous_pressure());
      if (!constant_strain)
        return;
      const Moduli m = moduli(material);
      if (m.kappa > stiff_volume * m.mu)
        out.add(element.name,
                " locks at Poisson ratio ",
                material.poisson_ratio,
                ": each cell keeps its own volume, and the displacements may be far too small; "
                "choose P1-P1, or ",
                stable_elements(element.kind));
    }
  } // namespace

  std::vector<std::string> warnings_of(const RunResult    &result,
                                       const Element      &element,
                                       const Material     &material,
                                       const TrustFigures &figures)
  {
    Sentences out;
    out.sentences       = advice(material);
    const auto weakness = make_distortional_energy(material.energy, moduli(material))
                              ->weakness(figures.deformation);
    if (!weakness.empty())
      out.sentences.push_back(weakness);
    say_locking(out, element, material);
    say_stability(out, result, element, material.poisson_ratio);
    say_pressure(out, result, element);
    say_crushed(out, result, material);
    // Taylor-Hood needs an interior vertex in every cell.
    const bool taylor_hood = element.pressure && element.pressure->family == Family::lagrange
                             && element.displacement.family == Family::lagrange
                             && element.displacement.degree > 1;
    if (taylor_hood && figures.clamped_cells > 0)
      out.add(figures.clamped_cells,
              " cells have all their vertices held: ",
              element.name,
              " loses its stability there; refine the mesh at the support, or choose MINI or "
              "P1-P1s");
    return out.sentences;
  }
} // namespace isochor
