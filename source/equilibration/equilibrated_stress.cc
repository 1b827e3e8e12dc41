// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/equilibration/equilibrated_stress.h>
#include <hpvi/equilibration/traction_system.h>
#include <hpvi/stresses/edge_polynomial.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Places of vertices along a face, in deal.II's order. */
constexpr unsigned int vertex_of_face[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};

/** Do the traction of an edge at the boundary and the outer normal agree, 1, or not, -1? */
double outward(const StressEdge &edge)
{
  return edge.sides[0].face % 2 ? 1. : -1.;
}

/** psi = c + c_x xi + c_y eta + c_xy xi eta from its values at the vertices. */
std::array<double, 4> bilinear(const std::array<double, 4> &v)
{
  return {{(v[0] + v[1] + v[2] + v[3]) / 4, (-v[0] + v[1] - v[2] + v[3]) / 4,
           (-v[0] - v[1] + v[2] + v[3]) / 4, (v[0] - v[1] - v[2] + v[3]) / 4}};
}

/** Times xi (0) or eta (1); what exceeds the highest mode is dropped. */
template <unsigned int n_components>
Modes<n_components> times(const unsigned int variable, const Modes<n_components> &modes)
{
  const unsigned int n = modes.n, step = variable == 0 ? n : 1, other_step = n + 1 - step;
  Modes<n_components> result(n);
  for (unsigned int power = 0; power + 1 < n; ++power)
  {
    const double shift = legendre::shift(power + 1);
    for (unsigned int k = 0; k < n_components; ++k)
    {
      const double *const from = &modes.coefficients[k * n * n + power * step];
      double *const to = &result.coefficients[k * n * n + power * step];
      for (unsigned int i = 0; i < n * other_step; i += other_step)
      {
        to[i + step] += shift * from[i];
        to[i] += shift * from[i + step];
      }
    }
  }
  return result;
}

/** The stress of a displacement whose discrete equations know but the projection of div u (Volume::projected). */
Modes<3> without_oscillating_pressure(Modes<3> sigma, const unsigned int p, const Tensor<2, 2> &B,
                                      const Material &material)
{
  const double lambda = material.lambda(2), mu = material.mu();
  const Tensor<2, 2> to_trace = transpose(B) * B, unit = invert(to_trace);
  for (unsigned int i = 0; i < sigma.n; ++i)
    for (unsigned int j = 0; j < sigma.n; ++j)
      if (i + j >= p)
      {
        const double trace = sigma(0, i, j) * to_trace[0][0] + sigma(1, i, j) * to_trace[1][1] +
                             2 * sigma(2, i, j) * to_trace[0][1];
        const double pressure = lambda / (2 * (lambda + mu)) * trace;
        sigma(0, i, j) -= pressure * unit[0][0];
        sigma(1, i, j) -= pressure * unit[1][1];
        sigma(2, i, j) -= pressure * unit[0][1];
      }
  return sigma;
}

/** A row of the symmetric tensor. */
Modes<2> row(const unsigned int k, const Modes<3> &s)
{
  const unsigned int size = s.n * s.n;
  Modes<2> result(s.n);
  for (const unsigned int c : {0, 1})
  {
    const auto from = s.coefficients.begin() + size * (k == c ? k : 2);
    std::copy(from, from + size, result.coefficients.begin() + size * c);
  }
  return result;
}

Tensor<1, 2> body_force(const Scene<2> &scene, const Point<2> &x)
{
  Tensor<1, 2> F;
  for (unsigned int c = 0; c < 2; ++c)
    if (scene.body_force[c])
      F[c] = scene.body_force[c]->value(x);
  return F;
}

void add(Modes<2> &sum, const Modes<2> &part)
{
  for (unsigned int k = 0; k < 2; ++k)
    for (unsigned int i = 0; i < std::min(sum.n, part.n); ++i)
      for (unsigned int j = 0; j < std::min(sum.n, part.n); ++j)
        sum(k, i, j) += part(k, i, j);
}
} // namespace

