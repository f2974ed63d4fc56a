#include "parts.h"

#include <isochor/core/patterns.h>
#include <isochor/mesh/generator.h>

#include <algorithm>

namespace isochor
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace scene_parts
  {
    void declare_mesh(ParameterHandler &prm)
    {
      const MeshRequest defaults;

      prm.declare_entry("Dimension",
                        "3",
                        Patterns::Selection("2|3"),
                        "Space dimension: 3, or 2 for plane strain (per metre of thickness). No "
                        "unit.");
      prm.declare_entry("Mesh",
                        "",
                        Patterns::Anything(),
                        "Where the mesh comes from; must be set. A gmsh geometry (.geo, meshed "
                        "with Mesh size) or mesh (.msh) file, relative to the folder of this "
                        "parameter file, or a generator with lengths in m. From one corner at the "
                        "origin: box(lx, ly, lz), rectangle(lx, ly), with the boundaries left, "
                        "right (x), bottom, top (y), back, front (z). quadrilateral(x0,y0, x1,y1, "
                        "x2,y2, x3,y3): corners counterclockwise, the bottom side first. Around "
                        "the x axis from x = 0: cylinder(radius, length) with left, right, side, "
                        "tube(inner, outer, length) with left, right, inner, outer. Around the "
                        "origin: sphere_octant(inner, outer), a thick shell where x, y, z >= 0, "
                        "with left (x = 0), bottom (y = 0), back (z = 0), inner, outer; "
                        "annulus_quarter(inner, outer), the same in 2D. All consist of what cells "
                        "the element needs. A .geo file gives hexahedra or quadrilaterals if it "
                        "says so itself where its constant hexahedra is 1: DefineConstant[ "
                        "hexahedra = 0 ] makes it one that the element sets. Examples: "
                        "../meshes/cantilever.geo; box(1, 0.1, 0.1)");
      prm.declare_entry("Mesh size",
                        to_text(defaults.size),
                        NumberPattern::at_least(0),
                        "Edge length wanted in m, at least 0; where edges of curved bodies differ, "
                        "their mean. 0: as the .geo file has it; not used by .msh files. Example: "
                        "0.05");
      prm.declare_entry(
          "Geometry order",
          to_text(defaults.geometry_order),
          Patterns::Selection("1|2"),
          "Shape of the cells: 1, straight edges; 2, quadratic edges that follow "
          "curved surfaces, as quadratic and cubic elements need on curved bodies (of "
          "linear elements the shape functions would not be linear any more). A "
          ".geo file is meshed with this order, a .msh file must have it. No unit.");
      prm.declare_entry("Cells",
                        "",
                        Patterns::Anything(),
                        "Generators only: number of blocks in each direction, whole numbers of at "
                        "least 1, no unit. box, rectangle, quadrilateral: along x, y, z. cylinder: "
                        "around a quarter, from the square core to the side, along x. tube: "
                        "through the wall, around a quarter, along x. annulus_quarter: through the "
                        "wall, around. sphere_octant: through the wall, along half an edge of the "
                        "octant. Empty: length / Mesh size, rounded. Example: 30, 3, 3");
      prm.declare_entry(
          "Split",
          split_names.name(defaults.split),
          Patterns::Selection(split_names.selection()),
          "Generators of triangles and tetrahedra only: how a block is cut. 6-tet: six "
          "tetrahedra around a diagonal; 5-tet: five, mirrored from block to block "
          "(hardly locks); right: 2D, by the diagonal from lower left to upper "
          "right. In 2D, always right.");
    }

    MeshRequest
    parse_mesh(ParameterHandler &prm, const int dim, const std::filesystem::path &folder)
    {
      MeshRequest       request;
      const std::string source = trim(prm.get("Mesh"));
      if (source.empty())
        throw UserError("Scene/Mesh: not set; allowed: a .geo or .msh file, or a generator such as "
                        "box(1, 0.1, 0.1)");
      if (is_generator(source))
        request.source = source;
      else
        request.source = std::filesystem::absolute(folder / source).lexically_normal().string();

      request.size           = parse_number(prm.get("Mesh size"), "Scene/Mesh size");
      request.geometry_order = prm.get("Geometry order") == "2" ? 2 : 1;

      const auto cells = split_list(prm.get("Cells"), ',');
      for (const std::string &number : cells)
        request.cells.push_back(parse_whole_number(number, 1, "Scene/Cells"));
      // A file takes any that a generator might.
      std::size_t n_counts = dim;
      std::string where    = "in " + std::to_string(dim) + "D";
      if (is_generator(source))
        {
          const GeneratorForm &form = generator_form(source);
          n_counts                  = form.counts.size();
          where                     = "for " + form.call;
        }
      if (!cells.empty() && cells.size() != n_counts)
        throw UserError("Scene/Cells: '" + prm.get("Cells") + "' has "
                        + std::to_string(cells.size()) + " numbers; " + where
                        + " allowed: " + std::to_string(n_counts)
                        + " whole numbers separated by commas, or nothing");

      request.split = split_names.value(prm.get("Split"), "Scene/Split");
      if (dim == 3 && request.split == Split::right_diagonal)
        throw UserError("Scene/Split: 'right' is for Dimension = 2; allowed in 3D: 6-tet or 5-tet");
      if (dim == 2 && request.split == Split::five_tets)
        throw UserError("Scene/Split: '5-tet' is for Dimension = 3; allowed in 2D: right");
      if (dim == 2) // the default is that of 3D
        request.split = Split::right_diagonal;
      return request;
    }

    std::vector<Entry>
    entries_of(ParameterHandler &prm, const std::string &key, const std::string &form)
    {
      std::vector<Entry> entries;
      for (const std::string &text : split_list(prm.get(key), ';'))
        {
          const std::string origin = "Scene/" + key + ": entry '" + text + "'";
          const auto        colon  = text.find(':');
          if (std::ranges::count(text, '(') != std::ranges::count(text, ')'))
            throw UserError(origin + ": '(' and ')' do not pair; allowed: " + form);
          if (colon == std::string::npos)
            throw UserError(origin + ": no ':' in it; allowed: " + form);
          const Entry entry{trim(text.substr(0, colon)), trim(text.substr(colon + 1)), origin};
          if (entry.name.empty())
            throw UserError(origin + ": nothing before the ':'; allowed: " + form);
          if (entry.value.empty())
            throw UserError(origin + ": nothing after the ':'; allowed: " + form);
          entries.push_back(entry);
        }
      return entries;
    }

    void check_boundary_name(const std::string &name, const std::string &origin)
    {
      if (name.empty())
        throw UserError(origin
                        + ": a boundary name is missing; allowed: the names of the mesh, "
                          "such as left");
      if (name.find_first_of(",;:(){}|=\"'") != std::string::npos)
        throw UserError(origin + ": '" + name
                        + "' cannot be the name of a boundary; allowed: the "
                          "names of the mesh, such as left, without punctuation");
    }

    unsigned int parse_component(const std::string &word, const int dim, const std::string &origin)
    {
      if (word == "x" || word == "y" || (word == "z" && dim == 3))
        return word[0] - 'x';
      throw UserError(origin + ": '" + word + "' is not a component; allowed in "
                      + std::to_string(dim) + "D: " + (dim == 2 ? "x or y" : "x, y or z"));
    }
  } // namespace scene_parts

  template <int dim>
  void Scene<dim>::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Scene");
    scene_parts::declare_mesh(prm);
    scene_parts::declare_material(prm);
    scene_parts::declare_supports(prm);
    scene_parts::declare_loads(prm);
    scene_parts::declare_probes(prm);
    prm.leave_subsection();
  }

  template <int dim>
  Scene<dim> Scene<dim>::parse(ParameterHandler &prm, const std::filesystem::path &folder)
  {
    if (dimension_of(prm) != dim)
      throw std::logic_error("a scene of another dimension");

    // The handler must come out as it went in, whatever happens.
    struct Subsection
    {
      explicit Subsection(ParameterHandler &prm)
        : prm(prm)
      {
        prm.enter_subsection("Scene");
      }
      ~Subsection()
      {
        prm.leave_subsection();
      }
      ParameterHandler &prm;
    } const subsection(prm);

    Scene scene;
    scene.mesh     = scene_parts::parse_mesh(prm, dim, folder);
    scene.material = scene_parts::parse_material(prm);
    scene_parts::parse_supports(prm, scene);
    scene_parts::parse_loads(prm, scene);
    scene_parts::parse_probes(prm, scene);
    return scene;
  }

  int dimension_of(ParameterHandler &prm)
  {
    return prm.get({"Scene"}, "Dimension") == "2" ? 2 : 3;
  }

  template <int dim>
  std::vector<std::pair<std::string, std::string>> boundary_references(const Scene<dim> &scene)
  {
    std::vector<std::pair<std::string, std::string>> references;

    const auto add = [&](const auto &parts) {
      for (const auto &part : parts)
        if (!part.boundary.empty())
          references.emplace_back(part.boundary, part.origin);
    };
    add(scene.supports);
    add(scene.tractions);
    add(scene.pressures);
    add(scene.probes);
    return references;
  }

  template <int dim>
  void check_loads_against_supports(const Scene<dim> &scene)
  {
    const auto check = [&](const auto &loads) {
      for (const auto &load : loads)
        {
          std::array<bool, dim> held{};
          std::string           by;
          for (const Support<dim> &support : scene.supports)
            if (support.boundary == load.boundary)
              {
                by += (by.empty() ? "" : " and ") + support.origin;
                for (unsigned int d = 0; d < dim; ++d)
                  held[d] = held[d] || support.components[d];
              }
          if (std::ranges::count(held, true) == dim)
            throw UserError(load.origin
                            + ": the load has no effect, because all displacements of "
                              "boundary '"
                            + load.boundary + "' are prescribed by " + by
                            + "; allowed: a boundary with a free component");
        }
    };
    check(scene.tractions);
    check(scene.pressures);
  }

  template struct Scene<2>;
  template struct Scene<3>;
  template std::vector<std::pair<std::string, std::string>> boundary_references(const Scene<2> &);
  template std::vector<std::pair<std::string, std::string>> boundary_references(const Scene<3> &);
  template void check_loads_against_supports(const Scene<2> &);
  template void check_loads_against_supports(const Scene<3> &);
} // namespace isochor
