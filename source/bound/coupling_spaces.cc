// SPDX-License-Identifier: LGPL-2.1-or-later

// How strongly friction couples back is a number of the body, and a mesh that is fine where stresses of one load are
// singular is no better for it than another one. A space of its own, of high degree on few cells, stays the same from
// step to step, with its factor.
#include <hpvi/algebra/triangular.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/coupling_spaces.h>
#include <hpvi/plane/curved_edges.h>
#include <hpvi/plane/mesh.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Stiffness against tractions that would push along a free motion, over the largest of S. */
constexpr double hold = 1e5;

/** Bisections of an edge of the coarse mesh: what a mesh of a solution has at most. */
constexpr unsigned int most_bisections = 40;

/** Does contact with friction that knows the pressure act on this edge of a cell? */
bool has_coupling(const Triangulation<2>::cell_iterator &cell, const unsigned int face,
                  const Scene<2> &scene)
{
  return cell->at_boundary(face) && cell->face(face)->boundary_id() < scene.boundaries.size() &&
         scene.boundaries[cell->face(face)->boundary_id()].friction.knows_pressure();
}

template <class F>
void for_each_coupled_edge(const Triangulation<2> &mesh, const Scene<2> &scene, const F &f)
{
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (has_coupling(cell, face, scene))
        f(cell, face);
}

/** L of a symmetric matrix; false: it is not positive definite. */
bool factor(FullMatrix<double> &A)
{
  return A.m() == 0 || cholesky(A.m(), &A(0, 0), A.m());
}

} // namespace

FullMatrix<double> reduced(FullMatrix<double> A, const FullMatrix<double> &B,
                           const FullMatrix<double> &C)
{
  const unsigned int n = B.m(), m = B.n(), k = C.n();
  FullMatrix<double> result(m, k);
  if (n == 0 || m == 0 || k == 0)
    return result;
  if (!factor(A)) // its lower triangle by columns is the upper one of deal.II's rows
    throw NumericalFailure("the compliance of contact is not regular");
  const auto solved = [&](const FullMatrix<double> &right)
  {
    std::vector<double> Z(std::size_t(n) * right.n());
    for (unsigned int j = 0; j < right.n(); ++j)
      for (unsigned int i = 0; i < n; ++i)
        Z[std::size_t(j) * n + i] = right(i, j);
    solve_triangular('N', n, right.n(), {&A(0, 0), n}, Z.data(), n);
    return Z;
  };
  const std::vector<double> Z = solved(B), Y = &B == &C ? Z : solved(C);
  // deal.II's rows are columns here.
  multiply('T', 'N', k, m, n, 1., {Y.data(), n}, {Z.data(), n}, 0., &result(0, 0), k);
  return result;
}

