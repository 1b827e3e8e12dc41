// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/space/box_bound.h>
#include <hpvi/space/box_equilibration.h>
#include <hpvi/space/upper_energy.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_tools.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double same_gap = 1e-12;   ///< of a gap: what differs by less is round-off
constexpr double tolerable = 1e-9;   ///< imbalance of a patch, relative
constexpr double smooth_load = 1e-6; ///< of the square of a load: by what two rules may differ

/** Bernstein's polynomials of degree @p p at @p s in [0,1]. */
std::vector<double> bernstein(const unsigned int p, const double s)
{
  std::vector<double> result(p + 1);
  double binomial = 1;
  for (unsigned int i = 0; i <= p; binomial *= double(p - i) / (i + 1), ++i)
    result[i] = binomial * std::pow(s, i) * std::pow(1 - s, p - i);
  return result;
}

FullMatrix<double> values_at(const QGauss<1> &rule, const unsigned int p)
{
  FullMatrix<double> result(rule.size(), p + 1);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const std::vector<double> values = bernstein(p, rule.point(q)[0]);
    for (unsigned int j = 0; j <= p; ++j)
      result(q, j) = values[j];
  }
  return result;
}

/** Values of modes. */
FullMatrix<double> modes_at(const QGauss<1> &rule, const unsigned int p)
{
  FullMatrix<double> result(rule.size(), p + 1);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const std::vector<double> L = legendre::values(p + 1, 2 * rule.point(q)[0] - 1);
    for (unsigned int j = 0; j <= p; ++j)
      result(q, j) = L[j];
  }
  return result;
}

/** Matrices between what represents a polynomial of degree p in one variable. */
struct Representations
{
  explicit Representations(const unsigned int p)
      : gauss(p + 1), fine(p + 6), finer(2 * p + 12), nodes(p + 1), to_gauss(modes_at(gauss, p)),
        from_gauss(p + 1, p + 1), gauss_values(values_at(gauss, p)), nodal(p + 1, p + 1),
        to_nodes(p + 1, p + 1), modes(tables.from_nodes(p)), modes_transposed(p + 1, p + 1),
        to_fine(values_at(fine, p)), modes_to_fine(modes_at(fine, p)), to_finer(values_at(finer, p))
  {
    const FE_Q<1> element(p);
    const std::vector<unsigned int> numbers = FETools::hierarchic_to_lexicographic_numbering<1>(p);
    FullMatrix<double> at_nodes(p + 1, p + 1);
    for (unsigned int i = 0; i <= p; ++i)
    {
      nodes[numbers[i]] = element.get_unit_support_points()[i][0];
      const std::vector<double> of_node = bernstein(p, nodes[numbers[i]]);
      for (unsigned int j = 0; j <= p; ++j)
        at_nodes(numbers[i], j) = of_node[j];
    }
    to_nodes = at_nodes;
    nodal.invert(at_nodes);
    from_gauss.invert(gauss_values);
    modes_transposed.copy_transposed(modes);
  }

  LegendreTables tables;
  const QGauss<1> gauss, fine, finer;
  std::vector<double> nodes;             ///< of Gauss and Lobatto
  const FullMatrix<double> to_gauss;     ///< values of modes at gauss
  FullMatrix<double> from_gauss;         ///< Bernstein coefficients of values at gauss
  const FullMatrix<double> gauss_values; ///< the other way
  FullMatrix<double> nodal;              ///< Bernstein coefficients of values at nodes
  FullMatrix<double> to_nodes;           ///< the other way
  const FullMatrix<double> &modes;       ///< of values at nodes
  FullMatrix<double> modes_transposed;
  const FullMatrix<double> to_fine;       ///< values at #fine of Bernstein coefficients
  const FullMatrix<double> modes_to_fine; ///< of modes
  const FullMatrix<double> to_finer;      ///< values at #finer of Bernstein coefficients
};

