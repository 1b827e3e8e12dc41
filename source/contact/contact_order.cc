// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/curved_edges.h>
#include <hpvi/contact/contact_order.h>

#include <algorithm>
#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
void sort_along_boundaries(const Geometry<dim> &geometry, std::vector<ContactFace<dim>> &faces)
{
  if (!geometry.mesh)
    return std::stable_sort(faces.begin(), faces.end(),
                            [](const ContactFace<dim> &a, const ContactFace<dim> &b)
                            {
                              if (a.condition->id != b.condition->id)
                                return a.condition->id < b.condition->id;
                              return a.frame(0.5).tangent * (b.point(0.5) - a.point(0.5)) > 0;
                            });
  const EdgePlaces places(*geometry.mesh);
  std::vector<std::pair<double, unsigned int>> order;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const EdgePlace at = places(faces[k].cell, faces[k].face_no);
    order.emplace_back(at.edge + (at.from + at.to) / 2, k);
  }
  std::sort(order.begin(), order.end());
  std::vector<ContactFace<dim>> sorted;
  for (const auto &[place, k] : order)
    sorted.push_back(faces[k]);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const ContactFace<dim> &a, const ContactFace<dim> &b)
                   { return a.condition->id < b.condition->id; });
  faces = std::move(sorted);
}

template void sort_along_boundaries(const Geometry<2> &, std::vector<ContactFace<2>> &);
} // namespace hpvi
