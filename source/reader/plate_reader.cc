// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/plate_reader.h>

#include <regex>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int rotation = 2;

/** A number for the plate as a whole, which may change in time but not from place to place. */
void check_constant(const Parameters &parameters, const std::string &section,
                    const std::string &entry)
{
  static const std::regex coordinate("\\b[xy]\\b");
  if (std::regex_search(parameters.text(section, entry), coordinate))
    parameters.reject(section, entry,
                      "uses x or y, and a rigid plate has one value; write a number, or a function "
                      "of t in a load history");
}

/** Displacement or Force by component, Rotation or Moment: one of both may be there. */
void check_one(const Parameters &parameters, const std::string &section, const bool both,
               const std::string &force, const std::string &motion, const std::string &component)
{
  if (both)
    parameters.reject(section, force,
                      "contradicts " + section + "/" + motion + " = " +
                          printable(parameters.text(section, motion)) + component +
                          "; a plate has one of the two, write `free` for the other");
}
} // namespace

void read_plate(const Parameters &parameters, const ExpressionReader<2> &expressions,
                const std::string &section, const std::vector<Point<2>> &points,
                const double thickness, const bool is_axisymmetric, BoundaryCondition<2> &boundary)
{
  if (!parameters.boolean(section, "Rigid"))
  {
    for (const char *const entry : {"Force", "Rotation", "Moment"})
      if (!parameters.text(section, entry).empty())
        parameters.reject(section, entry,
                          "is that of a rigid plate; set Rigid = true, or remove it and give "
                          "Traction, a force per area");
    return;
  }
  if (points.empty())
    return; // parts have taken it all, which its check says
  for (const char *const entry : {"Displacement", "Force", "Rotation", "Moment"})
    check_constant(parameters, section, entry);
  RigidPlate<2> plate;
  const std::vector<Point<2>> anywhere{points.front()};
  const auto force = expressions.read<2>(section, "Force", "free", anywhere),
             displacement = expressions.read<2>(section, "Displacement", "free", anywhere);
  const auto value = [&](const auto &function) { return function->value(anywhere[0]); };
  for (unsigned int c = 0; c < 2; ++c)
  {
    check_one(parameters, section, force[c] && displacement[c], "Force", "Displacement",
              std::string(" in ") + "xy"[c]);
    if (displacement[c])
      plate.displacement[c] = value(displacement[c]);
    if (force[c])
      plate.force[c] = value(force[c]) / thickness;
  }
  const auto angle = expressions.read<1>(section, "Rotation", "free", anywhere)[0],
             moment = expressions.read<1>(section, "Moment", "free", anywhere)[0];
  check_one(parameters, section, angle && moment, "Moment", "Rotation", "");
  if (angle)
    plate.displacement[rotation] = value(angle);
  if (moment)
    plate.force[rotation] = value(moment) / thickness;
  if (is_axisymmetric)
  {
    for (const bool is_named : {bool(displacement[0]), bool(force[0])})
      if (is_named)
        parameters.reject(
            section, force[0] ? "Force" : "Displacement",
            "is radial in x, and a plate of an axisymmetric body moves along the axis "
            "alone; write free in x");
    if (angle || moment)
      parameters.reject(section, angle ? "Rotation" : "Moment",
                        "turns a plate of an axisymmetric body, which moves along the axis alone; "
                        "remove it");
    plate.displacement[0] = plate.displacement[rotation] = 0.;
  }
  boundary.plate = plate;
  boundary.displacement = {};
}
} // namespace hpvi
