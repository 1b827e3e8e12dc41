// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/admissibility/admissible_pressure.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/solver/inequality_program.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Negative pressures that are taken for round-off, relative to the largest pressure. */
constexpr double round_off = 1e-13;

/** A cell far from the origin has rounded vertices: what one frame knows is no rectangle, all do. */
constexpr double negligible_angle = 1e-10;

/** `int_0^1 t` and `int_0^1 t s` of t with coefficients c are `mean c_0` and `(mean c_0 + slope c_1)/2`. */
const double mean = std::sqrt(0.5), slope = std::sqrt(1. / 6.);

/** One face: the data of its two polynomials, and these. */
struct PressedFace
{
  unsigned int n; ///< coefficients: p + 1
  double length, weight;
  bool is_skew;                            ///< do shears at corners depend on the normal traction?
  double origin, step;                     ///< place `origin + step s` along the boundary
  Vector<double> openness;                 ///< of u_0 - u_Nn
  std::array<double, 2> force{}, moment{}; ///< <z_n, psi_a>, <z_n, psi_a s>
  std::array<Vector<double>, 2> wanted, t; ///< psi_a z_n; t_a
  std::array<unsigned int, 2> vertices;
  const void *boundary;
  bool is_balanced = true; ///< has pi the moments of z_n, or its force alone?

  EdgePolynomial pressure() const
  {
    Vector<double> sum(t[0]);
    sum += t[1];
    return EdgePolynomial({sum.begin(), sum.end()});
  }

  double least() const
  {
    const EdgePolynomial pi = pressure();
    double result = pi(0.);
    for (const double s : pi.extremes())
      result = std::min(result, pi(s));
    return result;
  }
};

template <int dim>
EdgePolynomial discrete_pressure(const ContactFace<dim> &face, const Solution<dim> &solution)
{
  const QGauss<1> &gauss = solution.tables.gauss(face.degree + 1);
  std::vector<double> values;
  for (const Point<1> &point : gauss.get_points())
    values.push_back(solution.contact_space.pressure(face, solution.z, point[0]));
  return EdgePolynomial::through(values, gauss);
}

/** Adds `weight z psi_a` and `weight z psi_a s` at a point. */
void add_moments(PressedFace &face, const double s, const double weighted)
{
  for (unsigned int end = 0; end < 2; ++end)
  {
    const double hat = end == 0 ? 1. - s : s;
    face.force[end] += weighted * hat;
    face.moment[end] += weighted * hat * s;
  }
}

template <int dim>
void set_moments(PressedFace &result, const ContactFace<dim> &face, const EdgePolynomial &z,
                 const Solution<dim> &solution)
{
  if (face.at_nodes)
  {
    const QGaussLobatto<1> &rule = solution.tables.gauss_lobatto(face.degree + 1);
    for (unsigned int k = 0, i = 0; k < rule.size() && i < face.normal_points.size(); ++k)
      if (face.normal_points[i] == rule.point(k)[0])
        add_moments(result, rule.point(k)[0],
                    face.length * rule.weight(k) * solution.z[face.pressures[i++]]);
    return;
  }
  const QGauss<1> &gauss = solution.tables.gauss(result.n + 1);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0];
    add_moments(result, s, face.length * gauss.weight(q) * z(s));
  }
}

/** The projection of psi_a z_n, with its moments and without a value at the other end of a skew face. */
Vector<double> own_part(const PressedFace &face, const unsigned int end)
{
  Vector<double> t(face.wanted[end]);
  t[0] = face.force[end] / (face.length * mean);
  t[1] = (2. * face.moment[end] / face.length - mean * t[0]) / slope;
  if (!face.is_skew)
    return t;
  const Vector<double> L = legendre_basis(face.n, 1. - end);
  double square = 0;
  for (unsigned int i = 2; i < face.n; ++i)
    square += L[i] * L[i];
  const double value = t * L;
  for (unsigned int i = 2; i < face.n; ++i)
    t[i] -= value / square * L[i];
  return t;
}

