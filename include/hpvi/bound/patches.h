// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_patches_h
#define hpvi_patches_h

#include <hpvi/bound/patch_problem.h>

#include <array>
#include <utility>
#include <vector>

namespace hpvi
{
/** The cells and edges of the patch of a vertex. */
struct Patch
{
  unsigned int vertex;
  std::vector<PatchCell> cells;
  std::vector<PatchEdge> edges;
};

/**
 * The problem of a patch: tractions on its edges such that `sum_K h_K^2 r_K' G_K r_K` is least subject to `N_K' r_K = 0` in each
 * cell, where r_K are the data of its cells and the tractions. Its steps, in their order, for matrices that patches share.
 */
class PatchProblem
{
public:
  /** Both must outlive this object. */
  PatchProblem(const Patch &patch, EquilibrationCache &cache);

  EquilibrationCache::Signature signature() const; ///< equal: one factor will do

  /** What tells which conditions imply the others: the signature without degrees, those of p = 2 excepted. */
  EquilibrationCache::Signature form(const PatchFactor &factor) const;

  void set_matrices(PatchFactor &factor); ///< H and all conditions

  /** Places of as many conditions as `C'H^-1 C` has rank: patches have motions and corners in common. */
  std::vector<unsigned int> independent_conditions(const PatchFactor &factor) const;

  /** `W = L^-1 C` of some conditions and the factor of W'W; false: they nearly depend on one another. @p least_pivot: of W'W, over the largest. */
  bool choose(const std::vector<unsigned int> &places, PatchFactor &factor,
              double least_pivot = poor_pivot) const;
  static constexpr double poor_pivot = 1e-7; ///< of conditions that another patch has chosen

  void renew(std::vector<unsigned int> &places,
             PatchFactor &factor) const; ///< chooses those that are independent

  PatchDefect solve(const PatchFactor &factor);

  void add_tractions() const; ///< to the sums of the edges

private:
  /** One component of the traction on an edge as data of a cell: `r_row += weight R t`. */
  struct Block
  {
    unsigned int row;                    ///< among the data of the edges
    unsigned int n;                      ///< coefficients
    double weight;                       ///< of the component in the direction of the data
    const dealii::FullMatrix<double> *R; ///< to a half of the edge; null: the whole
    unsigned int unknown;                ///< the first, or none
    const std::vector<double> *known;    ///< coefficients, where there is no unknown
  };

  static void add_transposed(const Block &b, const double *data, double scale, double *target);
  unsigned int place(unsigned int edge) const;
  std::vector<Block> blocks_of(const PatchCell &cell) const;
  void add_places(const PatchCell &cell, EquilibrationCache::Signature &key) const;
  void add_energy(const PatchCell &cell, const std::vector<Block> &parts, double scale,
                  PatchFactor &factor) const;
  void add_conditions(const PatchCell &cell, const std::vector<Block> &parts, unsigned int first,
                      PatchFactor &factor);
  void add_data(const PatchCell &cell, const std::vector<Block> &parts, double scale,
                std::vector<double> &g, std::vector<double> &right) const;
  void minimise(const PatchFactor &factor, const std::vector<double> &right);
  void subtract_met(const PatchCell &cell, const std::vector<Block> &parts, double *right) const;

  const std::vector<PatchCell> &cells;
  const std::vector<PatchEdge> &edges;
  EquilibrationCache &cache;
  std::vector<std::array<unsigned int, 2>> first_unknown; ///< by edge of the patch and component
  std::vector<std::vector<Block>> blocks;                 ///< by cell
  unsigned int n = 0;
  std::vector<double> conditions; ///< n x PatchFactor::present: C, while a factor is made
  std::vector<double> x;          ///< the tractions
};

/**
 * The problems of some patches, on all threads of the thread pool, as if one were solved after the other: tractions are added to the sums of
 * their edges, which hold given ones. What each leaves of |N'r| at most.
 */
std::vector<PatchDefect> solve_patches(const std::vector<Patch> &patches,
                                       EquilibrationCache &cache);
} // namespace hpvi

#endif
