// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/linear_solver.h>
#include <hpvi/bound/traction_system.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
double largest(const std::vector<double> &values)
{
  double result = 0;
  for (const double value : values)
    result = std::max(result, std::abs(value));
  return result;
}

/**
 * Least energy under conditions `C'x = b`, some of which others imply: `A x = C (rho b - mu) - g` with
 * `A = H + C rho C'` and multipliers mu such that `C'x = b`, by conjugate gradients, preconditioned by rho. The
 * conditions of a cell are about its own tractions, so that A has no more entries than H. Eigenvalues of
 * `rho C'A^-1 C` are at most 1, and but those of the slowest bending of a slender body are near it.
 */
class TractionSystem
{
public:
  TractionSystem(const std::vector<PatchCell> &cells, const std::vector<PatchEdge> &edges,
                 const LegendreTables &legendre);

  /** Adds the tractions to the sums of the edges. */
  WorstCondition solve();

private:
  using Multipliers = std::vector<double>; ///< of all conditions

  struct Cell
  {
    std::vector<unsigned int> unknowns;
    unsigned int first_condition, n_conditions;
    std::vector<double> C; ///< unknowns x conditions
  };

  /** B, n_edges x unknowns, from tractions of edges to those of the faces of a cell, and what is given there. */
  struct Faces
  {
    std::vector<double> B, known;
  };

  void number_unknowns();
  unsigned int end_of(unsigned int edge) const;
  void set_pattern();
  Faces faces_of(const PatchCell &cell, const LegendreTables &legendre,
                 std::vector<unsigned int> &unknowns) const;
  void add(const PatchCell &cell, double scale, const LegendreTables &legendre);
  void add_conditions(const PatchCell &cell, const Faces &faces, std::vector<double> &H);
  void add_energy(const Cell &cell, const std::vector<double> &H);
  Vector<double> forces(const Multipliers &mu) const;
  Multipliers met(const Vector<double> &x) const;
  Multipliers missed(const Vector<double> &x) const;
  Vector<double> minimiser() const;
  WorstCondition worst(const Multipliers &missed) const;

  const std::vector<PatchCell> &patch_cells;
  const std::vector<PatchEdge> &edges;
  std::vector<std::array<unsigned int, 2>> first; ///< unknown, by edge and component
  std::vector<unsigned int> edge_of;              ///< by unknown
  /** By edge: where the rows of another one begin in its columns. */
  std::vector<std::map<unsigned int, unsigned int>> places;
  std::vector<Cell> cells;
  SymmetricMatrix A;
  Vector<double> g;
  Multipliers b, rho;
};

TractionSystem::TractionSystem(const std::vector<PatchCell> &cells,
                               const std::vector<PatchEdge> &edges, const LegendreTables &legendre)
    : patch_cells(cells), edges(edges)
{
  number_unknowns();
  set_pattern();
  for (const PatchCell &cell : cells)
    add(cell, cell.area / cells[0].area, legendre);
}

void TractionSystem::number_unknowns()
{
  for (unsigned int e = 0; e < edges.size(); ++e)
  {
    first.emplace_back();
    for (unsigned int c = 0; c < 2; ++c)
    {
      const StressEdge::Component &component = edges[e].edge->components[c];
      first[e][c] = edge_of.size();
      if (component.is_unknown)
        edge_of.insert(edge_of.end(), component.n, e);
    }
  }
  g.reinit(edge_of.size());
}

/** Behind the last unknown of an edge. */
unsigned int TractionSystem::end_of(const unsigned int edge) const
{
  return edge + 1 < edges.size() ? first[edge + 1][0] : edge_of.size();
}

/** Columns of an edge have rows for each edge up to it with which it shares a cell. */
void TractionSystem::set_pattern()
{
  places.resize(edges.size());
  for (const PatchCell &cell : patch_cells)
    for (const unsigned int e : cell.cell->edges)
      for (const unsigned int other : cell.cell->edges)
        if (other <= e)
          places[e][other] = 0;
  std::size_t n_entries = 0;
  for (unsigned int e = 0; e < edges.size(); ++e)
  {
    unsigned int n = 0;
    for (auto &[other, place] : places[e])
    {
      place = n;
      n += end_of(other) - first[other][0];
    }
    const std::size_t own = end_of(e) - first[e][0];
    n_entries += own * (n - own) + own * (own + 1) / 2;
  }
  A.resize(n_entries);
  int end = 0;
  for (unsigned int unknown = 0; unknown < edge_of.size(); ++unknown)
  {
    for (const auto &[other, place] : places[edge_of[unknown]])
      for (unsigned int row = first[other][0]; row < end_of(other) && row <= unknown; ++row)
        A.row[end++] = row;
    A.column_start.push_back(end);
  }
}