EquilibratedStress::EquilibratedStress(const Solution<2> &solution, const Parts &friction,
                                       const Parts &pressure, EquilibrationCache &cache,
                                       const Solution<2> *const measured, const Volume volume)
    : squares(solution.displacement_space.degrees().size()), solution(solution), cache(cache),
      volume(volume), vertex_patches(solution, has_distorted_cells(solution))
{
  const auto &faces = solution.contact_space.faces();
  contact_parts.resize(faces.size());
  for (unsigned int face = 0; face < faces.size(); ++face)
    for (unsigned int end = 0; end < 2; ++end)
    {
      contact_parts[face].friction[end] = friction(face, end);
      if (faces[face].condition->is_unilateral())
        contact_parts[face].pressure[end] = pressure(face, end);
    }
  known.resize(vertex_patches.edges().size());
  for (unsigned int e = 0; e < known.size(); ++e)
    if (vertex_patches.edges()[e].at_boundary())
      set_known_tractions(e);
  if (vertex_patches.has_macro_cells)
    macro_stresses = std::make_unique<const MacroStresses>(solution, vertex_patches, cache);
  else
  {
    set_cells();
    set_data();
  }
  set_tractions();
  if (measured)
    measure_from(*measured);
  measure();
  cache.drop_unused();
}

const VertexPatches &EquilibratedStress::patches() const
{
  return vertex_patches;
}

const std::vector<std::array<std::vector<double>, 2>> &EquilibratedStress::tractions() const
{
  return sums;
}

/** Adds `weight psi traction` at s in [0,1] of an edge, psi the hat function of one end. */
void EquilibratedStress::add_load(const unsigned int index, const unsigned int end, const double s,
                                  const double weight, const Tensor<1, 2> &traction)
{
  const StressEdge &edge = vertex_patches.edges()[index];
  const std::vector<double> L = legendre::values(edge.degree, 2 * s - 1);
  const double psi = end == 0 ? 1 - s : s;
  for (unsigned int c = 0; c < 2; ++c)
  {
    std::vector<double> &coefficients = known[index][end][c];
    const double value = 2 * weight * psi * (traction * edge.components[c].direction);
    for (unsigned int i = 0; i < coefficients.size(); ++i)
      coefficients[i] += value * L[i];
  }
}

/** That of the discrete equations. */
LoadRule<1> EquilibratedStress::load_rule(const StressEdge &edge) const
{
  const StressEdge::Side &side = edge.sides[0];
  return solution.spaces->loads->traction(vertex_patches.cells()[side.cell].iterator, side.face,
                                          solution.displacement_space.degrees()[side.cell]);
}

Tensor<1, 2> EquilibratedStress::load_on(const StressEdge &edge, const double s) const
{
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  const StressEdge::Side &side = edge.sides[0];
  const auto face = vertex_patches.cells()[side.cell].iterator->face(side.face);
  const Point<2> x = face->vertex(0) + s * (face->vertex(1) - face->vertex(0));
  Tensor<1, 2> result;
  for (unsigned int c = 0; c < 2; ++c)
    if (condition.traction[c])
      result[c] = outward(edge) * condition.traction[c]->value(x);
  return result;
}

/** `-g l t` with the polynomial l of one end. */
Tensor<1, 2> EquilibratedStress::friction_on(const StressEdge &edge, const unsigned int end,
                                             const double s, const double bound) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[edge.contact_face];
  return -outward(edge) * bound *
         legendre::evaluate(contact_parts[edge.contact_face].friction[end], 2 * s - 1) *
         face.frame(s).tangent;
}

/**
 * What loads and contact prescribe on an edge of the boundary, in the direction of the edge's traction.
 * Loads have the quadrature of the discrete equations, so that moments are the same.
 */
void EquilibratedStress::set_known_tractions(const unsigned int index)
{
  const StressEdge &edge = vertex_patches.edges()[index];
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  Quadrature<1> loads;
  if (condition.has_traction())
    loads = load_rule(edge).quadrature;
  for (unsigned int end = 0; end < 2; ++end)
  {
    for (unsigned int c = 0; c < 2; ++c)
      known[index][end][c].assign(edge.components[c].n, 0.);
    for (unsigned int q = 0; q < loads.size(); ++q)
      add_load(index, end, loads.point(q)[0], loads.weight(q), load_on(edge, loads.point(q)[0]));
    if (edge.contact_face != numbers::invalid_unsigned_int)
    {
      const FrictionRule rule = traction_rule(solution.contact_space.faces()[edge.contact_face],
                                              edge.degree - 2, solution.tables);
      for (unsigned int q = 0; q < rule.points.size(); ++q)
        add_load(index, end, rule.points[q], rule.weights[q],
                 friction_on(edge, end, rule.points[q], rule.values[q]));
      const std::vector<double> &t = contact_parts[edge.contact_face].pressure[end];
      for (unsigned int i = 0; i < t.size(); ++i)
        known[index][end][0][i] -= t[i];
    }
    meet_ends(edge, end, prescribed_traction(index, end));
  }
}

