// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/pretension_force.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** `int sigma_N : E` on one cell of the layer. */
double work_of_stress(const Solution<2> &solution, const PlaneStrain &unit,
                      const DoFHandler<2>::active_cell_iterator &cell)
{
  const Scene<2> &scene = solution.scene;
  const unsigned int index = cell->active_cell_index(),
                     degree = solution.displacement_space.degrees()[index];
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(scene.material_of(cell));
  const ShapesOfRule shapes(solution.spaces->loads->initial_strain(cell, degree), degree,
                            solution.tables);
  const ShapeTable<2> &table = shapes.table;
  const std::vector<double> local = solution.coefficients(index),
                            derivatives = evaluate(table.derivatives, local),
                            values = evaluate(table.values, local);
  Tensor<2, 2> E;
  E[0][0] = unit[0];
  E[1][1] = unit[1];
  E[0][1] = E[1][0] = unit[2];
  double work = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Point<2> x = map.point(table.points[q]);
    const Tensor<2, 2> jacobian = map.jacobian(table.points[q]),
                       gradient = physical_gradient<2>(derivatives, q * table.rows_per_point,
                                                       table.derivatives.m(), invert(jacobian));
    const Tensor<1, 2> u({values[q], values[table.values.m() + q]});
    const Tensor<2, 2> stress(law.stress(gradient - scene.initial_strain_in(cell, x),
                                         scene.hoop_strain(cell->material_id(), u, gradient, x)));
    work += table.weights[q] * std::abs(determinant(jacobian)) * scene.circumference(x) *
            scalar_product(stress, E);
  }
  return work;
}

/** `int f . n psi` likewise. */
double work_of_weight(const Solution<2> &solution, const Pretension<2> &cut,
                      const DoFHandler<2>::active_cell_iterator &cell)
{
  const Scene<2> &scene = solution.scene;
  const unsigned int degree = solution.displacement_space.degrees()[cell->active_cell_index()];
  const CellMap<2> map = map_of<2>(cell);
  const Quadrature<2> rule = solution.spaces->loads->body_force(cell, degree).quadrature;
  double work = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const Point<2> x = map.point(rule.point(q));
    work += rule.weight(q) * std::abs(determinant(map.jacobian(rule.point(q)))) *
            scene.circumference(x) * cut.fall(x) *
            (load_at<2>(scene.body_force_in(cell), x) * cut.normal);
  }
  return work;
}
} // namespace

std::vector<double> pretension_forces(const Solution<2> &solution)
{
  const Scene<2> &scene = solution.scene;
  std::vector<double> forces;
  for (const Pretension<2> &cut : scene.pretensions)
  {
    double &force = forces.emplace_back(0.);
    for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
      if (const types::material_id beside = material_beside(scene, cell->material_id());
          beside != cell->material_id() && cut.materials.count(beside) > 0 &&
          cut.materials.at(beside) == cell->material_id())
      {
        force += work_of_stress(solution, unit_shortening(cut), cell);
        if (scene.has_body_force())
          force += work_of_weight(solution, cut, cell);
      }
  }
  return forces;
}
} // namespace hpvi
