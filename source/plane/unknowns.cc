// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numbers.h>
#include <hpvi/plane/unknowns.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A node with two displacements that are unknowns, `u = sum_k x_k d_k` from now on. */
struct RotatedNode
{
  std::array<unsigned int, 2> unknowns; ///< of components 0 and 1
  std::array<types::global_dof_index, 2> dofs;
  std::array<Tensor<1, 2>, 2>
      directions; ///< tangent and normal, so that d_k has most of component k
};

/**
 * Nodes of slanted contact edges where both components of u are unknowns, by either of these. Tangent and normal in their
 * place make a scene that is turned the same.
 */
std::map<unsigned int, RotatedNode> rotated_nodes(const ContactOperator<2> &contact_operator,
                                                  const Unknowns<2> &unknowns)
{
  std::map<unsigned int, RotatedNode> result;
  for (const ContactOperator<2>::Rows &rows : contact_operator.rows())
  {
    const ContactFrame<2> frame = rows.face->frame(0.5);
    const Tensor<1, 2> &t = frame.tangent, &n = frame.normal;
    const bool along_x = std::abs(t[0]) >= std::abs(t[1]);
    const Tensor<1, 2> first = along_x ? t : n, second = along_x ? n : t;
    const unsigned int n_nodes = rows.dofs.size() / 2;
    for (unsigned int node = 0; node < n_nodes && std::abs(t[0] * t[1]) > 1e-12; ++node)
    {
      const std::array<types::global_dof_index, 2> dofs{
          {rows.dofs[node], rows.dofs[n_nodes + node]}};
      if (!unknowns.is_plain(dofs[0]) || !unknowns.is_plain(dofs[1]))
        continue;
      const std::array<unsigned int, 2> own{
          {unknowns.terms(dofs[0])[0].first, unknowns.terms(dofs[1])[0].first}};
      const RotatedNode turned{
          own, dofs, {{first[0] < 0 ? -first : first, second[1] < 0 ? -second : second}}};
      for (const unsigned int unknown : own)
        result.emplace(unknown, turned);
    }
  }
  return result;
}

/** A row of T by the unknowns of turned nodes. */
std::vector<std::pair<unsigned int, double>>
turned(const Terms &terms, const std::map<unsigned int, RotatedNode> &nodes)
{
  std::map<unsigned int, double> sum;
  double largest = 0;
  for (const auto &[unknown, weight] : terms)
  {
    largest = std::max(largest, std::abs(weight));
    const auto found = nodes.find(unknown);
    if (found == nodes.end())
      sum[unknown] += weight;
    else
      for (unsigned int k = 0; k < 2; ++k)
        sum[found->second.unknowns[k]] +=
            weight * found->second.directions[k][unknown == found->second.unknowns[0] ? 0 : 1];
  }
  std::vector<std::pair<unsigned int, double>> result;
  for (const auto &[unknown, weight] : sum)
    if (std::abs(weight) > 1e-14 * largest) // the other direction of a slanted edge cancels
      result.emplace_back(unknown, weight);
  return result;
}
} // namespace

template <int dim>
Unknowns<dim>::Unknowns(const DisplacementSpace<dim> &displacement_space,
                        const ContactOperator<dim> &contact_operator,
                        const ShapeTables<dim> &tables)
    : space(displacement_space), contact_operator(contact_operator),
      moments(contact_operator.contact_space().n_multipliers(), none), offsets(space.n_dofs())
{
  const std::vector<unsigned int> numbers = number(tables);
  const std::map<types::global_dof_index, Line> inside_contact_edges = edges_with_moments(numbers);

  first_entry.reserve(space.n_dofs() + 1);
  auto edge_line = inside_contact_edges.begin(); // ascending, as the loop is
  Line line;
  for (types::global_dof_index dof = 0; dof < space.n_dofs(); ++dof)
  {
    first_entry.push_back(entries.size());
    if (edge_line != inside_contact_edges.end() && edge_line->first == dof)
    {
      entries.insert(entries.end(), edge_line->second.begin(), edge_line->second.end());
      ++edge_line;
    }
    else if (numbers[dof] != none)
      entries.emplace_back(numbers[dof], 1.);
    else if (space.constraints().is_constrained(dof))
    {
      line.clear();
      add_terms(dof, 1., numbers, line, offsets[dof]);
      entries.insert(entries.end(), line.begin(), line.end());
    }
  }
  first_entry.push_back(entries.size());

  const std::map<unsigned int, RotatedNode> nodes = rotated_nodes(contact_operator, *this);
  if (nodes.empty())
    return;
  std::vector<std::pair<unsigned int, double>> all;
  std::vector<std::size_t> first;
  for (types::global_dof_index dof = 0; dof < space.n_dofs(); ++dof)
  {
    const Line own = turned(terms(dof), nodes);
    first.push_back(all.size());
    all.insert(all.end(), own.begin(), own.end());
  }
  first.push_back(all.size());
  entries.swap(all);
  first_entry.swap(first);
  for (const auto &[unknown, node] : nodes)
    rotated.push_back({unknown, node.dofs, node.directions[unknown == node.unknowns[0] ? 0 : 1]});
}

