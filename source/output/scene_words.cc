// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/backend.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/mesh_words.h>
#include <hpvi/output/pretension_report.h>
#include <hpvi/output/probe_table.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/reader/gmsh/drawing_kind.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/shapes/mesh_from_file.h>
#include <hpvi/scene/bare_joints.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/hexahedral_mesh.h>
#include <hpvi/space/load_check.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr const char *coordinates[] = {"x", "y", "z"};

std::string joined(const std::vector<std::vector<std::string>> &lists)
{
  std::string words;
  for (const std::vector<std::string> &phrases : lists)
    for (const std::string &phrase : phrases)
      words += (words.empty() ? "" : ", ") + phrase;
  return words;
}

/** As in "from (0, 0) to (1, 1) mm, 4 coarse cells". */
template <int dim>
std::string extent_in_words(const BoundingBox<dim> &box, const std::string &length_unit,
                            const unsigned int n_cells)
{
  const auto &[begin, end] = box.get_boundary_points();
  const std::string unit = unit_name(length_unit);
  return "from " + to_string(begin) + " to " + to_string(end) + (unit.empty() ? "" : " " + unit) +
         ", " + text(n_cells) + (n_cells == 1 ? " coarse cell" : " coarse cells");
}

/** Without those of layers that a Pretension shortens: they are what is beside them. */
template <int dim>
unsigned int n_materials(const Scene<dim> &scene)
{
  unsigned int n = 0;
  for (unsigned int m = 0; m < scene.materials.size(); ++m)
    n += material_beside(scene, m) == m ? 1 : 0;
  return n;
}

/** As in ", initial strain e1 = 0.001, thermal expansion 1.2e-05"; wherever the material may be. */
template <int dim>
std::string initial_strain_in_words(const InitialStrain<dim> &initial,
                                    const std::vector<Point<dim>> &points)
{
  std::string words;
  for (unsigned int k = 0; k < initial.components.size(); ++k)
    if (initial.components[k])
      words += (words.empty() ? ", initial strain " : ", ") + std::string(strain_names<dim>()[k]) +
               " = " + range_in_words(values_at<dim>(points, initial.components[k]), "");
  if (initial.expansion != 0)
    words += ", thermal expansion " + text(initial.expansion, 6);
  return words;
}
} // namespace

template <int dim>
std::string body_force_unit(const Scene<dim> &scene)
{
  const std::string stress = unit_name(scene.stress_unit), length = unit_name(scene.length_unit);
  return stress.empty() || length.empty() ? stress : stress + "/" + length;
}

template <int dim>
Scene<dim> at_the_end(const Scene<dim> &scene)
{
  if (!scene.has_load_history())
    return scene;
  const Loading<dim> &loading = scene.loading;
  // Of some times, of which no period of an expression is a multiple: to look at all load steps takes long.
  DataScale past;
  for (const double t : {0.13, 0.41, 0.78})
  {
    const DataScale scale = loading.steps > 1 ? data_scale(loading.at(t)) : DataScale();
    past.stress = std::max(past.stress, scale.stress);
    past.displacement = std::max(past.displacement, scale.displacement);
  }
  return load_step(scene, loading.steps, past);
}

template <int dim>
std::set<std::size_t> materials_of(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  std::set<std::size_t> result;
  for (const auto &cell : mesh.active_cell_iterators())
    result.insert(material_beside(scene, cell->material_id()));
  return result;
}

template <int dim>
std::string name_in_words(const Scene<dim> &scene, const std::size_t number)
{
  const std::string &name = scene.materials[number].name;
  if (!name.empty() || n_materials(scene) == 1)
    return "material" + (name.empty() ? "" : " " + name);
  return scene.parameters ? "material elsewhere" : "material " + std::to_string(number);
}

template <int dim>
std::string material_in_words(const Scene<dim> &scene, const Material &material)
{
  std::string words = material.elasticity_in_words(unit_name(scene.stress_unit), dim);
  if (dim == 2)
    words += scene.is_axisymmetric()                ? ", axisymmetric, forces of the full turn"
             : material.plane == PlaneModel::stress ? ", plane stress"
                                                    : ", plane strain";
  if (material.density > 0)
    words += ", density " + text(material.density, 6);
  const std::size_t number = &material - scene.materials.data();
  if (number < scene.initial_strains.size())
    words += initial_strain_in_words(scene.initial_strains[number], sample_body(scene.geometry));
  if (scene.thickness != 1)
    words += ", thickness " + with_unit(scene.thickness, scene.length_unit, 6);
  return words;
}

