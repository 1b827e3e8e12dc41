// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/space/box_bound.h>
#include <hpvi/space/box_bound_stages.h>
#include <hpvi/space/upper_energy.h>

#include <deal.II/fe/fe_tools.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double tolerable = 1e-9;   ///< imbalance of a patch, relative
constexpr double smooth_load = 1e-6; ///< of the square of a load: by what two rules may differ
} // namespace

BoxBound::BoxBound(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix, const DistributedVector &u,
                   const std::vector<ContactVector<3>> &lambda, const double work)
    : space(space), matrix(matrix), u(u), lambda(lambda), work_of_rule(work),
      p(space.tables.only().degree), of(p),
      numbering(FETools::hierarchic_to_lexicographic_numbering<3>(p)), stiffness(space),
      cells(space.dof_handler.get_triangulation().n_active_cells()), moved(cells.size()),
      gaps(cells.size())
{
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    cells[cell->active_cell_index()] = cell;
}

/** Over the length of the cell: strains of a box of volume one. */
Vector<double> BoxBound::modes(const Cell &cell, const DistributedVector &of_vector) const
{
  const CellField<3> field = space.field(cell, of_vector);
  const Tensor<1, 3> size = PrimalSpace<3>::extent(cell);
  const double length = std::cbrt(size[0] * size[1] * size[2]);
  const unsigned int n = field.size();
  Vector<double> result(3 * n);
  for (unsigned int c = 0; c < 3; ++c)
  {
    BoxModes values(n);
    for (unsigned int i = 0; i < n; ++i)
      values[numbering[i]] = field[i][c] / length;
    const BoxModes coefficients = along_axes(of.modes, values, 3);
    std::copy(coefficients.begin(), coefficients.end(), result.begin() + c * n);
  }
  return result;
}

/** Coefficients of the projection onto polynomials of degree p; @p missed: the square of what is left. */
BoxModes BoxBound::projected(const Load<3> &load, const unsigned int component,
                             const CellMap<3> &map, const int face, double &missed_square)
{
  const unsigned int n_axes = face < 0 ? 3 : 2;
  std::vector<double> values;
  std::array<double, 2> squares{}; // by two rules
  for (const bool is_finer : {true, false})
    at_points(is_finer ? of.finer : of.fine, n_axes,
              [&](unsigned int, const std::array<double, 3> &x, const double weight)
              {
                const Point<3> reference =
                    face < 0 ? Point<3>(x[0], x[1], x[2]) : on_cell_face(face, x);
                const double value = load[component]->value(map.point(reference));
                squares[is_finer] += weight * value * value;
                if (!is_finer)
                  values.push_back(value);
              });
  if (std::abs(squares[1] - squares[0]) > smooth_load * squares[1])
    flaw = "a load is not smooth inside the cell at " + to_string(map.point(Point<3>(.5, .5, .5)));
  const BoxModes result = along_axes(of.tables.projection(p + 1, of.fine.size()), values, n_axes);
  missed_square += missed_by(result, values, n_axes);
  return result;
}

/** The mean square of what modes lack of values at the fine points. */
double BoxBound::missed_by(const BoxModes &modes, const std::vector<double> &values,
                           const unsigned int n_axes) const
{
  const BoxModes kept = along_axes(of.modes_to_fine, modes, n_axes);
  double square = 0;
  at_points(of.fine, n_axes,
            [&](const unsigned int q, const auto &, const double weight)
            { square += weight * std::pow(values[q] - kept[q], 2); });
  return square;
}

void BoxBound::take_loads()
{
  const unsigned int n = (p + 1) * (p + 1) * (p + 1);
  forces.resize(cells.size());
  missed.resize(cells.size());
  for (unsigned int k = 0; k < cells.size(); ++k)
  {
    const Cell &cell = cells[k];
    const CellMap<3> map = map_of<3>(cell);
    const Tensor<1, 3> size = PrimalSpace<3>::extent(cell);
    const double volume = size[0] * size[1] * size[2];
    if (space.scene.has_body_force())
    {
      const Load<3> &load = space.scene.body_force_in(cell);
      forces[k].resize(3 * n);
      double square = 0;
      for (unsigned int c = 0; c < 3; ++c)
        if (load[c])
        {
          const BoxModes of_component = projected(load, c, map, -1, square);
          std::copy(of_component.begin(), of_component.end(), forces[k].begin() + c * n);
        }
      missed[k][6] = std::sqrt(volume * square);
    }
    for (unsigned int face = 0; face < 6; ++face)
    {
      if (!cell->at_boundary(face))
        continue;
      const BoundaryCondition<3> &condition = space.condition(cell, face);
      GivenTractions &side = sides[{k, face}];
      double square = 0;
      for (unsigned int c = 0; c < 3; ++c)
      {
        side.is_given[c] =
            !condition.displacement[c] && !(c == face / 2 && condition.holds_normal());
        if (side.is_given[c] && condition.traction[c])
          side.modes[c] = projected(condition.traction, c, map, face, square);
      }
      missed[k][face] = std::sqrt(volume / size[face / 2] * square);
    }
  }
}

