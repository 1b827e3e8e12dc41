// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tests_overrides_h
#define hpvi_tests_overrides_h

#include "texts.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

/** Entries of a scene and their values; in a list of them others may stand as a whole. */
class Overrides : public std::vector<std::pair<std::string, std::string>>
{
  using Entries = std::vector<std::pair<std::string, std::string>>;

  struct Part : Entries
  {
    Part(const std::string &path, const std::string &value) : Entries{{path, value}}
    {
    }
    Part(const value_type &entry) : Entries{entry}
    {
    }
    Part(const Entries &entries) : Entries(entries)
    {
    }
  };

public:
  Overrides() = default;
  Overrides(const std::initializer_list<Part> parts)
  {
    for (const Part &part : parts)
      insert(end(), part.begin(), part.end());
  }
};

/** @p entries and @p more, whose values count where both have an entry. */
inline Overrides with(Overrides entries, const Overrides &more)
{
  for (const auto &entry : more)
  {
    entries.erase(std::remove_if(entries.begin(), entries.end(),
                                 [&](const auto &known) { return known.first == entry.first; }),
                  entries.end());
    entries.push_back(entry);
  }
  return entries;
}

inline Overrides operator+(const Overrides &entries, const Overrides &more)
{
  return with(entries, more);
}

inline Overrides joined(const std::vector<Overrides> &all)
{
  Overrides result;
  for (const Overrides &some : all)
    result = with(result, some);
  return result;
}

/** What many scenes have. */
namespace given
{
/** Of the material of that name. */
inline Overrides elastic(const std::string &E, const std::string &nu, const std::string &name = "")
{
  const std::string section = name.empty() ? "Material" : "Material " + name;
  return {{section + "/Young's modulus", E}, {section + "/Poisson's ratio", nu}};
}

/** The one body, from (0, 0) or @p lower to @p upper. */
inline Overrides box(const std::string &upper, const std::string &subdivisions)
{
  return {{"Geometry/Upper corner", upper}, {"Geometry/Subdivisions", subdivisions}};
}

inline Overrides box(const std::string &lower, const std::string &upper,
                     const std::string &subdivisions)
{
  return {{"Geometry/Lower corner", lower}, box(upper, subdivisions)};
}

/** One of several bodies, likewise. */
inline Overrides block(const std::string &name, const std::string &upper,
                       const std::string &subdivisions)
{
  return {{"Body " + name + "/Upper corner", upper},
          {"Body " + name + "/Subdivisions", subdivisions}};
}

inline Overrides block(const std::string &name, const std::string &lower, const std::string &upper,
                       const std::string &subdivisions)
{
  return {{"Body " + name + "/Lower corner", lower}, block(name, upper, subdivisions)};
}

/** Of a section, Geometry or Body NAME. */
inline Overrides quadrilateral(const std::string &section, const std::string &corners)
{
  return {{section + "/Shape", "quadrilateral"}, {section + "/Corners", corners}};
}

inline Overrides quadrilateral(const std::string &section, const std::string &corners,
                               const std::string &subdivisions)
{
  return {quadrilateral(section, corners), {section + "/Subdivisions", subdivisions}};
}

inline Overrides ring(const std::string &section, const std::string &radii,
                      const std::string &angles, const std::string &subdivisions)
{
  return {{section + "/Shape", "ring sector"},
          {section + "/Radii", radii},
          {section + "/Angles", angles},
          {section + "/Subdivisions", subdivisions}};
}

inline Overrides half_disc(const std::string &section, const std::string &centre,
                           const std::string &radius, const std::string &angle)
{
  return {{section + "/Shape", "half disc"},
          {section + "/Centre", centre},
          {section + "/Radius", radius},
          {section + "/Angle", angle}};
}

inline Overrides graded(const std::string &section, const std::string &towards,
                        const std::string &levels)
{
  return {{section + "/Graded towards", towards}, {section + "/Grading levels", levels}};
}

inline Overrides joint(const std::string &name, const std::string &between, const std::string &law)
{
  return {{"Contact " + name + "/Between", between}, {"Contact " + name + "/Law", law}};
}

/** Contact with Tresca's friction. */
inline Overrides rough(const std::string &boundary, const std::string &contact,
                       const std::string &bound)
{
  return {{"Boundary " + boundary + "/Contact", contact},
          {"Boundary " + boundary + "/Friction bound", bound}};
}

/** Coulomb's friction in the place of Tresca's, at the bottom. */
inline Overrides coulomb(const std::string &coefficient)
{
  return {{"Boundary bottom/Friction bound", ""},
          {"Boundary bottom/Friction coefficient", coefficient}};
}

inline Overrides clamped(const std::vector<std::string> &boundaries)
{
  Overrides result;
  for (const std::string &boundary : boundaries)
    result.emplace_back("Boundary " + boundary + "/Displacement", "0; 0");
  return result;
}

inline Overrides symmetric(const std::vector<std::string> &boundaries)
{
  Overrides result;
  for (const std::string &boundary : boundaries)
    result.emplace_back("Boundary " + boundary + "/Symmetry", "true");
  return result;
}

inline Overrides steps(const std::string &method, const std::string &number)
{
  return {{"Adaptivity/Method", method}, {"Adaptivity/Maximum steps", number}};
}

inline Overrides steps(const std::string &method, const std::string &number,
                       const std::string &start_degree)
{
  return {steps(method, number), {"Adaptivity/Start degree", start_degree}};
}
} // namespace given

#endif
