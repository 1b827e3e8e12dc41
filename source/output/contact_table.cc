// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/contact_table.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A vector along the contact: in the plane one number, in space its components. */
void add(Record &record, const std::string &name, const double value)
{
  record.emplace_back(name, value);
}

void add(Record &record, const std::string &name, const Tensor<1, 3> &vector)
{
  for (unsigned int d = 0; d < 3; ++d)
    record.emplace_back(name + '_' + "xyz"[d], vector[d]);
}

/** Of two bodies the side without multipliers; of a foundation nothing. */
template <int dim>
std::string master_name(const ContactState<dim> &state, const Scene<dim> &scene)
{
  const auto &pair = scene.boundaries[state.boundary].pair;
  if (!pair)
    return "";
  const auto &parts = scene.pairs[*pair].parts;
  return scene.boundaries[state.slave == parts[0] ? parts[1] : parts[0]].name;
}

template <int dim>
Record row(const ContactPoint<dim> &point, const ContactState<dim> &state, const Scene<dim> &scene)
{
  const BoundaryCondition<dim> &boundary = scene.boundaries[state.boundary];
  Record record;
  for (unsigned int d = 0; d < dim; ++d)
    record.emplace_back(std::string(1, "xyz"[d]), point.x[d]);
  record.emplace_back("normal_displacement", point.normal_displacement);
  add(record, "tangential_displacement", point.tangential_displacement);
  add(record, "multiplier", point.lambda);
  record.emplace_back("normal_traction", point.normal_traction);
  add(record, "tangential_traction", point.tangential_traction);
  record.emplace_back("state", mode_name(point.mode()));
  record.emplace_back("boundary",
                      boundary.pair ? scene.boundaries[boundary.side].name : boundary.name);
  record.emplace_back("gap", boundary.contact == Contact::tangential ? Value() : Value(point.gap));
  if (scene.has_load_history())
    add(record, "slip", point.slip);
  if (!scene.has_pairs())
    return record;
  record.emplace_back("contact", boundary.pair ? scene.pairs[*boundary.pair].name : "");
  record.emplace_back("master", master_name(state, scene));
  record.emplace_back("jump_normal", point.normal_jump);
  add(record, "jump_tangential", point.tangential_jump);
  return record;
}
} // namespace

template <int dim>
std::vector<Record> contact_rows(const Scene<dim> &scene,
                                 const std::vector<ContactState<dim>> &contact)
{
  std::vector<Record> rows;
  for (const ContactState<dim> &state : contact)
    for (const ContactPoint<dim> &point : state.points)
      rows.push_back(row(point, state, scene));
  return rows;
}

Record history_record(const PointHistory &point, const double wear)
{
  const double range = point.slip_range();
  return {{"pressure_max", point.pressure},
          {"shear_max", point.shear},
          {"slip_range", range},
          {"slip_path", point.path},
          {"dissipated", point.dissipated},
          {"time_open", point.open},
          {"ruiz_1", point.shear * range},
          {"ruiz_2", point.tension * point.shear * range},
          {"wear_depth", wear > 0 ? Value(wear * point.rubbed) : Value()}};
}

template <int dim>
std::vector<Record> contact_history_rows(const Scene<dim> &scene,
                                         const std::vector<ContactHistory> &contact)
{
  std::vector<Record> rows;
  for (const ContactHistory &history : contact)
  {
    const BoundaryCondition<dim> &boundary = scene.boundaries[history.boundary];
    for (const PointHistory &point : history.points)
    {
      Record &row = rows.emplace_back(Record{
          {"boundary", boundary.pair ? scene.boundaries[boundary.side].name : boundary.name}});
      for (unsigned int d = 0; d < dim; ++d)
        row.emplace_back(std::string(1, "xyz"[d]), point.x[d]);
      const Record numbers = history_record(point, boundary.wear);
      row.insert(row.end(), numbers.begin(), numbers.end());
      if (scene.has_pairs())
        row.emplace_back("contact", boundary.pair ? scene.pairs[*boundary.pair].name : "");
    }
  }
  return rows;
}

template std::vector<Record> contact_history_rows(const Scene<2> &,
                                                  const std::vector<ContactHistory> &);
template std::vector<Record> contact_history_rows(const Scene<3> &,
                                                  const std::vector<ContactHistory> &);
template std::vector<Record> contact_rows(const Scene<2> &, const std::vector<ContactState<2>> &);
template std::vector<Record> contact_rows(const Scene<3> &, const std::vector<ContactState<3>> &);
} // namespace hpvi
