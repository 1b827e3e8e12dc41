// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_common_refinement_h
#define hpvi_common_refinement_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/grid/tria.h>

namespace hpvi
{
/**
 * Calls `leaf(a, in_a, b, in_b)` for each part of the body that lies in one active cell a of @p one, of this process, and
 * in one active cell b of @p other: meshes that descend from the same coarse mesh. in_a and in_b are that part in the
 * reference cells of a and b; one of them is all of it.
 */
template <int dim, class Leaf>
void for_each_common_part(const dealii::Triangulation<dim> &one,
                          const dealii::Triangulation<dim> &other, const Leaf &leaf)
{
  using Cell = typename dealii::Triangulation<dim>::cell_iterator;
  using Box = dealii::BoundingBox<dim>;
  struct Walk
  {
    const Leaf &leaf;

    void descend(const Cell &a, const Box &in_a, const Cell &b, const Box &in_b) const
    {
      if (!a->has_children() && !a->is_locally_owned())
        return;
      if (!a->has_children() && !b->has_children())
      {
        leaf(a, in_a, b, in_b);
        return;
      }
      for (unsigned int c = 0; c < dealii::GeometryInfo<dim>::max_children_per_cell; ++c)
        descend(a->has_children() ? a->child(c) : a, a->has_children() ? in_a : in_a.child(c),
                b->has_children() ? b->child(c) : b, b->has_children() ? in_b : in_b.child(c));
    }
  };
  const Box unit = dealii::create_unit_bounding_box<dim>();
  const Walk walk{leaf};
  auto b = other.begin(0);
  for (auto a = one.begin(0); a != one.end(0); ++a, ++b)
    walk.descend(a, unit, b, unit);
}
} // namespace hpvi

#endif
