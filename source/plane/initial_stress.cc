// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/initial_stress.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Initial strain and its stress around the axis of an axisymmetric body, and one over the radius. */
struct Hoop
{
  double strain, stress, curvature;
};

/** C eps_0 at all points of @p table; @p strains: eps_0. */
std::vector<Tensor<2, 2>> stresses_of(const std::vector<Tensor<2, 2>> &strains,
                                      const Material &material, const ShapeTable<2> &table,
                                      const unsigned int degree, const Volume volume)
{
  const HookesLaw<2> law(material);
  std::vector<Tensor<2, 2>> result;
  for (const Tensor<2, 2> &strain : strains)
    result.emplace_back(law.stress(strain));
  if (volume == Volume::full || !material.is_nearly_incompressible(2))
    return result;
  const FullMatrix<double> modes = oscillating_modes(table, degree);
  Vector<double> weighted(strains.size()), oscillating(strains.size()), amplitudes(modes.m());
  for (unsigned int q = 0; q < strains.size(); ++q)
    weighted[q] = table.weights[q] * trace(strains[q]);
  modes.vmult(amplitudes, weighted);
  modes.Tvmult(oscillating, amplitudes);
  for (unsigned int q = 0; q < strains.size(); ++q)
    for (unsigned int d = 0; d < 2; ++d)
      result[q][d][d] -= law.volume_modulus() * oscillating[q];
  return result;
}

/** What the initial strain of a cell is at its points. */
struct StrainOfCell
{
  StrainOfCell(const Scene<2> &scene, const DisplacementSpace<2> &space,
               const ShapeTables<2> &tables, const LoadRules<2> &rules, Volume volume,
               const Triangulation<2>::active_cell_iterator &cell);

  const unsigned int degree;
  const CellMap<2> map;
  const ShapesOfRule shapes;
  const ShapeTable<2> &table;
  std::vector<Tensor<2, 2>> strains, stresses; ///< eps_0, C eps_0
  std::vector<Hoop> hoops;                     ///< what these are around an axis
  std::vector<double> weights, across;         ///< Material::energy_across()
};

StrainOfCell::StrainOfCell(const Scene<2> &scene, const DisplacementSpace<2> &space,
                           const ShapeTables<2> &tables, const LoadRules<2> &rules,
                           const Volume volume, const Triangulation<2>::active_cell_iterator &cell)
    : degree(space.degrees()[cell->active_cell_index()]), map(map_of<2>(cell)),
      shapes(rules.initial_strain(cell, degree), degree, tables), table(shapes.table)
{
  for (const Point<2> &point : table.points)
    strains.push_back(scene.initial_strain_in(cell, map.point(point)));
  stresses = stresses_of(strains, scene.material_of(cell), table, degree, volume);
  for (unsigned int q = 0; q < strains.size(); ++q)
  {
    const Point<2> x = map.point(table.points[q]);
    weights.push_back(table.weights[q] * std::abs(determinant(map.jacobian(table.points[q]))) *
                      scene.circumference(x));
    Hoop hoop{0., 0., 0.};
    if (scene.is_axisymmetric())
    {
      hoop.curvature = 1 / x[0];
      const HookesLaw<2> law(scene.material_of(cell));
      hoop.strain = initial_strain_across<2>(scene, cell, x);
      hoop.stress = law.hoop_stress(strains[q], hoop.strain);
      stresses[q] = Tensor<2, 2>(law.stress(strains[q], hoop.strain));
    }
    hoops.push_back(hoop);
    across.push_back(
        scene.material_of(cell).energy_across(initial_strain_across<2>(scene, cell, x)));
  }
}

/** Calls f(index, strain) for all cells that have an initial strain, by all threads. */
template <class F>
void for_each_strain(const Scene<2> &scene, const DisplacementSpace<2> &space,
                     const ShapeTables<2> &tables, const LoadRules<2> &rules, const Volume volume,
                     const F &f)
{
  std::vector<Triangulation<2>::active_cell_iterator> cells;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (scene.has_initial_strain() && scene.initial_strains[cell->material_id()])
      cells.push_back(cell);
  parallel_for_each(cells.size(), 4,
                    [&](const unsigned int k) {
                      f(cells[k]->active_cell_index(),
                        StrainOfCell(scene, space, tables, rules, volume, cells[k]));
                    });
}
} // namespace

