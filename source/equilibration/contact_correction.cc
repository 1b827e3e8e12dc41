// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/restricted_energy.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/equilibration/contact_correction.h>
#include <hpvi/solver/inequality_program.h>
#include <hpvi/stresses/legendre.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int none = numbers::invalid_unsigned_int;

double sum(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.);
}

/** What happens on a contact face as a whole. */
struct Slip
{
  enum Mode
  {
    everywhere,
    partly,
    nowhere
  } mode = everywhere;
  double direction = 0.; ///< 1 or -1; 0: none, or both

  bool is_directed_everywhere() const
  {
    return mode == everywhere && direction != 0.;
  }
};

/** A face without friction slips, in no direction. */
template <int dim>
Slip slip_of(const ContactFace<dim> &face, const Solution<dim> &solution)
{
  unsigned int n_forward = 0, n_backward = 0;
  for (unsigned int k = 0; k < face.n_multipliers; ++k)
  {
    const unsigned int i = face.first_multiplier + k;
    const double wall = (1. - 1e-10) * solution.contact_space.multipliers()[i].bound;
    n_forward += solution.z[i] >= wall;
    n_backward += solution.z[i] <= -wall;
  }
  Slip result;
  if (n_forward == 0 && n_backward == 0 && face.n_multipliers > 0)
    result.mode = Slip::nowhere;
  else if (n_forward < face.n_multipliers && n_backward < face.n_multipliers)
    result.mode = Slip::partly;
  if (n_forward == 0 || n_backward == 0)
    result.direction = n_forward > 0 ? 1. : n_backward > 0 ? -1. : 0.;
  return result;
}

template <int dim>
std::vector<Slip> slips_of(const std::vector<ContactFace<dim>> &faces,
                           const Solution<dim> &solution)
{
  std::vector<Slip> result;
  for (const ContactFace<dim> &face : faces)
    result.push_back(slip_of(face, solution));
  return result;
}

/**
 * The end of slip may be on the first face that sticks as well as on the last that slips, with one Gauss point
 * on each always. That the former slips in part, with the direction of the latter, excludes neither.
 */
void free_neighbours(std::vector<Slip> &slips)
{
  const std::vector<Slip> discrete(slips);
  for (unsigned int k = 0; k + 1 < slips.size(); ++k)
    for (const auto &[one, other] : {std::pair(k, k + 1), std::pair(k + 1, k)})
      if (discrete[one].mode == Slip::nowhere && discrete[other].is_directed_everywhere())
        slips[one] = {Slip::partly, discrete[other].direction};
}

/** One component of the displacement on a contact face by the unknowns of the linear system. */
struct Trace
{
  std::vector<unsigned int> unknowns;
  FullMatrix<double> legendre; ///< coefficients x unknowns
  std::vector<double> u;       ///< those of u_Nt, or of u_Nn - u_0

  /** u minus that of w */
  EdgePolynomial rest(const Vector<double> &w) const
  {
    std::vector<double> result(u);
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] -= legendre(i, k) * w[unknowns[k]];
    return EdgePolynomial(result);
  }

  /** By more unknowns, from @p first on, with their coefficients. */
  void extend(const FullMatrix<double> &more, const unsigned int first)
  {
    FullMatrix<double> all(more.m(), unknowns.size() + more.n());
    all.fill(legendre, 0, 0, 0, 0);
    all.fill(more, 0, unknowns.size(), 0, 0);
    legendre = all;
    for (unsigned int i = 0; i < more.n(); ++i)
      unknowns.push_back(first + i);
    u.resize(more.m());
  }
};

template <int dim>
Trace trace_of(const ContactFace<dim> &face, const Tensor<1, dim> &direction,
               const Solution<dim> &solution, const Unknowns<dim> &unknowns,
               const FullMatrix<double> &legendre)
{
  const unsigned int n = face.degree + 1;
  const auto dofs = solution.displacement_space.cell_dofs(face.cell->active_cell_index());
  const std::vector<unsigned int> &on_edge =
      solution.tables.numbering(face.degree).edge[face.face_no];
  std::map<unsigned int, Vector<double>> columns; // values at nodes by unknown
  Vector<double> u(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int c = 0; c < dim; ++c)
    {
      const types::global_dof_index dof = dofs[on_edge[c * n + j]];
      u[j] += direction[c] * solution.u[dof];
      for (const auto &[unknown, weight] : unknowns.terms(dof))
      {
        Vector<double> &column = columns[unknown];
        if (column.size() == 0)
          column.reinit(n);
        column[j] += direction[c] * weight;
      }
    }
  Trace result;
  Vector<double> of_u(n);
  legendre.vmult(of_u, u);
  result.u.assign(of_u.begin(), of_u.end());
  for (auto column = columns.begin(); column != columns.end();)
    column = column->second.linfty_norm() < 1e-12 ? columns.erase(column) : std::next(column);
  result.legendre.reinit(n, columns.size());
  for (const auto &[unknown, values] : columns)
  {
    Vector<double> coefficients(n);
    legendre.vmult(coefficients, values);
    for (unsigned int i = 0; i < n; ++i)
      result.legendre(i, result.unknowns.size()) = coefficients[i];
    result.unknowns.push_back(unknown);
  }
  return result;
}