/** Values of f at tensor products of @p rule on a face or, @p face invalid, in a cell. */
template <class F>
void at_points(const QGauss<1> &rule, const unsigned int n_axes, const F &f)
{
  const unsigned int n = rule.size(), n_points = std::pow(n, n_axes);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    std::array<double, 3> x{};
    double weight = 1;
    for (unsigned int d = 0, rest = q; d < n_axes; ++d, rest /= n)
    {
      x[d] = rule.point(rest % n)[0];
      weight *= rule.weight(rest % n);
    }
    f(q, x, weight);
  }
}

Point<3> on_cell_face(const unsigned int face, const std::array<double, 3> &x)
{
  const auto axes = tangents<3>(face);
  Point<3> result;
  result[axes[0]] = x[0];
  result[axes[1]] = x[1];
  result[face / 2] = face % 2;
  return result;
}

/** Values of a polynomial on a face, by Bernstein coefficients; none: of zero. */
BoxModes at(const FullMatrix<double> &values, const BoxModes &coefficients)
{
  return coefficients.empty() ? BoxModes(values.m() * values.m())
                              : along_axes(values, coefficients, 2);
}

/** The face functions of friction and pressure on one contact face. */
struct ContactTractions
{
  bool has_friction = false, has_pressure = false;
  std::array<BoxModes, 2>
      lambda;        ///< Bernstein coefficients of lam* along both tangents of tangents()
  BoxModes pressure; ///< of pi
};

/** The largest t <= 1 with |mean + t (c - mean)| <= 1. */
double within_disc(const Tensor<1, 2> &mean, const Tensor<1, 2> &c)
{
  const Tensor<1, 2> d = c - mean;
  const double a = d * d, b = mean * d, rest = std::max(0., 1 - mean * mean);
  if (a + 2 * b <= rest)
    return 1.;
  return a > 0 ? std::max(0., (std::sqrt(b * b + a * rest) - b) / a) : 1.;
}

class BoxBound
{
public:
  BoxBound(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix, const DistributedVector &u,
           const std::vector<ContactVector<3>> &lambda, const double work)
      : space(space), matrix(matrix), u(u), lambda(lambda), work_of_rule(work),
        p(space.tables.degree), of(p),
        numbering(FETools::hierarchic_to_lexicographic_numbering<3>(p)), stiffness(space),
        cells(space.dof_handler.get_triangulation().n_active_cells()), moved(cells.size()),
        gaps(cells.size())
  {
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      cells[cell->active_cell_index()] = cell;
  }

  ErrorBound compute();

private:
  using Cell = PrimalSpace<3>::Cell;

  Vector<double> modes(const Cell &cell, const DistributedVector &of) const;
  void take_loads();
  BoxModes projected(const Load<3> &load, unsigned int component, const CellMap<3> &map, int face,
                     double &missed);
  double missed_by(const BoxModes &modes, const std::vector<double> &values,
                   unsigned int n_axes) const;
  void take_contact(const BoxEquilibration &elements);
  ContactTractions tractions(const ContactDofFace<3> &face, const BoxStress &element) const;
  void give(const ContactDofFace<3> &face, const ContactTractions &contact);
  DistributedVector balanced();
  void correct();
  Vector<double> local_load(unsigned int cell) const;
  std::vector<std::vector<types::global_dof_index>> face_dofs(const ContactDofFace<3> &face) const;
  std::vector<bool> held() const;
  BoxModes violation(const ContactDofFace<3> &face, unsigned int component) const;
  BoxModes gaps_at_nodes(const ContactDofFace<3> &face) const;
  void set_above();
  void correct_along(const ContactDofFace<3> &face, unsigned int c,
                     const std::vector<bool> &is_held);
  double constrained_value(types::global_dof_index dof) const;
  void keep_edges(const std::vector<types::global_dof_index> &dofs, double sign,
                  BoxModes &coefficients) const;
  void set_gap(const ContactDofFace<3> &face, const ContactTractions &contact);