namespace
{
/** As in "box from (0, 0) to (4, 4) mm, 16 coarse cells", "mesh file body.msh from (0, 0) ...". */
template <int dim>
std::string body_in_words(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  const bool has_shape = scene.parameters && scene.parameters->has("Geometry", "Shape");
  std::string shape = has_shape ? scene.parameters->text("Geometry", "Shape") : "";
  if (shape == "file")
  {
    const std::string name =
        printable(std::filesystem::path(scene.parameters->text("Geometry", "File")).filename());
    shape = "mesh file " + name;
    if (!scene.geometry.mesh->origin.empty())
      shape = name + ", " + scene.geometry.mesh->origin + ",";
  }
  return "body: " + (shape.empty() ? "" : shape + " ") +
         extent_in_words(GridTools::compute_bounding_box(mesh), scene.length_unit,
                         mesh.n_active_cells()) +
         (scene.geometry.grading_levels > 0 && !scene.geometry.graded_towards.empty()
              ? ", graded towards " + text(unsigned(scene.geometry.graded_towards.size())) +
                    (scene.geometry.graded_towards.size() == 1 ? " point" : " points")
              : "") +
         "\n";
}

/** Of a body among several, as in "lug.step, a STEP file, lengths in mm, "; empty: it is of no file. */
template <int dim>
std::string file_in_words(const Scene<dim> &scene, const std::string &body)
{
  const std::string section = "Body " + body;
  const std::string file = scene.parameters && scene.parameters->has(section, "File")
                               ? scene.parameters->text(section, "File")
                               : "";
  if (file.empty())
    return "";
  const std::string origin = kind_of_drawing(beside(scene.parameters->file_name(), file))
                                 .origin(scene.parameters->text(section, "Length unit"));
  return origin.empty() ? ""
                        : printable(std::filesystem::path(file).filename()) + ", " + origin + ", ";
}

/** Of several bodies each, as in "body punch: from (0 0) to (1 1) mm, 4 coarse cells, material steel", and its own degree. */
template <int dim>
std::string bodies_in_words(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  std::string lines;
  std::vector<unsigned int> own = scene.adaptivity.degrees_of_bodies;
  own.resize(scene.geometry.bodies.size());
  for (unsigned int b = 0; b < scene.geometry.bodies.size(); ++b)
  {
    std::vector<Point<dim>> vertices;
    unsigned int n = 0;
    std::size_t material = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (body_of<dim>(scene.geometry, cell) == b)
      {
        ++n;
        material = material_beside(scene, cell->material_id());
        for (const unsigned int v : cell->vertex_indices())
          vertices.push_back(cell->vertex(v));
      }
    lines += "body " + scene.geometry.bodies[b].name + ": " +
             file_in_words(scene, scene.geometry.bodies[b].name) +
             extent_in_words(BoundingBox<dim>(vertices), scene.length_unit, n) +
             (n_materials(scene) > 1 ? ", " + name_in_words(scene, material) : "") +
             (own[b] > 0 ? ", degree " + std::to_string(own[b]) : "") + "\n";
  }
  return lines;
}

/** Where bodies lie on each other as if they did not know. */
template <int dim>
std::string bare_joints_in_words(const Scene<dim> &scene)
{
  std::string lines;
  if constexpr (dim == 2)
    for (const BareJoint<2> &joint : bare_joints(scene))
      lines += joint.sides[0] + " and " + joint.sides[1] + " lie on each other at " +
               to_string(joint.at) + ", and no Contact names them\n";
  return lines;
}

/** What a mesh file holds. */
template <int dim>
std::string mesh_in_words(const Scene<dim> &scene)
{
  std::string lines;
  if constexpr (dim == 2)
    if (scene.geometry.shape == Shape::bodies && scene.geometry.mesh->is_numbered)
      for (const std::string &line : boundaries_in_words(*scene.geometry.mesh, scene.length_unit))
        lines += line + "\n";
  if (scene.geometry.shape != Shape::file || !scene.geometry.mesh)
    return lines;
  std::vector<std::string> words;
  if constexpr (dim == 2)
    words = mesh_words(*scene.geometry.mesh, scene.length_unit);
  else
    words = mesh_words(*hexahedra_of(scene.geometry), scene.length_unit);
  for (const std::string &line : words)
    lines += line + "\n";
  return lines;
}

template <int dim>
std::string materials_in_words(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  std::string lines;
  for (const std::size_t k : materials_of(scene, mesh))
    lines += name_in_words(scene, k) + ": " + material_in_words(scene, scene.materials[k]) + "\n";
  for (const InitialStrain<dim> &initial : scene.initial_strains)
    if (initial.temperature)
      return lines + "temperature: " +
             range_in_words(values_at<dim>(sample_body(scene.geometry), initial.temperature), "") +
             "\n";
  return lines;
}

template <int dim>
std::string boundaries_in_words(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  std::string lines;
  std::vector<std::string> free;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    const std::optional<BoundaryPhrases> phrases = phrases_of(scene, boundary, mesh);
    if (!phrases || (boundary.pair && scene.pairs[*boundary.pair].parts[0] != boundary.id))
      continue; // the first of two sides speaks for both
    const std::string words = joined({phrases->supports, phrases->contacts, phrases->loads});
    if (words.empty())
      free.push_back(boundary.name.empty()
                         ? (dim == 2 ? "edges without a name" : "faces without a name")
                         : name_and_place(scene, boundary));
    else
      lines += name_and_place(scene, boundary) + ": " + words + "\n";
  }
  return lines + (free.empty() ? "" : "free: " + joined({free}) + "\n");
}