/** Free displacements on the boundary of cells, in the order in which cells show them. */
template <int dim>
std::vector<unsigned int> Unknowns<dim>::number(const ShapeTables<dim> &tables)
{
  std::vector<unsigned int> numbers(space.n_dofs(), none);
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int index = cell->active_cell_index();
      const auto cell_dofs = space.cell_dofs(index);
      const unsigned int n_boundary = tables.numbering(space.degrees()[index]).n_boundary;
      for (unsigned int i = 0; i < n_boundary; ++i)
        if (numbers[cell_dofs[i]] == none && !space.constraints().is_constrained(cell_dofs[i]))
        {
          numbers[cell_dofs[i]] = dofs.size();
          dofs.push_back(cell_dofs[i]);
        }
    }
  return numbers;
}

/** Add `weight u` of a displacement that is free or constrained by others that are. */
template <int dim>
void Unknowns<dim>::add_terms(const types::global_dof_index dof, const double weight,
                              const std::vector<unsigned int> &numbers, Line &line,
                              double &offset) const
{
  if (const auto *constrained = space.constraints().get_constraint_entries(dof))
  {
    for (const auto &[master, factor] : *constrained)
      line.emplace_back(numbers[master], weight * factor);
    offset += weight * space.constraints().get_inhomogeneity(dof);
  }
  else if (numbers[dof] != none)
    line.emplace_back(numbers[dof], weight);
}

/** Rows of T for the nodes inside contact edges that have moments. */
template <int dim>
std::map<types::global_dof_index, typename Unknowns<dim>::Line>
Unknowns<dim>::edges_with_moments(const std::vector<unsigned int> &numbers)
{
  static_assert(dim == 2, "a tangent and a normal");
  std::map<types::global_dof_index, Line> lines;
  const std::vector<EdgeRows> &all = contact_operator.rows();
  for (unsigned int k = 0; k < all.size(); ++k)
  {
    const EdgeRows *friction = nullptr, *pressure = nullptr;
    const ContactFace<dim> *face = all[k].face;
    for (; k < all.size() && all[k].face == face; ++k)
      if (all[k].nodes)
        (all[k].kind == ContactOperator<dim>::Kind::friction ? friction : pressure) = &all[k];
    --k;
    if (!friction && !pressure)
      continue;
    const std::vector<types::global_dof_index> &edge_dofs = (friction ? friction : pressure)->dofs;
    const ContactFrame<dim> frame = face->frame(0.5);
    // Each direction takes the place of the component that it has most of.
    const unsigned int along = std::abs(frame.tangent[0]) >= std::abs(frame.tangent[1]) ? 0 : 1;
    express(friction, edge_dofs, frame.tangent, along, numbers, lines);
    if (!face->condition->holds_normal())
      express(pressure, edge_dofs, frame.normal, 1 - along, numbers, lines);
  }
  return lines;
}