/** What happens along the normal on a face with unilateral contact. */
struct Opening
{
  enum Mode
  {
    closed,
    partly,
    open
  } mode;
  Trace penetration; ///< u_Nn - u_0
  EdgePolynomial pressure;

  /** `int pi (u_0 - u_Nn + w_n)` over [0,1] */
  double gap(const EdgePolynomial &rest) const
  {
    const std::vector<double> pi = pressure.coefficients(), r = rest.coefficients();
    return -0.5 * std::inner_product(pi.begin(), pi.begin() + std::min(pi.size(), r.size()),
                                     r.begin(), 0.);
  }
};

/** The end of contact likewise may be on the first face that presses. */
void free_neighbours(std::vector<std::optional<Opening>> &openings)
{
  std::vector<bool> is_open;
  for (const auto &opening : openings)
    is_open.push_back(opening && opening->mode == Opening::open);
  for (unsigned int k = 0; k < openings.size(); ++k)
    if (openings[k] && openings[k]->mode == Opening::closed &&
        ((k > 0 && is_open[k - 1]) || (k + 1 < is_open.size() && is_open[k + 1])))
      openings[k]->mode = Opening::partly;
}

/** Or zero, if none is above that, or all are round-off. */
double largest_value(const EdgePolynomial &polynomial, const double round_off)
{
  double result = 0.;
  if (polynomial.largest() <= round_off || polynomial.enclosure().second <= 0.)
    return result;
  for (const double s : polynomial.extremes())
    result = std::max(result, polynomial(s));
  return result;
}

template <int dim>
Opening opening_of(const unsigned int number, const Solution<dim> &solution,
                   const Unknowns<dim> &unknowns, const AdmissiblePressure<dim> &pressure,
                   const LegendreTables &tables)
{
  const ContactFace<dim> &face = solution.contact_space.faces()[number];
  unsigned int n_pressing = 0;
  for (const unsigned int i : face.pressures)
    n_pressing += solution.z[i] > 0.;
  Opening result{
      n_pressing == 0                      ? Opening::open
      : n_pressing < face.pressures.size() ? Opening::partly
                                           : Opening::closed,
      trace_of(face, face.frame(0.5).normal, solution, unknowns, tables.from_nodes(face.degree)),
      pressure.value(number)};
  const std::vector<double> gap = gap_at_nodes(face, solution.tables, tables).coefficients();
  for (unsigned int i = 0; i < gap.size(); ++i)
    result.penetration.u[i] -= gap[i];
  return result;
}

/** `int g (|v| - l v)` over one face, cut where g jumps or v changes sign. */
template <int dim, class F>
double friction_gap(const ContactFace<dim> &face, const EdgePolynomial &v,
                    const Solution<dim> &solution, const F &l)
{
  if (face.friction.vanishes())
    return 0.;
  std::vector<double> cuts = v.zeros();
  cuts.insert(cuts.end(), face.friction.cuts.begin(), face.friction.cuts.end());
  std::sort(cuts.begin(), cuts.end());
  // l* has degree p + 5, v up to p + 8; the rest is for g.
  const QGauss<1> &gauss = solution.tables.gauss(face.degree + 8);
  double result = 0;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = cuts[k + 1] - cuts[k], s = cuts[k] + width * gauss.point(q)[0];
      const double value = v(s);
      // One difference at a time: where l is the direction of v, nothing is left, not even round-off.
      const double density = std::abs(value) * (1. - (value < 0. ? -1. : 1.) * l(s));
      if (density != 0.)
        result +=
            face.length * width * gauss.weight(q) * density * face.friction_bound(face.point(s));
    }
  return result;
}

