// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/equilibration/patch_problem.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int none = numbers::invalid_unsigned_int;

/** One component of the traction on an edge as data of a cell: `r_row += weight R t`. */
struct Block
{
  unsigned int row;                 ///< among the data of the edges
  unsigned int n;                   ///< coefficients
  double weight;                    ///< of the component in the direction of the data
  const FullMatrix<double> *R;      ///< to a half of the edge; null: the whole
  unsigned int unknown;             ///< the first, or none
  const std::vector<double> *known; ///< coefficients
};

class PatchProblem
{
public:
  PatchProblem(const std::vector<PatchCell> &cells, std::map<unsigned int, PatchEdge> &edges,
               EquilibrationCache &cache)
      : cells(cells), edges(edges), cache(cache)
  {
    for (auto &[index, edge] : edges)
      for (unsigned int c = 0; c < 2; ++c)
      {
        const StressEdge::Component &component = edge.edge->components[c];
        first_unknown[index][c] = component.is_unknown ? n : none;
        n += component.is_unknown ? component.n : 0;
      }
    for (const PatchCell &cell : cells)
      blocks.push_back(blocks_of(cell));
  }

  double solve();

private:
  std::vector<Block> blocks_of(const PatchCell &cell) const;
  EquilibrationCache::Signature signature() const;
  void factorise(PatchFactor &factor) const;
  void add_energy(const PatchCell &cell, const std::vector<Block> &parts, double scale,
                  PatchFactor &factor) const;
  void add_data(const PatchCell &cell, const std::vector<Block> &parts, double scale,
                std::vector<double> &g, std::vector<double> &right) const;

  const std::vector<PatchCell> &cells;
  std::map<unsigned int, PatchEdge> &edges;
  EquilibrationCache &cache;
  std::map<unsigned int, std::array<unsigned int, 2>> first_unknown;
  std::vector<std::vector<Block>> blocks; ///< by cell
  unsigned int n = 0;
};

std::vector<Block> PatchProblem::blocks_of(const PatchCell &cell) const
{
  std::vector<Block> result;
  for (unsigned int face = 0; face < 4; ++face)
  {
    const auto found = edges.find(cell.cell->edges[face]);
    if (found == edges.end())
      continue;
    const StressEdge &edge = *found->second.edge;
    const unsigned int part = cell.cell->parts[face];
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int row = 0; row < 2; ++row)
      {
        const StressEdge::Component &component = edge.components[c];
        const double weight = component.direction * (row == 0 ? edge.normal : edge.tangent);
        if (std::abs(weight) < 1e-12)
          continue;
        const unsigned int unknown = first_unknown.at(found->first)[c];
        result.push_back({cell.element->edge_entry(face, row), component.n, weight,
                          part == whole_edge ? nullptr : &cache.legendre.half(component.n, part),
                          unknown, &found->second.traction[c]});
      }
  }
  return result;
}

/** Two patches of the same signature have the same matrices. */
EquilibrationCache::Signature PatchProblem::signature() const
{
  EquilibrationCache::Signature key;
  std::map<unsigned int, unsigned int> order;
  for (const auto &[index, edge] : edges)
  {
    order.emplace(index, order.size());
    for (const StressEdge::Component &component : edge.edge->components)
    {
      key.push_back(component.is_unknown ? component.n : 0);
      key.push_back(std::lround(1e11 * (component.direction * edge.edge->normal)));
    }
  }
  for (const PatchCell &cell : cells)
  {
    key.push_back(reinterpret_cast<long>(cell.element));
    key.push_back(std::lround(1e6 * std::log2(cell.area / cells[0].area)));
    for (unsigned int face = 0; face < 4; ++face)
    {
      const auto found = order.find(cell.cell->edges[face]);
      key.push_back(found == order.end() ? -1 : 4 * found->second + (cell.cell->parts[face] + 1));
    }
  }
  return key;
}