template <int dim>
PressedFace pressed_face(const ContactFace<dim> &face, const Solution<dim> &solution,
                         const LegendreTables &legendre)
{
  const ContactFrame<dim> frame = face.frame(0.5);
  PressedFace result;
  result.n = traction_degree(face, solution.z, solution.contact_space) + 1;
  result.length = face.length;
  result.weight = face.length / (2. * solution.scene.material_of(face.cell).mu() * face.degree);
  const Tensor<2, dim> J = face.map.jacobian({0.5, 0.5});
  result.is_skew =
      std::abs(J[0][0] * J[0][1] + J[1][0] * J[1][1]) > negligible_angle * J.norm_square();
  result.origin = face.point(0.) * frame.tangent;
  result.step = face.point(1.) * frame.tangent - result.origin;
  result.boundary = face.condition;
  const EdgePolynomial z = discrete_pressure(face, solution),
                       u_0 = gap_at_nodes(face, solution.tables, legendre),
                       u_n = edge_trace(face, frame.normal, solution.displacement_space,
                                        solution.tables, solution.u);
  set_moments(result, face, z, solution);
  const QGauss<1> &gauss = solution.tables.gauss(result.n + 1);
  result.openness.reinit(result.n);
  for (unsigned int end = 0; end < 2; ++end)
    result.wanted[end].reinit(result.n);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0], weight = 2. * gauss.weight(q);
    const Vector<double> L = legendre_basis(result.n, s);
    result.openness.add(weight * (u_0(s) - u_n(s)), L);
    result.wanted[0].add(weight * (1. - s) * z(s), L);
    result.wanted[1].add(weight * s * z(s), L);
  }
  for (unsigned int end = 0; end < 2; ++end)
  {
    result.vertices[end] = face.cell->face(face.face_no)->vertex_index(end);
    result.t[end] = own_part(result, end);
  }
  return result;
}

/** What pressures of some faces have to have in common with z_n. */
enum class Balance
{
  force_and_moment, ///< of each patch
  force             ///< of all
};

/** The program that neighbouring faces share. */
class NeighbourhoodProgram
{
public:
  NeighbourhoodProgram(std::vector<PressedFace *> faces, double scale);

  bool solve(Balance balance); ///< set t of the faces; false: there are none

private:
  InequalityProgram start() const;
  bool add_balance(InequalityProgram &program) const;
  bool add_force(InequalityProgram &program) const;
  bool add_rims(InequalityProgram &program) const;
  void add_bound(unsigned int face, double s, InequalityProgram &program) const;
  unsigned int unknown(const unsigned int face, const unsigned int end) const
  {
    return first[face] + end * faces[face]->n;
  }

  const std::vector<PressedFace *> faces;
  const double scale;
  std::vector<unsigned int> first;
};

NeighbourhoodProgram::NeighbourhoodProgram(std::vector<PressedFace *> some_faces,
                                           const double scale)
    : faces(std::move(some_faces)), scale(scale), first{0}
{
  for (const PressedFace *face : faces)
    first.push_back(first.back() + 2 * face->n);
}

InequalityProgram NeighbourhoodProgram::start() const
{
  FullMatrix<double> H(first.back(), first.back());
  Vector<double> h(first.back());
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; end < 2; ++end)
      for (unsigned int i = 0; i < faces[k]->n; ++i)
      {
        const double weight = faces[k]->weight * faces[k]->length;
        H(unknown(k, end) + i, unknown(k, end) + i) = weight;
        h[unknown(k, end) + i] =
            weight * faces[k]->wanted[end][i] - faces[k]->length * faces[k]->openness[i];
      }
  return InequalityProgram(H, h);
}

/** Force and moment at each vertex, over the faces of the neighbourhood. */
bool NeighbourhoodProgram::add_balance(InequalityProgram &program) const
{
  std::map<unsigned int, std::array<Vector<double>, 2>> rows;
  std::map<unsigned int, std::array<double, 2>> values;
  const double origin = faces[0]->origin, unit = std::abs(faces[0]->step);
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; end < 2; ++end)
    {
      const PressedFace &face = *faces[k];
      auto &[force, moment] = rows[face.vertices[end]];
      auto &[of_force, of_moment] = values[face.vertices[end]];
      if (force.size() == 0)
      {
        force.reinit(first.back());
        moment.reinit(first.back());
      }
      const double offset = (face.origin - origin) / unit, step = face.step / unit;
      const unsigned int i = unknown(k, end);
      force[i] = face.length / unit * mean;
      moment[i] = face.length / unit * (offset + step / 2) * mean;
      moment[i + 1] = face.length / unit * step / 2 * slope;
      of_force += face.force[end] / unit;
      of_moment += (offset * face.force[end] + step * face.moment[end]) / unit;
    }
  for (const auto &[vertex, row] : rows)
    for (unsigned int k = 0; k < 2; ++k)
      if (!program.add_equality(row[k], values[vertex][k]))
        return false;
  return true;
}