Tensor<1, 2> EquilibratedStress::prescribed_traction(const unsigned int index, const double s) const
{
  const StressEdge &edge = vertex_patches.edges()[index];
  Tensor<1, 2> result = load_on(edge, s);
  if (edge.contact_face == numbers::invalid_unsigned_int)
    return result;
  const ContactFace<2> &face = solution.contact_space.faces()[edge.contact_face];
  const auto &[friction, pressure] = contact_parts[edge.contact_face];
  const auto at = [s](const std::vector<double> &part)
  { return legendre::evaluate(part, 2 * s - 1); };
  const double l = (1 - s) * at(friction[0]) + s * at(friction[1]);
  return result - outward(edge) * face.friction_bound(face.point(s)) * l * face.frame(s).tangent -
         (at(pressure[0]) + at(pressure[1])) * edge.normal;
}

std::vector<std::pair<double, double>>
EquilibratedStress::prescribed_points(const unsigned int index) const
{
  const StressEdge &edge = vertex_patches.edges()[index];
  std::vector<double> cuts = {0., 1.};
  unsigned int n = 8;
  if (solution.scene.boundaries[edge.boundary].has_traction())
  {
    const LoadRule<1> rule = load_rule(edge);
    cuts = rule.cuts;
    n = std::max(n, rule.most_points);
  }
  if (edge.contact_face != numbers::invalid_unsigned_int)
  {
    const auto &others = solution.contact_space.faces()[edge.contact_face].friction.cuts;
    cuts.insert(cuts.end(), others.begin(), others.end());
    std::sort(cuts.begin(), cuts.end());
  }
  const QGauss<1> &gauss = solution.tables.gauss(edge.degree + n);
  std::vector<std::pair<double, double>> result;
  for (unsigned int piece = 0; piece + 1 < cuts.size(); ++piece)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double length = cuts[piece + 1] - cuts[piece];
      result.emplace_back(cuts[piece] + length * gauss.point(q)[0], length * gauss.weight(q));
    }
  return result;
}

/** |F - Pi F| on a cell. */
double EquilibratedStress::missed_force(const unsigned int index) const
{
  if (macro_stresses)
    return macro_stresses->missed_force(index);
  const Cell &cell = cells[index];
  const Modes<2> &modes = cell.force;
  if (modes.n == 0)
    return 0.;
  const unsigned int m = cell.element->m;
  const CellMap<2> map = map_of<2>(vertex_patches.cells()[index].iterator);
  const auto &loads = *solution.spaces->loads;
  const auto &iterator = vertex_patches.cells()[index].iterator;
  const LoadRule<2> own = loads.body_force(iterator, solution.displacement_space.degrees()[index]);
  const Quadrature<2> rule = own.n_gauss > 0 ? Quadrature<2>(solution.tables.gauss(modes.n + 2))
                                             : loads.body_force(iterator, m).quadrature;
  double sum = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const auto L_x = legendre::values(modes.n, 2 * rule.point(q)[0] - 1),
               L_y = legendre::values(modes.n, 2 * rule.point(q)[1] - 1);
    Tensor<1, 2> projected;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < std::min(modes.n, m - k); ++i)
        for (unsigned int j = 0; j < std::min(modes.n, m - 1 + k); ++j)
          projected[k] -= modes(k, i, j) * L_x[i] * L_y[j];
    const Tensor<1, 2> missed =
        body_force(solution.scene, map.point(rule.point(q))) - cell.B * projected / cell.h;
    sum += rule.weight(q) * missed.norm_square();
  }
  return std::sqrt(sum) * 2 * cell.h;
}

const LegendreTables &EquilibratedStress::legendre_tables() const
{
  return cache.legendre;
}

/**
 * The shear at the ends of an edge is that of the neighbouring edges, whatever projections are; the two highest modes
 * of a component that is known, of the tangential one if it is, make it so.
 */