/**
 * How many degrees edge bubbles have beyond the cell's. Measured: with eight the bound is a twentieth lower near
 * incompressibility, where it is harder to move in one cell; elsewhere by up to a twentieth, not worth their matrices.
 */
template <int dim>
unsigned int bubbles_on(const ContactFace<dim> &face, const Scene<dim> &scene)
{
  return scene.material_of(face.cell).is_nearly_incompressible(dim) ? 8 : 4;
}

/** Coefficients of P_{p+1+i} - P_{p-1+i}, which vanish at both ends: (p + 1 + n_bubbles) x n_bubbles. */
FullMatrix<double> bubble_coefficients(const unsigned int p, const unsigned int n_bubbles)
{
  FullMatrix<double> result(p + 1 + n_bubbles, n_bubbles);
  for (unsigned int i = 0; i < n_bubbles; ++i)
  {
    result(p + 1 + i, i) = 1. / legendre::root(p + 1 + i);
    result(p - 1 + i, i) = -1. / legendre::root(p - 1 + i);
  }
  return result;
}

enum class Role
{
  outside, ///< w is zero there
  fixed,   ///< by u_Nt where the body sticks, by u_Nn - u_0 where it presses
  free
};

/** A trace of w at a point of its face by the unknowns of a strip that are kept. */
Vector<double> trace_row(const RestrictedEnergy &strip, const Trace &trace, const double s)
{
  const Vector<double> L = legendre_basis(trace.legendre.m(), s);
  Vector<double> values(trace.unknowns.size()), row(strip.n_kept());
  trace.legendre.Tvmult(values, L);
  for (unsigned int m = 0; m < values.size(); ++m)
    if (const unsigned int place = strip.place(trace.unknowns[m]); place != none)
      row[place] += values[m];
  return row;
}

/** `sign (rest - w) <= 0` along a face, w that of the unknowns kept. */
struct Condition
{
  const Trace *trace;
  EdgePolynomial rest;
  double sign;

  /** At one point; false: w is fixed there. */
  bool add_to(InequalityProgram &program, const RestrictedEnergy &strip, const double s) const
  {
    Vector<double> row = trace_row(strip, *trace, s);
    row *= sign;
    if (row.linfty_norm() <= 1e-9)
      return false;
    program.add_inequality(row, sign * rest(s));
    return true;
  }
};

/** One w and what it is worth. */
struct Candidate
{
  Vector<double> w;
  std::vector<double> gaps;
  double total = 0;
};

/** Finds w. */
template <int dim>
class Search
{
public:
  Search(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
         const AdmissibleFriction<dim> &friction, const AdmissiblePressure<dim> &pressure,
         EdgeBubbles<dim> *bubbles);

  /** No correction. */
  Candidate nothing() const;

  /** Of w, with as much more as it takes for u_N - w not to penetrate. */
  Candidate of(const Vector<double> &w) const;
  /** The best one, from one that is known. */
  Candidate best(Candidate result) const;

  std::vector<double> energies(const Vector<double> &w) const; ///< |w|_a^2 by cell

private:
  std::vector<Role> roles() const;
  void add_normal_roles(std::vector<Role> &roles) const;
  Vector<double> fixed_displacement() const;
  bool find_near_pressure(unsigned int face) const;
  double penetration(const Vector<double> &w, std::map<unsigned int, double> &heights) const;
  bool lift(Vector<double> &w) const;
  void add_friction(const RestrictedEnergy &strip, const std::vector<bool> &nearby,
                    const Vector<double> &fixed, Vector<double> &h,
                    std::vector<Condition> &conditions) const;
  void add_pressure(const RestrictedEnergy &strip, const Vector<double> &fixed, Vector<double> &h,
                    std::vector<Condition> &conditions) const;
  std::vector<bool> nearby_faces(const std::vector<double> &gaps) const;
  std::vector<unsigned int> kept_unknowns(const std::vector<bool> &nearby,
                                          const std::vector<Role> &roles) const;
  void try_one_direction(const RestrictedEnergy &strip, const std::vector<bool> &nearby,
                         const Vector<double> &fixed, Candidate &best) const;
  void take_better(Candidate &best, const Vector<double> &w) const;

  using Directions = std::vector<std::pair<Tensor<1, dim>, Trace *>>;
  void add_bubbles(const ContactFace<dim> &face, const Directions &directions,
                   EdgeBubbles<dim> &bubbles);
  void add_columns(unsigned int cell, const typename EdgeBubbles<dim>::Energies &energies);

