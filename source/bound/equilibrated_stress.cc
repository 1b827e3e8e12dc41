// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/bound/equilibrated_stress.h>
#include <hpvi/bound/patches.h>
#include <hpvi/bound/traction_system.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/plane/springs.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Of springs, by cell: `int k (start - u_N)^2`, what they exert on the displacement that the stress is made of less what
 * they exert on the measured one, a term of eta^2 as |sigma(u_N) - s|^2 is.
 */
void add_spring_squares(const Solution<2> &start, const Solution<2> &measured,
                        std::vector<double> &squares)
{
  Vector<double> change(start.u), forces(change.size());
  change -= measured.u;
  for (const SpringFace &face :
       spring_faces(measured.scene, measured.displacement_space, measured.tables))
    squares[face.cell] += add_spring_forces({face}, change, forces);
}

/** The parts of a hat function: cell, and number in it. */
using Hats = std::vector<std::pair<unsigned int, unsigned int>>;

/** Not by number: patches of one shape share their factor. */
Hats by_shape(const VertexPatches::Patch &patch, const VertexPatches &vertex_patches)
{
  Hats hats(patch.cells.begin(), patch.cells.end());
  std::stable_sort(hats.begin(), hats.end(),
                   [&](const auto &a, const auto &b)
                   {
                     return vertex_patches.cells()[a.first].hats[a.second].values >
                            vertex_patches.cells()[b.first].hats[b.second].values;
                   });
  return hats;
}

/** Those along which a hat function does not vanish, with their @p sums. */
std::vector<PatchEdge> edges_of(const Hats &hats, const VertexPatches &vertex_patches,
                                const BoundaryTractions &boundary,
                                std::vector<std::array<std::vector<double>, 2>> &sums)
{
  std::vector<PatchEdge> result;
  for (const auto &[index, hat] : hats)
  {
    const VertexPatches::Cell &cell = vertex_patches.cells()[index];
    const std::array<double, 4> &psi = cell.hats[hat].values;
    for (unsigned int face = 0; face < 4; ++face)
    {
      const unsigned int e = cell.edges[face];
      const bool reversed = cell.parts[face] == reversed_edge;
      const bool first = psi[GeometryInfo<2>::face_to_cell_vertices(face, reversed)] != 0;
      const StressEdge &edge = vertex_patches.edges()[e];
      if ((first || psi[GeometryInfo<2>::face_to_cell_vertices(face, !reversed)] !=
                        0) && // linear along an edge that hangs here
          std::none_of(result.begin(), result.end(),
                       [&](const PatchEdge &other) { return other.index == e; }))
        result.push_back({e, &edge,
                          edge.at_boundary() ? &boundary.of_hats(e)[first ? 0 : 1] : nullptr,
                          &sums[e]});
    }
  }
  return result;
}
} // namespace

