// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_deformation_h
#define hpvi_deformation_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <utility>
#include <vector>

namespace hpvi
{
/**
 * How far a body moves that is not carried along: what a displacement, given at points, leaves when the
 * nearest infinitesimal rigid motion `r(x) = a + w x (x - c)` is taken away, nearest in the sum of
 * squares. Moving or turning the whole scene does not change it.
 */
template <int dim>
class Deformation
{
public:
  void add(const dealii::Point<dim> &x, const dealii::Tensor<1, dim> &u);

  /**
   * `max |u - r|` over the points of all processes [length]; collective. At least 1e-8 of the largest |u|,
   * for that much may be round-off; 0 without points.
   */
  double largest(MPI_Comm communicator = MPI_COMM_SELF) const;

private:
  using Vector = dealii::Tensor<1, 3>; ///< the plane is that of z = 0

  std::vector<std::pair<Vector, Vector>> displacements; ///< x, u
};
} // namespace hpvi

#endif
