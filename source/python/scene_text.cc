// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/display_name.h>
#include <hpvi/base/text.h>
#include <hpvi/output/scene_json.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/python/scene_text.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/gmsh/given_mesh.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/pretension_reader.h>
#include <hpvi/reader/probe_reader.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/scene_reader.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
/** What @p ask says of the scene, in the plane or in space. */
template <class Ask>
auto ask_scene(const SceneText &text, const Ask &ask)
{
  const ParameterFile file = text.read();
  if (scene_dimension(file) == 3)
    return ask(read_scene<3>(file));
  return ask(read_scene<2>(file));
}

/** "Boundary" of "Boundary left/Traction". */
std::string kind_of(const std::string &path)
{
  return path.substr(0, path.find_first_of(" /"));
}

std::string name_of(const std::string &path)
{
  return path.substr(path.rfind('/') + 1);
}

/** One of each kind of section. */
const std::vector<Entry> &entries_of_kinds()
{
  static const std::vector<Entry> all = []()
  {
    std::vector<Entry> entries = scene_entries(2, {{"NAME"}, {"NAME"}});
    for (const auto &some : {body_entries(2, "NAME"), pair_entries("NAME"),
                             pretension_entries("NAME"), probe_entries(2, "NAME")})
      entries.insert(entries.end(), some.begin(), some.end());
    return entries;
  }();
  return all;
}
} // namespace

ParameterFile SceneText::read() const
{
  ParameterFile all(file, entries);
  if (!mesh)
    return all;
  std::vector<std::string> sections, with_file;
  for (const Assignment &one : all.assignments)
    if (one.section == "Geometry" ||
        (one.section.compare(0, 5, "Body ") == 0 && one.section != "Body force"))
      (one.name == "File" ? with_file : sections).push_back(one.section);
  if (sections.empty() && with_file.empty())
    sections.push_back("Geometry");
  const std::string where = display_name(file) + " (points and cells)";
  for (const std::string &section : std::set<std::string>(sections.begin(), sections.end()))
    if (std::find(with_file.begin(), with_file.end(), section) == with_file.end())
    {
      all.assignments.push_back({section, "Shape", "file", where});
      all.assignments.push_back(
          {section, "File", mesh_file.empty() ? mesh->name : mesh_file, where});
    }
  return all;
}

void SceneText::set(const std::string &path, const std::string &value)
{
  const std::string name = single_spaced(path);
  for (auto &[entry, old] : entries)
    if (entry == name)
    {
      old = value; // in its place: materials are tried in the order in which they stand
      return;
    }
  entries.emplace_back(name, value);
}

std::string SceneText::value(const std::string &path) const
{
  const std::string name = single_spaced(path);
  for (const auto &[entry, value] : entries)
    if (entry == name)
      return value;
  const std::size_t slash = name.rfind('/');
  const std::string section = slash == std::string::npos ? "" : name.substr(0, slash);
  return ask_scene(*this,
                   [&](const auto &scene)
                   {
                     if (!scene.parameters->has(section, name_of(name)))
                       throw InputError(scene.origin() + ": " + printable(name) +
                                        ": this scene has no such entry; print() shows all");
                     return scene.parameters->text(section, name_of(name));
                   });
}

std::string SceneText::words() const
{
  return ask_scene(*this, [](const auto &scene) { return Utilities::trim(scene_in_words(scene)); });
}

std::string SceneText::json() const
{
  return ask_scene(*this, [](const auto &scene) { return scene_json(scene); });
}

std::string SceneText::print() const
{
  return ask_scene(*this, [](const auto &scene) { return effective_parameters(scene); });
}

std::string SceneText::title() const
{
  return ask_scene(*this, [](const auto &scene) { return scene.title; });
}

bool has_components(const std::string &path, const std::string &value)
{
  for (const Entry &entry : entries_of_kinds())
    if (entry.name == name_of(path) && kind_of(entry.path()) == kind_of(path) &&
        entry.wanted.find(';') != std::string::npos)
      return entry.pattern->match(value);
  return false;
}
} // namespace hpvi
