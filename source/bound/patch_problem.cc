// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/triangular.h>
#include <hpvi/base/numbers.h>
#include <hpvi/bound/patches.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr char tractions[] = "the tractions of a patch of cells";

/** Pivots of conditions that others imply, relative to the largest. */
constexpr double dependent = 1e-11;

} // namespace

/** `target += scale B' data` with the part of B that is a block. */
void PatchProblem::add_transposed(const Block &b, const double *const data, const double scale,
                                  double *const target)
{
  for (unsigned int i = 0; i < b.n; ++i)
  {
    double sum = b.R ? 0. : data[b.row + i];
    for (unsigned int l = 0; b.R && l < b.n; ++l)
      sum += (*b.R)(l, i) * data[b.row + l];
    target[i] += scale * b.weight * sum;
  }
}

PatchProblem::PatchProblem(const Patch &patch, EquilibrationCache &cache)
    : cells(patch.cells), edges(patch.edges), cache(cache), first_unknown(edges.size())
{
  for (unsigned int e = 0; e < edges.size(); ++e)
    for (unsigned int c = 0; c < 2; ++c)
    {
      const StressEdge::Component &component = edges[e].edge->components[c];
      first_unknown[e][c] = component.is_unknown ? n : none;
      n += component.is_unknown ? component.n : 0;
    }
  blocks.reserve(cells.size());
  for (const PatchCell &cell : cells)
    blocks.push_back(blocks_of(cell));
}

/** Of an edge of the mesh among those of the patch, or none. */
unsigned int PatchProblem::place(const unsigned int edge) const
{
  for (unsigned int e = 0; e < edges.size(); ++e)
    if (edges[e].index == edge)
      return e;
  return none;
}

std::vector<PatchProblem::Block> PatchProblem::blocks_of(const PatchCell &cell) const
{
  std::vector<Block> result;
  result.reserve(8);
  for (unsigned int face = 0; face < 4; ++face)
  {
    const unsigned int e = place(cell.cell->edges[face]);
    if (e == none)
      continue;
    const StressEdge &edge = *edges[e].edge;
    const unsigned int part = cell.cell->parts[face];
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int row = 0; row < 2; ++row)
      {
        const StressEdge::Component &component = edge.components[c];
        const double weight = cell.cell->weight(face, edge, component, row);
        if (std::abs(weight) < 1e-12)
          continue;
        result.push_back({cell.element.edge_entry(face, row), component.n, weight,
                          part == whole_edge ? nullptr : &cache.legendre.part(component.n, part),
                          first_unknown[e][c], edges[e].known ? &(*edges[e].known)[c] : nullptr});
      }
  }
  return result;
}

/** Which edges of the patch a cell has, and which part of them. */
void PatchProblem::add_places(const PatchCell &cell, EquilibrationCache::Signature &key) const
{
  for (unsigned int face = 0; face < 4; ++face)
  {
    const unsigned int e = place(cell.cell->edges[face]);
    key.push_back(
        e == none ? -1 : 8 * e + 2 * (cell.cell->parts[face] + 1) + (cell.cell->turns[face] < 0));
  }
}

/** Two patches of the same signature have the same matrices. */
EquilibrationCache::Signature PatchProblem::signature() const
{
  EquilibrationCache::Signature key;
  key.reserve(4 * edges.size() + 6 * cells.size());
  for (const PatchEdge &edge : edges)
    for (const StressEdge::Component &component : edge.edge->components)
    {
      key.push_back(component.is_unknown ? component.n : 0);
      key.push_back(std::lround(1e11 * (component.direction * edge.edge->normal)));
    }
  for (const PatchCell &cell : cells)
  {
    key.push_back(reinterpret_cast<long>(cell.element.G.entries));
    key.push_back(std::lround(1e6 * std::log2(cell.area / cells[0].area)));
    add_places(cell, key);
  }
  return key;
}

/** Adds `scale B' G B` to H, where B takes unknowns to data. */
void PatchProblem::add_energy(const PatchCell &cell, const std::vector<Block> &parts,
                              const double scale, PatchFactor &factor) const
{
  const TractionEnergy &element = cell.element;
  std::vector<double> first, second;
  for (const Block &b : parts)
    for (const Block &d : parts)
    {
      if (b.unknown == none || d.unknown == none || d.unknown > b.unknown)
        continue; // the lower triangle is enough
      DensePart G = element.G;
      G.entries += std::size_t(d.row) * G.stride + b.row;
      if (b.R) // matrices of deal.II are transposed, by columns
      {
        first.resize(b.n * d.n);
        multiply('N', 'N', b.n, d.n, b.n, 1., {&(*b.R)(0, 0), b.n}, G, 0., first.data(), b.n);
        G = {first.data(), b.n};
      }
      if (d.R)
      {
        second.resize(b.n * d.n);
        multiply('N', 'T', b.n, d.n, d.n, 1., G, {&(*d.R)(0, 0), d.n}, 0., second.data(), b.n);
        G = {second.data(), b.n};
      }
      for (unsigned int j = 0; j < d.n; ++j)
      {
        double *const column = factor.H.column(d.unknown + j);
        for (unsigned int i = d.unknown == b.unknown ? j : 0; i < b.n; ++i)
          column[b.unknown + i] += scale * b.weight * d.weight * G.entries[j * G.stride + i];
      }
    }
}

