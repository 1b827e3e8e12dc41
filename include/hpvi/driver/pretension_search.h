// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pretension_search_h
#define hpvi_pretension_search_h

#include <hpvi/scene/scene.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace hpvi
{
/**
 * Finds the shortenings of Scene::pretensions that give their forces. These are the gradient of the least energy, which is
 * convex in the shortenings: they grow with them, and where nothing opens or slips they are linear. By the method of Broyden,
 * Fletcher, Goldfarb and Shanno (J. Nocedal, S. Wright, Numerical Optimization, 2006, (6.19)), whose slopes begin with
 * layer_stiffness(), more than which they cannot be, and are kept from mesh to mesh.
 */
class PretensionSearch
{
public:
  /** @p learnt: learnt() of a run to go on with, or nothing. */
  explicit PretensionSearch(const Scene<2> &scene,
                            const dealii::Vector<double> &learnt = dealii::Vector<double>());

  /** For a scene whose shortenings are all zero, to begin with. */
  std::vector<double> first() const;

  /** Before the first solution on a mesh. */
  void begin();

  /**
   * After a solution with the shortenings of @p scene and these @p forces for unit thickness: the next ones to try; none: these
   * are it. Throws NumericalFailure where they cannot be found.
   */
  std::vector<double> next(const Scene<2> &scene, const std::vector<double> &forces);

  /** The slopes, row by row. */
  std::vector<double> learnt() const;

private:
  void learn(const dealii::Vector<double> &dx, const dealii::Vector<double> &dg);
  dealii::Vector<double> step();

  std::vector<double> stiffness, wanted;
  double tolerance;
  dealii::FullMatrix<double> slopes; ///< dg/dx of x = k^1/2 delta and g = k^-1/2 (force - wanted)
  dealii::Vector<double> x, g;       ///< of the last try on this mesh
  unsigned int n_solutions = 0;      ///< on this mesh
};
} // namespace hpvi

#endif
