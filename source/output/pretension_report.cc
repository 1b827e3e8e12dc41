// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/pretension_report.h>
#include <hpvi/output/record.h>
#include <hpvi/output/results_report.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
std::string pretensions_in_words(const Scene<dim> &scene)
{
  std::string lines;
  if constexpr (dim == 2)
    for (const Pretension<2> &cut : scene.pretensions)
      lines += "pretension " + cut.name + ": force " +
               with_unit(cut.force, force_unit(scene.stress_unit, scene.length_unit)) +
               " across the cut from " + to_string(cut.from) + " to " + to_string(cut.to) +
               (scene.is_axisymmetric() ? ", area " : ", length ") +
               text(section_of_cut(scene, cut), 6) + ", shortened over a depth of " +
               with_unit(cut.depth, scene.length_unit) + " in " + text(unsigned(cut.layer.size())) +
               (cut.layer.size() == 1 ? " coarse cell" : " coarse cells") +
               (scene.has_load_history() ? " in the first load step, fixed then" : "") + "\n";
  return lines;
}

namespace
{
/** The row of its force. */
template <int dim>
const Resultant<dim> *row_of(const Pretension<dim> &cut, const StepReport<dim> &step)
{
  const auto row = std::find_if(step.forces.begin(), step.forces.end(),
                                [&](const Resultant<dim> &one) {
                                  return one.kind == ForceKind::pretension && one.name == cut.name;
                                });
  return row == step.forces.end() ? nullptr : &*row;
}
} // namespace

template <int dim>
std::string pretensions_in_words(const StepReport<dim> &step)
{
  const Scene<dim> &scene = step.scene;
  std::string words;
  for (const Pretension<dim> &cut : scene.pretensions)
    if (const Resultant<dim> *const row = row_of(cut, step))
      words += "pretension " + cut.name + ": force " +
               with_unit(row->normal.best(), force_unit(scene.stress_unit, scene.length_unit),
                         shown_digits) +
               ", shortened by " + with_unit(cut.shortening, scene.length_unit, shown_digits) +
               "\n";
  return words;
}

template <int dim>
std::string pretensions_json(const StepReport<dim> &step)
{
  JsonMembers members;
  for (const Pretension<dim> &cut : step.scene.pretensions)
    if (const Resultant<dim> *const row = row_of(cut, step))
      members.emplace_back(
          cut.name, json_members({{"force", json_value(row->normal.best())},
                                  {"force_bound", row->normal.interval
                                                      ? json_value(row->normal.interval->half_width)
                                                      : "null"},
                                  {"shortening", json_value(cut.shortening)}}));
  return json_members(members, 4);
}

template std::string pretensions_in_words(const Scene<2> &);
template std::string pretensions_in_words(const Scene<3> &);
template std::string pretensions_in_words(const StepReport<2> &);
template std::string pretensions_in_words(const StepReport<3> &);
template std::string pretensions_json(const StepReport<2> &);
template std::string pretensions_json(const StepReport<3> &);
} // namespace hpvi
