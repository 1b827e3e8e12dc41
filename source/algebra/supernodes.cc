// SPDX-License-Identifier: LGPL-2.1-or-later

// CHOLMOD's factorisation takes one supernode after the other, and leaves threads to BLAS, whose matrices are small here: in the plane
// half of the work is in blocks of less than a hundred rows. What can be done at once is in the elimination tree: supernodes
// that are not above one another know nothing of each other. A supernode is complete when all below it have
// subtracted what they add to it.
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/algebra/supernodes.h>
#include <hpvi/base/team.h>

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

private:
  /** What one thread works with. */
  struct Scratch
  {
    std::vector<int> place,
        relative; ///< by row of the matrix: its place in the supernode; by row of an update
    std::vector<double> product;
  };

  int n_rows(const int s) const
  {
    return pi[s + 1] - pi[s];
  }
  int n_columns(const int s) const
  {
    return super[s + 1] - super[s];
  }
  double work(const Update &update) const
  {
    const double columns = update.end - update.first;
    return columns * (n_rows(update.from) - update.first) * n_columns(update.from);
  }
  double work(int s) const;
  void set_updates();
  void set_tasks();
  void begin(int s, std::vector<int> &place);
  void multiply(const Update &update, double *product) const;
  void subtract(int s, const Update &update, const std::vector<int> &place, const double *product,
                int first_column, int end_column, std::vector<int> &relative);
  void complete(int s);
  std::unique_ptr<Scratch> take_scratch();
  void give_back(std::unique_ptr<Scratch> scratch);
  void factor_alone(int s, Scratch &scratch);
  void factor_together(int s, Scratch &scratch);

  const int n_super, *const super, *const pi, *const px, *const rows;
  const int *const A_start, *const A_row;
  const double *const A_value;
  double *const x;
  const std::size_t n;
  std::vector<int> parent;         ///< of each supernode; n_super: none
  std::vector<Update> updates;     ///< of all supernodes, one after the other, as CHOLMOD has them
  std::vector<unsigned int> first; ///< of a supernode
  std::vector<std::vector<int>> tasks; ///< subtrees: their supernodes, from below
  std::vector<int> above;              ///< all others
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
  set_tasks();
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
    result += work(updates[k]);
  return result;
}

/** The largest subtrees with less than a part of all work. */
void Supernodes::set_tasks()
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
  tasks.resize(sizes.size());
  for (int s = 0; s < n_super; ++s)
    (task[s] < 0 ? above : tasks[place[task[s]]]).push_back(s);
}

/** The entries of A, and where its rows are. */
void Supernodes::begin(const int s, std::vector<int> &place)
{
  const std::size_t m = n_rows(s);
  std::fill(x + px[s], x + px[s] + m * n_columns(s), 0.);
  place.resize(n);
  for (int k = pi[s]; k < pi[s + 1]; ++k)
    place[rows[k]] = k - pi[s];
  for (int column = super[s]; column < super[s + 1]; ++column)
    for (int k = A_start[column]; k < A_start[column + 1]; ++k)
      x[px[s] + m * (column - super[s]) + place[A_row[k]]] = A_value[k];
}

/** product := what is to be subtracted, the lower triangle and what is below it. */
void Supernodes::multiply(const Update &update, double *const product) const
{
  const blas_int m = n_rows(update.from), inner = n_columns(update.from),
                 columns = update.end - update.first, all = m - update.first, rest = all - columns;
  const double one = 1., zero = 0., *const begin = x + px[update.from] + update.first;
  dsyrk_("L", "N", &columns, &inner, &one, begin, &m, &zero, product, &all);
  if (rest > 0)
    dealii::gemm("N", "C", &rest, &columns, &inner, &one, begin + columns, &m, begin, &m, &zero,
                 product + columns, &all);
}

/** In some columns of the supernode. */
void Supernodes::subtract(const int s, const Update &update, const std::vector<int> &place,
                          const double *const product, const int first_column, const int end_column,
                          std::vector<int> &relative)
{
  const std::size_t m = n_rows(s);
  const int all = n_rows(update.from) - update.first;
  const int *const own = rows + pi[update.from] + update.first;
  int begin = 0, end = update.end - update.first;
  while (begin < end && place[own[begin]] < first_column)
    ++begin;
  while (begin < end && place[own[end - 1]] >= end_column)
    --end;
  relative.resize(all);
  for (int i = begin; begin < end && i < all; ++i)
    relative[i] = place[own[i]];
  for (int j = begin; j < end; ++j)
  {
    double *const column = x + px[s] + m * relative[j];
    const double *const values = product + std::size_t(j) * all;
    for (int i = j; i < all; ++i)
      column[relative[i]] -= values[i];
  }
}

/** Its own Cholesky factor, and what is below it. */
void Supernodes::complete(const int s)
{
  const blas_int m = n_rows(s), columns = n_columns(s), rest = m - columns;
  double *const block = x + px[s], one = 1.;
  blas_int info = 0;
  dealii::potrf("L", &columns, block, &m, &info);
  if (info != 0)
    is_positive = false;
  if (rest > 0)
    dtrsm_("R", "L", "C", "N", &rest, &columns, &one, block, &m, block + columns, &m);
}

void Supernodes::factor_alone(const int s, Scratch &scratch)
{
  begin(s, scratch.place);
  for (unsigned int k = first[s]; k < first[s + 1]; ++k)
  {
    const Update &update = updates[k];
    const std::size_t size =
        std::size_t(n_rows(update.from) - update.first) * (update.end - update.first);
    if (scratch.product.size() < size)
      scratch.product.resize(size);
    multiply(update, scratch.product.data());
    subtract(s, update, scratch.place, scratch.product.data(), 0, n_columns(s), scratch.relative);
  }
  complete(s);
}

/** Products of some updates at a time, and then what they subtract, by columns. */
void Supernodes::factor_together(const int s, Scratch &scratch)
{
  begin(s, scratch.place);
  constexpr std::size_t most = 1 << 20; // entries that are kept
  std::vector<std::size_t> start;
  for (unsigned int k = first[s]; k < first[s + 1];)
  {
    const unsigned int group = k;
    std::size_t size = 0;
    start.clear();
    for (; k < first[s + 1] && size < most; ++k)
    {
      start.push_back(size);
      size += std::size_t(n_rows(updates[k].from) - updates[k].first) *
              (updates[k].end - updates[k].first);
    }
    if (scratch.product.size() < size)
      scratch.product.resize(size);
    for_all(k - group, 4,
            [&](const unsigned int i)
            { multiply(updates[group + i], &scratch.product[start[i]]); });
    in_parts(n_columns(s), 16,
             [&](const unsigned int begin, const unsigned int end)
             {
               std::vector<int> relative;
               for (unsigned int i = 0; i < start.size(); ++i)
                 subtract(s, updates[group + i], scratch.place, &scratch.product[start[i]], begin,
                          end, relative);
             });
  }
  complete(s);
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
  for_all(tasks.size(), 1,
          [&](const unsigned int k)
          {
            std::unique_ptr<Scratch> scratch = take_scratch();
            for (const int s : tasks[k])
              if (is_positive)
                factor_alone(s, *scratch);
            give_back(std::move(scratch));
          });
  Scratch scratch;
  for (const int s : above)
    if (is_positive)
    {
      if (team_size() > 1 && work(s) > 1e6)
        factor_together(s, scratch);
      else
        factor_alone(s, scratch);
    }
  return is_positive;
}
} // namespace

bool factor_supernodes(const cholmod_sparse &A, cholmod_factor &L)
{
  return Supernodes(A, L).factor();
}
} // namespace hpvi