/** The force of all faces, and `t_a = psi_a pi`: `s t_0 = (1 - s) t_1` at as many points as that has coefficients. */
bool NeighbourhoodProgram::add_force(InequalityProgram &program) const
{
  Vector<double> force(first.back());
  double of_force = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; end < 2; ++end)
    {
      force[unknown(k, end)] = mean * faces[k]->length / faces[0]->length;
      of_force += faces[k]->force[end] / faces[0]->length;
    }
  if (!program.add_equality(force, std::max(0., of_force)))
    return false;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int i = 0, n = faces[k]->n; i <= n; ++i)
    {
      const double s = 0.5 - 0.5 * std::cos(numbers::PI * i / n);
      const Vector<double> L = legendre_basis(n, s);
      Vector<double> row(first.back());
      for (unsigned int j = 0; j < n; ++j)
      {
        row[unknown(k, 0) + j] = s * L[j];
        row[unknown(k, 1) + j] = (s - 1.) * L[j];
      }
      if (!program.add_equality(row, 0.))
        return false;
    }
  return true;
}

/** A skew face has no traction at the rim of a patch, where the shear would have to follow it. */
bool NeighbourhoodProgram::add_rims(InequalityProgram &program) const
{
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; faces[k]->is_skew && end < 2; ++end)
    {
      const Vector<double> L = legendre_basis(faces[k]->n, 1. - end);
      Vector<double> row(first.back());
      std::copy(L.begin(), L.end(), row.begin() + unknown(k, end));
      if (!program.add_equality(row, 0.))
        return false;
    }
  return true;
}

/** pi(s) >= 0 */
void NeighbourhoodProgram::add_bound(const unsigned int face, const double s,
                                     InequalityProgram &program) const
{
  const Vector<double> L = legendre_basis(faces[face]->n, s);
  Vector<double> row(first.back());
  for (unsigned int end = 0; end < 2; ++end)
    std::copy(L.begin(), L.end(), row.begin() + unknown(face, end));
  program.add_inequality(row, 0.);
}

bool NeighbourhoodProgram::solve(const Balance balance)
try
{
  InequalityProgram program = start();
  if (balance == Balance::force ? !add_force(program) : !add_balance(program) || !add_rims(program))
    return false;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int i = 0, n = 2 * faces[k]->n; i <= n; ++i)
      add_bound(k, 0.5 - 0.5 * std::cos(numbers::PI * i / n), program);
  // As in AdmissibleFriction, extremes that stand out become points as well.
  bool stands_out = true;
  for (unsigned int round = 0; stands_out && round < 30; ++round)
  {
    if (!program.solve())
      return false;
    stands_out = false;
    for (unsigned int k = 0; k < faces.size(); ++k)
    {
      for (unsigned int end = 0; end < 2; ++end)
        std::copy_n(program.minimiser().begin() + unknown(k, end), faces[k]->n,
                    faces[k]->t[end].begin());
      const EdgePolynomial pi = faces[k]->pressure();
      for (const double s : pi.extremes())
        if (pi(s) < -0.1 * round_off * scale)
        {
          stands_out = true;
          add_bound(k, s, program);
        }
    }
  }
  return std::all_of(faces.begin(), faces.end(),
                     [&](const PressedFace *face) { return face->least() >= -round_off * scale; });
}
catch (const NumericalFailure &)
{
  return false;
}

/** Neighbouring faces that are solved for as one; numbers along the boundary. */
struct Neighbourhood
{
  unsigned int first, last;
  bool is_solved = false;
};

/** All faces, and the neighbourhoods of those on which z_n is negative somewhere. */
class Neighbourhoods
{
public:
  Neighbourhoods(std::map<unsigned int, PressedFace> &faces, double scale);

  bool solve(); ///< false: a face has no admissible pressure

private:
  bool are_neighbours(unsigned int k) const;
  bool solve(const Neighbourhood &neighbourhood);
  bool redistribute(Neighbourhood &neighbourhood);
  bool grow(Neighbourhood &neighbourhood) const;
  void merge();