/** `sum_i N_ji m'_i`, m' the moments of the body opposite: the unknowns are those of the jump. */
template <int dim>
typename Unknowns<dim>::Line
Unknowns<dim>::moments_opposite(const EdgeRows &rows, const FullMatrix<double> &N,
                                const unsigned int j, const std::vector<unsigned int> &numbers,
                                double &offset) const
{
  Line line;
  const auto &multipliers = contact_operator.contact_space().multipliers();
  for (unsigned int k = 0; k < rows.master_dofs.size(); ++k)
  {
    double weight = 0;
    for (unsigned int i = 0; i < rows.multipliers.size(); ++i)
      weight += N(j, i) * rows.master(i, k) / multipliers[rows.multipliers[i]].weight;
    if (weight != 0.)
      add_terms(rows.master_dofs[k], weight, numbers, line, offset);
  }
  return line;
}

/**
 * Add to the rows of T of the nodes inside an edge the displacement along @p direction, whose unknowns
 * are those that @p component would have: `u += d (N (m, u_d(0), u_d(1)))` with moments, or where
 * there are none, @p rows null, `u += d u_d` with nodal values.
 */
template <int dim>
void Unknowns<dim>::express(const EdgeRows *rows,
                            const std::vector<types::global_dof_index> &edge_dofs,
                            const Tensor<1, dim> &direction, const unsigned int component,
                            const std::vector<unsigned int> &numbers,
                            std::map<types::global_dof_index, Line> &lines)
{
  const unsigned int n_nodes = edge_dofs.size() / dim, n = n_nodes - 2;
  const auto dof_at = [&](const unsigned int c, const unsigned int node)
  { return edge_dofs[c * n_nodes + node]; };
  // Where u_n = 0, either component may be the free one.
  const auto unknown_at = [&](const unsigned int node)
  {
    const unsigned int own = numbers[dof_at(component, node)];
    return own != none ? own : numbers[dof_at(1 - component, node)];
  };
  for (unsigned int i = 0; i < n && rows; ++i)
    moments[rows->multipliers[i]] = unknown_at(i + 1);

  for (unsigned int j = 0; j < n; ++j)
  {
    std::map<unsigned int, double> u_d;
    double offset = 0;
    Tensor<1, dim> along = direction;
    if (rows)
    {
      const FullMatrix<double> &N = *rows->nodes;
      for (unsigned int i = 0; i < n; ++i)
        u_d[moments[rows->multipliers[i]]] = N(j, i);
      for (const auto &[unknown, weight] : moments_opposite(*rows, N, j, numbers, offset))
        u_d[unknown] += weight;
      for (const unsigned int end : {0U, 1U})
        for (unsigned int c = 0; c < dim; ++c)
          if (direction[c] != 0.)
          {
            Line line;
            add_terms(dof_at(c, end * (n_nodes - 1)), N(j, n + end) * direction[c], numbers, line,
                      offset);
            for (const auto &[unknown, weight] : line)
              u_d[unknown] += weight;
          }
    }
    else
    {
      along *= direction[component] < 0 ? -1. : 1.; // so that a component of u stays what it is
      u_d[unknown_at(j + 1)] = 1.;
      rotated.push_back({unknown_at(j + 1), {{dof_at(0, j + 1), dof_at(1, j + 1)}}, along});
    }
    for (unsigned int c = 0; c < dim; ++c)
    {
      Line &line = lines[dof_at(c, j + 1)];
      offsets[dof_at(c, j + 1)] += along[c] * offset;
      for (const auto &[unknown, weight] : u_d)
        if (along[c] != 0.)
          line.emplace_back(unknown, along[c] * weight);
    }
  }
}

template <int dim>
unsigned int Unknowns<dim>::n() const
{
  return dofs.size();
}

template <int dim>
Terms Unknowns<dim>::terms(const types::global_dof_index dof) const
{
  return {entries.data() + first_entry[dof], first_entry[dof + 1] - first_entry[dof]};
}

template <int dim>
double Unknowns<dim>::prescribed(const types::global_dof_index dof) const
{
  return offsets[dof];
}

template <int dim>
bool Unknowns<dim>::is_plain(const types::global_dof_index dof) const
{
  return first_entry[dof + 1] == first_entry[dof] + 1 && entries[first_entry[dof]].second == 1. &&
         dofs[entries[first_entry[dof]].first] == dof;
}

