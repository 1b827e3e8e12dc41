// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/automatic_pairs.h>
#include <hpvi/scene/bare_joints.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace hpvi
{
namespace
{
const std::string contact_section = "Contact ", automatic = "automatic";

/** The last value of an entry, which counts. */
std::string value_of(const std::vector<Assignment> &all, const std::string &section,
                     const std::string &name)
{
  std::string value;
  for (const Assignment &one : all)
    if (one.section == section && one.name == name)
      value = one.value;
  return value;
}

/** Does it say something with which a side is no part of a pair? */
bool is_taken(const std::vector<Assignment> &all, const std::string &side)
{
  for (const char *const entry : {"Displacement", "Symmetry", "Rigid", "Contact"})
    if (const std::string value = value_of(all, "Boundary " + side, entry);
        !value.empty() && value != "false" && value != "none")
      return true;
  return false;
}

bool has_name(const std::string &side)
{
  return side.find('.') != std::string::npos;
}

/** As a scene file has it. */
std::string section_text(const std::string &section, const std::vector<Assignment> &own)
{
  std::string text = "subsection " + section + "\n";
  for (auto one = own.begin(); one != own.end(); ++one)
    if (!one->name.empty() &&
        std::none_of(one + 1, own.end(),
                     [&](const Assignment &later) { return later.name == one->name; }))
      text += "  set " + one->name + " = " + one->value + "\n";
  return text + "end";
}
} // namespace

std::vector<std::string> automatic_pairs(const std::vector<Assignment> &all)
{
  std::vector<std::string> result;
  for (const Assignment &one : all)
    if (one.section.compare(0, contact_section.size(), contact_section) == 0 &&
        one.name == "Between" && value_of(all, one.section, "Between") == automatic)
      if (const std::string name = one.section.substr(contact_section.size());
          std::find(result.begin(), result.end(), name) == result.end())
        result.push_back(name);
  return result;
}

std::vector<Assignment> without_pairs(const std::vector<Assignment> &all,
                                      const std::vector<std::string> &pairs)
{
  std::vector<Assignment> result;
  std::copy_if(all.begin(), all.end(), std::back_inserter(result),
               [&](const Assignment &one)
               {
                 return std::none_of(pairs.begin(), pairs.end(),
                                     [&](const std::string &pair)
                                     { return one.section == contact_section + pair; });
               });
  return result;
}

template <int dim>
std::vector<Assignment> with_pairs_found(const std::vector<Assignment> &all,
                                         const std::vector<std::string> &pairs,
                                         const Scene<dim> &bodies, std::string &sections)
{
  std::vector<Assignment> result = without_pairs(all, pairs);
  std::set<std::array<std::string, 2>> known;
  for (const std::string &pair : pairs)
  {
    const std::string section = contact_section + pair;
    std::vector<Assignment> own;
    for (const Assignment &one : all)
      if (one.section == section)
        own.push_back(one);
    const auto between = std::find_if(own.rbegin(), own.rend(),
                                      [](const Assignment &one) { return one.name == "Between"; });
    const double within = std::strtod(value_of(all, section, "Closed within").c_str(), nullptr);
    std::vector<std::array<std::string, 2>> found;
    std::string nameless;
    for (const BareJoint<dim> &joint : touching_sides(bodies, within))
      if (!has_name(joint.sides[0]) || !has_name(joint.sides[1]))
        nameless = joint.sides[0] + " and " + joint.sides[1] + " lie on each other at " +
                   to_string(joint.at);
      else if (!is_taken(all, joint.sides[0]) && !is_taken(all, joint.sides[1]) &&
               known.insert(joint.sides).second)
        found.push_back(joint.sides);
    if (found.empty())
      fail(between->where, section + "/Between = automatic",
           nameless.empty()
               ? "finds no sides of two bodies that lie on each other and that no "
                 "other pair, support or foundation has; name two, or set Closed "
                 "within to their distance in the drawing"
               : "finds that " + nameless + "; give them names in the drawing, or by Curves");
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      const std::string name = section + (found.size() == 1 ? "" : " " + std::to_string(k + 1));
      std::vector<Assignment> copy;
      for (Assignment one : own)
      {
        one.section = name;
        if (one.name == "Between")
          one.value = found[k][0] + ", " + found[k][1];
        copy.push_back(one);
      }
      sections += (sections.empty() ? "" : "\n") + section_text(name, copy);
      result.insert(result.end(), copy.begin(), copy.end());
    }
  }
  return result;
}

template std::vector<Assignment> with_pairs_found(const std::vector<Assignment> &,
                                                  const std::vector<std::string> &,
                                                  const Scene<2> &, std::string &);
template std::vector<Assignment> with_pairs_found(const std::vector<Assignment> &,
                                                  const std::vector<std::string> &,
                                                  const Scene<3> &, std::string &);
} // namespace hpvi