  std::map<unsigned int, PressedFace> &faces; ///< by their number
  const double scale;
  std::vector<Neighbourhood> all;
};

Neighbourhoods::Neighbourhoods(std::map<unsigned int, PressedFace> &faces, const double scale)
    : faces(faces), scale(scale)
{
  for (const auto &[k, face] : faces)
    if (face.least() < -round_off * scale)
      all.push_back({k, k});
}

/** Are faces k and k + 1 two of one straight boundary with a common vertex? */
bool Neighbourhoods::are_neighbours(const unsigned int k) const
{
  const auto one = faces.find(k), other = faces.find(k + 1);
  if (one == faces.end() || other == faces.end() || one->second.boundary != other->second.boundary)
    return false;
  for (const unsigned int vertex : one->second.vertices)
    for (const unsigned int same : other->second.vertices)
      if (vertex == same)
        return true;
  return false;
}

bool Neighbourhoods::solve(const Neighbourhood &neighbourhood)
{
  std::vector<PressedFace *> members;
  for (unsigned int k = neighbourhood.first; k <= neighbourhood.last; ++k)
  {
    members.push_back(&faces.at(k));
    members.back()->is_balanced = true;
  }
  return NeighbourhoodProgram(members, scale).solve(Balance::force_and_moment);
}

/**
 * No pressure has the moment of a force that stands in a corner. So each face on which z_n is negative
 * keeps its force alone, and the neighbourhood shrinks to these.
 */
bool Neighbourhoods::redistribute(Neighbourhood &neighbourhood)
{
  Neighbourhood rest{neighbourhood.last, neighbourhood.first, true};
  for (unsigned int k = neighbourhood.first; k <= neighbourhood.last; ++k)
  {
    PressedFace &face = faces.at(k);
    for (unsigned int end = 0; end < 2; ++end)
      face.t[end] = own_part(face, end);
    if (face.least() >= -round_off * scale)
      continue;
    if (!NeighbourhoodProgram({&face}, scale).solve(Balance::force))
      return false;
    face.is_balanced = false;
    rest.first = std::min(rest.first, k);
    rest.last = k;
  }
  neighbourhood = rest;
  return true;
}

bool Neighbourhoods::grow(Neighbourhood &neighbourhood) const
{
  constexpr unsigned int largest = 12;
  if (neighbourhood.last - neighbourhood.first >= largest)
    return false;
  const bool before = neighbourhood.first > 0 && are_neighbours(neighbourhood.first - 1),
             behind = are_neighbours(neighbourhood.last);
  neighbourhood.first -= before;
  neighbourhood.last += behind;
  return before || behind;
}

/** One of two that overlap, to be solved anew. */
void Neighbourhoods::merge()
{
  std::vector<Neighbourhood> merged;
  for (const Neighbourhood &next : all)
    if (!merged.empty() && next.first <= merged.back().last)
      merged.back() = {std::min(merged.back().first, next.first),
                       std::max(merged.back().last, next.last)};
    else
      merged.push_back(next);
  all = merged;
}

bool Neighbourhoods::solve()
{
  while (
      std::any_of(all.begin(), all.end(), [](const Neighbourhood &one) { return !one.is_solved; }))
  {
    for (Neighbourhood &one : all)
      if (!one.is_solved)
      {
        one.is_solved = solve(one);
        if (!one.is_solved && !grow(one) && !redistribute(one))
          return false;
      }
    merge();
  }
  return true;
}
} // namespace

template <int dim>
AdmissiblePressure<dim>::AdmissiblePressure(const Solution<dim> &solution)
    : parts(solution.contact_space.faces().size())
{
  static_assert(dim == 2, "vertices of edges");
  const LegendreTables legendre;
  std::map<unsigned int, PressedFace> faces;
  double scale = 0;
  for (unsigned int k = 0; k < parts.size(); ++k)
    if (const ContactFace<dim> &face = solution.contact_space.faces()[k]; !face.pressures.empty())
    {
      faces[k] = pressed_face(face, solution, legendre);
      for (const unsigned int pressure : face.pressures)
        scale = std::max(scale, std::abs(solution.z[pressure]));
    }
  const bool is_admissible = Neighbourhoods(faces, scale).solve();
  for (const auto &[k, face] : faces)
  {
    for (unsigned int end = 0; end < 2; ++end)
      parts[k][end] = EdgePolynomial({face.t[end].begin(), face.t[end].end()});
    if (!face.is_balanced)
      redistributed.push_back(k);
    if (!is_admissible)
      largest_tension = std::max(largest_tension, -face.least() / scale);
  }
}

