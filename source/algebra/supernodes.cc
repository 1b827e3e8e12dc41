// SPDX-License-Identifier: LGPL-2.1-or-later

// CHOLMOD's factorisation takes one supernode after the other, and leaves threads to BLAS, whose matrices are small here: in the plane
// half of the work is in blocks of less than a hundred rows. What can be done at once is in the elimination tree: supernodes
// that are not above one another know nothing of each other. A supernode is complete when all below it have
// subtracted what they add to it. The few at the top are most of the work that is left, and large: their columns are worked on in panels,
// which also touch the memory of the factor first where they are set, the dearest part of a large one.
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/algebra/supernodes.h>
#include <hpvi/base/thread_pool.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

// deal.II does not declare these.
extern "C"
{
  void dsyrk_(const char *, const char *, const dealii::types::blas_int *,
              const dealii::types::blas_int *, const double *, const double *,
              const dealii::types::blas_int *, const double *, double *,
              const dealii::types::blas_int *);
  void dtrsm_(const char *, const char *, const char *, const char *,
              const dealii::types::blas_int *, const dealii::types::blas_int *, const double *,
              const double *, const dealii::types::blas_int *, double *,
              const dealii::types::blas_int *);
}

namespace hpvi
{
using dealii::types::blas_int;

namespace
{
/** Columns of a large supernode that are worked on at once, and rows below them: whatever the number of threads. */
constexpr int panel = 64, panel_rows = 256;

/** What supernode @p from does to one above it: its rows from @p first to @p end are columns there. */
struct Update
{
  int from, first, end;
};

class Supernodes
{
public:
  Supernodes(const cholmod_sparse &A, cholmod_factor &L);
  bool factor();

  SharedSupernodes shared;

private:
  /** What one thread works with. */
  struct Scratch
  {
    std::vector<int> place,
        relative; ///< by row of the matrix: its place in the supernode; by row of an update
    std::unique_ptr<double[]> product;
    std::size_t size = 0; ///< of the product
  };

  int n_rows(const int s) const
  {
    return pi[s + 1] - pi[s];
  }
  int n_columns(const int s) const
  {
    return super[s + 1] - super[s];
  }
  double work(int s) const;
  void set_updates();
  void share();
  void begin(int s, const std::vector<int> &place, int first_column, int end_column);
  Update part_of(const Update &update, int first_column, int end_column) const;
  void multiply(const Update &update, Scratch &scratch) const;
  void subtract(int s, const Update &update, const std::vector<int> &place, Scratch &scratch);
  void set_columns(int s, const std::vector<int> &place, int first_column, int end_column,
                   Scratch &scratch);
  void complete(int s, int first_column, int end_column);
  void complete_panels(int s);
  std::unique_ptr<Scratch> take_scratch();
  void give_back(std::unique_ptr<Scratch> scratch);
  void factor(int s, Scratch &scratch);