  const Solution<dim> &solution;
  const Discretisation<dim> &discretisation;
  const AdmissibleFriction<dim> &friction;
  const std::vector<ContactFace<dim>> &faces;
  std::vector<Slip> slips;
  std::vector<Trace> traces; ///< of u_t
  std::vector<std::optional<Opening>> openings;
  std::vector<bool> is_near_pressure;       ///< by face
  BorderedMatrix A;                         ///< bordered by edge bubbles
  std::vector<unsigned int> cell_of_bubble; ///< by column of the border
  double tolerance = 0;                     ///< of penetrations: round-off
};

template <int dim>
Search<dim>::Search(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
                    const AdmissibleFriction<dim> &friction,
                    const AdmissiblePressure<dim> &pressure, EdgeBubbles<dim> *const bubbles)
    : solution(solution), discretisation(discretisation), friction(friction),
      faces(solution.contact_space.faces()), slips(slips_of(faces, solution)),
      openings(faces.size()), A{discretisation.system.A, {}}
{
  const LegendreTables tables;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    traces.push_back(trace_of(faces[k], faces[k].frame(0.5).tangent, solution,
                              discretisation.unknowns, tables.from_nodes(faces[k].degree)));
    if (!faces[k].condition->is_unilateral())
      continue;
    openings[k] = opening_of(k, solution, discretisation.unknowns, pressure, tables);
    tolerance = std::max(tolerance, 1e-14 * EdgePolynomial(openings[k]->penetration.u).largest());
  }
  for (unsigned int k = 0; k < faces.size(); ++k)
    is_near_pressure.push_back(find_near_pressure(k));
  if (!bubbles)
    return;
  free_neighbours(slips);
  free_neighbours(openings);
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const ContactFrame<dim> frame = faces[k].frame(0.5);
    Directions directions;
    if (slips[k].mode == Slip::partly)
      directions.emplace_back(frame.tangent, &traces[k]);
    if (openings[k] && openings[k]->mode == Opening::partly)
      directions.emplace_back(frame.normal, &openings[k]->penetration);
    if (!directions.empty())
      add_bubbles(faces[k], directions, *bubbles);
  }
}

/**
 * Bubbles along the directions of some traces on a face, as unknowns of these. A cell at the boundary with two faces
 * has them on one.
 */
template <int dim>
void Search<dim>::add_bubbles(const ContactFace<dim> &face, const Directions &directions,
                              EdgeBubbles<dim> &bubbles)
{
  const unsigned int cell = face.cell->active_cell_index(), first = A.n();
  if (std::find(cell_of_bubble.begin(), cell_of_bubble.end(), cell) != cell_of_bubble.end())
    return;
  const unsigned int n_bubbles = bubbles_on(face, solution.scene);
  const FullMatrix<double> coefficients = bubble_coefficients(face.degree, n_bubbles);
  const unsigned int n_nodes = coefficients.m();
  FullMatrix<double> at_nodes(dim * n_nodes, directions.size() * n_bubbles);
  for (unsigned int node = 0; node < n_nodes; ++node)
  {
    const Vector<double> L =
        legendre_basis(n_nodes, solution.tables.gauss_lobatto(n_nodes).point(node)[0]);
    Vector<double> values(n_bubbles);
    coefficients.Tvmult(values, L);
    for (unsigned int d = 0; d < directions.size(); ++d)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int i = 0; i < n_bubbles; ++i)
          at_nodes(c * n_nodes + node, d * n_bubbles + i) = directions[d].first[c] * values[i];
  }
  add_columns(cell, bubbles.energies(face, at_nodes, solution.scene, solution.tables));
  for (unsigned int d = 0; d < directions.size(); ++d)
    directions[d].second->extend(coefficients, first + d * n_bubbles);
}

template <int dim>
void Search<dim>::add_columns(const unsigned int cell,
                              const typename EdgeBubbles<dim>::Energies &energies)
{
  const auto dofs = solution.displacement_space.cell_dofs(cell);
  const unsigned int first = A.n();
  for (unsigned int i = 0; i < energies.own.n(); ++i)
  {
    std::map<unsigned int, double> column;
    for (unsigned int j = 0; j < energies.with_shapes.m(); ++j)
      for (const auto &[unknown, weight] : discretisation.unknowns.terms(dofs[j]))
        column[unknown] += weight * energies.with_shapes(j, i);
    for (unsigned int j = 0; j <= i; ++j)
      column[first + j] = energies.own(j, i);
    for (const auto &[row, value] : column)
    {
      A.border.row.push_back(row);
      A.border.value.push_back(value);
    }
    A.border.column_start.push_back(A.border.row.size());
    cell_of_bubble.push_back(cell);
  }
}

