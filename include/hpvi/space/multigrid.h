// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_multigrid_h
#define hpvi_multigrid_h

#include <hpvi/base/processes.h>
#include <hpvi/space/coarse_solver.h>
#include <hpvi/space/level_transfer.h>
#include <hpvi/space/vertex_solver.h>

#include <deal.II/lac/precondition.h>

namespace hpvi
{
/**
 * Geometric multigrid for `A + H` in space by global coarsening: each mesh has all cells of the next one coarsened once,
 * contact dofs of the same degree on its contact faces, and the states of contact that LevelTransfer hands down. A V-cycle
 * smooths by Chebyshev polynomials of degree 6 in single precision. The coarsest mesh is factorised, or where it
 * has too many unknowns smoothed as well, above VertexSolver. A new state of the contact takes no set-up but that of these.
 */
class Multigrid
{
public:
  /** Does @p space offer what it takes: degrees 2 to 4? */
  static bool is_for(const PrimalSpace<3> &space);

  /** @p space must outlive it. Collective. */
  explicit Multigrid(const PrimalSpace<3> &space);

  void multiply(DistributedVector &y, const DistributedVector &x) const;            ///< y = A x
  void multiply_linearised(DistributedVector &y, const DistributedVector &x) const; ///< (A + H) x
  void linearise(const std::vector<ContactDofState<3>> &states);                    ///< collective
  void precondition(DistributedVector &z, const DistributedVector &r) const;        ///< one V-cycle

  /** Of A at contact dofs. */
  const std::vector<MultigridLevel<float>::Block> &blocks() const
  {
    return levels.back().matrix->blocks;
  }

  MultigridLevel<double> finest; ///< A, to which conjugate gradients are exact

private:
  using Vector = MultigridLevel<float>::Vector;
  using Smoother = dealii::PreconditionChebyshev<MultigridLevel<float>, Vector, BlockJacobi<float>>;

  struct Level
  {
    std::shared_ptr<const dealii::Triangulation<3>> mesh;
    std::unique_ptr<PrimalSpace<3>> own_space; ///< null on the finest mesh
    std::unique_ptr<MultigridLevel<float>> matrix;
    std::unique_ptr<LevelTransfer> from_below; ///< null on the coarsest mesh
    std::unique_ptr<Smoother> smoother;
    mutable Vector x, b, r;
  };

  void prepare(Level &level);
  void cycle(unsigned int l) const;

  std::vector<Level> levels;              ///< from the coarsest on
  std::unique_ptr<CoarseSolver> factors;  ///< of a coarsest mesh of few unknowns
  std::unique_ptr<VertexSolver> vertices; ///< or, under the smoother of the coarsest mesh
  mutable DistributedVector from, to;     ///< of the finest, with neighbours
};
} // namespace hpvi

#endif