EquilibratedStress::EquilibratedStress(const Solution<2> &solution, const Parts &friction,
                                       const Parts &pressure, EquilibrationCache &cache,
                                       const Solution<2> *const measured, const Volume volume,
                                       const JointTractions *const joints)
    : squares(solution.displacement_space.degrees().size()), antisymmetry(squares.size()),
      cache(cache), joints(joints),
      vertex_patches(solution,
                     joints || solution.scene.is_axisymmetric() || has_distorted_cells(solution),
                     joints),
      boundary(solution, vertex_patches, friction, pressure, joints)
{
  if (vertex_patches.has_rows)
    row_stresses =
        std::make_unique<const RowStresses>(solution, vertex_patches, boundary, joints, cache);
  else
    plain_stresses = std::make_unique<ParallelogramStresses>(
        solution, vertex_patches, boundary.marked_corners(), volume, cache);
  // Of a body that expands freely the stress is the round-off of eps(u_N) and eps_0.
  set_tractions(has_long_cells(solution),
                solution.scene.has_initial_strain() ? data_scale(solution.scene).stress : 0.);
  if (measured)
    measure_from(*measured);
  measure();
  if (measured)
    add_spring_squares(solution, *measured, squares);
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

const BoundaryTractions &EquilibratedStress::prescribed() const
{
  return boundary;
}

const LegendreTables &EquilibratedStress::legendre_tables() const
{
  return cache.legendre;
}

double EquilibratedStress::missed_force(const unsigned int cell) const
{
  return row_stresses ? row_stresses->missed_force(cell) : plain_stresses->missed_force(cell);
}

std::vector<RowStresses::JointPart> EquilibratedStress::joint_parts(const unsigned int cell,
                                                                    const unsigned int face) const
{
  return row_stresses ? row_stresses->joint_parts(cell, face)
                      : std::vector<RowStresses::JointPart>();
}

double EquilibratedStress::missed_traction(const unsigned int cell, const unsigned int face) const
{
  return row_stresses ? row_stresses->missed_traction(cell, face) : 0.;
}

double EquilibratedStress::missed_initial_stress(const unsigned int cell) const
{
  return plain_stresses ? plain_stresses->missed_initial_stress(cell) : 0.;
}

double EquilibratedStress::initial_stress_error(const Solution<2> &solution,
                                                const unsigned int cell) const
{
  const auto &iterator = vertex_patches.cells()[cell].iterator;
  const unsigned int degree = solution.displacement_space.degrees()[cell];
  return memoised(cache.initial_stress_errors, cell_key(iterator, degree),
                  [&]()
                  {
                    return hpvi::initial_stress_error(solution.scene, iterator, degree,
                                                      *solution.spaces->loads, solution.tables);
                  });
}

PatchCell EquilibratedStress::patch_cell(const unsigned int cell, const unsigned int hat) const
{
  return row_stresses ? row_stresses->patch_cell(cell, hat) : plain_stresses->patch_cell(cell, hat);
}

/** By patches, or all at once where cells are so long that hat functions would cost too much. */
void EquilibratedStress::set_tractions(const bool has_long_cells, const double initial_stress)
{
  for (unsigned int e = 0; e < vertex_patches.edges().size(); ++e)
  {
    const StressEdge &edge = vertex_patches.edges()[e];
    sums.emplace_back();
    for (unsigned int c = 0; c < 2; ++c)
    {
      sums[e][c].resize(edge.components[c].n);
      for (unsigned int i = 0; !edge.components[c].is_unknown && i < sums[e][c].size(); ++i)
        sums[e][c][i] = boundary.of_hats(e)[0][c][i] + boundary.of_hats(e)[1][c][i];
    }
  }
  if (has_long_cells)
    solve_all_cells();
  else
    solve_patches();
  double largest = initial_stress;
  for (const auto &edge : sums)
    for (const auto &component : edge)
      for (const double coefficient : component)
        largest = std::max(largest, std::abs(coefficient));
  defect = defect == 0 ? 0. : defect / largest;
}

/** A hundred at a time, which is enough for all threads and little to keep. */
void EquilibratedStress::solve_patches()
{
  constexpr std::size_t grain = 128;
  const auto &all = vertex_patches.patches();
  std::vector<Patch> patches;
  for (std::size_t first = 0; first < all.size(); first += grain)
  {
    patches.clear();
    patches.resize(std::min(grain, all.size() - first));
    parallel_for_each(patches.size(), 16,
                      [&](const unsigned int k)
                      {
                        patches[k].vertex = all[first + k].vertex;
                        const Hats ordered = by_shape(all[first + k], vertex_patches);
                        for (const auto &[cell, hat] : ordered)
                          patches[k].cells.push_back(patch_cell(cell, hat));
                        patches[k].edges = edges_of(ordered, vertex_patches, boundary, sums);
                      });
    const std::vector<PatchDefect> missed = hpvi::solve_patches(patches, cache);
    for (unsigned int k = 0; k < patches.size(); ++k)
      if (const double most = std::max(missed[k].equilibrium, missed[k].corners); !(most <= defect))
      {
        defect = most;
        worst_vertex = patches[k].vertex;
        is_worst_in_corners = missed[k].corners > missed[k].equilibrium;
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
  for (unsigned int e = 0; e < vertex_patches.edges().size(); ++e)
  {
    const StressEdge &edge = vertex_patches.edges()[e];
    all_edges.push_back({e, &edge, edge.at_boundary() ? &sums[e] : nullptr, &sums[e]});
  }
  const WorstCondition worst = solve_all(all_cells, all_edges, cache.legendre);
  defect = worst.missed;
  is_worst_in_corners = worst.corner != numbers::invalid_unsigned_int;
  worst_vertex = vertex_patches.cells()[worst.cell].iterator->vertex_index(
      is_worst_in_corners ? worst.corner : 0);
}

void EquilibratedStress::add_tractions(const unsigned int index, double *const all) const
{
  const TractionEnergy element = patch_cell(index, 0).element;
  const VertexPatches::Cell &geometry = vertex_patches.cells()[index];
  for (unsigned int face = 0; face < 4; ++face)
  {
    const StressEdge &edge = vertex_patches.edges()[geometry.edges[face]];
    const unsigned int part = geometry.parts[face];
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int row = 0; row < 2; ++row)
      {
        const StressEdge::Component &component = edge.components[c];
        const double weight = geometry.weight(face, edge, component, row);
        if (weight == 0.)
          continue;
        const std::vector<double> &t = sums[geometry.edges[face]][c];
        double *const target = all + element.edge_entry(face, row);
        const FullMatrix<double> *const half =
            part == whole_edge ? nullptr : &cache.legendre.part(component.n, part);
        for (unsigned int i = 0; i < component.n; ++i)
          if (!half)
            target[i] += weight * t[i];
          else
            for (unsigned int j = 0; j < component.n; ++j)
              target[i] += weight * (*half)(i, j) * t[j];
      }
  }
}

/** Tractions and loads of a parallelogram without those of sigma(u_N). */
std::vector<double> EquilibratedStress::data_of(const unsigned int cell) const
{
  std::vector<double> result = plain_stresses->data(cell);
  add_tractions(cell, result.data() + result.size() - patch_cell(cell, 0).element.n_edges());
  return result;
}

std::vector<double> EquilibratedStress::row_tractions(const unsigned int cell) const
{
  std::vector<double> result(patch_cell(cell, 0).element.n_edges());
  add_tractions(cell, result.data());
  return result;
}

void EquilibratedStress::measure()
{
  if (plain_stresses)
    squares = plain_stresses->squares([&](const unsigned int cell) { return data_of(cell); });
  else
    parallel_for_each(squares.size(), 8,
                      [&](const unsigned int cell)
                      {
                        const auto [square, antisymmetric] =
                            row_stresses->distance(cell, row_tractions(cell));
                        squares[cell] = square;
                        antisymmetry[cell] = antisymmetric;
                      });
}

void EquilibratedStress::measure_from(const Solution<2> &other)
{
  if (row_stresses)
    row_stresses =
        std::make_unique<const RowStresses>(other, vertex_patches, boundary, joints, cache);
  else
    plain_stresses->measure_from(other);
}

bool EquilibratedStress::has_rows() const
{
  return vertex_patches.has_rows;
}

Tensor<2, 2> EquilibratedStress::value_of_rows(const unsigned int cell,
                                               const Point<2> &reference) const
{
  return row_stresses->value(cell, row_tractions(cell), reference);
}

StressElement::Stress EquilibratedStress::stress(const unsigned int cell) const
{
  return plain_stresses->stress(cell, data_of(cell));
}

Tensor<2, 2> EquilibratedStress::frame(const unsigned int cell) const
{
  return plain_stresses->frame(cell);
}
} // namespace hpvi