TractionSystem::Faces TractionSystem::faces_of(const PatchCell &cell,
                                               const LegendreTables &legendre,
                                               std::vector<unsigned int> &unknowns) const
{
  const unsigned int n_edges = cell.element.n_edges();
  Faces result{{}, std::vector<double>(n_edges)};
  for (unsigned int face = 0; face < 4; ++face)
  {
    const unsigned int e = cell.cell->edges[face], part = cell.cell->parts[face];
    const StressEdge &edge = *edges[e].edge;
    for (unsigned int c = 0; c < 2; ++c)
    {
      const StressEdge::Component &component = edge.components[c];
      for (unsigned int i = 0; i < component.n; ++i)
      {
        std::vector<double> column(n_edges);
        for (const unsigned int row : {0, 1})
        {
          const double weight = cell.cell->weight(face, edge, component, row);
          double *const target = &column[cell.element.edge_entry(face, row)];
          if (std::abs(weight) < 1e-12)
            continue; // and no room, where it has one mode more
          if (part == whole_edge)
            target[i] = weight;
          else
            for (unsigned int k = 0; k <= i; ++k)
              target[k] = weight * legendre.part(component.n, part)(k, i);
        }
        if (component.is_unknown)
        {
          unknowns.push_back(first[e][c] + i);
          result.B.insert(result.B.end(), column.begin(), column.end());
        }
        else
          for (unsigned int k = 0; k < n_edges; ++k)
            result.known[k] += (*edges[e].known)[c][i] * column[k];
      }
    }
  }
  return result;
}

void TractionSystem::add(const PatchCell &cell, const double scale, const LegendreTables &legendre)
{
  const DensePart G = cell.element.G;
  const unsigned int n_edges = cell.element.n_edges();
  cells.emplace_back();
  const Faces faces = faces_of(cell, legendre, cells.back().unknowns);
  const unsigned int n = cells.back().unknowns.size();
  const DensePart B{faces.B.data(), n_edges};
  std::vector<double> GB(n_edges * n), H(n * n), slope(n),
      gradient(cell.gradient, cell.gradient + n_edges);
  multiply('N', 'N', n_edges, n, n_edges, 1., G, B, 0., GB.data(), n_edges);
  multiply('T', 'N', n, n, n_edges, scale, B, {GB.data(), n_edges}, 0., H.data(), n);
  multiply('N', 'N', n_edges, 1, n_edges, 1., G, {faces.known.data(), n_edges}, 1., gradient.data(),
           n_edges);
  multiply('T', 'N', n, 1, n_edges, scale, B, {gradient.data(), n_edges}, 0., slope.data(), n);
  for (unsigned int i = 0; i < n; ++i)
    g[cells.back().unknowns[i]] += slope[i];
  add_conditions(cell, faces, H);
  add_energy(cells.back(), H);
}

/**
 * C and b, and `C rho C'` added to H. A condition costs 1e8 times the energy of the tractions that it is about:
 * round-off then leaves that energy some eight digits, enough for a matrix that is positive definite in slender bodies, and conjugate gradients few steps.
 */
void TractionSystem::add_conditions(const PatchCell &cell, const Faces &faces,
                                    std::vector<double> &H)
{
  const TractionEnergy &element = cell.element;
  const unsigned int n_edges = element.n_edges(), m = element.n_conditions;
  Cell &own = cells.back();
  const unsigned int n = own.unknowns.size();
  own.first_condition = b.size();
  own.n_conditions = m;
  own.C.resize(n * m);
  multiply('T', 'N', n, m, n_edges, 1., {faces.B.data(), n_edges}, element.N, 0., own.C.data(), n);
  b.insert(b.end(), cell.defect, cell.defect + m);
  multiply('T', 'N', m, 1, n_edges, -1., element.N, {faces.known.data(), n_edges}, -1.,
           &b[own.first_condition], m);
  std::vector<double> weighted(own.C);
  for (unsigned int k = 0; k < m; ++k)
  {
    double square = 0, energy = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double entry = std::pow(own.C[k * n + i], 2);
      square += entry;
      energy += entry * H[i * n + i];
    }
    rho.push_back(square > 0 ? 1e8 * energy / (square * square) : 0.);
    for (unsigned int i = 0; i < n; ++i)
      weighted[k * n + i] *= rho.back();
  }
  multiply('N', 'T', n, n, m, 1., {weighted.data(), n}, {own.C.data(), n}, 1., H.data(), n);
}

