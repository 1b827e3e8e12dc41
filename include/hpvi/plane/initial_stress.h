// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_initial_stress_h
#define hpvi_initial_stress_h

#include <deal.II/lac/vector.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/displacement_space.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/shape_tables.h>

namespace hpvi
{
/** Does anything act inside cells? */
template <int dim>
bool has_interior_loads(const Scene<dim> &scene)
{
  return scene.has_body_force() || scene.has_initial_strain();
}

/** e33 in @p cell at @p x, that of the initial strain across the plane. */
template <int dim, class Cell>
double initial_strain_across(const Scene<dim> &scene, const Cell &cell, const dealii::Point<dim> &x)
{
  return scene.initial_strains.empty() ? 0.
                                       : scene.initial_strains[cell->material_id()].value(x)[3];
}

/**
 * The slope of @p f by the reference coordinate @p r: by a difference of fourth order, whose error, 1e-15 of the fifth derivative, and
 * round-off are both below what the last bits of u_N leave of an indicator.
 */
template <int dim, class Function>
auto difference_along(const Function &f, const dealii::Point<dim> &reference, const unsigned int r)
{
  constexpr double step = 5e-4; // two of them stay in the cell
  const auto beside = [&](const int n)
  {
    dealii::Point<dim> x = reference;
    x[r] += n * step;
    return f(x);
  };
  return (8. * (beside(1) - beside(-1)) - (beside(2) - beside(-2))) / (12 * step);
}

/**
 * `div C eps_0` at a point inside @p cell, by differences [stress/length]. Strains that belong to no displacement have slopes without
 * the symmetry of second derivatives: HookesLaw::divergence_of_stress() is not for them.
 */
template <int dim, class Cell>
dealii::Tensor<1, dim> initial_stress_divergence(const Scene<dim> &scene, const Cell &cell,
                                                 const CellMap<dim> &map,
                                                 const dealii::Point<dim> &reference)
{
  const HookesLaw<dim> law(scene.material_of(cell));
  const dealii::Tensor<2, dim> inverse = dealii::invert(map.jacobian(reference));
  dealii::Tensor<1, dim> result;
  for (unsigned int r = 0; r < dim; ++r)
    result += law.stress(difference_along([&](const dealii::Point<dim> &x) -> dealii::Tensor<2, dim>
                                          { return scene.initial_strain_in(cell, map.point(x)); },
                                          reference, r)) *
              inverse[r];
  return result;
}

/** The square in energy of what the polynomials through the points of the rule in a cell miss of eps_0, seen at more of them. */
double initial_stress_error(const Scene<2> &scene,
                            const dealii::Triangulation<2>::cell_iterator &cell,
                            unsigned int degree, const LoadRules<2> &rules,
                            const ShapeTables<2> &tables);

/** Its root on all cells of @p space together: initial_strain_loads() on v is off by no more times |v|_a. */
double initial_stress_error(const Scene<2> &scene, const DisplacementSpace<2> &space,
                            const LoadRules<2> &rules, const ShapeTables<2> &tables);

/**
 * `int C eps_0 : eps(v_i)`, what the initial strain does as a load [stress length], by @p rules of the scene, which may be on other cells than its own. Where div v counts projected only, that of eps_0 is
 * projected likewise: the pressure is that of both.
 */
dealii::Vector<double> initial_strain_loads(const Scene<2> &scene,
                                            const DisplacementSpace<2> &space,
                                            const ShapeTables<2> &tables, const LoadRules<2> &rules,
                                            Volume volume = Volume::full);

/**
 * `1/2 int C eps_0 : eps_0 - int C eps_0 : eps(u)`, by what the elastic energy `1/2 int C (eps(u) - eps_0) : (eps(u) - eps_0)`
 * differs from a(u,u)/2, for unit thickness [stress length^2]; in plane strain with what e33 stores across.
 */
double initial_energy(const Scene<2> &scene, const DisplacementSpace<2> &space,
                      const ShapeTables<2> &tables, const dealii::Vector<double> &u);
} // namespace hpvi

#endif