namespace
{
/** On one part of the rule in a cell. */
double initial_stress_error(const Scene<2> &scene, const Triangulation<2>::cell_iterator &cell,
                            const RulePart<2> &part, const ShapeTables<2> &tables)
{
  const auto &[box, n] = part;
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(scene.material_of(cell));
  const QGauss<1> &own = tables.gauss(n), &finer = tables.gauss(n + 3);
  FullMatrix<double> basis(n + 3, n); // through the points of the one at those of the other
  for (unsigned int q = 0; q < n + 3; ++q)
    for (unsigned int i = 0; i < n; ++i)
      basis(q, i) = tables.gauss_lagrange(n)[i].value(finer.point(q)[0]);
  const auto at = [&box = box](const QGauss<1> &gauss, const unsigned int a, const unsigned int b)
  { return box.unit_to_real(Point<2>(gauss.point(a)[0], gauss.point(b)[0])); };
  const auto strains_at = [&](const QGauss<1> &gauss)
  {
    std::array<FullMatrix<double>, 4> values; // the last around the axis
    values.fill(FullMatrix<double>(gauss.size(), gauss.size()));
    for (unsigned int a = 0; a < gauss.size(); ++a)
      for (unsigned int b = 0; b < gauss.size(); ++b)
      {
        const Point<2> x = map.point(at(gauss, a, b));
        const Tensor<2, 2> strain = scene.initial_strain_in(cell, x);
        for (unsigned int k = 0; k < 3; ++k)
          values[k](a, b) = strain[k == 1][k != 0];
        if (scene.is_axisymmetric())
          values[3](a, b) = initial_strain_across<2>(scene, cell, x);
      }
    return values;
  };
  std::array<FullMatrix<double>, 4> missed = strains_at(finer);
  const std::array<FullMatrix<double>, 4> known = strains_at(own);
  FullMatrix<double> half(n + 3, n), whole(n + 3, n + 3);
  for (unsigned int k = 0; k < 4; ++k)
  {
    basis.mmult(half, known[k]);
    half.mTmult(whole, basis);
    missed[k].add(-1., whole);
  }
  double sum = 0;
  for (unsigned int a = 0; a < n + 3; ++a)
    for (unsigned int b = 0; b < n + 3; ++b)
    {
      Tensor<2, 2> strain;
      strain[0][0] = missed[0](a, b);
      strain[1][1] = missed[1](a, b);
      strain[0][1] = strain[1][0] = missed[2](a, b);
      const Point<2> reference = at(finer, a, b);
      sum += finer.weight(a) * finer.weight(b) * box.volume() *
             std::abs(determinant(map.jacobian(reference))) *
             scene.circumference(map.point(reference)) *
             law.energy_product(strain, missed[3](a, b));
    }
  return sum;
}
} // namespace

double initial_stress_error(const Scene<2> &scene, const Triangulation<2>::cell_iterator &cell,
                            const unsigned int degree, const LoadRules<2> &rules,
                            const ShapeTables<2> &tables)
{
  double sum = 0;
  if (scene.initial_strains[cell->material_id()])
    for (const RulePart<2> &part : rules.initial_strain(cell, degree).parts)
      sum += initial_stress_error(scene, cell, part, tables);
  return sum;
}

double initial_stress_error(const Scene<2> &scene, const DisplacementSpace<2> &space,
                            const LoadRules<2> &rules, const ShapeTables<2> &tables)
{
  double sum = 0;
  if (scene.has_initial_strain())
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      sum += initial_stress_error(scene, cell, space.degrees()[cell->active_cell_index()], rules,
                                  tables);
  return std::sqrt(sum);
}

Vector<double> initial_strain_loads(const Scene<2> &scene, const DisplacementSpace<2> &space,
                                    const ShapeTables<2> &tables, const LoadRules<2> &rules,
                                    const Volume volume)
{
  std::vector<std::vector<double>> of_cells(space.degrees().size());
  const auto add = [&](const unsigned int index, const StrainOfCell &cell)
  {
    const LocalNumbering &numbering = tables.numbering(cell.degree);
    std::vector<double> &load = of_cells[index];
    load.resize(numbering.shape.size());
    for (unsigned int q = 0; q < cell.weights.size(); ++q)
    {
      // C eps_0 : grad v = (C eps_0 J^-T) : reference gradient of v
      const Tensor<2, 2> pulled = cell.weights[q] * cell.stresses[q] *
                                  transpose(invert(cell.map.jacobian(cell.table.points[q])));
      const double hoop = cell.weights[q] * cell.hoops[q].stress * cell.hoops[q].curvature;
      for (unsigned int i = 0; i < load.size(); ++i)
      {
        for (unsigned int r = 0; r < 2; ++r)
          load[i] += pulled[numbering.component[i]][r] *
                     cell.table.derivatives(q * cell.table.rows_per_point + r, numbering.shape[i]);
        if (hoop != 0 && numbering.component[i] == 0)
          load[i] += hoop * cell.table.values(q, numbering.shape[i]);
      }
    }
  };
  for_each_strain(scene, space, tables, rules, volume, add);
  Vector<double> load(space.n_dofs());
  for (unsigned int index = 0; index < of_cells.size(); ++index)
    for (unsigned int i = 0; i < of_cells[index].size(); ++i)
      load[space.cell_dofs(index)[i]] += of_cells[index][i];
  return load;
}

double initial_energy(const Scene<2> &scene, const DisplacementSpace<2> &space,
                      const ShapeTables<2> &tables, const Vector<double> &u)
{
  std::vector<double> of_cells(space.degrees().size());
  const auto measure = [&](const unsigned int index, const StrainOfCell &cell)
  {
    const LocalNumbering &numbering = tables.numbering(cell.degree);
    const ShapeTable<2> &table = cell.table;
    const auto dofs = space.cell_dofs(index);
    std::vector<double> local(dofs.size());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      local[numbering.component[i] * dofs.size() / 2 + numbering.shape[i]] = u[dofs[i]];
    const std::vector<double> derivatives = evaluate(table.derivatives, local),
                              values = evaluate(table.values, local);
    for (unsigned int q = 0; q < cell.weights.size(); ++q)
    {
      const Tensor<2, 2> gradient =
          physical_gradient<2>(derivatives, q * table.rows_per_point, table.derivatives.m(),
                               invert(cell.map.jacobian(table.points[q])));
      const Hoop &hoop = cell.hoops[q];
      of_cells[index] +=
          cell.weights[q] *
          (scalar_product(cell.stresses[q], 0.5 * cell.strains[q] - gradient) +
           hoop.stress * (0.5 * hoop.strain - values[q] * hoop.curvature) + cell.across[q]);
    }
  };
  for_each_strain(scene, space, tables, space.rules(), Volume::full, measure);
  return sum(of_cells);
}
} // namespace hpvi
