// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/contact_report.h>
#include <hpvi/output/plate_report.h>
#include <hpvi/output/record.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
std::string plate_in_words(const Scene<dim> &scene, const std::string &boundary,
                           const Equilibrium<dim> &equilibrium)
{
  for (const PlateState<dim> &plate : equilibrium.plates)
    if (scene.boundaries[plate.boundary].name == boundary)
    {
      const std::string unit = unit_name(scene.length_unit);
      return ", moves by " + to_string(Point<dim>(plate.displacement)) +
             (unit.empty() ? "" : " " + unit) + " and turns by " +
             text(plate.rotation + 0., 6) + // never -0
             " rad at " + to_string(plate.centre);
    }
  return {};
}

template <int dim>
std::string plates_json(const Scene<dim> &scene, const Equilibrium<dim> &equilibrium)
{
  std::string list;
  for (const PlateState<dim> &plate : equilibrium.plates)
    list += (list.empty() ? "\n    " : ",\n    ") +
            json_string(scene.boundaries[plate.boundary].name) +
            ": {\"mean_point\": " + json_point<dim>(plate.centre) +
            ", \"displacement\": " + json_point<dim>(plate.displacement) +
            ", \"rotation\": " + json_value(plate.rotation) +
            ", \"moment\": " + json_value(plate.moment) + "}";
  return "{" + list + (list.empty() ? "}" : "\n  }");
}

template std::string plate_in_words(const Scene<2> &, const std::string &, const Equilibrium<2> &);
template std::string plate_in_words(const Scene<3> &, const std::string &, const Equilibrium<3> &);
template std::string plates_json(const Scene<2> &, const Equilibrium<2> &);
template std::string plates_json(const Scene<3> &, const Equilibrium<3> &);
} // namespace hpvi