void EquilibratedStress::meet_ends(const StressEdge &edge, const unsigned int end,
                                   const Tensor<1, 2> &at_end)
{
  auto &parts = known[&edge - vertex_patches.edges().data()][end];
  std::array<double, 2> weights, missing{{0., 0.}};
  for (unsigned int c = 0; c < 2; ++c)
  {
    const StressEdge::Component &component = edge.components[c];
    weights[c] = component.is_unknown ? 0. : edge.weight_in_shear(component);
    missing[end] += weights[c] * (at_end * component.direction);
    for (unsigned int i = 0; i < component.n; ++i)
      for (unsigned int side = 0; side < 2; ++side)
        missing[side] -= weights[c] * parts[c][i] * legendre::at_end(i, side);
  }
  const unsigned int by = weights[1] != 0., n = edge.components[by].n;
  for (const unsigned int i : {n - 2, n - 1})
    for (unsigned int side = 0; weights[by] != 0. && side < 2; ++side)
      parts[by][i] += missing[side] / weights[by] * legendre::at_end(i, side) / (2 * i + 1);
}

/** S_xy at one end of a boundary edge, as far as it is known. */
EquilibratedStress::EndShear EquilibratedStress::end_shear(const unsigned int index,
                                                           const unsigned int end) const
{
  const StressEdge &edge = vertex_patches.edges()[index];
  EndShear result;
  for (unsigned int c = 0; c < 2; ++c)
  {
    const StressEdge::Component &component = edge.components[c];
    const double weight = edge.weight_in_shear(component);
    if (component.is_unknown)
    {
      result.is_free |= std::abs(component.direction * edge.tangent) > 1. - 1e-12;
      result.leans |= weight != 0.;
      continue;
    }
    double value = 0;
    for (unsigned int i = 0; i < component.n; ++i)
      value += known[index][end][c][i] * legendre::at_end(i, end);
    result.known += weight * value;
    result.scale += std::abs(value);
  }
  return result;
}

/**
 * Corners of cells, by bits, where the edges of the boundary that meet prescribe different shears. The cells
 * of both share the difference, that of one cell takes it. So they do where other boundaries meet and the shear of one leans on an unknown traction that is not along it: 
 * that alone could pay for the difference, but by the more the less it leans. Equal shears differ by round-off of the largest
 * one, more so where vertices far from the origin are rounded.
 */
std::vector<unsigned int> EquilibratedStress::marked_corners() const
{
  std::vector<unsigned int> result(vertex_patches.cells().size());
  std::map<unsigned int, std::vector<std::pair<unsigned int, unsigned int>>> ends;
  const std::vector<StressEdge> &all = vertex_patches.edges();
  for (unsigned int e = 0; e < all.size(); ++e)
    if (all[e].at_boundary())
      for (unsigned int end = 0; end < 2; ++end)
        ends[all[e].vertices[end]].emplace_back(e, end);
  double largest = 0;
  for (const auto &[vertex, edges] : ends)
    for (const auto &[e, end] : edges)
      largest = std::max(largest, end_shear(e, end).scale);
  for (const auto &[vertex, edges] : ends)
  {
    const StressEdge &first = all[edges[0].first], &second = all[edges[1].first];
    const EndShear one = end_shear(edges[0].first, edges[0].second),
                   other = end_shear(edges[1].first, edges[1].second);
    const bool differs = std::abs(one.known - other.known) > 1e-10 * largest,
               leans = first.boundary != second.boundary && (one.leans || other.leans);
    if (one.is_free || other.is_free || !(differs || leans))
      continue;
    for (const auto &[e, end] : edges)
      result[all[e].sides[0].cell] |= 1u << vertex_of_face[all[e].sides[0].face][end];
  }
  return result;
}

Tensor<2, 2> EquilibratedStress::frame(const unsigned int cell) const
{
  const Tensor<2, 2> J = map_of<2>(vertex_patches.cells()[cell].iterator).jacobian({0.5, 0.5});
  return J / std::sqrt(determinant(J));
}

void EquilibratedStress::set_cells()
{
  const std::vector<unsigned int> marked = marked_corners();
  cells.resize(marked.size());
  for (unsigned int index = 0; index < cells.size(); ++index)
  {
    Cell &cell = cells[index];
    const auto &iterator = vertex_patches.cells()[index].iterator;
    const CellMap<2> map = map_of<2>(iterator);
    cell.B = frame(index);
    cell.h = std::sqrt(determinant(map.jacobian({0.5, 0.5}))) / 2;
    unsigned int m = 0;
    for (const unsigned int edge : vertex_patches.cells()[index].edges)
      m = std::max(m, vertex_patches.edges()[edge].degree);
    EquilibrationCache::Signature key = {m, iterator->material_id(), marked[index]};
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        key.push_back(std::lround(1e11 * cell.B[i][j]));
    auto &element = cache.elements[key];
    if (!element)
      element = std::make_unique<const StressElement>(
          m, cell.B, solution.scene.material_of(iterator), marked[index]);
    cell.element = element.get();
    set_stress(index, solution);
    if (solution.scene.has_body_force())
      set_force(index);
    Batch &batch = batches[cell.element];
    cell.place = batch.cells.size();
    cell.first_hat = batch.n_hats;
    batch.cells.push_back(index);
    batch.n_hats += vertex_patches.cells()[index].hats.size();
  }
}

