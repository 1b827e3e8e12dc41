// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_dual_scene_h
#define hpvi_dual_scene_h

#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/scene.h>

#include <map>

namespace hpvi
{
/**
 * The linear problem a(z, v) = q(v) for all v of V, the displacements that vanish where components are prescribed and
 * slide where contact is bilateral; unilateral contact and friction leave V free. q is a load: of a @p probe along a boundary
 * the mean of the @p component of v there, a force where that is a rigid plate, none where it is prescribed; of one over a disc that with the weight of smooth_mean(). |z|_a is the norm of q
 * on V. @p meshed: lengths of the probe's boundaries, of a body of revolution areas, where those of the mesh are others than those of the
 * scene.
 */
Scene<2> dual_scene(const Scene<2> &scene, const Probe<2> &probe, unsigned int component,
                    const std::map<dealii::types::boundary_id, double> &meshed = {});

/**
 * The mean over a disc of radius r has a density that jumps, which no rule of quadrature integrates. In its place stands
 *
 *     rho(s) = (k + 1)/(pi R^2) (1 - s^2/R^2)^k,   k = 6,
 *
 * over a disc about the same centre, with R = 2 r where the body has room. The stress e (x) g + g (x) e - (e.g) I with
 * `g = grad phi`, `Delta phi = rho - 1/(pi r^2)`, vanishes beyond R and makes up for the difference: its divergence along e is that, and so
 *
 *     |mean of v.e - int rho v.e| <= remainder |v|_a.
 */
struct SmoothMean
{
  double radius;    ///< R [length]
  double remainder; ///< [(stress length^dim)^{-1/2} length]

  double density(double s) const; ///< rho [length^-2]
};
SmoothMean smooth_mean(const Scene<2> &scene, const Probe<2> &probe);
} // namespace hpvi

#endif