  const PrimalSpace<3> &space;
  NewtonMatrix<3> &matrix;
  const DistributedVector &u;
  const std::vector<ContactVector<3>> &lambda;
  const double work_of_rule; ///< L(u_N) by the points of the discrete problem
  const unsigned int p;
  const Representations of;
  const std::vector<unsigned int> numbering;
  const BoxStiffness<3> stiffness;
  std::vector<Cell> cells;
  std::vector<BoxModes> forces;
  BoxEquilibration::Sides sides;
  std::vector<ContactTractions> contact;     ///< by face of the space
  std::vector<std::array<double, 7>> missed; ///< |F - Pi F|, |G - Pi G| by cell
  std::vector<double> moved, gaps;           ///< |w|_K^2 and gap(u_N - w) by cell
  DistributedVector w;
  double change = 0;   ///< J(u_N - w) - J(u_N)
  double work = 0;     ///< L(u_N)
  double of_rules = 0; ///< by how much rules differ in these
  double above = 0;    ///< what polynomials through nodes of gaps are above them at most [length]
  std::string flaw;
};

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

// @sect3{What contact exerts}
//
// The stress of u_N along a face with the mean of the multiplier, as far as the law allows it: a polynomial whose Bernstein coefficients
// are in a convex set is in it everywhere.
ContactTractions BoxBound::tractions(const ContactDofFace<3> &face, const BoxStress &element) const
{
  ContactTractions result;
  const unsigned int axis = face.face / 2, m = p + 1;
  const auto axes = tangents<3>(face.face);
  const Vector<double> coefficients = modes(face.cell, u);
  const CellMap<3> map = map_of<3>(face.cell);
  const BoundaryCondition<3> &condition = space.condition(face.cell, face.face);
  const double sign = face.face % 2 ? 1. : -1.;
  const auto at_gauss = [&](const unsigned int component)
  {
    return along_axes(of.to_gauss,
                      on_face(element.stress(coefficients, component, axis), m, face.face), 2);
  };
  result.has_friction = face.has_friction();
  result.has_pressure = face.has_pressure();
  double area = 0;
  for (unsigned int k = 0; k < space.tables.n_contact_dofs(); ++k)
    area += space.contact[face.first() + k].area;
  if (face.has_pressure())
  {
    double mean = 0, of_stress = 0;
    for (unsigned int k = 0; k < space.tables.n_contact_dofs(); ++k)
      mean +=
          space.contact[face.pressure + k].area / area * std::max(0., lambda[face.pressure + k][0]);
    BoxModes values = at_gauss(axis);
    at_points(of.gauss, 2,
              [&](const unsigned int q, const auto &, const double weight)
              { of_stress -= weight * values[q]; });
    for (double &value : values)
      value = mean - value - of_stress;
    result.pressure = along_axes(of.from_gauss, values, 2);
    const double least = *std::min_element(result.pressure.begin(), result.pressure.end()),
                 t = least >= 0 ? 1. : mean / (mean - least);
    for (double &coefficient : result.pressure)
      coefficient = std::max(0., mean + t * (coefficient - mean));
  }
  const BoxModes pressure = at(of.gauss_values, result.pressure);
  if (face.has_friction())
  {
    Tensor<1, 2> mean, of_stress;
    for (unsigned int k = 0; k < space.tables.n_contact_dofs(); ++k)
      for (unsigned int s = 0; s < 2; ++s)
        for (unsigned int t = 0; t < 2; ++t)
          mean[t] += space.contact[face.friction + k].area / area * lambda[face.friction + k][s] *
                     face.direction(face.tangential(s))[axes[t]];
    if (mean.norm() > 1)
      mean /= mean.norm();
    std::array<BoxModes, 2> values{{at_gauss(axes[0]), at_gauss(axes[1])}};
    at_points(of.gauss, 2,
              [&](const unsigned int q, const std::array<double, 3> &x, const double weight)
              {
                const double g =
                    condition.friction.limit(map.point(on_cell_face(face.face, x)), pressure[q]);
                Tensor<1, 2> value = mean;
                if (g > 0)
                  value = -sign / g * Tensor<1, 2>({values[0][q], values[1][q]});
                if (value.norm() > 1)
                  value /= value.norm();
                for (unsigned int t = 0; t < 2; ++t)
                  values[t][q] = value[t];
                of_stress += weight * value;
              });
    for (unsigned int t = 0; t < 2; ++t)
    {
      for (double &value : values[t])
        value += mean[t] - of_stress[t];
      result.lambda[t] = along_axes(of.from_gauss, values[t], 2);
    }
    double t = 1;
    for (unsigned int j = 0; j < result.lambda[0].size(); ++j)
      t = std::min(t, within_disc(mean, Tensor<1, 2>({result.lambda[0][j], result.lambda[1][j]})));
    for (unsigned int s = 0; s < 2; ++s)
      for (double &coefficient : result.lambda[s])
        coefficient = mean[s] + t * (coefficient - mean[s]);
  }
  return result;
}

