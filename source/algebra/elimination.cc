// SPDX-License-Identifier: LGPL-2.1-or-later

// What CHOLMOD does before any number is known is for one thread, and takes a time that goes with the entries of A. In a finite element of
// degree p an edge has p - 1 unknowns for each component, and all have the same neighbours: one of them says it for all.
#include <hpvi/algebra/elimination.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace hpvi
{
namespace
{
/** From so many unknowns on nested dissection by METIS wins in space what it takes itself (doc/space.md). */
constexpr std::size_t dissected = 150000;

/** CHOLMOD's supernodes: columns super[s], ..., super[s + 1] - 1 have the rows from pi[s] on, and their values from px[s] on. */
struct Structure
{
  std::vector<int> super{0}, pi{0}, px{0}, rows;
  double n_values = 0, largest_update = 0; ///< more than an index can count would not fit

  Structure(const cholmod_factor &of_classes, const std::vector<int> &start);
  cholmod_factor *symbolic_factor(cholmod_common &common) const;
};

/** Of unknowns, from that of classes: @p start as in Elimination. */
Structure::Structure(const cholmod_factor &of_classes, const std::vector<int> &start)
{
  const int *const class_super = static_cast<const int *>(of_classes.super),
                   *const class_pi = static_cast<const int *>(of_classes.pi),
                   *const class_rows = static_cast<const int *>(of_classes.s);
  for (unsigned int s = 0; s < of_classes.nsuper; ++s)
  {
    super.push_back(start[class_super[s + 1]]);
    for (int k = class_pi[s]; k < class_pi[s + 1]; ++k)
      for (int row = start[class_rows[k]]; row < start[class_rows[k] + 1]; ++row)
        rows.push_back(row);
    const std::size_t n_columns = super[s + 1] - super[s], n_rows = rows.size() - pi[s];
    pi.push_back(rows.size());
    n_values += double(n_columns) * n_rows;
    px.push_back(n_values <= std::numeric_limits<int>::max() ? int(n_values) : 0);
  }
  std::vector<unsigned int> of_column;
  for (unsigned int s = 0; s + 1 < super.size(); ++s)
    of_column.resize(super[s + 1], s);
  for (unsigned int s = 0; s + 1 < super.size(); ++s)
    for (int begin = pi[s] + super[s + 1] - super[s], end = begin; begin < pi[s + 1]; begin = end)
    {
      while (end < pi[s + 1] && of_column[rows[end]] == of_column[rows[begin]])
        ++end;
      largest_update = std::max(largest_update, double(end - begin) * (pi[s + 1] - begin));
    }
}

/** With the members that cholmod_free_factor() expects. */
cholmod_factor *Structure::symbolic_factor(cholmod_common &common) const
{
  cholmod_factor *L = cholmod_allocate_factor(super.back(), &common);
  if (!L)
    return nullptr;
  const auto copy = [&](const std::vector<int> &numbers)
  {
    auto *const result = static_cast<int *>(cholmod_malloc(numbers.size(), sizeof(int), &common));
    if (result)
      std::copy(numbers.begin(), numbers.end(), result);
    return result;
  };
  L->is_super = L->is_ll = true;
  L->nsuper = super.size() - 1;
  L->ssize = rows.size();
  L->xsize = n_values;
  L->maxcsize = largest_update;
  L->super = copy(super);
  L->pi = copy(pi);
  L->px = copy(px);
  L->s = copy(rows);
  return L;
}
} // namespace

Elimination::Elimination(const cholmod_sparse &A, const EliminationHints &hints,
                         const std::vector<unsigned int> &interface, cholmod_common &common)
{
  gather(A, hints.supervariables);
  order(hints.stage, interface, common);
  if (common.status == CHOLMOD_OK)
    expand();
}

/** The first unknown of a class stands for it. */
void Elimination::gather(const cholmod_sparse &A, const std::vector<unsigned int> &supervariables)
{
  const unsigned int n = A.ncol;
  std::vector<unsigned int> own;
  if (supervariables.empty())
  {
    own.resize(n);
    std::iota(own.begin(), own.end(), 0);
  }
  const std::vector<unsigned int> &of = supervariables.empty() ? own : supervariables;
  n_classes = 1 + *std::max_element(of.begin(), of.end());
  first.assign(n_classes + 1, 0);
  for (const unsigned int number : of)
    ++first[number + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> end(first.begin(), first.end() - 1);
  member.resize(n);
  for (unsigned int i = 0; i < n; ++i)
    member[end[of[i]]++] = i;
  const int *const A_start = static_cast<const int *>(A.p), *const A_row =
                                                                static_cast<const int *>(A.i);
  column_start.push_back(0);
  for (unsigned int k = 0; k < n_classes; ++k)
  {
    const int column = member[first[k]];
    for (int entry = A_start[column]; entry < A_start[column + 1]; ++entry)
      if (const unsigned int other = of[A_row[entry]]; member[first[other]] == A_row[entry])
        row.push_back(other);
    column_start.push_back(row.size());
  }
}

cholmod_sparse Elimination::as_cholmod()
{
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = n_classes;
  matrix.nzmax = row.size();
  matrix.p = column_start.data();
  matrix.i = row.data();
  matrix.stype = 1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.packed = true;
  return matrix;
}

// CAMD is a minimum degree ordering under constraints: group by group, here stage by stage, then the unknowns that are kept.
void Elimination::order(const std::vector<unsigned int> &stage,
                        const std::vector<unsigned int> &interface, cholmod_common &common)
{
  const int last = stage.empty() ? 1 : 1 + *std::max_element(stage.begin(), stage.end());
  std::vector<int> groups(n_classes, 0);
  if (interface.size() <
      member.size()) // else all are in one group, and CAMD wants its number to be below n
    for (unsigned int k = 0; k < n_classes; ++k)
    {
      const unsigned int unknown = member[first[k]];
      if (std::binary_search(interface.begin(), interface.end(), unknown))
        groups[k] = last;
      else if (!stage.empty())
        groups[k] = stage[unknown];
    }
  class_order.resize(n_classes);
  cholmod_sparse matrix = as_cholmod();
  if (interface.empty() && stage.empty() && member.size() >= dissected)
    cholmod_metis(&matrix, nullptr, 0, /*postorder=*/true, class_order.data(), &common);
  else
    cholmod_camd(&matrix, nullptr, 0, groups.data(), class_order.data(), &common);
}

void Elimination::expand()
{
  start.push_back(0);
  for (const int number : class_order)
  {
    permutation.insert(permutation.end(), member.begin() + first[number],
                       member.begin() + first[number + 1]);
    start.push_back(permutation.size());
  }
}

cholmod_factor *Elimination::analyse(cholmod_common &common)
{
  // The order is taken as it is: a postordering could move interface dofs away from the end.
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = false;
  cholmod_sparse matrix = as_cholmod();
  for (std::size_t &n_columns : common.nrelax) // up to which supernodes may have zeros
    n_columns = n_columns * n_classes / member.size();
  cholmod_factor *of_classes = cholmod_analyze_p(&matrix, class_order.data(), nullptr, 0, &common);
  if (!of_classes)
    return nullptr;
  const Structure structure(*of_classes, start);
  cholmod_free_factor(&of_classes, &common);
  if (structure.n_values > std::numeric_limits<int>::max())
  {
    common.status = CHOLMOD_TOO_LARGE;
    return nullptr;
  }
  return structure.symbolic_factor(common);
}
} // namespace hpvi
