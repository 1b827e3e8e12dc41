// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/user_names.h>

#include <algorithm>
#include <cctype>

namespace hpvi
{
namespace
{
const std::string material = "Material ", boundary = "Boundary ", body = "Body ",
                  contact = "Contact ", probe = "Probe ", pretension = "Pretension ";

bool begins_with(const std::string &text, const std::string &start)
{
  return text.size() > start.size() && text.compare(0, start.size(), start) == 0;
}

/** Where a name stands for the first time. */
struct Found
{
  std::string name, where;
};

void check_name(const Found &found, const std::string &kind)
{
  const auto is_fit = [](const unsigned char c)
  { return std::isalnum(c) || c == '_' || c == '-' || c == ' '; };
  if (!std::all_of(found.name.begin(), found.name.end(), is_fit))
    fail(found.where, kind + found.name,
         "is no name; take letters, digits, '_', '-' and blanks between them");
}

/** Adds @p found unless it is there. */
void add(std::vector<std::string> &names, const Found &found, const std::string &kind)
{
  if (std::find(names.begin(), names.end(), found.name) != names.end())
    return;
  check_name(found, kind);
  for (const std::string &name : names)
    if (lower_case(name) == lower_case(found.name))
      fail(found.where, kind + found.name,
           "differs from " + kind + name + " in case alone; choose another name");
  names.push_back(found.name);
}
} // namespace

std::vector<std::string> body_names(const std::vector<Assignment> &all)
{
  std::vector<std::string> result;
  for (const Assignment &one : all)
    if (begins_with(one.section, body) && one.section != "Body force")
    {
      if (lower_case(one.section) == "body force")
        fail(one.where, one.section,
             "is no name of a body: it differs from the subsection Body force in case alone; "
             "choose another name");
      add(result, {one.section.substr(body.size()), one.where}, body);
    }
  for (const Assignment &one : all)
    if (!result.empty() && one.section == "Geometry")
      fail(one.where, one.section,
           "is that of a single body, and this scene has " + listed(result, "and") +
               "; write its entries in the subsection Body NAME");
    else if (result.empty() && begins_with(one.section, contact))
      fail(one.where, one.section,
           "stands between bodies, and this scene has none; open a subsection Body NAME for each, "
           "or write Contact in a Boundary for a rigid foundation");
    else if (const std::size_t dot = one.section.find('.');
             result.empty() && begins_with(one.section, boundary) && dot != std::string::npos)
      fail(one.where, one.section,
           "names a body, and this scene has no bodies; write " + boundary +
               one.section.substr(dot + 1));
  return result;
}

UserNames user_names(const std::vector<Assignment> &all, const std::vector<std::string> &sides)
{
  UserNames result;
  result.sides = sides;
  std::vector<std::string> known = sides;
  for (const Assignment &one : all)
  {
    if (begins_with(one.section, material))
      add(result.materials, {one.section.substr(material.size()), one.where}, material);
    if (begins_with(one.section, contact))
      add(result.pairs, {one.section.substr(contact.size()), one.where}, contact);
    if (begins_with(one.section, probe))
      add(result.probes, {one.section.substr(probe.size()), one.where}, probe);
    if (begins_with(one.section, pretension))
      add(result.pretensions, {one.section.substr(pretension.size()), one.where}, pretension);
    if (!begins_with(one.section, boundary) || one.name != "On")
      continue;
    const Found part{one.section.substr(boundary.size()), one.where};
    const bool is_side = std::find(sides.begin(), sides.end(), part.name) != sides.end();
    if (is_side ||
        std::find(result.parts.begin(), result.parts.end(), part.name) != result.parts.end())
      continue; // On is unknown in a side
    add(known, part, boundary);
    result.parts.push_back(part.name);
  }
  return result;
}
} // namespace hpvi