/** The largest of u_Nn - w_n - u_0, and at each vertex that of its faces. */
template <int dim>
double Search<dim>::penetration(const Vector<double> &w,
                                std::map<unsigned int, double> &heights) const
{
  double result = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (openings[k])
    {
      const double height = largest_value(openings[k]->penetration.rest(w), tolerance);
      result = std::max(result, height);
      for (unsigned int end = 0; end < 2; ++end)
      {
        double &at_vertex = heights[faces[k].cell->face(faces[k].face_no)->vertex_index(end)];
        at_vertex = std::max(at_vertex, height);
      }
    }
  return result;
}

/**
 * w_n += a piecewise linear function that takes away what penetrates; false: supports are in the way of more
 * than round-off.
 */
template <int dim>
bool Search<dim>::lift(Vector<double> &w) const
{
  std::map<unsigned int, double> heights;
  if (penetration(w, heights) <= tolerance)
    return true;
  Vector<double> u(solution.u.size());
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (openings[k])
    {
      const unsigned int n = faces[k].degree + 1;
      const auto face = faces[k].cell->face(faces[k].face_no);
      const double first = heights[face->vertex_index(0)], last = heights[face->vertex_index(1)];
      if (first == 0. && last == 0.)
        continue;
      const Tensor<1, dim> normal = faces[k].frame(0.5).normal;
      const auto dofs = solution.displacement_space.cell_dofs(faces[k].cell->active_cell_index());
      const std::vector<unsigned int> &on_edge =
          solution.tables.numbering(faces[k].degree).edge[faces[k].face_no];
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int c = 0; c < dim; ++c)
        {
          const double s = solution.tables.gauss_lobatto(n).point(j)[0];
          if (const auto dof = dofs[on_edge[c * n + j]];
              discretisation.unknowns.terms(dof).size() > 0)
            u[dof] = normal[c] * (1. + 1e-10) * (first + s * (last - first));
        }
    }
  const Vector<double> lifted = discretisation.unknowns.coordinates(u);
  for (unsigned int i = 0; i < lifted.size(); ++i)
    w[i] += lifted[i];
  return penetration(w, heights) <= std::max(tolerance, 1e-13 * solution.u.linfty_norm());
}

template <int dim>
Candidate Search<dim>::nothing() const
{
  return of(Vector<double>(A.n()));
}

template <int dim>
Candidate Search<dim>::of(const Vector<double> &w) const
{
  Candidate result{w, {}, 0.};
  const bool is_admissible = lift(result.w);
  result.total = is_admissible ? A.energy(result.w) : std::numeric_limits<double>::infinity();
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const EdgePolynomial rest = traces[k].rest(result.w);
    // Where w has taken u_Nt away, round-off is left, whose signs are not worth the search.
    result.gaps.push_back(rest.largest() > 1e-13 * EdgePolynomial(traces[k].u).largest()
                              ? friction_gap(faces[k], rest, solution,
                                             [&](const double s) { return friction.value(k, s); })
                              : 2. * rest.largest() * faces[k].length *
                                    faces[k].friction.integral());
    if (openings[k])
      result.gaps.back() +=
          faces[k].length * openings[k]->gap(openings[k]->penetration.rest(result.w));
  }
  result.total += 2. * sum(result.gaps);
  return result;
}

template <int dim>
void Search<dim>::take_better(Candidate &best, const Vector<double> &w) const
{
  Candidate next = of(w);
  if (next.total < best.total)
    best = std::move(next);
}

/** @p cells and those that share unknowns with them. */
template <int dim>
std::vector<bool> with_neighbours(const std::vector<bool> &cells,
                                  const DisplacementSpace<dim> &space,
                                  const Unknowns<dim> &unknowns, const unsigned int n_unknowns)
{
  std::vector<bool> touched(n_unknowns), result(cells);
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    if (cells[cell])
      for (const auto dof : space.cell_dofs(cell))
        for (const auto &[unknown, weight] : unknowns.terms(dof))
          touched[unknown] = true;
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    for (const auto dof : space.cell_dofs(cell))
      for (const auto &[unknown, weight] : unknowns.terms(dof))
        result[cell] = result[cell] || touched[unknown];
  return result;
}

