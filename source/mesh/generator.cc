#include <isochor/mesh/generator.h>

#include "bodies.h"

namespace isochor
{
  namespace
  {
    template <int dim>
    void check_split(const Split split, const std::string &origin)
    {
      const auto name = [](const Split split) { return split_names.name(split); };
      if (dim == 3 && split == Split::right_diagonal)
        throw UserError(origin + ": the split '" + name(split) + "' is for triangles; choose "
                        + listed({name(Split::six_tets), name(Split::five_tets)}));
      if (dim == 2 && split == Split::five_tets)
        throw UserError(origin + ": the split '" + name(split)
                        + "' is for tetrahedra; triangles have '" + name(Split::right_diagonal)
                        + "'");
    }
  } // namespace

  template <int dim>
  RawMesh<dim> generate(const MeshRequest &request)
  {
    const GeneratorForm &form   = generator_form(request.source);
    const std::string    origin = "Mesh '" + request.source + "'";
    if (form.dim != dim)
      throw UserError(origin + ": " + form.name + " is " + (form.dim == 3 ? "three" : "two")
                      + "-dimensional, the scene is " + (dim == 3 ? "three" : "two")
                      + "-dimensional");
    const GeneratorCall call = parse_generator(request.source);
    if (request.kind == CellKind::simplex)
      check_split<dim>(request.split, origin);
    return fill(blocks_of<dim>(call, request), request.kind, request.split, request.geometry_order);
  }

  template RawMesh<2> generate<2>(const MeshRequest &);
  template RawMesh<3> generate<3>(const MeshRequest &);
} // namespace isochor