/** Adds `scale B' G B` to H and appends the columns `B' N`, where B takes unknowns to data. */
void PatchProblem::add_energy(const PatchCell &cell, const std::vector<Block> &parts,
                              const double scale, PatchFactor &factor) const
{
  const StressElement &element = *cell.element;
  std::vector<double> first, second;
  for (const Block &b : parts)
    for (const Block &d : parts)
    {
      if (b.unknown == none || d.unknown == none || d.unknown > b.unknown)
        continue; // the lower triangle is enough
      DensePart G{&element.edge_energy()[std::size_t(d.row) * element.n_data +
                                         element.n_divergence + b.row],
                  element.n_data};
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
  for (unsigned int k = 0; k < element.n_conditions(); ++k)
  {
    const double *const N =
        &element.conditions()[std::size_t(k) * element.n_data + element.n_divergence];
    const std::size_t column = factor.conditions.size();
    factor.conditions.resize(column + n);
    for (const Block &b : parts)
      for (unsigned int i = 0; b.unknown != none && i < b.n; ++i)
      {
        double sum = b.R ? 0. : N[b.row + i];
        for (unsigned int l = 0; b.R && l < b.n; ++l)
          sum += (*b.R)(l, i) * N[b.row + l];
        factor.conditions[column + b.unknown + i] += b.weight * sum;
      }
  }
  factor.n_conditions += element.n_conditions();
}

void PatchProblem::factorise(PatchFactor &factor) const
{
  factor.n = n;
  factor.H.assign(std::size_t(n) * n, 0.);
  for (unsigned int k = 0; k < cells.size(); ++k)
    add_energy(cells[k], blocks[k], cells[k].area / cells[0].area, factor);
  AssertThrow(cholesky(n, factor.H.data(), n), ExcInternalError());
  factor.W = factor.conditions;
  const unsigned int m = factor.n_conditions;
  solve_triangular('N', n, m, {factor.H.data(), n}, factor.W.data(), n);
  std::vector<double> S(m * m);
  multiply('T', 'N', m, m, n, 1., {factor.W.data(), n}, {factor.W.data(), n}, 0., S.data(), m);
  factor.S = PivotedCholesky(m, S, 1e-11); // patches have motions and corners in common
}

/** g := gradient of the energy where unknown tractions vanish, right := what N'B x has to be. */
void PatchProblem::add_data(const PatchCell &cell, const std::vector<Block> &parts,
                            const double scale, std::vector<double> &g,
                            std::vector<double> &right) const
{
  const StressElement &element = *cell.element;
  const unsigned int n_edges = element.n_edges, n_conditions = element.n_conditions();
  std::vector<double> known(n_edges), gradient(cell.gradient, cell.gradient + n_edges),
      defect(cell.defect, cell.defect + n_conditions);
  bool has_known = false;
  for (const Block &b : parts)
    if (b.unknown == none)
      for (unsigned int i = 0; i < b.n; ++i)
      {
        double value = b.R ? 0. : (*b.known)[i];
        for (unsigned int l = 0; b.R && l < b.n; ++l)
          value += (*b.R)(i, l) * (*b.known)[l];
        known[b.row + i] += b.weight * value;
        has_known = has_known || value != 0.;
      }
  if (has_known)
  {
    multiply('N', 'N', n_edges, 1, n_edges, 1.,
             {&element.edge_energy()[element.n_divergence], element.n_data},
             {known.data(), n_edges}, 1., gradient.data(), n_edges);
    multiply('T', 'N', n_conditions, 1, n_edges, 1.,
             {&element.conditions()[element.n_divergence], element.n_data}, {known.data(), n_edges},
             1., defect.data(), n_conditions);
  }
  for (const Block &b : parts)
    for (unsigned int i = 0; b.unknown != none && i < b.n; ++i)
    {
      double sum = b.R ? 0. : gradient[b.row + i];
      for (unsigned int l = 0; b.R && l < b.n; ++l)
        sum += (*b.R)(l, i) * gradient[b.row + l];
      g[b.unknown + i] += scale * b.weight * sum;
    }
  for (const double value : defect)
    right.push_back(-value);
}

double PatchProblem::solve()
{
  const auto [found, is_new] = cache.patches.try_emplace(signature());
  PatchFactor &factor = found->second;
  if (is_new)
    factorise(factor);
  std::vector<double> x(n), right;
  for (unsigned int k = 0; k < cells.size(); ++k)
    add_data(cells[k], blocks[k], cells[k].area / cells[0].area, x, right);
  for (double &value : x)
    value = -value;
  const unsigned int m = factor.n_conditions;
  solve_triangular('N', n, 1, {factor.H.data(), n}, x.data(), n);
  for (unsigned int pass = 0; pass < 2; ++pass) // twice, for round-off
  {
    std::vector<double> left(right);
    multiply('T', 'N', m, 1, n, -1., {factor.W.data(), n}, {x.data(), n}, 1., left.data(), m);
    const std::vector<double> mu = factor.S.solve(left);
    multiply('N', 'N', n, 1, m, 1., {factor.W.data(), n}, {mu.data(), m}, 1., x.data(), n);
  }
  solve_triangular('T', n, 1, {factor.H.data(), n}, x.data(), n);
  multiply('T', 'N', m, 1, n, -1., {factor.conditions.data(), n}, {x.data(), n}, 1., right.data(),
           m);
  for (auto &[index, edge] : edges)
    for (unsigned int c = 0; c < 2; ++c)
      if (const unsigned int first = first_unknown[index][c]; first != none)
        edge.traction[c].assign(x.begin() + first, x.begin() + first + edge.edge->components[c].n);
  double largest = 0;
  for (const double value : right)
    largest = std::max(largest, std::abs(value));
  return largest;
}
} // namespace

double solve_patch(const std::vector<PatchCell> &cells, std::map<unsigned int, PatchEdge> &edges,
                   EquilibrationCache &cache)
{
  return PatchProblem(cells, edges, cache).solve();
}
} // namespace hpvi