/** Puts projections of -g lam* and -pi n among the given tractions. */
void BoxBound::give(const ContactDofFace<3> &face, const ContactTractions &of_face)
{
  const unsigned int cell = face.cell->active_cell_index(), axis = face.face / 2;
  const auto axes = tangents<3>(face.face);
  const CellMap<3> map = map_of<3>(face.cell);
  GivenTractions &side = sides.at({cell, face.face});
  const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
  const double sign = face.face % 2 ? 1. : -1., area = size[axes[0]] * size[axes[1]];
  const FullMatrix<double> &projection = of.tables.projection(p + 1, of.fine.size());
  const auto add = [&](const unsigned int component, const BoxModes &values)
  {
    const BoxModes of_component = along_axes(projection, values, 2);
    missed[cell][face.face] += std::sqrt(area * missed_by(of_component, values, 2));
    BoxModes &sum = side.modes[component];
    sum.resize(of_component.size());
    for (unsigned int i = 0; i < sum.size(); ++i)
      sum[i] += of_component[i];
  };
  const BoxModes pressure = at(of.to_fine, of_face.pressure);
  if (of_face.has_pressure)
  {
    BoxModes values = pressure;
    for (double &value : values)
      value *= -sign;
    add(axis, values);
  }
  if (of_face.has_friction)
    for (unsigned int s = 0; s < 2; ++s)
    {
      BoxModes values = along_axes(of.to_fine, of_face.lambda[s], 2);
      at_points(of.fine, 2,
                [&](const unsigned int q, const std::array<double, 3> &x, double)
                {
                  values[q] *=
                      -space.condition(face.cell, face.face)
                           .friction.limit(map.point(on_cell_face(face.face, x)), pressure[q]);
                });
      add(axes[s], values);
    }
}

void BoxBound::take_contact(const BoxEquilibration &elements)
{
  for (const ContactDofFace<3> &face : space.faces)
  {
    contact.push_back(tractions(face, elements.element(face.cell->active_cell_index())));
    give(face, contact.back());
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
      result[space.tables.numbers[i][c]] = of_nodes[numbering[i]];
  }
  return result;
}