/** sigma(u_N) = B S B' and F = B f/h in the frame of the cell. */
void EquilibratedStress::set_stress(const unsigned int index, const Solution<2> &of)
{
  Cell &cell = cells[index];
  const auto &iterator = vertex_patches.cells()[index].iterator;
  const unsigned int p = solution.displacement_space.degrees()[index];
  const HookesLaw<2> law(solution.scene.material_of(iterator));
  const Tensor<2, 2> inverse = invert(cell.B);
  cell.sigma = Modes<3>(cell.element->m + 1);
  const std::vector<double> coefficients = of.coefficients(index);
  for (unsigned int c = 0; c < 2; ++c)
  {
    const FullMatrix<double> U = cache.legendre.displacement_modes(coefficients, c, p);
    for (unsigned int d = 0; d < 2; ++d)
    {
      Tensor<2, 2> reference;
      reference[c][d] = 1 / cell.h;
      const Tensor<2, 2> s =
          inverse * Tensor<2, 2>(law.stress(reference * inverse)) * transpose(inverse);
      const std::array<double, 3> weights{{s[0][0], s[1][1], s[0][1]}};
      for (unsigned int b = 0; b <= p; ++b)
      {
        std::array<double, 2> sums{{0., 0.}}; // L_i' = root(i) sum root(a) L_a, a = i-1, i-3, ...
        for (unsigned int i = p; i > 0; --i)
        {
          const unsigned int a = i - 1;
          sums[i % 2] += legendre::root(i) * (d == 0 ? U(i, b) : U(b, i));
          for (unsigned int k = 0; k < 3; ++k)
            cell.sigma(k, d == 0 ? a : b, d == 0 ? b : a) +=
                weights[k] * legendre::root(a) * sums[i % 2];
        }
      }
    }
  }
}

/**
 * Interpolated at the points of the loads, so that psi F has the moments with rigid motions that the discrete
 * equations have.
 */
void EquilibratedStress::set_force(const unsigned int index)
{
  Cell &cell = cells[index];
  const CellMap<2> map = map_of<2>(vertex_patches.cells()[index].iterator);
  const LoadRule<2> rule = solution.spaces->loads->body_force(
      vertex_patches.cells()[index].iterator, solution.displacement_space.degrees()[index]);
  const unsigned int n = rule.n_gauss;
  if (n == 0)
    return set_force(index, rule.quadrature);
  const QGauss<1> &gauss = solution.tables.gauss(n);
  const Tensor<2, 2> inverse = invert(cell.B);
  std::array<FullMatrix<double>, 2> values{{FullMatrix<double>(n, n), FullMatrix<double>(n, n)}};
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = 0; b < n; ++b)
    {
      const Tensor<1, 2> F =
          body_force(solution.scene, map.point(Point<2>(gauss.point(a)[0], gauss.point(b)[0])));
      const Tensor<1, 2> f = -cell.h * (inverse * F);
      for (unsigned int k = 0; k < 2; ++k)
        values[k](a, b) = f[k];
    }
  const FullMatrix<double> &project = cache.legendre.projection(n, n);
  FullMatrix<double> half(n, n), modes(n, n);
  cell.force = Modes<2>(n);
  for (unsigned int k = 0; k < 2; ++k)
  {
    project.mmult(half, values[k]);
    half.mTmult(modes, project);
    std::copy(&modes(0, 0), &modes(0, 0) + n * n, &cell.force.coefficients[k * n * n]);
  }
}

/** The same by any other rule: moments with polynomials as high as the element and psi take. */
void EquilibratedStress::set_force(const unsigned int index, const Quadrature<2> &rule)
{
  Cell &cell = cells[index];
  const CellMap<2> map = map_of<2>(vertex_patches.cells()[index].iterator);
  const unsigned int n = cell.element->m + 2;
  const Tensor<2, 2> inverse = invert(cell.B);
  cell.force = Modes<2>(n);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const Tensor<1, 2> f = -4 * rule.weight(q) * cell.h *
                           (inverse * body_force(solution.scene, map.point(rule.point(q))));
    const auto L_x = legendre::values(n, 2 * rule.point(q)[0] - 1),
               L_y = legendre::values(n, 2 * rule.point(q)[1] - 1);
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          cell.force(k, i, j) += f[k] * L_x[i] * L_y[j];
  }
}