template <int dim>
Vector<double> Unknowns<dim>::expand(const Vector<double> &x) const
{
  Vector<double> u(space.n_dofs());
  for (types::global_dof_index dof = 0; dof < u.size(); ++dof)
    for (const auto &[unknown, weight] : terms(dof))
      u[dof] += weight * x[unknown];
  return u;
}

template <int dim>
Vector<double> Unknowns<dim>::distribute(const Vector<double> &x) const
{
  Vector<double> u = expand(x);
  u += offsets;
  return u;
}

template <int dim>
Vector<double> Unknowns<dim>::collect(const Vector<double> &forces) const
{
  Vector<double> result(n());
  for (types::global_dof_index dof = 0; dof < forces.size(); ++dof)
    if (forces[dof] != 0.)
      for (const auto &[unknown, weight] : terms(dof))
        result[unknown] += weight * forces[dof];
  return result;
}

template <int dim>
Vector<double> Unknowns<dim>::coordinates(const Vector<double> &u) const
{
  Vector<double> x(n());
  for (unsigned int unknown = 0; unknown < n(); ++unknown)
    x[unknown] = u[dofs[unknown]];
  for (const NodalValue &node : rotated)
  {
    x[node.unknown] = 0;
    for (unsigned int c = 0; c < dim; ++c)
      x[node.unknown] += node.direction[c] * u[node.dofs[c]];
  }
  const Vector<double> Bu = contact_operator.moments(u);
  const auto &multipliers = contact_operator.contact_space().multipliers();
  for (unsigned int i = 0; i < moments.size(); ++i)
    if (moments[i] != none)
      x[moments[i]] = Bu[i] / multipliers[i].weight;
  return x;
}

template <int dim>
ConditionRows Unknowns<dim>::contact_rows() const
{
  const double negligible = 1e-14;
  const auto &multipliers = contact_operator.contact_space().multipliers();
  ConditionRows result;
  result.B.resize(moments.size());
  result.prescribed.reinit(moments.size());
  std::map<unsigned int, std::map<unsigned int, double>> sums; // two faces may give to one row
  for (const EdgeRows &rows : contact_operator.rows())
    for (unsigned int i = 0; i < rows.B.m(); ++i)
    {
      const unsigned int row = rows.multipliers[i];
      if (rows.nodes)
      {
        result.B[row] = {{moments[row], multipliers[row].weight}};
        continue;
      }
      std::map<unsigned int, double> &sum = sums[row];
      for (unsigned int j = 0; j < rows.B.n(); ++j)
      {
        result.prescribed[row] += rows.B(i, j) * offsets[rows.dofs[j]];
        if (std::abs(rows.B(i, j)) > negligible * rows.B.linfty_norm())
          for (const auto &[unknown, weight] : terms(rows.dofs[j]))
            sum[unknown] += rows.B(i, j) * weight;
      }
      for (unsigned int j = 0; j < rows.master.n(); ++j)
      {
        result.prescribed[row] -= rows.master(i, j) * offsets[rows.master_dofs[j]];
        for (const auto &[unknown, weight] : terms(rows.master_dofs[j]))
          sum[unknown] -= rows.master(i, j) * weight;
      }
    }
  for (const auto &[row, sum] : sums)
  {
    double largest = 0;
    for (const auto &[unknown, weight] : sum)
      largest = std::max(largest, std::abs(weight));
    for (const auto &[unknown, weight] : sum)
      if (std::abs(weight) > negligible * largest) // the other direction of a slanted edge cancels
        result.B[row].emplace_back(unknown, weight);
  }
  for (unsigned int i = 0; i < multipliers.size(); ++i)
    result.prescribed[i] -= multipliers[i].gap;

  for (const Line &row : result.B)
    for (const auto &entry : row)
      result.interface.push_back(entry.first);
  std::sort(result.interface.begin(), result.interface.end());
  result.interface.erase(std::unique(result.interface.begin(), result.interface.end()),
                         result.interface.end());
  for (Line &row : result.B)
    for (auto &entry : row)
      entry.first =
          std::lower_bound(result.interface.begin(), result.interface.end(), entry.first) -
          result.interface.begin();
  return result;
}

template class Unknowns<2>;
} // namespace hpvi