/** Appends those columns of `B' N` that are not empty: a corner away from the vertex sees no unknown. */
void PatchProblem::add_conditions(const PatchCell &cell, const std::vector<Block> &parts,
                                  const unsigned int first, PatchFactor &factor)
{
  const TractionEnergy &element = cell.element;
  std::vector<double> column(n);
  for (unsigned int k = 0; k < element.n_conditions; ++k)
  {
    const double *const N = element.N.entries + std::size_t(k) * element.N.stride;
    std::fill(column.begin(), column.end(), 0.);
    for (const Block &b : parts)
      if (b.unknown != none)
        add_transposed(b, N, 1., &column[b.unknown]);
    if (std::all_of(column.begin(), column.end(), [](const double entry) { return entry == 0.; }))
      continue;
    conditions.insert(conditions.end(), column.begin(), column.end());
    factor.present.push_back(first + k);
  }
}

EquilibrationCache::Signature PatchProblem::form(const PatchFactor &factor) const
{
  EquilibrationCache::Signature key(factor.present.begin(), factor.present.end());
  for (const PatchEdge &edge : edges)
    for (const StressEdge::Component &component : edge.edge->components)
      key.push_back(component.is_unknown ? -1 - long(std::min(component.n, 4U)) : -1);
  for (const PatchCell &cell : cells)
    add_places(cell, key);
  return key;
}

std::vector<unsigned int> PatchProblem::independent_conditions(const PatchFactor &factor) const
{
  const unsigned int m = factor.present.size();
  std::vector<double> W(conditions), S(m * m);
  factor.H.solve('N', m, W.data(), n);
  multiply('T', 'N', m, m, n, 1., {W.data(), n}, {W.data(), n}, 0., S.data(), m);
  return PivotedCholesky(m, S, dependent).order;
}

bool PatchProblem::choose(const std::vector<unsigned int> &places, PatchFactor &factor,
                          const double least_pivot) const
{
  const unsigned int rank = places.size();
  factor.chosen = places;
  factor.W.clear();
  factor.W.reserve(std::size_t(rank) * n);
  for (const unsigned int k : places)
    factor.W.insert(factor.W.end(), &conditions[std::size_t(k) * n],
                    &conditions[std::size_t(k) * n] + n);
  factor.H.solve('N', rank, factor.W.data(), n);
  std::vector<double> S(rank * rank);
  multiply('T', 'N', rank, rank, n, 1., {factor.W.data(), n}, {factor.W.data(), n}, 0., S.data(),
           rank);
  factor.S = PackedTriangle(rank);
  for (unsigned int j = 0; j < rank; ++j)
    std::copy(&S[j * rank + j], &S[j * rank] + rank, factor.S.column(j) + j);
  if (!factor.S.factor())
    return false;
  double least = 1., largest = 0.;
  for (unsigned int i = 0; i < rank; ++i)
  {
    const double pivot = factor.S.column(i)[i];
    least = i == 0 ? pivot : std::min(least, pivot);
    largest = std::max(largest, pivot);
  }
  return least * least > least_pivot * largest * largest;
}

void PatchProblem::set_matrices(PatchFactor &factor)
{
  factor.H = PackedTriangle(n);
  unsigned int first = 0;
  for (const PatchCell &cell : cells)
    first += cell.element.n_conditions;
  conditions.reserve(std::size_t(first) * n);
  first = 0;
  for (unsigned int k = 0; k < cells.size(); ++k)
  {
    add_energy(cells[k], blocks[k], cells[k].area / cells[0].area, factor);
    add_conditions(cells[k], blocks[k], first, factor);
    first += cells[k].element.n_conditions;
  }
  require_regular(factor.H.factor(), tractions);
}

void PatchProblem::renew(std::vector<unsigned int> &places, PatchFactor &factor) const
{
  places = independent_conditions(factor);
  require_regular(choose(places, factor, 0.1 * dependent), tractions);
}

