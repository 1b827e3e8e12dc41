// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/checks/rejection.h>

#include <hpvi/base/text.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/scene_entries.h>

#include <utility>
#include <vector>

namespace hpvi
{
template <int dim>
std::string mention(const Scene<dim> &scene, const std::string &section, const std::string &name,
                    const std::string &value)
{
  const std::string shown = scene.parameters ? scene.parameters->text(section, name) : value;
  return section + "/" + name +
         (scene.parameters || !shown.empty() ? " = " + printable(shown) : "");
}

template <int dim>
void reject(const Scene<dim> &scene, const std::string &section, const std::string &name,
            const std::string &problem_and_remedy, const std::string &value)
{
  if (scene.parameters)
    scene.parameters->reject(section, name, problem_and_remedy);
  fail(printable(scene.name), mention(scene, section, name, value), problem_and_remedy);
}

template <int dim>
void check_value(const Scene<dim> &scene, const std::string &section, const std::string &name,
                 const std::string &shown)
{
  static const std::vector<Entry> entries = scene_entries(
      dim, UserNames{{}, {}, boundary_names(dim)}); // a history asks for each load step
  for (const Entry &entry : entries)
    if (entry.section == section && entry.name == name)
      if (const std::string objection = entry.objection(shown); !objection.empty())
        reject(scene, section, name, objection, shown);
}

template <int dim>
std::string in_entries_of(const Scene<dim> &scene, const std::string &message)
{
  std::vector<std::pair<std::string, std::string>> changes;
  if (scene.geometry.shape == Shape::file)
    changes = {{"raise Geometry/Subdivisions", "take more cells in Geometry/File"},
               {"Geometry/Subdivisions", "cells in Geometry/File"}};
  if (scene.geometry.shape == Shape::bodies)
    changes = {{"Geometry/", "Body NAME/"}};
  std::string result = message;
  for (const auto &[of_a_box, own] : changes)
    for (std::size_t at = 0; (at = result.find(of_a_box, at)) != std::string::npos;
         at += own.size())
      result.replace(at, of_a_box.size(), own);
  return result;
}

std::string name_of(const Contact contact)
{
  return contact == Contact::tied ? "tied" : contact_names[static_cast<unsigned int>(contact)];
}

template std::string mention(const Scene<2> &, const std::string &, const std::string &,
                             const std::string &);
template std::string mention(const Scene<3> &, const std::string &, const std::string &,
                             const std::string &);
template void reject(const Scene<2> &, const std::string &, const std::string &,
                     const std::string &, const std::string &);
template void reject(const Scene<3> &, const std::string &, const std::string &,
                     const std::string &, const std::string &);
template std::string in_entries_of(const Scene<2> &, const std::string &);
template std::string in_entries_of(const Scene<3> &, const std::string &);
template void check_value(const Scene<2> &, const std::string &, const std::string &,
                          const std::string &);
template void check_value(const Scene<3> &, const std::string &, const std::string &,
                          const std::string &);
} // namespace hpvi