/**
 * Columns of data of one cell: of `psi sigma` with divergence `sigma grad psi - psi F` for the bilinear
 * functions psi.
 */
void EquilibratedStress::set_data(const unsigned int index, double *const r) const
{
  const StressElement &element = *cells[index].element;
  const Material &material = solution.scene.material_of(vertex_patches.cells()[index].iterator);
  Modes<3> stable;
  const bool is_projected = volume == Volume::projected && material.is_nearly_incompressible(2);
  if (is_projected)
    stable = without_oscillating_pressure(
        cells[index].sigma, solution.displacement_space.degrees()[index], cells[index].B, material);
  const Modes<3> &sigma = is_projected ? stable : cells[index].sigma;
  const Modes<3> times_xi = times(0, sigma), times_eta = times(1, sigma);
  const Modes<2> &force = cells[index].force, force_xi = times(0, force);
  const auto add_column =
      [&](const unsigned int k, const Modes<3> &product, Modes<2> divergence, const Modes<2> &load)
  {
    add(divergence, load);
    element.residual(product, divergence, r + std::size_t(k) * element.n_data);
  };
  add_column(0, sigma, Modes<2>(sigma.n), force);
  add_column(1, times_xi, row(0, sigma), force_xi);
  add_column(2, times_eta, row(1, sigma), times(1, force));
  Modes<2> both = row(0, times_eta);
  add(both, row(1, times_xi));
  add_column(3, times(1, times_xi), both, times(1, force_xi));
}

/** Appends `matrix' r` for each hat function of some cells, from r for each of the bilinear functions. */
void EquilibratedStress::add_to_hats(const std::vector<unsigned int> &some_cells,
                                     const std::vector<double> &matrix,
                                     const std::vector<double> &r,
                                     std::vector<double> &result) const
{
  const unsigned int n_columns = n_bilinear * some_cells.size(), n_data = r.size() / n_columns,
                     n_rows = matrix.size() / n_data;
  std::vector<double> products(std::size_t(n_rows) * n_columns);
  multiply('T', 'N', n_rows, n_columns, n_data, 1., {matrix.data(), n_data}, {r.data(), n_data}, 0.,
           products.data(), n_rows);
  const double *product = products.data();
  for (const unsigned int index : some_cells)
  {
    for (const VertexPatches::Hat &hat : vertex_patches.cells()[index].hats)
    {
      const std::array<double, n_bilinear> c = bilinear(hat.values);
      for (unsigned int i = 0; i < n_rows; ++i)
        result.push_back(c[0] * product[i] + c[1] * product[n_rows + i] +
                         c[2] * product[2 * n_rows + i] + c[3] * product[3 * n_rows + i]);
    }
    product += std::size_t(n_bilinear) * n_rows;
  }
}

/** Some cells at a time: what they need on the way stays in the cache. */
void EquilibratedStress::set_data()
{
  constexpr unsigned int at_once = 64;
  std::vector<unsigned int> some_cells;
  std::vector<double> r;
  for (auto &[element, batch] : batches)
  {
    const std::size_t n = element->n_data, column = n * n_bilinear;
    batch.r.reserve(n * batch.cells.size());
    batch.gradients.reserve(std::size_t(element->n_edges) * batch.n_hats);
    batch.defects.reserve(std::size_t(element->n_conditions()) * batch.n_hats);
    for (unsigned int first = 0; first < batch.cells.size(); first += at_once)
    {
      const auto begin = batch.cells.begin() + first;
      some_cells.assign(begin, begin + std::min<std::size_t>(at_once, batch.cells.end() - begin));
      r.resize(column * some_cells.size());
      for (unsigned int k = 0; k < some_cells.size(); ++k)
      {
        set_data(some_cells[k], &r[column * k]);
        batch.r.insert(batch.r.end(), &r[column * k], &r[column * k] + n);
      }
      add_to_hats(some_cells, element->edge_energy(), r, batch.gradients);
      add_to_hats(some_cells, element->conditions(), r, batch.defects);
    }
  }
}

