// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/equilibration/patch_problem.h>
#include <hpvi/equilibration/patch_workspace.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr char tractions[] = "the tractions of a patch of cells";

constexpr unsigned int none = numbers::invalid_unsigned_int;

/** Pivots of conditions that others imply, relative to the largest. */
constexpr double dependent = 1e-11;

/** `target += scale B' data` with the part of B that is a block. */
void add_transposed(const TractionBlock &b, const double *const data, const double scale,
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

class PatchProblem
{
public:
  PatchProblem(const std::vector<PatchCell> &cells, const std::vector<PatchEdge> &edges,
               EquilibrationCache &cache, PatchWorkspace &own)
      : cells(cells), edges(edges), cache(cache), own(own), first_unknown(own.first_unknown),
        blocks(own.blocks)
  {
    first_unknown.resize(edges.size());
    for (unsigned int e = 0; e < edges.size(); ++e)
      for (unsigned int c = 0; c < 2; ++c)
      {
        const StressEdge::Component &component = edges[e].edge->components[c];
        first_unknown[e][c] = component.is_unknown ? n : none;
        n += component.is_unknown ? component.n : 0;
      }
    if (blocks.size() < cells.size())
      blocks.resize(cells.size());
    for (unsigned int k = 0; k < cells.size(); ++k)
      set_blocks(cells[k], blocks[k]);
  }

  PatchDefect solve();

private:
  unsigned int place(unsigned int edge) const;
  void set_blocks(const PatchCell &cell, std::vector<TractionBlock> &result) const;
  void add_places(const PatchCell &cell, EquilibrationCache::Signature &key) const;
  const EquilibrationCache::Signature &signature() const;
  EquilibrationCache::Signature form(const std::vector<unsigned int> &present) const;
  void factorise(PatchFactor &factor) const;
  std::vector<unsigned int> independent_conditions(const PatchFactor &factor) const;
  bool choose(const std::vector<unsigned int> &conditions, PatchFactor &factor) const;
  void add_energy(const PatchCell &cell, const std::vector<TractionBlock> &parts, double scale,
                  PatchFactor &factor) const;
  void add_conditions(const PatchCell &cell, const std::vector<TractionBlock> &parts,
                      unsigned int first, PatchFactor &factor) const;
  void add_data(const PatchCell &cell, const std::vector<TractionBlock> &parts, double scale,
                std::vector<double> &g, std::vector<double> &right) const;
  void minimise(const PatchFactor &factor, std::vector<double> &x,
                std::vector<double> &right) const;

  const std::vector<PatchCell> &cells;
  const std::vector<PatchEdge> &edges;
  EquilibrationCache &cache;
  PatchWorkspace &own;
  std::vector<std::array<unsigned int, 2>> &first_unknown;
  std::vector<std::vector<TractionBlock>> &blocks;
  unsigned int n = 0;
};

/** Of an edge of the mesh among those of the patch, or none. */
unsigned int PatchProblem::place(const unsigned int edge) const
{
  for (unsigned int e = 0; e < edges.size(); ++e)
    if (edges[e].index == edge)
      return e;
  return none;
}

void PatchProblem::set_blocks(const PatchCell &cell, std::vector<TractionBlock> &result) const
{
  result.clear();
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
const EquilibrationCache::Signature &PatchProblem::signature() const
{
  EquilibrationCache::Signature &key = own.signature;
  key.clear();
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
void PatchProblem::add_energy(const PatchCell &cell, const std::vector<TractionBlock> &parts,
                              const double scale, PatchFactor &factor) const
{
  const TractionEnergy &element = cell.element;
  std::vector<double> first, second;
  for (const TractionBlock &b : parts)
    for (const TractionBlock &d : parts)
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
        for (unsigned int i = 0; i < b.n; ++i)
          factor.H[std::size_t(d.unknown + j) * n + b.unknown + i] +=
              scale * b.weight * d.weight * G.entries[j * G.stride + i];
    }
}

/** Appends those columns of `B' N` that are not empty: a corner away from the vertex sees no unknown. */
void PatchProblem::add_conditions(const PatchCell &cell, const std::vector<TractionBlock> &parts,
                                  const unsigned int first, PatchFactor &factor) const
{
  const TractionEnergy &element = cell.element;
  std::vector<double> column(n);
  for (unsigned int k = 0; k < element.n_conditions; ++k)
  {
    const double *const N = element.N.entries + std::size_t(k) * element.N.stride;
    std::fill(column.begin(), column.end(), 0.);
    for (const TractionBlock &b : parts)
      if (b.unknown != none)
        add_transposed(b, N, 1., &column[b.unknown]);
    if (std::all_of(column.begin(), column.end(), [](const double entry) { return entry == 0.; }))
      continue;
    factor.conditions.insert(factor.conditions.end(), column.begin(), column.end());
    factor.present.push_back(first + k);
  }
}

/** What tells which conditions imply the others: the signature without degrees, those of p = 2 excepted. */
EquilibrationCache::Signature PatchProblem::form(const std::vector<unsigned int> &present) const
{
  EquilibrationCache::Signature key(present.begin(), present.end());
  for (const PatchEdge &edge : edges)
    for (const StressEdge::Component &component : edge.edge->components)
      key.push_back(component.is_unknown ? -1 - long(std::min(component.n, 4U)) : -1);
  for (const PatchCell &cell : cells)
    add_places(cell, key);
  return key;
}

/** Places of as many conditions as `C'H^-1 C` has rank: patches have motions and corners in common. */
std::vector<unsigned int> PatchProblem::independent_conditions(const PatchFactor &factor) const
{
  const unsigned int m = factor.present.size();
  std::vector<double> W(factor.conditions), S(m * m);
  solve_triangular('N', n, m, {factor.H.data(), n}, W.data(), n);
  multiply('T', 'N', m, m, n, 1., {W.data(), n}, {W.data(), n}, 0., S.data(), m);
  return PivotedCholesky(m, S, dependent).order;
}

/** `W = L^-1 C` of some conditions and the factor of W'W; false: they depend on one another. */
bool PatchProblem::choose(const std::vector<unsigned int> &conditions, PatchFactor &factor) const
{
  const unsigned int rank = conditions.size();
  factor.chosen = conditions;
  factor.W.clear();
  factor.W.reserve(std::size_t(rank) * n);
  for (const unsigned int k : conditions)
    factor.W.insert(factor.W.end(), &factor.conditions[std::size_t(k) * n],
                    &factor.conditions[std::size_t(k) * n] + n);
  solve_triangular('N', n, rank, {factor.H.data(), n}, factor.W.data(), n);
  factor.S.resize(rank * rank);
  multiply('T', 'N', rank, rank, n, 1., {factor.W.data(), n}, {factor.W.data(), n}, 0.,
           factor.S.data(), rank);
  if (!cholesky(rank, factor.S.data(), rank))
    return false;
  double least = 1., largest = 0.;
  for (unsigned int i = 0; i < rank; ++i)
  {
    const double pivot = factor.S[i * rank + i];
    least = i == 0 ? pivot : std::min(least, pivot);
    largest = std::max(largest, pivot);
  }
  return least * least > 0.1 * dependent * largest * largest;
}

/** H and C, and the conditions that imply all. */
void PatchProblem::factorise(PatchFactor &factor) const
{
  factor.H.assign(std::size_t(n) * n, 0.);
  unsigned int first = 0;
  for (const PatchCell &cell : cells)
    first += cell.element.n_conditions;
  factor.conditions.reserve(std::size_t(first) * n);
  first = 0;
  for (unsigned int k = 0; k < cells.size(); ++k)
  {
    add_energy(cells[k], blocks[k], cells[k].area / cells[0].area, factor);
    add_conditions(cells[k], blocks[k], first, factor);
    first += cells[k].element.n_conditions;
  }
  require_regular(cholesky(n, factor.H.data(), n), tractions);
  const auto [known, is_new] = cache.independent_conditions.try_emplace(form(factor.present));
  if (!is_new && choose(known->second, factor))
    return;
  known->second = independent_conditions(factor);
  require_regular(choose(known->second, factor), tractions);
}

/** g := gradient of the energy where unknown tractions vanish, right := what N'B x has to be. */
void PatchProblem::add_data(const PatchCell &cell, const std::vector<TractionBlock> &parts,
                            const double scale, std::vector<double> &g,
                            std::vector<double> &right) const
{
  const TractionEnergy &element = cell.element;
  const unsigned int n_edges = element.n_edges(), n_conditions = element.n_conditions;
  const double *gradient = cell.gradient, *defect = cell.defect;
  std::vector<double> &known = own.known, &changed_gradient = own.changed_gradient,
                      &changed_defect = own.changed_defect;
  known.clear();
  for (const TractionBlock &b : parts)
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
  for (const TractionBlock &b : parts)
    if (b.unknown != none)
      add_transposed(b, gradient, scale, &g[b.unknown]);
  for (unsigned int k = 0; k < n_conditions; ++k)
    right.push_back(-defect[k]);
}

/** x, the gradient, := what minimises energy subject to the chosen conditions; right := what all of them miss. */
void PatchProblem::minimise(const PatchFactor &factor, std::vector<double> &x,
                            std::vector<double> &right) const
{
  const unsigned int m = factor.present.size(), rank = factor.chosen.size();
  for (double &value : x)
    value = -value;
  solve_triangular('N', n, 1, {factor.H.data(), n}, x.data(), n);
  for (unsigned int pass = 0; pass < 2; ++pass) // twice, for round-off
  {
    std::vector<double> &mu = own.mu;
    mu.resize(rank);
    for (unsigned int i = 0; i < rank; ++i)
      mu[i] = right[factor.present[factor.chosen[i]]];
    multiply('T', 'N', rank, 1, n, -1., {factor.W.data(), n}, {x.data(), n}, 1., mu.data(), rank);
    for (const char op : {'N', 'T'})
      solve_triangular(op, rank, 1, {factor.S.data(), rank}, mu.data(), rank);
    multiply('N', 'N', n, 1, rank, 1., {factor.W.data(), n}, {mu.data(), rank}, 1., x.data(), n);
  }
  solve_triangular('T', n, 1, {factor.H.data(), n}, x.data(), n);
  std::vector<double> &met = own.met;
  met.assign(m, 0.);
  multiply('T', 'N', m, 1, n, 1., {factor.conditions.data(), n}, {x.data(), n}, 0., met.data(), m);
  for (unsigned int k = 0; k < m; ++k)
    right[factor.present[k]] -= met[k];
}

PatchDefect PatchProblem::solve()
{
  const auto [found, is_new] = cache.patches.try_emplace(signature());
  found->second.is_used = true;
  PatchFactor &factor = found->second.value;
  if (is_new)
    factorise(factor);
  std::vector<double> &x = own.g, &right = own.right;
  x.assign(n, 0.);
  right.clear();
  for (unsigned int k = 0; k < cells.size(); ++k)
    add_data(cells[k], blocks[k], cells[k].area / cells[0].area, x, right);
  minimise(factor, x, right);
  for (unsigned int e = 0; e < edges.size(); ++e)
    for (unsigned int c = 0; c < 2; ++c)
    {
      const unsigned int first = first_unknown[e][c];
      std::vector<double> &sum = (*edges[e].sum)[c];
      for (unsigned int i = 0; first != none && i < sum.size(); ++i)
        sum[i] += x[first + i];
    }
  PatchDefect result;
  auto value = right.begin();
  for (const PatchCell &cell : cells)
    for (unsigned int k = 0; k < cell.element.n_conditions; ++k, ++value)
    {
      double &largest = k < 3 ? result.equilibrium : result.corners; // three motions come first
      largest = std::max(largest, std::abs(*value));
    }
  return result;
}
} // namespace

TractionEnergy traction_energy(const StressElement &element)
{
  return {element.n_normal,
          element.n_tangential,
          element.n_conditions(),
          {&element.edge_energy()[element.n_divergence], element.n_data},
          {&element.conditions()[element.n_divergence], element.n_data}};
}

TractionEnergy traction_energy(const MacroStressElement &element)
{
  const unsigned int n = element.n_edges / 8;
  return {n,
          n,
          MacroStressElement::n_conditions,
          {element.edge_energy().data(), element.n_edges},
          {element.conditions().data(), element.n_edges}};
}

PatchDefect solve_patch(const std::vector<PatchCell> &cells, const std::vector<PatchEdge> &edges,
                        EquilibrationCache &cache)
{
  static thread_local PatchWorkspace workspace;
  return PatchProblem(cells, edges, cache, workspace).solve();
}
} // namespace hpvi
