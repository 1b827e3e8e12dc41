// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/discretisation/elastic_system.h>
#include <hpvi/discretisation/missed_loads.h>
#include <hpvi/discretisation/springs.h>

#include <algorithm>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of nodal @p forces. */
Tensor<1, 2> resultant(const Vector<double> &forces, const DisplacementSpace<2> &space,
                       const ShapeTables<2> &tables)
{
  Tensor<1, 2> result;
  std::vector<bool> is_counted(space.n_dofs());
  for (unsigned int cell = 0; cell < space.degrees().size(); ++cell)
  {
    const auto dofs = space.cell_dofs(cell);
    const LocalNumbering &numbering = tables.numbering(space.degrees()[cell]);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (!is_counted[dofs[i]])
      {
        is_counted[dofs[i]] = true;
        result[numbering.component[i]] += forces[dofs[i]];
      }
  }
  return result;
}
} // namespace

// Shape functions sum to one, and so nodal forces to the resultant. Plates have forces of their own, and initial strains none.
std::string missed_loads(const Discretisation<2> &discretisation, const LoadRules<2> &loads)
{
  const Scene<2> &scene = discretisation.scene;
  const DisplacementSpace<2> &space = discretisation.spaces->displacement_space;
  const ShapeTables<2> &tables = *discretisation.spaces->tables;
  Vector<double> of_mesh = discretisation.system.loads();
  if (scene.has_plates())
    of_mesh -= plate_loads(scene, space, tables);
  if (scene.has_initial_strain())
    of_mesh -= discretisation.system.strain_loads();
  const Tensor<1, 2> force = resultant(of_mesh, space, tables);
  if (!loads.are_missing_something(force))
    return {};
  return "loads sum to " + to_string(Point<2>(force)) + " on this mesh and to " +
         to_string(Point<2>(loads.sum().force)) +
         " on the coarse one: something in them is too narrow to be seen";
}

std::string unresolved_springs(const Solution<2> &solution)
{
  const std::vector<SpringFace> seen = spring_faces(solution.scene, solution.displacement_space,
                                                    solution.tables),
                                finer = spring_faces(solution.scene, solution.displacement_space,
                                                     solution.tables, 2);
  double largest = 0, most = 0;
  const SpringFace *worst = nullptr;
  for (unsigned int k = 0; k < seen.size(); ++k)
  {
    FullMatrix<double> missed(finer[k].matrix);
    missed.add(-1., seen[k].matrix);
    largest = std::max(largest, finer[k].matrix.frobenius_norm());
    if (const double difference = missed.frobenius_norm(); difference > most)
    {
      most = difference;
      worst = &seen[k];
    }
  }
  if (most <= 1e-9 * largest)
    return {};
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    if (cell->active_cell_index() == worst->cell)
      return "the springs on " + solution.scene.boundaries[worst->boundary].name +
             " are not resolved near " + to_string(cell->face(worst->face)->center()) + ", by " +
             text(most / largest, 2) + " of the stiffest";
  return {};
}

std::string unresolved_loads(const std::vector<UnresolvedLoad<2>> &unresolved,
                             const LoadRules<2> &loads)
{
  if (unresolved.empty())
    return {};
  const UnresolvedLoad<2> &worst =
      *std::max_element(unresolved.begin(), unresolved.end(),
                        [](const auto &a, const auto &b) { return a.deviation < b.deviation; });
  return lower_case(worst.name.substr(0, 1)) + worst.name.substr(1) + " is not resolved near " +
         to_string(worst.where) + ", by " + text(worst.deviation / loads.sum().absolute, 2) +
         " of all loads";
}
} // namespace hpvi