/** Of sigma with divergence -F. */
void EquilibratedStress::set_own_data(const unsigned int index)
{
  const Cell &cell = cells[index];
  const std::size_t n = cell.element->n_data;
  cell.element->residual(cell.sigma, cell.force, &batches.at(cell.element).r[n * cell.place]);
}

PatchCell EquilibratedStress::patch_cell(const unsigned int index, const unsigned int hat) const
{
  if (macro_stresses)
    return macro_stresses->patch_cell(index, hat);
  const Cell &cell = cells[index];
  const Batch &batch = batches.at(cell.element);
  const std::size_t column = cell.first_hat + hat;
  return {traction_energy(*cell.element), cell.h * cell.h,
          &batch.gradients[column * cell.element->n_edges],
          &batch.defects[column * cell.element->n_conditions()], &vertex_patches.cells()[index]};
}

/** By patches, or all at once where cells are so long that hat functions would cost too much. */
void EquilibratedStress::set_tractions()
{
  for (const StressEdge &edge : vertex_patches.edges())
    sums.push_back(
        {{std::vector<double>(edge.components[0].n), std::vector<double>(edge.components[1].n)}});
  if (has_long_cells(solution))
    solve_all_cells();
  else
    solve_patches();
  double largest = 0;
  for (const auto &edge : sums)
    for (const auto &component : edge)
      for (const double coefficient : component)
        largest = std::max(largest, std::abs(coefficient));
  defect = defect == 0 ? 0. : defect / largest;
}

void EquilibratedStress::solve_patches()
{
  std::vector<PatchCell> patch;
  std::vector<PatchEdge> edges;
  for (const auto &[vertex, hats] : vertex_patches.patches())
  {
    patch.clear();
    edges.clear();
    auto ordered = hats; // by shape, not by number: patches of one shape share their factor
    std::stable_sort(ordered.begin(), ordered.end(),
                     [&](const auto &a, const auto &b)
                     {
                       return vertex_patches.cells()[a.first].hats[a.second].values >
                              vertex_patches.cells()[b.first].hats[b.second].values;
                     });
    for (const auto &[index, hat] : ordered)
    {
      patch.push_back(patch_cell(index, hat));
      const VertexPatches::Cell &cell = vertex_patches.cells()[index];
      const std::array<double, 4> &psi = cell.hats[hat].values;
      for (unsigned int face = 0; face < 4; ++face)
      {
        const unsigned int e = cell.edges[face];
        const bool first = psi[vertex_of_face[face][0]] != 0;
        const StressEdge &edge = vertex_patches.edges()[e];
        if ((first || psi[vertex_of_face[face][1]] != 0) && // linear along an edge that hangs here
            std::none_of(edges.begin(), edges.end(),
                         [&](const PatchEdge &other) { return other.index == e; }))
          edges.push_back(
              {e, &edge, edge.at_boundary() ? &known[e][first ? 0 : 1] : nullptr, &sums[e]});
      }
    }
    const PatchDefect missed = solve_patch(patch, edges, cache);
    if (const double most = std::max(missed.equilibrium, missed.corners); !(most <= defect))
    {
      defect = most;
      worst_vertex = vertex;
      is_worst_in_corners = missed.corners > missed.equilibrium;
    }
  }
}

/** Hat functions sum to 1, and so do their data. */
void EquilibratedStress::solve_all_cells()
{
  std::vector<PatchCell> all_cells;
  std::vector<PatchEdge> all_edges;
  std::vector<std::vector<double>> data; // gradient and defect of each cell
  for (unsigned int index = 0; index < vertex_patches.cells().size(); ++index)
  {
    PatchCell cell = patch_cell(index, 0);
    const unsigned int n_edges = cell.element.n_edges(), n_conditions = cell.element.n_conditions;
    std::vector<double> sum(n_edges + n_conditions);
    for (unsigned int hat = 0; hat < vertex_patches.cells()[index].hats.size(); ++hat)
    {
      const PatchCell part = patch_cell(index, hat);
      for (unsigned int i = 0; i < n_edges; ++i)
        sum[i] += part.gradient[i];
      for (unsigned int i = 0; i < n_conditions; ++i)
        sum[n_edges + i] += part.defect[i];
    }
    data.push_back(std::move(sum));
    cell.gradient = data.back().data();
    cell.defect = cell.gradient + n_edges;
    all_cells.push_back(cell);
  }
  std::vector<std::array<std::vector<double>, 2>> given(vertex_patches.edges().size());
  for (unsigned int e = 0; e < given.size(); ++e)
  {
    const StressEdge &edge = vertex_patches.edges()[e];
    for (unsigned int c = 0; edge.at_boundary() && c < 2; ++c)
      for (unsigned int i = 0; i < edge.components[c].n; ++i)
        given[e][c].push_back(known[e][0][c][i] + known[e][1][c][i]);
    all_edges.push_back({e, &edge, edge.at_boundary() ? &given[e] : nullptr, &sums[e]});
  }
  const WorstCondition worst = solve_all(all_cells, all_edges, cache.legendre);
  defect = worst.missed;
  is_worst_in_corners = worst.corner != numbers::invalid_unsigned_int;
  worst_vertex = vertex_patches.cells()[worst.cell].iterator->vertex_index(
      is_worst_in_corners ? worst.corner : 0);
}