/** u_N + x, in balance with the loads and tractions that are given. */
DistributedVector BoxBound::balanced()
{
  DistributedVector b = space.owned_vector(), x = b;
  Vector<double> F(space.tables.fe.dofs_per_cell), displacement(F), internal(F);
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

// @sect3{An admissible displacement}
//
// U = u_N - w with U_n <= u_0: a Bernstein coefficient of w_n is that of u_n - u_0 where all of its faces press, else its positive part,
// which is enough everywhere. Halves of an edge take over what its whole has: cutting keeps coefficients positive.
std::vector<std::vector<types::global_dof_index>>
BoxBound::face_dofs(const ContactDofFace<3> &face) const
{
  std::vector<types::global_dof_index> dofs(space.tables.fe.dofs_per_cell);
  face.cell->get_dof_indices(dofs);
  std::vector<std::vector<types::global_dof_index>> result(
      3, std::vector<types::global_dof_index>((p + 1) * (p + 1)));
  const auto axes = tangents<3>(face.face);
  for (unsigned int i = 0; i < space.tables.n_shapes; ++i)
  {
    const unsigned int number = numbering[i];
    const std::array<unsigned int, 3> place{
        {number % (p + 1), number / (p + 1) % (p + 1), number / ((p + 1) * (p + 1))}};
    if (place[face.face / 2] == (face.face % 2) * p)
      for (unsigned int c = 0; c < 3; ++c)
        result[c][place[axes[0]] + (p + 1) * place[axes[1]]] = dofs[space.tables.numbers[i][c]];
  }
  return result;
}

/** By unknown: do all contact faces beside it press, or stick? */
std::vector<bool> BoxBound::held() const
{
  std::vector<bool> result(space.dof_handler.n_dofs(), true);
  for (const ContactDofFace<3> &face : space.faces)
  {
    bool presses = true, sticks = true;
    for (unsigned int k = 0; k < space.tables.n_contact_dofs(); ++k)
    {
      presses &= !face.has_pressure() || lambda[face.pressure + k][0] > 0;
      sticks &= face.has_friction() && space.contact[face.friction + k].weight > 0 &&
                lambda[face.friction + k].norm() < 1 - 1e-9;
    }
    const auto dofs = face_dofs(face);
    for (unsigned int c = 0; c < 3; ++c)
      for (const auto dof : dofs[c])
        if (!(c == face.face / 2 ? presses : sticks))
          result[dof] = false;
  }
  return result;
}

/** Bernstein coefficients of u_n - u_0 from above, of the tangential component @p component of u. */
BoxModes BoxBound::violation(const ContactDofFace<3> &face, const unsigned int component) const
{
  const double sign = face.face % 2 ? 1. : -1.;
  const auto dofs = face_dofs(face);
  BoxModes values, result;
  for (const auto dof : dofs[component])
    values.push_back(u(dof));
  if (component != face.face / 2)
    return along_axes(of.nodal, values, 2);
  const BoxModes gaps = gaps_at_nodes(face);
  for (unsigned int i = 0; i < values.size(); ++i)
    values[i] = sign * values[i] - gaps[i];
  result = along_axes(of.nodal, values, 2);
  for (double &coefficient : result)
    coefficient += above;
  return result;
}

BoxModes BoxBound::gaps_at_nodes(const ContactDofFace<3> &face) const
{
  const CellMap<3> map = map_of<3>(face.cell);
  const Expression<3> &gap = space.condition(face.cell, face.face).gap;
  BoxModes result((p + 1) * (p + 1));
  for (unsigned int i = 0; gap && i < result.size(); ++i)
    result[i] = gap->value(
        map.point(on_cell_face(face.face, {{of.nodes[i % (p + 1)], of.nodes[i / (p + 1)], 0.}})));
  return result;
}

/** Of all faces: neighbours have the same values at nodes that they share. */
void BoxBound::set_above()
{
  double largest = 0;
  for (const ContactDofFace<3> &face : space.faces)
  {
    const Expression<3> &gap = space.condition(face.cell, face.face).gap;
    if (!gap)
      continue;
    const CellMap<3> map = map_of<3>(face.cell);
    const BoxModes interpolated =
        along_axes(of.to_fine, along_axes(of.nodal, gaps_at_nodes(face), 2), 2);
    at_points(of.fine, 2,
              [&](const unsigned int q, const std::array<double, 3> &x, double)
              {
                const double value = gap->value(map.point(on_cell_face(face.face, x)));
                above = std::max(above, interpolated[q] - value);
                largest = std::max(largest, std::abs(value));
              });
  }
  if (above <= same_gap * largest)
    above = 0;
}

void BoxBound::correct()
{
  w = space.ghosted_vector();
  const std::vector<bool> is_held = held();
  std::vector<unsigned int> order(space.faces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [this](const unsigned int a, const unsigned int b)
                   { return space.faces[a].cell->level() < space.faces[b].cell->level(); });
  set_above();
  for (const bool is_normal : {false, true}) // what must not penetrate has the last word
    for (const unsigned int number : order)
      for (unsigned int c = 0; c < 3; ++c)
        if (const ContactDofFace<3> &face = space.faces[number];
            (c == face.face / 2) == is_normal &&
            (is_normal ? face.has_pressure() : face.has_friction()))
          correct_along(face, c, is_held);
  for (const auto dof : space.owned)
    if (space.constraints.is_constrained(dof))
      w(dof) = constrained_value(dof);
  for (const ContactDofFace<3> &face : space.faces)
    if (face.has_pressure())
    {
      const unsigned int c = face.face / 2;
      const double sign = face.face % 2 ? 1. : -1.;
      BoxModes values;
      const std::vector<types::global_dof_index> dofs = face_dofs(face)[c];
      for (const auto dof : dofs)
        values.push_back(sign * w(dof));
      const BoxModes of_w = along_axes(of.nodal, values, 2), needed = violation(face, c);
      for (unsigned int i = 0; i < of_w.size(); ++i)
        if (needed[i] - of_w[i] > same_gap * u.linfty_norm())
          flaw = "a support holds the body where its gap closes";
    }
}

/** Component @p c of w on one face. */
void BoxBound::correct_along(const ContactDofFace<3> &face, const unsigned int c,
                             const std::vector<bool> &is_held)
{
  const auto dofs = face_dofs(face)[c];
  const bool is_normal = c == face.face / 2;
  const double sign = is_normal && face.face % 2 == 0 ? -1. : 1.;
  BoxModes coefficients = violation(face, c);
  for (unsigned int i = 0; i < coefficients.size(); ++i)
    if (!is_held[dofs[i]])
      coefficients[i] = is_normal ? std::max(0., coefficients[i]) : 0.;
  keep_edges(dofs, sign, coefficients);
  const BoxModes values = along_axes(of.to_nodes, coefficients, 2);
  for (unsigned int i = 0; i < values.size(); ++i)
    if (!space.constraints.is_constrained(dofs[i]))
      w(dofs[i]) = sign * values[i];
}

double BoxBound::constrained_value(const types::global_dof_index dof) const
{
  double result = 0;
  if (const auto *const entries = space.constraints.get_constraint_entries(dof))
    for (const auto &[other, weight] : *entries)
      result += weight * w(other);
  return result;
}

/** Along edges of which inner nodes are constrained. */
void BoxBound::keep_edges(const std::vector<types::global_dof_index> &dofs, const double sign,
                          BoxModes &coefficients) const
{
  const unsigned int n = p + 1;
  for (const unsigned int side : {0u, p})
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      const auto place = [&](const unsigned int i)
      { return axis == 0 ? i + n * side : side + n * i; };
      if (!space.constraints.is_constrained(dofs[place(1)]))
        continue;
      BoxModes values;
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto dof = dofs[place(i)];
        values.push_back(sign *
                         (space.constraints.is_constrained(dof) ? constrained_value(dof) : w(dof)));
      }
      values = along_axes(of.nodal, values, 1);
      for (unsigned int i = 0; i < n; ++i)
        coefficients[place(i)] = values[i];
    }
}