template <int dim>
std::string body_force_in_words(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  if (!scene.has_body_force())
    return {};
  std::array<std::vector<double>, dim> values;
  for (const auto &cell : mesh.active_cell_iterators())
  {
    std::vector<Point<dim>> points{cell->center()};
    for (const unsigned int v : cell->vertex_indices())
      points.push_back(cell->vertex(v));
    for (unsigned int c = 0; c < dim; ++c)
      for (const double value : values_at<dim>(points, scene.body_force_in(cell)[c]))
        values[c].push_back(value);
  }
  std::vector<std::string> phrases;
  for (unsigned int c = 0; c < dim; ++c)
    if (!all_zero(values[c]))
      phrases.push_back(std::string(coordinates[c]) + ": " +
                        range_in_words(values[c], body_force_unit(scene)));
  return "body force: " + joined({phrases}) + "\n";
}

/** As in "20 load steps". */
template <int dim>
std::string history_in_words(const Loading<dim> &loading)
{
  return text(loading.steps) + " load steps" +
         (loading.until_steady == 0
              ? ""
              : ", repeated until the energy that friction dissipates in a cycle changes by less "
                "than " +
                    text(100 * loading.until_steady, shown_digits) + " %, at most " +
                    text(loading.maximum_cycles) + " times");
}

/** Without blank lines. */
std::string one_ending(std::string line)
{
  while (!line.empty() && line.back() == '\n')
    line.pop_back();
  return line + "\n";
}
} // namespace

template <int dim>
std::string resultant_in_words(const Scene<dim> &scene, const bool is_primal)
{
  if constexpr (dim == 2)
    if (!is_primal)
      return one_ending(loads_in_words(scene));
  return one_ending(LoadCheck<dim>(scene).in_words());
}

template <int dim>
std::string scene_in_words(const Scene<dim> &scene)
{
  const Scene<dim> last = at_the_end(scene);
  Triangulation<dim> mesh;
  make_mesh(last, mesh);
  std::string remarks;
  for (const std::string &remark : scene.remarks)
    remarks += remark + "\n";
  return (last.geometry.bodies.empty() ? body_in_words(last, mesh) : bodies_in_words(last, mesh)) +
         mesh_in_words(last) + remarks + bare_joints_in_words(last) +
         materials_in_words(last, mesh) +
         (scene.has_load_history()
              ? "load history: " + history_in_words(scene.loading) + "; what follows is at t = 1\n"
              : "") +
         boundaries_in_words(last, mesh) + body_force_in_words(last, mesh) +
         pretensions_in_words(last) + probes_in_words(last) +
         resultant_in_words(last, takes_primal_path(scene, 1));
}

template std::string body_force_unit(const Scene<2> &);
template std::string body_force_unit(const Scene<3> &);
template std::set<std::size_t> materials_of(const Scene<2> &, const Triangulation<2> &);
template std::set<std::size_t> materials_of(const Scene<3> &, const Triangulation<3> &);
template Scene<2> at_the_end(const Scene<2> &);
template Scene<3> at_the_end(const Scene<3> &);
template std::string name_in_words(const Scene<2> &, std::size_t);
template std::string name_in_words(const Scene<3> &, std::size_t);
template std::string material_in_words(const Scene<2> &, const Material &);
template std::string material_in_words(const Scene<3> &, const Material &);
template std::string scene_in_words(const Scene<2> &);
template std::string scene_in_words(const Scene<3> &);
template std::string resultant_in_words(const Scene<2> &, bool);
template std::string resultant_in_words(const Scene<3> &, bool);
} // namespace hpvi