  const int n_super, *const super, *const pi, *const px, *const rows;
  const int *const A_start, *const A_row;
  const double *const A_value;
  double *const x;
  const std::size_t n;
  std::vector<int> parent;         ///< of each supernode; n_super: none
  std::vector<Update> updates;     ///< of all supernodes, one after the other, as CHOLMOD has them
  std::vector<unsigned int> first; ///< of a supernode
  std::atomic<bool> is_positive{true};
  std::mutex mutex;
  std::vector<std::unique_ptr<Scratch>> idle; ///< with the mutex held
};

Supernodes::Supernodes(const cholmod_sparse &A, cholmod_factor &L)
    : n_super(L.nsuper), super(static_cast<const int *>(L.super)),
      pi(static_cast<const int *>(L.pi)), px(static_cast<const int *>(L.px)),
      rows(static_cast<const int *>(L.s)), A_start(static_cast<const int *>(A.p)),
      A_row(static_cast<const int *>(A.i)), A_value(static_cast<const double *>(A.x)),
      x(static_cast<double *>(L.x)), n(L.n), parent(n_super, n_super)
{
  set_updates();
  share();
}

/** A supernode is in the list of the one that its next rows are columns of; what came last is first. */
void Supernodes::set_updates()
{
  std::vector<int> of_column(n);
  for (int s = 0; s < n_super; ++s)
    std::fill(of_column.begin() + super[s], of_column.begin() + super[s + 1], s);
  std::vector<int> head(n_super, -1), next(n_super, -1), position(n_super, 0);
  const auto put = [&](const int s)
  {
    const int target = of_column[rows[pi[s] + position[s]]];
    next[s] = head[target];
    head[target] = s;
    return target;
  };
  for (int s = 0; s < n_super; ++s)
  {
    first.push_back(updates.size());
    for (int from = head[s], following; from >= 0; from = following)
    {
      following = next[from];
      int end = position[from];
      while (end < n_rows(from) && rows[pi[from] + end] < super[s + 1])
        ++end;
      updates.push_back({from, position[from], end});
      position[from] = end;
      if (end < n_rows(from))
        put(from);
    }
    position[s] = n_columns(s);
    if (n_rows(s) > n_columns(s))
      parent[s] = put(s);
  }
  first.push_back(updates.size());
}

double Supernodes::work(const int s) const
{
  double result = double(n_columns(s)) * n_columns(s) * n_rows(s);
  for (unsigned int k = first[s]; k < first[s + 1]; ++k)
  {
    const auto &[from, begin, end] = updates[k];
    result += double(end - begin) * (n_rows(from) - begin) * n_columns(from);
  }
  return result;
}

/** The largest subtrees with less than a part of all work. */
void Supernodes::share()
{
  std::vector<double> below(n_super);
  double all = 0;
  for (int s = 0; s < n_super; ++s) // parents come later
  {
    const double own = work(s);
    all += own;
    below[s] += own;
    if (parent[s] < n_super)
      below[parent[s]] += below[s];
  }
  const double most = all / 64;
  std::vector<int> task(n_super, -1);
  std::vector<double> sizes;
  for (int s = n_super - 1; s >= 0; --s)
    if (parent[s] < n_super && task[parent[s]] >= 0)
      task[s] = task[parent[s]];
    else if (below[s] < most)
    {
      task[s] = sizes.size();
      sizes.push_back(below[s]);
    }
  std::vector<int> order(sizes.size()), place(sizes.size()); // the longest first
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](const int a, const int b) { return sizes[a] > sizes[b]; });
  for (unsigned int k = 0; k < order.size(); ++k)
    place[order[k]] = k;
  shared.subtrees.resize(sizes.size());
  std::vector<unsigned int> level(n_super, 0);
  for (int s = 0; s < n_super; ++s)
    if (task[s] >= 0)
      shared.subtrees[place[task[s]]].push_back(s);
    else
    {
      if (parent[s] < n_super)
        level[parent[s]] = std::max(level[parent[s]], level[s] + 1);
      shared.above.resize(std::max<std::size_t>(shared.above.size(), level[s] + 1));
      shared.above[level[s]].push_back(s);
    }
}

/** The entries of A in some columns of the supernode, whose rows are at @p place. */
void Supernodes::begin(const int s, const std::vector<int> &place, const int first_column,
                       const int end_column)
{
  const std::size_t m = n_rows(s);
  std::fill(x + px[s] + m * first_column, x + px[s] + m * end_column, 0.);
  for (int column = first_column; column < end_column; ++column)
    for (int k = A_start[super[s] + column]; k < A_start[super[s] + column + 1]; ++k)
      x[px[s] + m * column + place[A_row[k]]] = A_value[k];
}

/** That of some columns, numbers of the matrix. */
Update Supernodes::part_of(const Update &update, const int first_column, const int end_column) const
{
  const int *const own = rows + pi[update.from], *const end = own + update.end;
  const int *const from = std::lower_bound(own + update.first, end, first_column);
  return {update.from, int(from - own), int(std::lower_bound(from, end, end_column) - own)};
}

/** What is to be subtracted, the lower triangle and what is below it. */
void Supernodes::multiply(const Update &update, Scratch &scratch) const
{
  const blas_int m = n_rows(update.from), inner = n_columns(update.from),
                 columns = update.end - update.first, all = m - update.first, rest = all - columns;
  const std::size_t size = std::size_t(all) * columns;
  if (scratch.size < size)
  {
    scratch.product.reset(); // before there is another
    scratch.product.reset(new double[size]);
    scratch.size = size;
  }
  double *const product = scratch.product.get();
  const double one = 1., zero = 0., *const begin = x + px[update.from] + update.first;
  dsyrk_("L", "N", &columns, &inner, &one, begin, &m, &zero, product, &all);
  if (rest > 0)
    dealii::gemm("N", "C", &rest, &columns, &inner, &one, begin + columns, &m, begin, &m, &zero,
                 product + columns, &all);
}

void Supernodes::subtract(const int s, const Update &update, const std::vector<int> &place,
                          Scratch &scratch)
{
  const std::size_t m = n_rows(s);
  const int all = n_rows(update.from) - update.first;
  const int *const own = rows + pi[update.from] + update.first;
  std::vector<int> &relative = scratch.relative;
  relative.resize(all);
  for (int i = 0; i < all; ++i)
    relative[i] = place[own[i]];
  for (int j = 0; j < update.end - update.first; ++j)
  {
    double *const column = x + px[s] + m * relative[j];
    const double *const values = scratch.product.get() + std::size_t(j) * all;
    for (int i = j; i < all; ++i)
      column[relative[i]] -= values[i];
  }
}

