// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pretension_h
#define hpvi_pretension_h

#include <hpvi/scene/geometry.h>
#include <hpvi/scene/initial_strain.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <map>
#include <string>
#include <vector>

namespace hpvi
{
template <int dim>
struct Scene;

/**
 * A bolt that is tightened: `subsection Pretension NAME`. On a straight cut through it a piece of the length delta is taken
 * out, `u(+) - u(-) = -delta n`, and the ends are joined again. Beside the cut is a layer of coarse cells of depth h. There
 * `u = w - delta psi n` with w continuous and psi falling from 1 on the cut to 0, so that the elastic strain is
 *
 *     eps(u) = eps(w) + delta E,   E = n n'/h:
 *
 * the jump is an initial strain -delta E of the layer, w the displacement of all stages, and stresses are those of the jump.
 * The force across the cut is what does work on delta, `int sigma : E + int f . n psi`. In the plane.
 */
template <int dim>
struct Pretension
{
  std::string name;
  dealii::Point<dim> from, to; ///< the ends of the cut
  double force = 0;            ///< F > 0, in all [stress length^(dim-1)]

  // Of add_pretension():
  dealii::Tensor<1, dim> normal; ///< n, from the cut into the layer
  double depth = 0;              ///< h [length]
  struct Cell
  {
    Corners<dim> corners;                ///< counterclockwise
    dealii::types::material_id material; ///< its own in the layer
  };
  std::vector<Cell> layer; ///< its coarse cells
  std::map<dealii::types::material_id, dealii::types::material_id>
      materials; ///< of the layer, by that which the cells beside it have

  double shortening = 0; ///< delta [length]
  bool is_fixed = false; ///< delta is that of a load step before

  /** psi in the layer. */
  double fall(const dealii::Point<dim> &x) const
  {
    return 1 - (x - from) * normal / depth;
  }

  /** That of the layer with this centre; null: none is. */
  const Cell *cell(const dealii::Point<dim> &centre) const;
};

/** E [1/length]. */
PlaneStrain unit_shortening(const Pretension<2> &cut);

/**
 * Finds the layer of @p cut and gives it materials of its own. Returns what is wrong with the cut and what to do; empty: it
 * is one of Scene::pretensions now.
 */
std::string add_pretension(Scene<2> &scene, Pretension<2> cut);

/** delta of Scene::pretensions number @p k, and the initial strain that it is. */
void set_shortening(Scene<2> &scene, unsigned int k, double shortening);

/** The same scene before anything is tightened. */
Scene<2> without_shortenings(const Scene<2> &scene);

/** The length of the cut or, of revolution, its area. */
double section_of_cut(const Scene<2> &scene, const Pretension<2> &cut);

/** `int E : C E`: the force per shortening [stress] where nothing gives way, for unit thickness. */
double layer_stiffness(const Scene<2> &scene, const Pretension<2> &cut);

/** The number of the material that the layer of a cut shares with the cells beside it; of other cells their own. */
template <int dim>
dealii::types::material_id material_beside(const Scene<dim> &scene,
                                           dealii::types::material_id material);
} // namespace hpvi

#endif