/** The work of loads and given tractions on the nodal displacements of a cell. */
Vector<double> BoxBound::local_load(const unsigned int k) const
{
  const unsigned int n = p + 1, n_shapes = n * n * n;
  const Tensor<1, 3> size = PrimalSpace<3>::extent(cells[k]);
  const double volume = size[0] * size[1] * size[2];
  Vector<double> result(3 * n_shapes);
  for (unsigned int c = 0; c < 3; ++c)
  {
    BoxModes work(n_shapes);
    for (unsigned int i = 0; i < n_shapes && !forces[k].empty(); ++i)
      work[i] = volume / 8 * forces[k][c * n_shapes + i];
    for (unsigned int face = 0; face < 6; ++face)
    {
      const BoxModes *const given =
          cells[k]->at_boundary(face) ? &sides.at({k, face}).modes[c] : nullptr;
      const auto axes = tangents<3>(face);
      for (unsigned int i = 0; i < n_shapes && given && !given->empty(); ++i)
      {
        const std::array<unsigned int, 3> mode{{i % n, i / n % n, i / (n * n)}};
        work[i] += volume / size[face / 2] / 4 * legendre::at_end(mode[face / 2], face % 2 == 1) *
                   (*given)[mode[axes[0]] + n * mode[axes[1]]];
      }
    }
    const BoxModes of_nodes = along_axes(of.modes_transposed, work, 3);
    for (unsigned int i = 0; i < n_shapes; ++i)
      result[space.tables.only().numbers[i][c]] = of_nodes[numbering[i]];
  }
  return result;
}

/** u_N + x, in balance with the loads and tractions that are given. */
DistributedVector BoxBound::balanced()
{
  DistributedVector b = space.owned_vector(), x = b;
  Vector<double> F(space.tables.only().fe.dofs_per_cell), displacement(F), internal(F);
  std::vector<types::global_dof_index> dofs(F.size());
  for (unsigned int k = 0; k < cells.size(); ++k)
  {
    Vector<double> local = local_load(k);
    cells[k]->get_dof_indices(dofs);
    cells[k]->get_dof_values(u, displacement);
    stiffness.multiply(cells[k], internal, displacement);
    work += local * displacement;
    local -= internal;
    if (any(space.moment_components(cells[k])))
      basis_of_moments(space, cells[k]).Tvmult(F, local);
    else
      F = local;
    space.constraints.distribute_local_to_global(F, dofs, b);
  }
  b.compress(VectorOperation::add);
  matrix.linearise(std::vector<ContactDofState<3>>(space.contact.size()), /*anew=*/true);
  matrix.solve(x, b, 1e-9 * b.l2_norm());
  x += space.in_contact_dofs(u);
  return space.displacement(x);
}

ErrorBound BoxBound::compute()
{
  take_loads();
  BoxEquilibration stresses(space, forces, sides);
  take_contact(stresses);
  const DistributedVector near = balanced();
  correct();
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    face_gaps.push_back(gap(space.faces[k], contact[k]));
    gaps[space.faces[k].cell->active_cell_index()] += face_gaps.back();
  }
  std::vector<Vector<double>> of_near, of_u;
  Vector<double> local(space.tables.only().fe.dofs_per_cell), internal(local), of_w(local);
  for (unsigned int k = 0; k < cells.size(); ++k)
  {
    of_near.push_back(modes(cells[k], near));
    of_u.push_back(modes(cells[k], u));
    cells[k]->get_dof_values(w, of_w);
    if (of_w.linfty_norm() == 0)
      continue;
    stiffness.multiply(cells[k], internal, of_w);
    cells[k]->get_dof_values(u, local);
    moved[k] = std::max(0., internal * of_w);
    change += moved[k] / 2 - internal * local + local_load(k) * of_w;
  }
  ErrorBound result;
  result.imbalance = stresses.balance(of_near);
  if (!(result.imbalance <= tolerable))
    flaw = "patches of cells are out of balance by up to " + text(result.imbalance, 2) +
           " of their stresses";
  double A = 0, b = 0, gap = 0;
  for (unsigned int k = 0; k < cells.size(); ++k)
  {
    const BoxStress &element = stresses.element(k);
    const BoxStress::Distance distance = stresses.distance(k, of_u[k]);
    double O = distance.antisymmetry + missed[k][6] * stresses.length(k) * element.poincare();
    for (unsigned int face = 0; face < 6; ++face)
      O += missed[k][face] * std::sqrt(stresses.length(k)) * element.trace(face);
    const double square = std::pow(std::sqrt(distance.square) + O, 2);
    A += square;
    b += moved[k];
    gap += gaps[k];
    result.stress += distance.square;
    result.oscillation += O * O;
    result.squares.push_back(square + moved[k] + 2 * gaps[k]);
  }
  A = std::sqrt(A);
  b = std::sqrt(b);
  result.stress = std::sqrt(result.stress);
  result.oscillation = std::sqrt(result.oscillation);
  result.slip = std::sqrt(2 * gap + b * b);
  result.moved = result.moved_by_energy = moved;
  result.lifted.resize(cells.size());
  result.total = result.estimate = result.radius = least_root(A, gap, b);
  result.energy = std::pow(A + b, 2) / 2 + gap;
  of_rules += std::abs(work - work_of_rule);
  result.energy_above = (b == 0 ? 0. : change) + of_rules;
  result.energy_below = result.energy - (b == 0 ? 0. : change) + of_rules;
  result.flaw = flaw;
  if (space.scene.has_coulomb_friction())
    set_coulomb(result, A, b);
  if (space.past && space.scene.has_friction())
    count_from_past(result);
  return result;
}

std::string no_box_bound(const PrimalSpace<3> &space, const DistributedVector &u)
{
  if (n_processes(space.communicator()) > 1)
    return "bounds in space are computed on one process";
  if (missed_displacement(space, u) > round_off_of_supports * u.linfty_norm())
    return "prescribed displacements are no polynomials of the degree of the cells";
  return {};
}

ErrorBound box_bound(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix,
                     const DistributedVector &u, const std::vector<ContactVector<3>> &lambda,
                     const double work)
try
{
  return BoxBound(space, matrix, u, lambda, work).compute();
}
catch (const NumericalFailure &failure)
{
  return no_solution_for_bound(failure.what());
}
} // namespace hpvi
