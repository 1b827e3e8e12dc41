// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/warnings/line.h>
#include <hpvi/results/warnings/warnings.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Tresca's bound knows no pressure. */
template <int dim>
Warnings open_friction(const std::vector<ContactState<dim>> &contact)
{
  double open = 0, all = 0;
  for (const ContactState<dim> &state : contact)
  {
    open += state.open_friction;
    all += state.absolute_friction;
  }
  if (!(open > 0.01 * all))
    return {};
  return {{WarningKind::open_friction, open / all,
           line("friction acts where contact is open: ", 100 * open / all,
                " % of it, because Friction bound is Tresca's and knows no pressure; let it "
                "vanish there, or take Friction coefficient")}};
}

/** Contact and its data stay where they were in the body at rest. */
template <int dim>
Warnings long_slip(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact)
{
  const double size = scene.geometry.diameter();
  double longest = 0;
  Point<dim> where;
  for (const ContactState<dim> &state : contact)
    for (const ContactPoint<dim> &point : state.points)
      if (!point.is_open && size_of(point.tangential_displacement) > longest)
      {
        longest = size_of(point.tangential_displacement);
        where = point.x;
      }
  if (longest < 0.1 * size)
    return {};
  return {{WarningKind::slip, longest,
           line("the body slides by ", labelled(longest, scene.length_unit), " at (", where, "), ",
                100 * longest / size,
                " % of its size, where contact is that of the body at rest; check loads and "
                "prescribed displacements")}};
}
} // namespace

template <int dim>
Warnings friction_warnings(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact)
{
  return joined(open_friction(contact), long_slip(scene, contact));
}

template Warnings friction_warnings(const Scene<2> &, const std::vector<ContactState<2>> &);
template Warnings friction_warnings(const Scene<3> &, const std::vector<ContactState<3>> &);
} // namespace hpvi