/**
 * Free are the traces, and what none but cells at the contact boundary have: w decays so fast into the body
 * more cells would change its energy by a few hundredths. A body that keeps its volume needs more room to move.
 */
template <int dim>
std::vector<Role> Search<dim>::roles() const
{
  const Unknowns<dim> &unknowns = discretisation.unknowns;
  std::vector<Role> result(A.n(), Role::free);
  std::vector<bool> is_at_contact(solution.displacement_space.degrees().size());
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (!faces[k].friction.vanishes() || is_near_pressure[k])
      is_at_contact[faces[k].cell->active_cell_index()] = true;
  if (solution.scene.is_nearly_incompressible())
    is_at_contact = with_neighbours(is_at_contact, solution.displacement_space, unknowns, A.n());
  for (unsigned int cell = 0; cell < is_at_contact.size(); ++cell)
    if (!is_at_contact[cell])
      for (const auto dof : solution.displacement_space.cell_dofs(cell))
        for (const auto &[unknown, weight] : unknowns.terms(dof))
          result[unknown] = Role::outside;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (const unsigned int unknown : traces[k].unknowns)
      if (slips[k].mode == Slip::nowhere)
        result[unknown] = Role::fixed;
      else if (!faces[k].friction.vanishes() && result[unknown] == Role::outside)
        result[unknown] = Role::free;
  add_normal_roles(result);
  return result;
}

/** Along a slanted boundary both components share unknowns: what one of them fixes is fixed. */
template <int dim>
void Search<dim>::add_normal_roles(std::vector<Role> &roles) const
{
  for (const bool is_near : {false, true})
    for (unsigned int k = 0; k < faces.size(); ++k)
      if (openings[k] && is_near == is_near_pressure[k])
        for (const unsigned int unknown : openings[k]->penetration.unknowns)
          if (roles[unknown] != Role::fixed)
            roles[unknown] = is_near ? Role::free : Role::outside;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (openings[k] && openings[k]->mode == Opening::closed)
      for (const unsigned int unknown : openings[k]->penetration.unknowns)
        roles[unknown] = Role::fixed;
}

/** Does a face press, or one of two on either side of it, or does it penetrate? */
template <int dim>
bool Search<dim>::find_near_pressure(const unsigned int face) const
{
  if (!openings[face])
    return false;
  for (unsigned int other = face < 2 ? 0 : face - 2;
       other < std::min<std::size_t>(face + 3, faces.size()); ++other)
    if (openings[other] && openings[other]->mode != Opening::open)
      return true;
  return largest_value(EdgePolynomial(openings[face]->penetration.u), tolerance) > tolerance;
}

/**
 * The unknowns of a displacement that is u_Nt where the body sticks and u_Nn - u_0 where it presses;
 * elsewhere of no use.
 */
template <int dim>
Vector<double> Search<dim>::fixed_displacement() const
{
  Vector<double> u(solution.u.size());
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const ContactFrame<dim> frame = faces[k].frame(0.5);
    const auto dofs = solution.displacement_space.cell_dofs(faces[k].cell->active_cell_index());
    const std::vector<unsigned int> &on_edge =
        solution.tables.numbering(faces[k].degree).edge[faces[k].face_no];
    const unsigned int n = faces[k].degree + 1;
    // A corner has had its part of another face.
    const auto complete = [&](const Tensor<1, dim> &direction, const auto &wanted)
    {
      for (unsigned int j = 0; j < n; ++j)
      {
        double missing = wanted(solution.tables.gauss_lobatto(n).point(j)[0]);
        for (unsigned int c = 0; c < dim; ++c)
          missing -= direction[c] * u[dofs[on_edge[c * n + j]]];
        for (unsigned int c = 0; c < dim; ++c)
          if (const auto dof = dofs[on_edge[c * n + j]];
              discretisation.unknowns.terms(dof).size() > 0)
            u[dof] += missing * direction[c];
      }
    };
    if (slips[k].mode == Slip::nowhere)
      complete(frame.tangent, EdgePolynomial(traces[k].u));
    if (openings[k] && openings[k]->mode == Opening::closed)
      complete(frame.normal, EdgePolynomial(openings[k]->penetration.u));
  }
  Vector<double> result = discretisation.unknowns.coordinates(u);
  result.grow_or_shrink(A.n());
  return result;
}