/** Some columns of the supernode: A less what all below it add to them. */
void Supernodes::set_columns(const int s, const std::vector<int> &place, const int first_column,
                             const int end_column, Scratch &scratch)
{
  begin(s, place, first_column, end_column);
  for (unsigned int k = first[s]; k < first[s + 1]; ++k)
  {
    const Update part = part_of(updates[k], super[s] + first_column, super[s] + end_column);
    if (part.first == part.end)
      continue;
    multiply(part, scratch);
    subtract(s, part, place, scratch);
  }
}

/** The Cholesky factor of some columns of the supernode, and what is below it in them, where all before them has been subtracted. */
void Supernodes::complete(const int s, const int first_column, const int end_column)
{
  const blas_int m = n_rows(s), columns = end_column - first_column, rest = m - end_column;
  double *const block = x + px[s] + std::size_t(first_column) * (m + 1), one = 1.;
  blas_int info = 0;
  dealii::potrf("L", &columns, block, &m, &info);
  if (info != 0)
    is_positive = false;
  parallel_for_each((rest + panel_rows - 1) / panel_rows, 1,
                    [&](const unsigned int k)
                    {
                      const blas_int part = std::min(panel_rows, rest - int(k) * panel_rows);
                      dtrsm_("R", "L", "C", "N", &part, &columns, &one, block, &m,
                             block + columns + k * panel_rows, &m);
                    });
}

/** Panel by panel, each of which is subtracted from all that follow. */
void Supernodes::complete_panels(const int s)
{
  const blas_int m = n_rows(s);
  const int columns = n_columns(s);
  double *const block = x + px[s];
  const double minus = -1., one = 1.;
  for (int begin = 0; begin < columns && is_positive; begin += panel)
  {
    const int end = std::min(begin + panel, columns);
    complete(s, begin, end);
    parallel_for_each((columns - end + panel - 1) / panel, 1,
                      [&](const unsigned int k)
                      {
                        const int first_column = end + k * panel;
                        const blas_int inner = end - begin,
                                       part = std::min(panel, columns - first_column),
                                       rest = m - first_column - part;
                        double *const target = block + std::size_t(first_column) * (m + 1);
                        const double *const from = block + std::size_t(begin) * m + first_column;
                        dsyrk_("L", "N", &part, &inner, &minus, from, &m, &one, target, &m);
                        if (rest > 0)
                          dealii::gemm("N", "C", &rest, &part, &inner, &minus, from + part, &m,
                                       from, &m, &one, target + part, &m);
                      });
  }
}

void Supernodes::factor(const int s, Scratch &scratch)
{
  scratch.place.resize(n);
  for (int k = pi[s]; k < pi[s + 1]; ++k)
    scratch.place[rows[k]] = k - pi[s];
  const int columns = n_columns(s);
  if (columns <= 2 * panel)
  {
    set_columns(s, scratch.place, 0, columns, scratch);
    complete(s, 0, columns);
    return;
  }
  parallel_for_each((columns + panel - 1) / panel, 1,
                    [&](const unsigned int k)
                    {
                      std::unique_ptr<Scratch> own = take_scratch();
                      const int begin = k * panel;
                      set_columns(s, scratch.place, begin, std::min(begin + panel, columns), *own);
                      give_back(std::move(own));
                    });
  complete_panels(s);
}

std::unique_ptr<Supernodes::Scratch> Supernodes::take_scratch()
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (idle.empty())
    return std::make_unique<Scratch>();
  std::unique_ptr<Scratch> result = std::move(idle.back());
  idle.pop_back();
  return result;
}

void Supernodes::give_back(std::unique_ptr<Scratch> scratch)
{
  const std::lock_guard<std::mutex> lock(mutex);
  idle.push_back(std::move(scratch));
}

bool Supernodes::factor()
{
  parallel_for_each(shared.subtrees.size(), 1,
                    [&](const unsigned int k)
                    {
                      std::unique_ptr<Scratch> scratch = take_scratch();
                      for (const int s : shared.subtrees[k])
                        if (is_positive)
                          factor(s, *scratch);
                      give_back(std::move(scratch));
                    });
  for (const std::vector<int> &level : shared.above)
    parallel_for_each(level.size(), 1,
                      [&](const unsigned int k)
                      {
                        std::unique_ptr<Scratch> scratch = take_scratch();
                        if (is_positive)
                          factor(level[k], *scratch);
                        give_back(std::move(scratch));
                      });
  return is_positive;
}
} // namespace

std::optional<SharedSupernodes> factor_supernodes(const cholmod_sparse &A, cholmod_factor &L)
{
  Supernodes supernodes(A, L);
  if (!supernodes.factor())
    return {};
  return std::move(supernodes.shared);
}
} // namespace hpvi
