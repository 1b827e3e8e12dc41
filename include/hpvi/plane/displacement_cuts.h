// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_displacement_cuts_h
#define hpvi_displacement_cuts_h

#include <hpvi/plane/coarse_cuts.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/plane/shape_tables.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** A prescribed displacement or gap that the nodes of an edge miss. */
template <int dim>
struct MissedDisplacement
{
  std::string name; ///< as in "Displacement on top", "Gap on bottom"
  bool is_gap;
  unsigned int cell;
  dealii::Point<dim> where;
  double value, interpolated; ///< one component of it, and of its interpolant at the nodes [length]
};

/** Coarse edges of the boundary, cut where prescribed displacements and gaps jump, bend or are narrow. */
template <int dim>
class DisplacementCuts
{
public:
  using Cell = coarse_cuts::Cell;

  /** Of the coarse cells of @p mesh; the scene must outlive this object. */
  DisplacementCuts(const Scene<dim> &scene, const dealii::Triangulation<dim> &mesh,
                   std::shared_ptr<const ShapeTables<dim>> tables);

  /**
   * Boundary edges of the active cells of @p mesh on which a prescribed component, or a gap, differs from its interpolant at the
   * Gauss-Lobatto nodes by more than a twentieth of its variation: one place for each edge. Where data are
   * smooth along the coarse edge that is not asked.
   */
  std::vector<MissedDisplacement<dim>> missed_displacements(const dealii::Triangulation<dim> &mesh,
                                                            const Degrees &degrees) const;

  /** Where on a face, in [0,1], prescribed displacements and gaps are to be looked at; smooth ones: nowhere. */
  std::vector<double> displacement_points(const Cell &cell, unsigned int face) const;

private:
  void cut(const Cell &cell, unsigned int face);

  const Scene<dim> &scene;
  const std::shared_ptr<const ShapeTables<dim>> tables;
  /** By coarse cell and face: those whose data are not smooth. */
  std::map<std::pair<unsigned int, unsigned int>, std::vector<double>> cuts;
};
} // namespace hpvi

#endif