/**
 * Faces whose slip is to keep its direction: those that slip in part, up to two slipping ones beside each that
 * does not slip everywhere, and those with more than a hundredth of the gap of all that slip.
 */
template <int dim>
std::vector<bool> Search<dim>::nearby_faces(const std::vector<double> &gaps) const
{
  double of_slip = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    of_slip += slips[k].mode == Slip::everywhere ? gaps[k] : 0.;
  std::vector<bool> result(faces.size());
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (slips[k].mode == Slip::everywhere)
      result[k] = gaps[k] > 0.01 * of_slip;
    else
    {
      result[k] = slips[k].mode == Slip::partly;
      for (unsigned int other = k < 2 ? 0 : k - 2;
           other < std::min<std::size_t>(k + 3, faces.size()); ++other)
        if (slips[other].mode == Slip::everywhere)
          result[other] = true;
    }
  for (unsigned int k = 0; k < faces.size(); ++k)
    result[k] = result[k] && slips[k].direction != 0.;
  return result;
}

template <int dim>
std::vector<unsigned int> Search<dim>::kept_unknowns(const std::vector<bool> &nearby,
                                                     const std::vector<Role> &roles) const
{
  std::vector<unsigned int> result;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (nearby[k] || slips[k].mode == Slip::partly)
      for (const unsigned int unknown : traces[k].unknowns)
        if (roles[unknown] == Role::free)
          result.push_back(unknown);
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (is_near_pressure[k])
      for (const unsigned int unknown : openings[k]->penetration.unknowns)
        if (roles[unknown] == Role::free)
          result.push_back(unknown);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/** On the faces nearby u_Nt - w_t has the direction of slip, and the gap is linear in w: l* of degree p + 5 times up to p + 8. */
template <int dim>
void Search<dim>::add_friction(const RestrictedEnergy &strip, const std::vector<bool> &nearby,
                               const Vector<double> &fixed, Vector<double> &h,
                               std::vector<Condition> &conditions) const
{
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (nearby[k])
    {
      const FrictionRule rule = traction_rule(faces[k], faces[k].degree + 5, solution.tables);
      for (unsigned int q = 0; q < rule.points.size(); ++q)
        h.add(faces[k].length * rule.weights[q] * rule.values[q] *
                  (slips[k].direction - friction.value(k, rule.points[q])),
              trace_row(strip, traces[k], rule.points[q]));
      conditions.push_back({&traces[k], traces[k].rest(fixed), -slips[k].direction});
    }
}

/** Where the body presses or nearly does, u_Nn - w_n <= u_0; the gap is linear in w. */
template <int dim>
void Search<dim>::add_pressure(const RestrictedEnergy &strip, const Vector<double> &fixed,
                               Vector<double> &h, std::vector<Condition> &conditions) const
{
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (is_near_pressure[k])
    {
      const Trace &trace = openings[k]->penetration;
      const QGauss<1> &gauss = solution.tables.gauss(faces[k].degree + 7);
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0];
        h.add(-faces[k].length * gauss.weight(q) * openings[k]->pressure(s),
              trace_row(strip, trace, s));
      }
      conditions.push_back({&trace, trace.rest(fixed), 1.});
    }
}

template <int dim>
void Search<dim>::try_one_direction(const RestrictedEnergy &strip, const std::vector<bool> &nearby,
                                    const Vector<double> &fixed, Candidate &best) const
{
  Vector<double> h = strip.h();
  std::vector<Condition> conditions;
  add_friction(strip, nearby, fixed, h, conditions);
  add_pressure(strip, fixed, h, conditions);
  InequalityProgram program(strip.H(), h);
  for (const Condition &condition : conditions)
    for (unsigned int i = 0, n = condition.trace->legendre.m(); i <= n; ++i)
      condition.add_to(program, strip, 0.5 - 0.5 * std::cos(numbers::PI * i / n));
  if (!program.solve())
    return;
  Vector<double> w = strip.minimiser(program.minimiser());
  // What has another sign between the points is worth more points.
  bool stands_out = true;
  for (unsigned int round = 0; stands_out && round < 10; ++round)
  {
    stands_out = false;
    for (const Condition &condition : conditions)
    {
      const EdgePolynomial rest = condition.trace->rest(w);
      const double round_off = condition.sign > 0. ? tolerance : 1e-14 * rest.largest();
      for (const double s : rest.extremes())
        if (condition.sign * rest(s) > round_off)
          stands_out = condition.add_to(program, strip, s) || stands_out;
    }
    stands_out = stands_out && program.solve();
    if (stands_out)
      w = strip.minimiser(program.minimiser());
  }
  take_better(best, w);
}