/** g := gradient of the energy where unknown tractions vanish, right := what N'B x has to be. */
void PatchProblem::add_data(const PatchCell &cell, const std::vector<Block> &parts,
                            const double scale, std::vector<double> &g,
                            std::vector<double> &right) const
{
  const TractionEnergy &element = cell.element;
  const unsigned int n_edges = element.n_edges(), n_conditions = element.n_conditions;
  const double *gradient = cell.gradient, *defect = cell.defect;
  std::vector<double> known, changed_gradient, changed_defect;
  for (const Block &b : parts)
    if (b.unknown == none)
      for (unsigned int i = 0; i < b.n; ++i)
        if ((*b.known)[i] != 0.) // edges of the boundary do not hang, and run the other way at most
        {
          known.resize(n_edges);
          known[b.row + i] += b.weight * (b.R ? (*b.R)(i, i) : 1.) * (*b.known)[i];
        }
  if (!known.empty())
  {
    changed_gradient.assign(gradient, gradient + n_edges);
    changed_defect.assign(defect, defect + n_conditions);
    multiply('N', 'N', n_edges, 1, n_edges, 1., element.G, {known.data(), n_edges}, 1.,
             changed_gradient.data(), n_edges);
    multiply('T', 'N', n_conditions, 1, n_edges, 1., element.N, {known.data(), n_edges}, 1.,
             changed_defect.data(), n_conditions);
    gradient = changed_gradient.data();
    defect = changed_defect.data();
  }
  for (const Block &b : parts)
    if (b.unknown != none)
      add_transposed(b, gradient, scale, &g[b.unknown]);
  for (unsigned int k = 0; k < n_conditions; ++k)
    right.push_back(-defect[k]);
}

/** x := the least energy subject to the chosen conditions, from the gradient where x vanishes. */
void PatchProblem::minimise(const PatchFactor &factor, const std::vector<double> &right)
{
  const unsigned int rank = factor.chosen.size();
  for (double &value : x)
    value = -value;
  factor.H.solve('N', 1, x.data(), n);
  std::vector<double> mu(rank);
  for (unsigned int pass = 0; pass < 2; ++pass) // twice, for round-off
  {
    for (unsigned int i = 0; i < rank; ++i)
      mu[i] = right[factor.present[factor.chosen[i]]];
    multiply('T', 'N', rank, 1, n, -1., {factor.W.data(), n}, {x.data(), n}, 1., mu.data(), rank);
    for (const char op : {'N', 'T'})
      factor.S.solve(op, 1, mu.data(), rank);
    multiply('N', 'N', n, 1, rank, 1., {factor.W.data(), n}, {mu.data(), rank}, 1., x.data(), n);
  }
  factor.H.solve('T', 1, x.data(), n);
}

/** right -= N'B x, for the conditions of a cell. */
void PatchProblem::subtract_met(const PatchCell &cell, const std::vector<Block> &parts,
                                double *const right) const
{
  const TractionEnergy &element = cell.element;
  std::vector<double> t(element.n_edges());
  for (const Block &b : parts)
    for (unsigned int i = 0; b.unknown != none && i < b.n; ++i)
    {
      const double value = b.weight * x[b.unknown + i];
      if (!b.R)
        t[b.row + i] += value;
      for (unsigned int l = 0; b.R && l < b.n; ++l)
        t[b.row + l] += (*b.R)(l, i) * value;
    }
  multiply('T', 'N', element.n_conditions, 1, t.size(), -1., element.N,
           {t.data(), element.n_edges()}, 1., right, element.n_conditions);
}

PatchDefect PatchProblem::solve(const PatchFactor &factor)
{
  std::vector<double> right;
  right.reserve(8 * cells.size());
  x.assign(n, 0.);
  for (unsigned int k = 0; k < cells.size(); ++k)
    add_data(cells[k], blocks[k], cells[k].area / cells[0].area, x, right);
  minimise(factor, right);
  PatchDefect result;
  double *value = right.data();
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
  {
    subtract_met(cells[cell], blocks[cell], value);
    for (unsigned int k = 0; k < cells[cell].element.n_conditions; ++k, ++value)
    {
      double &largest = k < 3 ? result.equilibrium : result.corners; // three motions come first
      largest = std::max(largest, std::abs(*value));
    }
  }
  return result;
}

void PatchProblem::add_tractions() const
{
  for (unsigned int e = 0; e < edges.size(); ++e)
    for (unsigned int c = 0; c < 2; ++c)
    {
      const unsigned int first = first_unknown[e][c];
      std::vector<double> &sum = (*edges[e].sum)[c];
      for (unsigned int i = 0; first != none && i < sum.size(); ++i)
        sum[i] += x[first + i];
    }
}

TractionEnergy traction_energy(const StressElement &element)
{
  return {element.n_normal,
          element.n_tangential,
          element.n_conditions(),
          {&element.edge_energy()[element.n_divergence], element.n_data},
          {&element.conditions()[element.n_divergence], element.n_data}};
}
} // namespace hpvi