/** A += H of one cell. */
void TractionSystem::add_energy(const Cell &cell, const std::vector<double> &H)
{
  const unsigned int n = cell.unknowns.size();
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int row = cell.unknowns[i], column = cell.unknowns[j], edge = edge_of[row];
      if (row <= column)
        A.value[A.column_start[column] + places[edge_of[column]].at(edge) + row - first[edge][0]] +=
            H[j * n + i];
    }
}

/** C mu */
Vector<double> TractionSystem::forces(const Multipliers &mu) const
{
  Vector<double> result(g.size());
  for (const Cell &cell : cells)
  {
    const double *entry = cell.C.data();
    for (unsigned int k = 0; k < cell.n_conditions; ++k)
      for (const unsigned int unknown : cell.unknowns)
        result[unknown] += mu[cell.first_condition + k] * *entry++;
  }
  return result;
}

/** C'x */
TractionSystem::Multipliers TractionSystem::met(const Vector<double> &x) const
{
  Multipliers result(b.size());
  for (const Cell &cell : cells)
  {
    const double *entry = cell.C.data();
    for (unsigned int k = 0; k < cell.n_conditions; ++k)
      for (const unsigned int unknown : cell.unknowns)
        result[cell.first_condition + k] += x[unknown] * *entry++;
  }
  return result;
}

/** C'x - b */
TractionSystem::Multipliers TractionSystem::missed(const Vector<double> &x) const
{
  Multipliers result = met(x);
  std::transform(result.begin(), result.end(), b.begin(), result.begin(), std::minus<>());
  return result;
}

Vector<double> TractionSystem::minimiser() const
{
  const LinearSolver solver(A, {});
  const auto product = [](const Multipliers &u, const Multipliers &v)
  { return std::inner_product(u.begin(), u.end(), v.begin(), 0.); };
  Multipliers p(b.size());
  std::transform(rho.begin(), rho.end(), b.begin(), p.begin(), std::multiplies<>());
  Vector<double> right = forces(p);
  right -= g;
  Vector<double> x = solver.solve(right);
  Multipliers r = missed(x), z(b.size());
  double last = 0;
  for (unsigned int pass = 0; pass < 100 && largest(r) > 1e-13 * x.linfty_norm(); ++pass)
  {
    std::transform(rho.begin(), rho.end(), r.begin(), z.begin(), std::multiplies<>());
    const double square = product(r, z);
    for (unsigned int k = 0; k < p.size(); ++k)
      p[k] = z[k] + (pass == 0 ? 0. : square / last * p[k]);
    const Vector<double> y = solver.solve(forces(p));
    Vector<double> next(x);
    next.add(-square / product(p, met(y)), y);
    const Multipliers rest = missed(next);
    // Far from the origin the data have fewer digits than the tolerance asks for: steps would lead away again.
    if (largest(rest) > 0.5 * largest(r) && largest(r) < 1e-10 * x.linfty_norm())
      break;
    x = next;
    r = rest;
    last = square;
  }
  return x;
}

/** A corner has a part in its two edges alone. */
unsigned int corner_of(const TractionEnergy &element, const unsigned int condition)
{
  unsigned int corner = 0;
  const double *const N = element.N.entries + std::size_t(condition) * element.N.stride;
  for (const unsigned int face : {1, 3})
  {
    const double *const begin = N + element.edge_entry(face, 0);
    if (std::any_of(begin, begin + element.n_edges() / 4,
                    [](const double entry) { return entry != 0.; }))
      corner += face == 1 ? 1 : 2;
  }
  return corner;
}

WorstCondition TractionSystem::worst(const Multipliers &missed) const
{
  WorstCondition result;
  for (unsigned int index = 0; index < cells.size(); ++index)
    for (unsigned int k = 0; k < cells[index].n_conditions; ++k)
      if (const double value = std::abs(missed[cells[index].first_condition + k]);
          !(value <= result.missed))
        result = {value, index,
                  k < 3 ? numbers::invalid_unsigned_int // three motions come first
                        : corner_of(patch_cells[index].element, k)};
  return result;
}

WorstCondition TractionSystem::solve()
{
  const Vector<double> x = minimiser();
  for (unsigned int e = 0; e < edges.size(); ++e)
    for (unsigned int c = 0; c < 2; ++c)
    {
      std::vector<double> &sum = (*edges[e].sum)[c];
      for (unsigned int i = 0; edges[e].edge->components[c].is_unknown && i < sum.size(); ++i)
        sum[i] += x[first[e][c] + i];
    }
  return worst(missed(x));
}
} // namespace

WorstCondition solve_all(const std::vector<PatchCell> &cells, const std::vector<PatchEdge> &edges,
                         const LegendreTables &legendre)
{
  return TractionSystem(cells, edges, legendre).solve();
}
} // namespace hpvi