void EquilibratedStress::add_tractions(const unsigned int index, const TractionEnergy &element,
                                       double *const all) const
{
  const VertexPatches::Cell &geometry = vertex_patches.cells()[index];
  for (unsigned int face = 0; face < 4; ++face)
  {
    const StressEdge &edge = vertex_patches.edges()[geometry.edges[face]];
    const unsigned int part = geometry.parts[face];
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int row = 0; row < 2; ++row)
      {
        const StressEdge::Component &component = edge.components[c];
        const double weight = component.direction * (row == 0 ? edge.normal : edge.tangent);
        if (weight == 0.)
          continue;
        const std::vector<double> &t = sums[geometry.edges[face]][c];
        double *const target = all + element.edge_entry(face, row);
        const FullMatrix<double> *const half =
            part == whole_edge ? nullptr : &cache.legendre.half(component.n, part);
        for (unsigned int i = 0; i < component.n; ++i)
          if (!half)
            target[i] += weight * t[i];
          else
            for (unsigned int j = 0; j < component.n; ++j)
              target[i] += weight * (*half)(i, j) * t[j];
      }
  }
}

/** Tractions and loads of a cell without those of sigma(u_N). */
std::vector<double> EquilibratedStress::data_of(const unsigned int index) const
{
  const Cell &cell = cells[index];
  const StressElement &element = *cell.element;
  const double *const column = &batches.at(&element).r[std::size_t(element.n_data) * cell.place];
  std::vector<double> r(column, column + element.n_data);
  add_tractions(index, traction_energy(element), &r[element.n_divergence]);
  return r;
}

std::vector<double> EquilibratedStress::macro_tractions(const unsigned int cell) const
{
  const TractionEnergy element = macro_stresses->patch_cell(cell, 0).element;
  std::vector<double> result(element.n_edges());
  add_tractions(cell, element, result.data());
  return result;
}

void EquilibratedStress::measure()
{
  for (unsigned int cell = 0; macro_stresses && cell < squares.size(); ++cell)
    squares[cell] = macro_stresses->square(cell, macro_tractions(cell));
  for (const auto &[element, batch] : batches)
  {
    std::vector<double> R;
    R.reserve(std::size_t(element->n_data) * batch.cells.size());
    for (const unsigned int index : batch.cells)
    {
      const std::vector<double> r = data_of(index);
      R.insert(R.end(), r.begin(), r.end());
    }
    element->half_energy(R, batch.cells.size());
    for (unsigned int k = 0; k < batch.cells.size(); ++k)
    {
      const double *const y = &R[std::size_t(k) * element->n_data];
      squares[batch.cells[k]] =
          std::pow(cells[batch.cells[k]].h, 2) * std::inner_product(y, y + element->n_data, y, 0.);
    }
  }
}

void EquilibratedStress::measure_from(const Solution<2> &other)
{
  if (macro_stresses)
    macro_stresses = std::make_unique<const MacroStresses>(other, vertex_patches, cache);
  for (unsigned int index = 0; index < cells.size(); ++index)
  {
    set_stress(index, other);
    set_own_data(index);
  }
}

bool EquilibratedStress::has_macro_cells() const
{
  return vertex_patches.has_macro_cells;
}

Tensor<2, 2> EquilibratedStress::macro_value(const unsigned int cell,
                                             const Point<2> &reference) const
{
  return macro_stresses->value(cell, macro_tractions(cell), reference);
}

StressElement::Stress EquilibratedStress::stress(const unsigned int cell) const
{
  return cells[cell].element->stress(cells[cell].sigma, data_of(cell).data());
}
} // namespace hpvi
