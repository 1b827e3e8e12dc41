// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/plane/elastic_system.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/plane/missed_loads.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Calls f(dof, component, x) once for each unknown, x its node. */
template <class F>
void for_each_node(const DisplacementSpace<2> &space, const ShapeTables<2> &tables, const F &f)
{
  std::vector<bool> is_counted(space.n_dofs());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const unsigned int index = cell->active_cell_index(), degree = space.degrees()[index];
    const auto dofs = space.cell_dofs(index);
    const LocalNumbering &numbering = tables.numbering(degree);
    const auto &nodes =
        tables.elements(degree)[degree - 1].base_element(0).get_unit_support_points();
    const CellMap<2> map = map_of<2>(cell);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (!is_counted[dofs[i]])
      {
        is_counted[dofs[i]] = true;
        f(dofs[i], numbering.component[i], map.point(nodes[numbering.shape[i]]));
      }
  }
}

/** Shape functions sum to one, and so nodal forces to the resultant. Plates have forces of their own, and initial strains none. */
DatumValue sum_of_loads(const Discretisation<2> &discretisation)
{
  const Scene<2> &scene = discretisation.scene;
  const DisplacementSpace<2> &space = discretisation.spaces->displacement_space;
  const ShapeTables<2> &tables = *discretisation.spaces->tables;
  Vector<double> of_mesh = discretisation.system.loads();
  const double round_off = 1e-14 * of_mesh.l1_norm(); // of what is taken away again
  if (scene.has_plates())
    of_mesh -= plate_loads(scene, space, tables);
  if (scene.has_initial_strain())
    of_mesh -= discretisation.system.strain_loads();
  DatumValue result;
  for_each_node(space, tables,
                [&](const types::global_dof_index dof, const unsigned int component,
                    const Point<2> &) { result[component] += of_mesh[dof]; });
  for (unsigned int c = 0; c < 2; ++c)
    if (std::abs(result[c]) <= round_off)
      result[c] = 0;
  return result;
}

/** `int C eps_0`, what its load does on v = x e_c + y e_d. */
DatumValue sum_of_initial_stress(const Discretisation<2> &discretisation)
{
  DatumValue result;
  Vector<double> load = discretisation.system.strain_loads();
  if (!discretisation.scene.pretensions.empty()) // which no rule looks at
    load = initial_strain_loads(without_shortenings(discretisation.scene),
                                discretisation.spaces->displacement_space,
                                *discretisation.spaces->tables, *discretisation.spaces->loads);
  for_each_node(
      discretisation.spaces->displacement_space, *discretisation.spaces->tables,
      [&](const types::global_dof_index dof, const unsigned int component, const Point<2> &x)
      {
        result[component] += load[dof] * x[component];
        if (component == 0)
          result[2] += load[dof] * x[1];
      });
  return result;
}

/** `int k_n`, `int k_t`. */
DatumValue sum_of_springs(const Discretisation<2> &discretisation)
{
  const Scene<2> &scene = discretisation.scene;
  const DisplacementSpace<2> &space = discretisation.spaces->displacement_space;
  DatumValue result;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f) && scene.boundaries[cell->face(f)->boundary_id()].spring)
      {
        const GivenData given = given_data(scene, cell, f, Datum::spring);
        const CellMap<2> map = map_of<2>(cell);
        const Quadrature<1> rule =
            space.rules().spring(cell, f, space.degrees()[cell->active_cell_index()]).quadrature;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Point<2> s = point_on_face<2>(f, rule.point(q)), x = map.point(s);
          result +=
              rule.weight(q) * map.face_measure(f, s) * scene.circumference(x) * given.value(x);
        }
      }
  return result;
}

/** `int g` along foundations. */
DatumValue sum_of_friction(const ContactSpace<2> &contact_space)
{
  DatumValue result;
  for (const ContactFace<2> &face : contact_space.faces())
    if (!face.condition->pair)
      result[0] += face.length * face.friction.integral();
  return result;
}
} // namespace

std::string in_words(const Datum datum, const DatumValue &value)
{
  return datum == Datum::initial_strain   ? to_string(Point<3>(value[0], value[1], value[2]))
         : datum == Datum::friction_bound ? to_string(value[0])
                                          : to_string(Point<2>(value[0], value[1]));
}

std::string missed_loads(const Discretisation<2> &discretisation, const LoadRules<2> &loads)
{
  const Scene<2> &scene = discretisation.scene;
  const auto compare = [&](const Datum datum, const DatumValue &sum, const std::string &what)
  {
    return loads.are_missing_something(datum, sum)
               ? what + " to " + in_words(datum, sum) + " on this mesh and to " +
                     in_words(datum, loads.total_of(datum).sum) +
                     " on the coarse one: something in them is too narrow to be seen"
               : "";
  };
  std::string result = compare(Datum::load, sum_of_loads(discretisation), "loads sum");
  if (result.empty() && scene.has_initial_strain() && !scene.is_axisymmetric())
    result = compare(Datum::initial_strain, sum_of_initial_stress(discretisation),
                     "stresses of initial strains sum");
  if (result.empty() && scene.has_springs())
    result = compare(Datum::spring, sum_of_springs(discretisation), "stiffnesses of springs sum");
  if (result.empty() && scene.has_friction() && !scene.is_axisymmetric())
    result = compare(Datum::friction_bound, sum_of_friction(discretisation.spaces->contact_space),
                     "friction bounds sum");
  return result;
}

std::string unresolved_loads(const std::vector<UnresolvedLoad<2>> &unresolved)
{
  if (unresolved.empty())
    return {};
  const UnresolvedLoad<2> &worst =
      *std::max_element(unresolved.begin(), unresolved.end(),
                        [](const auto &a, const auto &b) { return a.part < b.part; });
  return lower_case(worst.name.substr(0, 1)) + worst.name.substr(1) + " is not resolved near " +
         to_string(worst.where) + ", by " + text(worst.part, 2) + " of all " +
         (worst.datum == Datum::load             ? "loads"
          : worst.datum == Datum::initial_strain ? "stresses of initial strains"
                                                 : "springs");
}
} // namespace hpvi
