#pragma once

// Meshes of bodies that one line describes: boxes, cylinders, shells, ...

#include <isochor/mesh/raw_mesh.h>

namespace isochor
{
  /// How a generator is called, and what comes out.
  struct GeneratorForm
  {
    std::string              name;
    std::string              call; ///< "box(lx, ly, lz)"; all numbers are lengths in metres
    std::size_t              n_arguments;
    int                      dim;
    std::vector<std::string> counts; ///< what each number of MeshRequest::cells counts blocks of
    std::vector<std::string> boundaries;
  };

  /// All generators.
  const std::vector<GeneratorForm> &generator_forms();

  /// Does @p source read like a generator, "name(...)", rather than like a file?
  bool is_generator(const std::string &source);

  /// The generator that @p source names. Throws UserError if there is none.
  const GeneratorForm &generator_form(const std::string &source);

  /// The mesh, of the kind, split and geometry order requested, without quality; boundary holds the
  /// named faces. Throws UserError naming the source.
  ///
  /// Quadratic cells take all their nodes from the map of the body, so those on its surface lie
  /// exactly there; bodies with plane sides have straight cells.
  template <int dim>
  RawMesh<dim> generate(const MeshRequest &request);
} // namespace isochor
