// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/output/vtk_file.h>
#include <hpvi/output/vtu.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/values_at.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Higher ones VTK does not draw, and their equidistant nodes are bad. */
constexpr unsigned int highest_degree = 8;

/** FE_Q(@p degree) at the nodes of a cell of the file, x fastest. */
template <int dim>
ShapeTable<dim> table_at_nodes(const unsigned int degree)
{
  const unsigned int n = std::min(degree, highest_degree);
  std::vector<Point<dim>> nodes(std::lround(std::pow(n + 1, dim)));
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= n + 1)
      nodes[k][d] = double(rest % (n + 1)) / n;
  return tabulate<dim>(degree, nodes, std::vector<double>(nodes.size(), 1.), false);
}

/** What is written of u_N at points. */
template <int dim>
struct PointFields
{
  static constexpr unsigned int n_stresses = SymmetricTensor<2, dim>::n_independent_components;
  std::vector<VtkArray> arrays;

  explicit PointFields(const Scene<dim> &scene)
  {
    const auto declare = [&](const std::string &name, const unsigned int n, const std::string &unit)
    { arrays.push_back(vtk_array(name, std::vector<float>(), n, unit)); };
    declare("displacement", 3, scene.length_unit);
    declare("von_mises", 1, scene.stress_unit);
    for (unsigned int i = 0; i < n_stresses; ++i)
    {
      const auto index = SymmetricTensor<2, dim>::unrolled_to_component_indices(i);
      declare(std::string("sigma_") + "xyz"[index[0]] + "xyz"[index[1]], 1, scene.stress_unit);
    }
    if (dim == 2)
      declare("sigma_zz", 1, scene.stress_unit); // 0 in plane stress
  }

  void add(const PointValue<dim> &value)
  {
    FullStress full;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        full[i][j] = value.stress[i][j];
    if (dim == 2)
      full[2][2] = value.across;
    for (unsigned int d = 0; d < 3; ++d)
      append(arrays[0], d < dim ? value.displacement[d] : 0.);
    append(arrays[1], von_mises(full));
    for (unsigned int i = 0; i < n_stresses; ++i)
      append(arrays[2 + i], value.stress.access_raw_entry(i));
    if (dim == 2)
      append(arrays.back(), value.across);
  }

  static void append(VtkArray &array, const float number)
  {
    array.bytes.append(reinterpret_cast<const char *>(&number), sizeof number);
  }
};

/** Means over the contact faces of each cell, by active cell index. */
struct ContactMeans
{
  std::vector<float> pressure, friction; ///< -T_n and |T_t| [stress]

  template <int dim>
  explicit ContactMeans(const Field<dim> &field)
      : pressure(field.dof_handler.get_triangulation().n_active_cells()), friction(pressure)
  {
    std::vector<double> area(pressure.size());
    for (const FieldFace<dim> &face : field.faces())
    {
      const unsigned int cell = face.cell->active_cell_index();
      area[cell] += face.area();
      for (const PressurePoint<dim> &point : pressure_points(face, field))
        pressure[cell] += point.weight * point.pressure;
      for (const MultiplierPoint<dim> &point : field.multiplier_points(face, 0.))
        friction[cell] += point.area * point.traction.friction.norm();
    }
    for (unsigned int cell = 0; cell < area.size(); ++cell)
      for (std::vector<float> *const sum : {&pressure, &friction})
        (*sum)[cell] = area[cell] > 0 ? (*sum)[cell] / area[cell] : 0.F;
  }
};

/** Degree and indicator; where there are several, the process, the body and the material; of contact its means. */
template <int dim>
std::vector<VtkArray> cell_data(const StepReport<dim> &step, const bool is_shared)
{
  const Scene<dim> &scene = step.scene;
  const ContactMeans means(step.field);
  std::vector<VtkArray> arrays;
  const auto add = [&](const std::string &name, const std::string &unit, const auto &value_in)
  {
    std::vector<float> numbers;
    for (const auto &cell : step.field.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        numbers.push_back(value_in(cell));
    arrays.push_back(vtk_array(name, numbers, 1, unit));
  };
  add("degree", "", [&](const auto &cell) { return step.field.degree(cell); });
  add("estimate", "",
      [&](const auto &cell)
      { return std::sqrt(scene.thickness) * step.estimate.indicator(cell->active_cell_index()); });
  if (is_shared)
    add("process", "", [&](const auto &) { return rank_of(step.field.communicator()); });
  if (!scene.geometry.bodies.empty())
    add("body", "", [&](const auto &cell) { return body_of<dim>(scene.geometry, cell); });
  if (scene.materials.size() > 1)
    add("material", "", [](const auto &cell) { return cell->material_id(); });
  for (const auto &[name, mean] : {std::pair("contact_pressure", &means.pressure),
                                   std::pair("contact_friction", &means.friction)})
    if (scene.has_contact())
      add(name, scene.stress_unit,
          [&mean = mean](const auto &cell) { return (*mean)[cell->active_cell_index()]; });
  return arrays;
}

template <int dim>
VtkCell kind_of(const unsigned int degree)
{
  if (dim == 2)
    return degree == 1 ? VtkCell::quadrilateral : VtkCell::lagrange_quadrilateral;
  return degree == 1 ? VtkCell::hexahedron : VtkCell::lagrange_hexahedron;
}
} // namespace

template <int dim>
Vtu vtu(const StepReport<dim> &step, const std::vector<std::string> &pieces)
{
  const bool is_shared = pieces.size() > 1;
  std::map<unsigned int, ShapeTable<dim>> tables; // by degree
  std::map<unsigned int, std::vector<int>> orders;
  PointFields<dim> fields(step.scene);
  VtkGrid grid(step.number);
  for (const auto &cell : step.field.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const unsigned int degree = step.field.degree(cell), n = std::min(degree, highest_degree);
    if (tables.count(degree) == 0)
    {
      tables.emplace(degree, table_at_nodes<dim>(degree));
      orders.emplace(n, lagrange_nodes<dim>(n));
    }
    std::vector<int> nodes = orders.at(n);
    for (int &node : nodes)
      node += int(grid.points.size() / 3);
    grid.add_cell(kind_of<dim>(n), nodes);
    const CellMap<dim> map = map_of<dim>(cell);
    for (const Point<dim> &node : tables.at(degree).points)
    {
      const Point<dim> x = map.point(node);
      for (unsigned int d = 0; d < 3; ++d)
        grid.points.push_back(d < dim ? x[d] : 0.);
    }
    for (const PointValue<dim> &value : values_at(step.field, cell, tables.at(degree)))
      fields.add(value);
  }
  grid.point_data = std::move(fields.arrays);
  grid.cell_data = cell_data(step, is_shared);
  return {grid.vtu(), is_shared ? grid.pvtu(pieces) : ""};
}

template Vtu vtu(const StepReport<2> &, const std::vector<std::string> &);
template Vtu vtu(const StepReport<3> &, const std::vector<std::string> &);
} // namespace hpvi