FullMatrix<double> part(const FullMatrix<double> &A, const std::vector<unsigned int> &rows,
                        const std::vector<unsigned int> &columns)
{
  FullMatrix<double> result(rows.size(), columns.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
    for (unsigned int j = 0; j < columns.size(); ++j)
      result(i, j) = A(rows[i], columns[j]);
  return result;
}

double largest_of_tridiagonal(const std::vector<double> &diagonal,
                              const std::vector<double> &beside)
{
  double low = diagonal[0], high = diagonal[0];
  for (unsigned int i = 0; i < diagonal.size(); ++i)
  {
    const double radius = (i > 0 ? std::abs(beside[i - 1]) : 0.) +
                          (i + 1 < diagonal.size() ? std::abs(beside[i]) : 0.);
    low = std::max(low, diagonal[i]);
    high = std::max(high, diagonal[i] + radius);
  }
  for (unsigned int step = 0; step < 200 && high - low > 1e-14 * std::abs(high); ++step)
  {
    const double x = 0.5 * (low + high);
    bool is_above = false;
    double pivot = 1;
    for (unsigned int i = 0; i < diagonal.size() && !is_above; ++i)
    {
      const double square = i > 0 ? beside[i - 1] * beside[i - 1] : 0.;
      pivot = diagonal[i] - x - (i > 0 ? square / pivot : 0.);
      if (pivot == 0.)
        pivot = -std::numeric_limits<double>::min();
      is_above = pivot > 0.;
    }
    (is_above ? low : high) = x;
  }
  return high;
}

ContactCompliance::ContactCompliance(const Scene<2> &scene,
                                     std::shared_ptr<const Spaces<2>> all_spaces,
                                     CondensedElements<2> &elements,
                                     const std::function<void(const Solution<2> &)> &response)
    : spaces(std::move(all_spaces))
{
  const Discretisation<2> discretisation(scene, spaces, elements);
  const LinearSolver solver = discretisation.factor();
  const SchurComplement reduction(solver, discretisation.system.f, discretisation.contact_rows);
  const unsigned int n = spaces->contact_space.n_multipliers();
  S.reinit(n, n);
  double scale = 0;
  for (unsigned int i = 0; i < n; ++i)
  {
    for (unsigned int j = 0; j < n; ++j)
      S(i, j) = reduction.S()(i, j);
    scale = std::max(scale, S(i, i));
  }
  // Tractions that push along a free motion have no finite compliance.
  const auto &motions = discretisation.free_motions;
  const unsigned int n_motions = motions ? motions->balance().G.n() : 0;
  FullMatrix<double> along(n, n_motions); // times the root of that compliance, over the motion
  std::vector<double> amounts(n_motions);
  for (unsigned int m = 0; m < n_motions; ++m)
  {
    const FullMatrix<double> &G = motions->balance().G;
    double most = 0;
    for (unsigned int i = 0; i < n; ++i)
      most = std::max(most, std::abs(G(i, m)));
    amounts[m] = most > 0. ? std::sqrt(hold * scale) / most : 0.;
    for (unsigned int i = 0; i < n; ++i)
      along(i, m) = amounts[m] * G(i, m);
  }
  if (n_motions > 0)
    along.mTmult(S, along, /*adding=*/true);
  if (!response)
    return;
  const Vector<double> at_rest =
      discretisation.displacement(Vector<double>(discretisation.unknowns.n()));
  for (unsigned int i = 0; i < n; ++i)
  {
    Vector<double> z(n), of_motions(n_motions);
    z[i] = -1.;
    Vector<double> x = reduction.response(z);
    for (unsigned int m = 0; m < n_motions; ++m)
      of_motions[m] = amounts[m] * along(i, m);
    if (n_motions > 0)
      x += motions->at_unknowns(of_motions);
    Vector<double> u = discretisation.displacement(x);
    u -= at_rest;
    response(Solution<2>(scene, spaces, std::move(u), std::move(z)));
  }
}

const CouplingMatrices &ContactCompliance::matrices(const std::vector<unsigned int> &friction,
                                                    const std::vector<unsigned int> &pressures,
                                                    const std::vector<unsigned int> &held)
{
  const auto known =
      std::find_if(kept.begin(), kept.end(),
                   [&](const Known &one) { return one.friction == friction && one.held == held; });
  if (known != kept.end())
    kept.splice(kept.begin(), kept, known);
  else
  {
    FullMatrix<double> C = part(S, friction, friction), E(S.m(), pressures.size());
    const FullMatrix<double> of_held = part(S, held, friction);
    if (!held.empty())
      C.add(-1., reduced(part(S, held, held), of_held, of_held));
    for (unsigned int j = 0; j < pressures.size(); ++j)
      E(pressures[j], j) = 1.;
    kept.push_front({friction, held, CouplingMatrices(C, reduced(S, E, E))});
    if (kept.size() > 2)
      kept.pop_back();
  }
  return kept.front().matrices;
}

// @sect3{The largest eigenvalue}

CouplingMatrices::CouplingMatrices(const FullMatrix<double> &C, FullMatrix<double> given_Y)
    : L(C.m() * C.m()), Y(std::move(given_Y))
{
  const unsigned int n = C.m();
  FullMatrix<double> K(C);
  if (!factor(K)) // its lower triangle by columns is the upper one of deal.II's rows
    throw NumericalFailure("the compliance of contact is not regular");
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = j; i < n; ++i)
      L[std::size_t(j) * n + i] = K(j, i);
}

