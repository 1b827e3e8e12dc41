// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/evaluation/contact_state.h>
#include <hpvi/evaluation/stress.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/record.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The rows of one face at the Gauss points of its multiplier. */
template <int dim>
void add_face(const ContactFace<dim> &face, const Solution<dim> &solution,
              const ShapeTables<dim> &tables, std::vector<Record> &records)
{
  const std::vector<ContactPoint<dim>> points = contact_points(face, solution);
  const ContactTraces<dim> traces(face, points.size(), solution, tables);
  for (const ContactPoint<dim> &point : points)
  {
    const Tensor<1, dim> u = traces.displacement(point.q);
    Record record;
    for (unsigned int d = 0; d < dim; ++d)
      record.emplace_back(std::string(1, "xyz"[d]), text(point.x[d]));
    record.emplace_back("normal_displacement", text(face.normal * u));
    record.emplace_back("tangential_displacement", text(face.tangent * u));
    record.emplace_back("multiplier", text(point.lambda));
    record.emplace_back("normal_traction", text(traces.normal_traction(point.q)));
    record.emplace_back("tangential_traction",
                        text(0. - point.friction_bound * point.lambda)); // never -0
    record.emplace_back("state", point.slips ? "slip" : "stick");
    records.push_back(record);
  }
}
} // namespace

template <int dim>
std::string contact_table(const Solution<dim> &solution, const ShapeTables<dim> &tables)
{
  std::vector<Record> records;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    add_face(face, solution, tables, records);
  return csv(records);
}

template std::string contact_table(const Solution<2> &, const ShapeTables<2> &);
} // namespace hpvi