/** gap(u_N - w) on one face, and what w changes of the work of friction and of contact. */
void BoxBound::set_gap(const ContactDofFace<3> &face, const ContactTractions &of_face)
{
  const unsigned int axis = face.face / 2;
  const auto axes = tangents<3>(face.face);
  const auto dofs = face_dofs(face);
  const double sign = face.face % 2 ? 1. : -1.;
  const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
  const double area = size[axes[0]] * size[axes[1]];
  const CellMap<3> map = map_of<3>(face.cell);
  const BoundaryCondition<3> &condition = space.condition(face.cell, face.face);
  std::array<BoxModes, 3> of_u, of_w;
  for (unsigned int c = 0; c < 3; ++c)
    for (const auto dof : dofs[c])
    {
      of_u[c].push_back(u(dof));
      of_w[c].push_back(w(dof));
    }
  std::array<double, 2> by_rule{}, changes{};
  for (const bool is_finer : {false, true})
  {
    const QGauss<1> &rule = is_finer ? of.finer : of.fine;
    const FullMatrix<double> &values = is_finer ? of.to_finer : of.to_fine;
    std::array<BoxModes, 3> u_q, w_q;
    for (unsigned int c = 0; c < 3; ++c)
    {
      u_q[c] = at(values, along_axes(of.nodal, of_u[c], 2));
      w_q[c] = at(values, along_axes(of.nodal, of_w[c], 2));
    }
    const std::array<BoxModes, 3> contact_q{{at(values, of_face.lambda[0]),
                                             at(values, of_face.lambda[1]),
                                             at(values, of_face.pressure)}};
    at_points(rule, 2,
              [&](const unsigned int q, const std::array<double, 3> &reference, const double weight)
              {
                const Point<3> x = map.point(on_cell_face(face.face, reference));
                double gap = 0, of_contact = 0, friction = 0, of_u_contact = 0;
                if (of_face.has_friction)
                {
                  const double g = condition.friction.limit(x, contact_q[2][q]);
                  Tensor<1, 2> slip, before;
                  for (unsigned int s = 0; s < 2; ++s)
                  {
                    before[s] = u_q[axes[s]][q];
                    slip[s] = before[s] - w_q[axes[s]][q];
                    gap -= g * contact_q[s][q] * slip[s];
                    of_contact += g * contact_q[s][q] * w_q[axes[s]][q];
                    of_u_contact += g * contact_q[s][q] * before[s];
                  }
                  gap += g * slip.norm();
                  friction += g * (slip.norm() - before.norm());
                }
                if (of_face.has_pressure)
                {
                  const double u_0 = condition.gap ? condition.gap->value(x) : 0.,
                               u_n = sign * u_q[axis][q], w_n = sign * w_q[axis][q];
                  gap += contact_q[2][q] * (u_0 - u_n + w_n);
                  of_contact += contact_q[2][q] * w_n;
                  of_u_contact += contact_q[2][q] * u_n;
                }
                by_rule[is_finer] += weight * area * gap;
                changes[is_finer] += weight * area * (friction + of_contact);
                if (is_finer)
                  work += weight * area * of_u_contact;
              });
  }
  gaps[face.cell->active_cell_index()] +=
      std::max(0., by_rule[1]) + std::abs(by_rule[1] - by_rule[0]);
  change += changes[1];
  of_rules += std::abs(changes[1] - changes[0]);
}