FullMatrix<double> CouplingMatrices::symmetric(const Vector<double> &D) const
{
  const unsigned int n = D.size();
  FullMatrix<double> scaled(n, n), half(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      scaled(i, j) = D[i] * Y(i, j) * D[j];
  half = times_factor(scaled);
  FullMatrix<double> other(n, n);
  other.copy_transposed(half);
  return times_factor(other);
}

FullMatrix<double> CouplingMatrices::times_factor(const FullMatrix<double> &A) const
{
  const unsigned int n = A.m(), m = A.n();
  FullMatrix<double> result(n, m);
  multiply('N', 'N', m, n, n, 1., {&A(0, 0), m}, {L.data(), n}, 0., &result(0, 0), m);
  return result;
}

FullMatrix<double> CouplingMatrices::by_factor(const FullMatrix<double> &A) const
{
  const unsigned int n = A.m(), m = A.n();
  FullMatrix<double> result(n, m);
  std::vector<double> columns(std::size_t(n) * m);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < m; ++j)
      columns[std::size_t(j) * n + i] = A(i, j);
  solve_triangular('N', n, m, {L.data(), n}, columns.data(), n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < m; ++j)
      result(i, j) = columns[std::size_t(j) * n + i];
  return result;
}

// Lanczos' method on L' D Y D L, whole sequence kept orthogonal: S has some hundred rows.
double CouplingMatrices::largest_eigenvalue(const Vector<double> &D) const
{
  const unsigned int n = D.size();
  if (n == 0 || D.all_zero())
    return 0.;
  if (known_D.size() == n && D == known_D)
    return known_value;
  Vector<double> q(n), y(n);
  for (unsigned int i = 0; i < n; ++i)
    q[i] = 1. + 0.3 * std::sin(7. * i + 1.);
  q /= q.l2_norm();
  const auto times = [&](const char op, const double *A)
  {
    multiply(op, 'N', n, 1, n, 1., {A, n}, {q.begin(), n}, 0., y.begin(), n);
    q.swap(y);
  };
  std::vector<double> basis, diagonal, beside, parts(n);
  for (unsigned int step = 0; step < n; ++step)
  {
    basis.insert(basis.end(), q.begin(), q.end());
    times('N', L.data());
    q.scale(D);
    times('N', &Y(0, 0));
    q.scale(D);
    times('T', L.data());
    for (unsigned int round = 0; round < 2; ++round)
    {
      multiply('T', 'N', step + 1, 1, n, 1., {basis.data(), n}, {q.begin(), n}, 0., parts.data(),
               n);
      multiply('N', 'N', n, 1, step + 1, -1., {basis.data(), n}, {parts.data(), n}, 1., q.begin(),
               n);
      if (round == 0)
        diagonal.push_back(parts[step]);
    }
    const double norm = q.l2_norm();
    if (norm <= 1e-12 * *std::max_element(diagonal.begin(), diagonal.end()))
      break;
    if (step > 10 && step % 5 == 0)
    {
      const double value = largest_of_tridiagonal(diagonal, beside),
                   before = largest_of_tridiagonal({diagonal.begin(), diagonal.end() - 1}, beside);
      if (value - before <= 1e-9 * value)
        break;
    }
    beside.push_back(norm);
    q /= norm;
  }
  known_D = D;
  known_value = largest_of_tridiagonal(diagonal, beside);
  return known_value;
}

// @sect3{Places along contact}

EdgePart::EdgePart(Triangulation<2>::cell_iterator cell, const unsigned int face)
    : face(face), begin(on_coarse_edge(cell, face, 0.)), end(on_coarse_edge(cell, face, 1.))
{
  while (cell->level() > 0)
    cell = cell->parent();
  coarse_cell = cell->index();
}

FrictionAlong::FrictionAlong(const std::vector<ContactFace<2>> &faces, const SlipDirection &chi,
                             const std::vector<bool> &sticks)
    : faces(faces), chi(chi), sticks(sticks)
{
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (chi[k])
    {
      add({EdgePart(faces[k].cell, faces[k].face_no), k, 0., 1., 1., {}});
      for (const ContactSegment<2> &segment : faces[k].segments)
      {
        const auto [first, last] = std::minmax(segment.at_begin, segment.at_end);
        Part part{EdgePart(segment.cell, segment.face_no).between(first, last),
                  k,
                  segment.begin,
                  segment.end,
                  segment.end - segment.begin,
                  {}};
        if (segment.at_begin > segment.at_end)
          std::swap(part.from, part.to);
        add(part);
      }
    }
}

void FrictionAlong::add(Part part)
{
  for (unsigned int i = 0; i < n_samples; ++i)
    part.samples[i] = on_part(part, part.edge.at(double(i) / (n_samples - 1))).coefficient;
  parts.push_back(part);
}