template <int dim>
Candidate Search<dim>::best(Candidate result) const
{
  if (result.total == 0.)
    return result;
  const std::vector<Role> all_roles = roles();
  Vector<double> fixed = fixed_displacement();
  std::vector<bool> is_free;
  for (unsigned int i = 0; i < fixed.size(); ++i)
  {
    if (all_roles[i] != Role::fixed)
      fixed[i] = 0.;
    is_free.push_back(all_roles[i] == Role::free);
  }
  const std::vector<bool> nearby = nearby_faces(result.gaps);
  const RestrictedEnergy strip(A, is_free, fixed, kept_unknowns(nearby, all_roles));
  take_better(result, strip.minimiser());
  if (strip.n_kept() > 0)
    try
    {
      try_one_direction(strip, nearby, fixed, result);
    }
    catch (const NumericalFailure &)
    {
      // Stiffness that is singular to round-off: a candidate less.
    }
  return result;
}

template <int dim>
std::vector<double> Search<dim>::energies(const Vector<double> &w) const
{
  std::vector<double> result(solution.displacement_space.degrees().size());
  for (unsigned int cell = 0; cell < result.size(); ++cell)
    if (const auto &element = discretisation.condensation.element(cell))
    {
      const auto dofs = solution.displacement_space.cell_dofs(cell);
      Vector<double> values(element->condensed.m());
      for (unsigned int i = 0; i < values.size(); ++i)
        for (const auto &[unknown, weight] : discretisation.unknowns.terms(dofs[i]))
          values[i] += weight * w[unknown];
      if (!values.all_zero())
        result[cell] = element->condensed.matrix_norm_square(values);
    }
  for (unsigned int i = 0; i < cell_of_bubble.size(); ++i)
    result[cell_of_bubble[i]] += A.energy(A.A.n() + i, w);
  return result;
}
} // namespace

template <int dim>
ContactCorrection<dim>::ContactCorrection(const Solution<dim> &solution,
                                          const Discretisation<dim> &discretisation,
                                          const AdmissibleFriction<dim> &friction,
                                          const AdmissiblePressure<dim> &pressure,
                                          EdgeBubbles<dim> *const bubbles)
{
  const Search<dim> search(solution, discretisation, friction, pressure, bubbles);
  Candidate best = search.nothing();
  uncorrected = best.gaps;
  best = search.best(std::move(best));
  has_failed = !std::isfinite(best.total);
  face_gaps = std::move(best.gaps);
  w = std::move(best.w);
  cell_energies = search.energies(w);
}

template <int dim>
const std::vector<double> &ContactCorrection<dim>::gap() const
{
  return face_gaps;
}

template <int dim>
const std::vector<double> &ContactCorrection<dim>::uncorrected_gap() const
{
  return uncorrected;
}

template <int dim>
const std::vector<double> &ContactCorrection<dim>::energy() const
{
  return cell_energies;
}

template <int dim>
bool ContactCorrection<dim>::fails() const
{
  return has_failed;
}

template <int dim>
const Vector<double> &ContactCorrection<dim>::unknowns() const
{
  return w;
}

template <int dim>
double ContactCorrection<dim>::total() const
{
  return 2. * sum(face_gaps) + sum(cell_energies);
}

template <int dim>
double energy_change(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
                     const Vector<double> &v)
{
  const Vector<double> all = discretisation.unknowns.expand(v);
  double result = BorderedMatrix{discretisation.system.A, {}}.energy(v) / 2. -
                  solution.z * solution.spaces->contact_operator.moments(all);
  Vector<double> moved(solution.u);
  moved += all;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
  {
    const auto work = [&](const Vector<double> &u)
    {
      return friction_gap(face,
                          edge_trace(face, face.frame(0.5).tangent, solution.displacement_space,
                                     solution.tables, u),
                          solution, [](double) { return 0.; });
    };
    result += work(moved) - work(solution.u);
  }
  return result;
}

template class ContactCorrection<2>;
template double energy_change(const Solution<2> &, const Discretisation<2> &,
                              const Vector<double> &);
} // namespace hpvi
