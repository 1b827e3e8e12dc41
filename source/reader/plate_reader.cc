// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/plate_reader.h>

#include <regex>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A number for the plate as a whole, which may change in time but not from place to place. */
template <int dim>
void check_constant(const Parameters &parameters, const std::string &section,
                    const std::string &entry)
{
  static const std::regex coordinate(dim == 2 ? "\\b[xy]\\b" : "\\b[xyz]\\b");
  if (std::regex_search(parameters.text(section, entry), coordinate))
    parameters.reject(section, entry,
                      std::string("uses ") + (dim == 2 ? "x or y" : "x, y or z") +
                          ", and a rigid plate has one value; write a number, or a function "
                          "of t in a load history");
}

/** The @p n motions from @p first on, each by the force or by the displacement; the entries that name them, or nothing. */
template <std::size_t n, int dim>
std::array<std::string, n>
read_motions(const Parameters &parameters, const ExpressionReader<dim> &expressions,
             const std::string &section, const std::string &force_entry,
             const std::string &motion_entry, const Point<dim> &anywhere, const double thickness,
             const unsigned int first, RigidPlate<dim> &plate)
{
  const auto force = expressions.template read<n>(section, force_entry, "free", {anywhere}),
             motion = expressions.template read<n>(section, motion_entry, "free", {anywhere});
  std::array<std::string, n> named;
  for (unsigned int c = 0; c < n; ++c)
  {
    if (force[c] && motion[c])
      parameters.reject(section, force_entry,
                        "contradicts " + section + "/" + motion_entry + " = " +
                            printable(parameters.text(section, motion_entry)) +
                            (n == 1 ? "" : std::string(" in ") + "xyz"[c]) +
                            "; a plate has one of the two, write `free` for the other");
    if (motion[c])
      plate.displacement[first + c] = motion[c]->value(anywhere);
    if (force[c])
      plate.force[first + c] = force[c]->value(anywhere) / thickness;
    named[c] = motion[c] ? motion_entry : force[c] ? force_entry : "";
  }
  return named;
}
} // namespace

template <int dim>
void read_plate(const Parameters &parameters, const ExpressionReader<dim> &expressions,
                const std::string &section, const std::vector<Point<dim>> &points,
                const double thickness, const bool is_axisymmetric,
                BoundaryCondition<dim> &boundary)
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
    check_constant<dim>(parameters, section, entry);
  constexpr unsigned int rotation = dim;
  RigidPlate<dim> plate;
  const auto moved = read_motions<dim>(parameters, expressions, section, "Force", "Displacement",
                                       points.front(), thickness, 0, plate);
  const auto turned =
      read_motions<plate.n_motions - dim>(parameters, expressions, section, "Moment", "Rotation",
                                          points.front(), thickness, rotation, plate);
  if (is_axisymmetric)
  {
    if (!moved[0].empty())
      parameters.reject(section, moved[0],
                        "is radial in x, and a plate of an axisymmetric body moves along the axis "
                        "alone; write free in x");
    if (!turned[0].empty())
      parameters.reject(section, turned[0],
                        "turns a plate of an axisymmetric body, which moves along the axis alone; "
                        "remove it");
    plate.displacement[0] = plate.displacement[rotation] = 0.;
  }
  boundary.plate = plate;
  boundary.displacement = {};
}

template void read_plate(const Parameters &, const ExpressionReader<2> &, const std::string &,
                         const std::vector<Point<2>> &, double, bool, BoundaryCondition<2> &);
template void read_plate(const Parameters &, const ExpressionReader<3> &, const std::string &,
                         const std::vector<Point<3>> &, double, bool, BoundaryCondition<3> &);
} // namespace hpvi
