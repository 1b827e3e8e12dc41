// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/record.h>

namespace hpvi
{
using namespace dealii;

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

/** A vector along the contact: in the plane its component along `t = (-n_y, n_x)`. */
template <int dim>
void add_tangential(Record &record, const std::string &name, const Tensor<1, dim> &vector,
                    const MomentPoint<dim> &point)
{
  if constexpr (dim == 2)
    record.emplace_back(name, text(point.axis() == 0 ? point.normal_sign() * vector[1]
                                                     : -point.normal_sign() * vector[0]));
  else
    for (unsigned int d = 0; d < dim; ++d)
      record.emplace_back(name + '_' + "xyz"[d], text(d == point.axis() ? 0. : vector[d]));
}

template <int dim>
Record row(const MomentPoint<dim> &point, const BoundaryCondition<dim> &boundary)
{
  const double u_n = point.normal_sign() * point.displacement[point.axis()];
  Record record;
  for (unsigned int d = 0; d < dim; ++d)
    record.emplace_back(std::string(1, "xyz"[d]), text(point.x[d]));
  record.emplace_back("normal_displacement", text(u_n));
  add_tangential(record, "tangential_displacement", point.displacement, point);
  add_tangential(record, "multiplier", point.lambda, point);
  record.emplace_back("normal_traction", text(point.normal_traction));
  add_tangential(record, "tangential_traction", -point.bound * point.lambda, point);
  record.emplace_back("state", mode_name(point.mode()));
  record.emplace_back("boundary", boundary.name);
  record.emplace_back("gap", boundary.contact == Contact::tangential ? "" : text(point.gap));
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

template <int dim>
std::string contact_table(const Scene<dim> &scene, const std::vector<MomentPoint<dim>> &points)
{
  std::vector<Record> rows;
  for (const MomentPoint<dim> &point : points)
    rows.push_back(row(point, scene.boundaries[point.boundary]));
  return csv(rows);
}

template std::string contact_table(const Scene<2> &, const std::vector<ContactState<2>> &);
template std::string contact_table(const Scene<2> &, const std::vector<MomentPoint<2>> &);
template std::string contact_table(const Scene<3> &, const std::vector<MomentPoint<3>> &);
} // namespace hpvi