template <int dim>
const EdgePolynomial &AdmissiblePressure<dim>::part(const unsigned int face,
                                                    const unsigned int end) const
{
  return parts[face][end];
}

template <int dim>
EdgePolynomial AdmissiblePressure<dim>::value(const unsigned int face) const
{
  return parts[face][0] + parts[face][1];
}

template <int dim>
double AdmissiblePressure<dim>::tension() const
{
  return largest_tension;
}

template <int dim>
bool AdmissiblePressure<dim>::is_balanced() const
{
  return redistributed.empty();
}

template <int dim>
Vector<double> AdmissiblePressure<dim>::missing_forces(const Solution<dim> &solution) const
{
  Vector<double> result(solution.u.size());
  for (const unsigned int k : redistributed)
  {
    const ContactFace<dim> &face = solution.contact_space.faces()[k];
    const unsigned int n = face.degree + 1;
    const Tensor<1, dim> normal = face.frame(0.5).normal;
    const auto dofs = solution.displacement_space.cell_dofs(face.cell->active_cell_index());
    const std::vector<unsigned int> &on_edge =
        solution.tables.numbering(face.degree).edge[face.face_no];
    const auto add = [&](const unsigned int node, const double force)
    {
      for (unsigned int c = 0; c < dim; ++c)
        result[dofs[on_edge[c * n + node]]] += force * normal[c];
    };
    // z_n at the nodes has their weights, as a multiplier it is integrated.
    const EdgePolynomial pi = value(k), z = discrete_pressure(face, solution);
    const QGaussLobatto<1> &nodes = solution.tables.gauss_lobatto(n);
    for (unsigned int j = 0, i = 0; face.at_nodes && j < n && i < face.pressures.size(); ++j)
      if (face.normal_points[i] == nodes.point(j)[0])
        add(j, face.length * nodes.weight(j) * solution.z[face.pressures[i++]]);
    const unsigned int n_gauss = pi.coefficients().size() + 1;
    const QGauss<1> &gauss = solution.tables.gauss(n_gauss);
    const FullMatrix<double> &shapes =
        solution.tables.edge(face.degree, face.n_points, n_gauss).shapes;
    for (unsigned int q = 0; q < n_gauss; ++q)
    {
      const double s = gauss.point(q)[0], rest = (face.at_nodes ? 0. : z(s)) - pi(s);
      for (unsigned int j = 0; j < n; ++j)
        add(j, face.length * gauss.weight(q) * rest * shapes(q, j));
    }
  }
  return result;
}

template <int dim>
double gap_on_face(const ContactFace<dim> &face, const double s)
{
  const auto gap = [&](const double t) { return face.condition->gap_at(face.point(t)); };
  const double value = gap(s);
  if (s > 0. && s < 1.)
    return value;
  const double inside = gap(std::abs(s - 1e-9));
  const bool jumps = std::abs(inside - value) > 1e-6 * std::abs(inside - gap(0.5)) &&
                     std::abs(inside - value) > 1e-6 * std::abs(value);
  return jumps ? inside : value;
}

template <int dim>
EdgePolynomial gap_at_nodes(const ContactFace<dim> &face, const ShapeTables<dim> &tables,
                            const LegendreTables &legendre)
{
  const unsigned int n = face.degree + 1;
  Vector<double> values(n), coefficients(n);
  for (unsigned int k = 0; k < n; ++k)
    values[k] = gap_on_face(face, tables.gauss_lobatto(n).point(k)[0]);
  legendre.from_nodes(face.degree).vmult(coefficients, values);
  return EdgePolynomial({coefficients.begin(), coefficients.end()});
}

template class AdmissiblePressure<2>;
template double gap_on_face(const ContactFace<2> &, double);
template EdgePolynomial gap_at_nodes(const ContactFace<2> &, const ShapeTables<2> &,
                                     const LegendreTables &);
} // namespace hpvi