FrictionAlong::Value FrictionAlong::on_face(const unsigned int face, const double s) const
{
  const double coefficient =
      chi[face] ? faces[face].friction_coefficient(faces[face].point(s)) * chi[face](s) : 0.;
  return {coefficient, !sticks.empty() && sticks[face]};
}

/** At a place of the coarse edge. */
FrictionAlong::Value FrictionAlong::on_part(const Part &part, const double place) const
{
  return on_face(part.face, part.from + (place - part.edge.begin) / part.edge.length() *
                                            (part.to - part.from));
}

FrictionAlong::Value FrictionAlong::operator()(const EdgePart &edge, const double s,
                                               const Point<2> &place) const
{
  for (const Part &part : parts)
    if (part.edge.is_of_same_edge(edge) && edge.at(s) >= part.edge.begin &&
        edge.at(s) <= part.edge.end)
      return on_part(part, edge.at(s));
  throw NumericalFailure("friction at " + to_string(place) +
                         " is not found on the mesh of the step");
}

FrictionAlong::Variation FrictionAlong::along(const EdgePart &edge) const
{
  double low = std::numeric_limits<double>::infinity(), high = -low, shortest = low;
  const auto add = [&](const double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const Part &part : parts)
  {
    if (!edge.overlaps(part.edge))
      continue;
    const double begin = std::max(edge.begin, part.edge.begin),
                 end = std::min(edge.end, part.edge.end);
    for (unsigned int i = 0; i < n_samples; ++i)
      add(end - begin == part.edge.length()
              ? part.samples[i]
              : on_part(part, begin + (end - begin) * i / (n_samples - 1)).coefficient);
    shortest = std::min(shortest, part.edge.length() / part.share);
  }
  return high < low ? Variation{0., edge.length()} : Variation{high - low, shortest};
}

double FrictionAlong::largest() const
{
  double result = 0;
  for (const Part &part : parts)
    for (const double sample : part.samples)
      result = std::max(result, std::abs(sample));
  return result;
}

std::optional<Point<2>> FrictionAlong::missed_by(const std::vector<ContactFace<2>> &others) const
{
  std::vector<bool> is_seen(faces.size(), true);
  for (const Part &part : parts)
    if (part.share == 1. && part.samples[n_samples / 2] != 0.)
      is_seen[part.face] = false;
  for (const ContactFace<2> &other : others)
  {
    const EdgePart edge(other.cell, other.face_no);
    for (const Part &part : parts)
      is_seen[part.face] =
          is_seen[part.face] || (other.n_multipliers > 0 && part.edge.overlaps(edge));
  }
  const auto missed = std::find(is_seen.begin(), is_seen.end(), false);
  return missed == is_seen.end()
             ? std::nullopt
             : std::optional<Point<2>>(faces[missed - is_seen.begin()].point(0.5));
}

// @sect3{The space of a friction}
//
// A list of edges names a mesh: that whose contact edges are no longer.

CouplingSpaces::CouplingSpaces(const CouplingResolution &resolution) : resolution(resolution)
{
}

CouplingSpaces::~CouplingSpaces() = default;

void CouplingSpaces::begin(const Solution<2> &solution)
{
  if (scene)
    return;
  scene = &solution.scene;
  own_scene = solution.own_scene;
  first = solution.spaces;
  elements = std::make_unique<CondensedElements<2>>(*scene, *first->tables);
  Triangulation<2> coarse;
  make_mesh(*scene, coarse);
  coarse_edges = coupled_edges(coarse, *scene);
}