ErrorBound BoxBound::compute()
{
  take_loads();
  BoxEquilibration stresses(space, forces, sides);
  take_contact(stresses);
  const DistributedVector near = balanced();
  correct();
  for (unsigned int number = 0; number < contact.size(); ++number)
    set_gap(space.faces[number], contact[number]);
  std::vector<Vector<double>> of_near, of_u;
  Vector<double> local(space.tables.fe.dofs_per_cell), internal(local), of_w(local);
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
  {
    result.kind = BoundKind::estimate;
    result.why = "the coupling of friction and pressure is not known in space";
  }
  return result;
}
} // namespace

std::string no_box_bound(const PrimalSpace<3> &space, const DistributedVector &u)
{
  const Scene<3> &scene = space.scene;
  if (n_processes(space.communicator()) > 1)
    return "bounds in space are computed on one process";
  if (scene.geometry.has_mesh())
    return "cells of a mesh file are no boxes";
  if (scene.has_pairs())
    return "bodies in space touch each other";
  if (space.rests_on_contact)
    return "contact alone holds the body";
  if (space.past)
    return "slip is counted from the load step before";
  if (scene.has_springs())
    return "springs hold the body";
  if (scene.has_initial_strain())
    return "a material has an initial strain";
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    if (boundary.contact_direction)
      return "contact is along a direction";
    else if (boundary.contact == Contact::bilateral && boundary.gap)
      return "bilateral contact has a gap";
    else if (boundary.contact != Contact::unilateral && boundary.friction.knows_pressure())
      return "friction knows the pressure of contact that does not open";
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
