// Derivatives of displacement probes along a direction, against central differences of their values: every
// kind, component and magnitude, on simplices and hypercubes. Extremes keep their node, because no other
// one is near; other probes have none.

#include "../common/meshes.h"
#include "../common/report.h"

#include <isochor/measure/probes.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  std::vector<ProbeRequest<dim>> requests()
  {
    std::vector<ProbeRequest<dim>> all;
    const auto                     add = [&](const std::string                 &name,
                         const ProbeKind                    kind,
                         const std::string                 &boundary,
                         const std::optional<unsigned int> &component) {
      ProbeRequest<dim> request;
      request.name      = name;
      request.kind      = kind;
      request.boundary  = boundary;
      request.component = component;
      if (kind == ProbeKind::point_displacement)
        for (unsigned int d = 0; d < dim; ++d)
          (request.point ? *request.point : request.point.emplace())[d] = 0.3 + 0.1 * d;
      all.push_back(request);
    };
    add("mean on right", ProbeKind::mean_displacement, "right", {});
    add("mean", ProbeKind::mean_displacement, "", 1);
    add("mean magnitude", ProbeKind::mean_displacement, "", dim);
    add("point", ProbeKind::point_displacement, "", {});
    add("point magnitude", ProbeKind::point_displacement, "", dim);
    add("max", ProbeKind::max_displacement, "", 0);
    add("max magnitude on top", ProbeKind::max_displacement, "top", dim);
    add("min on top", ProbeKind::min_displacement, "top", {});
    add("volume", ProbeKind::volume, "", {});
    add("reaction", ProbeKind::reaction, "top", 0);
    return all;
  }

  /// Any field, the same on all ranks.
  template <int dim>
  Vector field(const Discretisation<dim> &discretisation, const double phase)
  {
    Vector state = discretisation.make_vector();
    for (LocalIndex i = 0; i < state.locally_owned_size(); ++i)
      state.local_element(i) = std::sin(phase + 1.7 * state.get_partitioner()->local_to_global(i));
    state.update_ghost_values();
    return state;
  }

  template <int dim>
  void test(const Mesh<dim> &mesh, const std::string &element)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, find_element(element, ""));
    const auto                wanted = requests<dim>();
    const Probes<dim>         probes(
        discretisation, {}, wanted, [&](const std::string &name, const std::string &what) {
          return mesh.boundary_id(name, what);
        });
    const Vector     state = field(discretisation, 0.), direction = field(discretisation, 1.);
    constexpr double h      = 1e-5;
    const auto       values = [&](const double step) {
      Vector moved(state);
      moved.add(step, direction);
      moved.update_ghost_values();
      return probes.measure(moved, state, 1.);
    };
    const auto before = values(-h), after = values(h);
    double     worst = 0;
    unsigned   n     = 0;
    out() << dim << "D " << element << ":";
    for (const auto &request : wanted)
      {
        const auto derivatives = probes.derivatives(request.name, state);
        if (derivatives.empty())
          out() << " none of " << request.name << ",";
        for (const auto &[column, derivative] : derivatives)
          {
            ++n;
            raise(worst,
                  std::abs(derivative * direction - (after[column] - before[column]) / (2 * h)));
          }
      }
    out() << ' ' << n << " derivatives off by " << below(worst, 1e-8) << ", unknown probe "
          << yes(probes.derivatives("nowhere", state).empty()) << '\n';
  }

  template <int dim>
  void test()
  {
    for (const char *element : {"P1", "P2-P1", "MINI", "P3"})
      test(*distorted_box<dim>(3), element);
    for (const char *element : {"Q1-P0", "Q2-P1"})
      test(*distorted_box<dim>(3, CellKind::hypercube), element);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
}