/** Contact ends at vertices where it does not go on without a corner. */
std::vector<CouplingSpaces::CoarseEdge>
CouplingSpaces::coupled_edges(const Triangulation<2> &coarse, const Scene<2> &scene)
{
  struct Around
  {
    std::vector<types::boundary_id> boundaries;
    std::vector<Tensor<1, 2>> normals;
  };
  std::map<unsigned int, Around> vertices;
  for (const auto &cell : coarse.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
        for (unsigned int end = 0; end < 2; ++end)
        {
          Around &around = vertices[cell->face(face)->vertex_index(end)];
          around.boundaries.push_back(cell->face(face)->boundary_id());
          around.normals.push_back(
              map_of<2>(cell).curve_normal(face, point_on_face<2>(face, Point<1>(end))));
        }
  const auto ends_at = [&](const unsigned int vertex)
  {
    const Around &around = vertices[vertex];
    return around.boundaries.size() != 2 || around.boundaries[0] != around.boundaries[1] ||
           std::abs(cross_product_2d(around.normals[0]) * around.normals[1]) > 1e-6;
  };
  std::vector<CoarseEdge> result;
  for_each_coupled_edge(coarse, scene,
                        [&](const auto &cell, const unsigned int face)
                        {
                          result.push_back({EdgePart(cell, face),
                                            {{ends_at(cell->face(face)->vertex_index(0)),
                                              ends_at(cell->face(face)->vertex_index(1))}}});
                        });
  return result;
}

std::vector<EdgePart> CouplingSpaces::wanted_edges(const FrictionAlong &friction) const
{
  const double most = resolution.variation * friction.largest();
  std::vector<EdgePart> result;
  const std::function<void(const CoarseEdge &, unsigned int)> add =
      [&](const CoarseEdge &part, const unsigned int level)
  {
    const auto &[edge, ends] = part;
    bool is_long = level < resolution.layers && (ends[0] || ends[1]);
    if (!is_long && level < most_bisections)
    {
      const FrictionAlong::Variation found = friction.along(edge);
      double shortest = resolution.shortest * found.shortest;
      // By whole threes of bisections: steps that bisect once more have the same space. Between bodies it is a new one anyway.
      if (!scene->has_pairs())
        shortest = std::exp2(3 * std::floor(std::log2(1.001 * shortest) / 3));
      is_long = found.height > most && edge.length() > 1.001 * shortest;
    }
    if (!is_long)
      return result.push_back(edge);
    add({edge.between(0., 0.5), {{ends[0], false}}}, level + 1);
    add({edge.between(0.5, 1.), {{false, ends[1]}}}, level + 1);
  };
  for (const CoarseEdge &edge : coarse_edges)
    add(edge, 0);
  return result;
}

std::shared_ptr<const Spaces<2>>
CouplingSpaces::space_with(const std::vector<EdgePart> &edges,
                           std::shared_ptr<Triangulation<2>> mesh) const
{
  for (bool is_changed = true; is_changed;)
  {
    is_changed = false;
    for_each_coupled_edge(*mesh, *scene,
                          [&](const auto &cell, const unsigned int face)
                          {
                            const EdgePart own(cell, face);
                            for (const EdgePart &wanted : edges)
                              if (own.overlaps(wanted) && wanted.length() < 0.75 * own.length())
                              {
                                cell->set_refine_flag();
                                is_changed = true;
                                return;
                              }
                          });
    mesh->execute_coarsening_and_refinement();
  }
  const Degrees degrees(mesh->n_active_cells(), resolution.degree);
  set_edge_degrees(*mesh, degrees);
  return std::make_shared<const Spaces<2>>(*scene, mesh, degrees, first->tables, first->loads);
}

ContactCompliance &CouplingSpaces::of(const Solution<2> &solution, const FrictionAlong &friction)
{
  begin(solution);
  std::vector<EdgePart> edges = wanted_edges(friction);
  const auto known =
      std::find_if(kept.begin(), kept.end(), [&](const auto &one) { return one.first == edges; });
  if (known != kept.end())
    kept.splice(kept.begin(), kept, known);
  else
  {
    const auto mesh = std::make_shared<Triangulation<2>>();
    make_mesh(*scene, *mesh);
    kept.emplace_front(std::piecewise_construct, std::forward_as_tuple(edges),
                       std::forward_as_tuple(*scene, space_with(edges, mesh), *elements));
    if (kept.size() > 4)
      kept.pop_back();
  }
  return kept.front().second;
}

ContactCompliance CouplingSpaces::on(
    std::shared_ptr<Triangulation<2>> mesh, const Solution<2> &solution,
    const FrictionAlong &friction,
    const std::function<std::function<void(const Solution<2> &)>(const Spaces<2> &)> &response)
{
  begin(solution);
  const std::shared_ptr<const Spaces<2>> spaces =
      space_with(wanted_edges(friction), std::move(mesh));
  return ContactCompliance(*scene, spaces, *elements, response(*spaces));
}
} // namespace hpvi
