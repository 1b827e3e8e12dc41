// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/record.h>

namespace hpvi
{
namespace
{
template <int dim>
Record row(const ContactPoint<dim> &point, const BoundaryCondition<dim> &boundary,
           const bool has_history)
{
  Record record;
  for (unsigned int d = 0; d < dim; ++d)
    record.emplace_back(std::string(1, "xyz"[d]), text(point.x[d]));
  record.emplace_back("normal_displacement", text(point.normal_displacement));
  record.emplace_back("tangential_displacement", text(point.tangential_displacement));
  record.emplace_back("multiplier", text(point.lambda));
  record.emplace_back("normal_traction", text(point.normal_traction));
  record.emplace_back("tangential_traction", text(point.tangential_traction));
  record.emplace_back("state", mode_name(point.mode()));
  record.emplace_back("boundary", boundary.name);
  record.emplace_back("gap", boundary.contact == Contact::tangential ? "" : text(point.gap));
  if (has_history)
    record.emplace_back("slip", text(point.slip));
  return record;
}
} // namespace

template <int dim>
std::string contact_table(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact)
{
  std::vector<Record> rows;
  for (const ContactState<dim> &state : contact)
    for (const ContactPoint<dim> &point : state.points)
      rows.push_back(row(point, scene.boundaries[state.boundary], scene.has_load_history()));
  return csv(rows);
}

template std::string contact_table(const Scene<2> &, const std::vector<ContactState<2>> &);
} // namespace hpvi
