// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/pair_rules.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

std::array<std::string, 2> read_between(const Parameters &parameters, const std::string &section)
{
  const std::vector<std::string> sides =
      Utilities::split_string_list(parameters.text(section, "Between"), ',');
  if (sides.size() != 2)
    parameters.reject(section, "Between",
                      "names no two sides; give BODY.side, BODY.side, or automatic");
  return {{sides[0], sides[1]}};
}

std::optional<unsigned int> read_slave(const Parameters &parameters, const std::string &section,
                                       const std::array<std::string, 2> &sides,
                                       const bool of_one_body)
{
  if (of_one_body)
    parameters.reject(section, "Between",
                      "names sides of one body; a body does not touch itself, name sides of two");
  const std::string slave = parameters.text(section, "Slave");
  if (slave == "automatic")
    return std::nullopt;
  const auto found = std::find(sides.begin(), sides.end(), slave);
  if (found == sides.end())
    parameters.reject(section, "Slave",
                      "is none of the two sides; give automatic or one of Between");
  return found - sides.begin();
}

void reject_overlap(const Parameters &parameters, const std::string &section, const double depth,
                    const std::string &place)
{
  parameters.reject(section, "Between",
                    "names sides that lie " + to_string(depth) + " inside each other" + place +
                        "; move the bodies apart and give an interference as a "
                        "negative Gap, or set Closed within if none is meant");
}

double read_closed_within(const Parameters &parameters, const std::string &section,
                          const double size)
{
  constexpr double most = 0.01;
  const double closed = parameters.number(section, "Closed within");
  if (closed > most * size)
    parameters.reject(section, "Closed within",
                      "is more than 1 % of the size of the bodies, " + to_string(size) +
                          "; give less, or move them together in the drawing");
  return closed > 0 ? closed + same_place * size : 0.;
}

std::string closed_in_words(const std::string &section, const std::array<std::string, 2> &names,
                            const double closed, const double least, const double largest)
{
  const std::string sides = names[0] + " and " + names[1], entry = section + "/Closed within";
  if (largest - least <= 1e-6 * closed && std::abs(least) <= closed)
    return entry + ": " + sides + " lie " + to_string(std::abs(least)) +
           (least < 0 ? " inside each other" : " apart") + " in the drawing, which counts as none";
  const std::string distances = entry + ": distances of " + sides + " in the drawing, from " +
                                to_string(least) + " to " + to_string(largest) + ", ";
  return distances + (least > closed ? "are all larger, and count"
                      : -least <= closed && largest <= closed
                          ? "count as none"
                          : "count as none up to it, so that the sides lie flat on each "
                            "other there; if they shall touch in a point, move a body");
}

template <int dim>
Expression<dim> beyond(const double closed, const double doubt, const Expression<dim> &distance)
{
  if (closed == 0 && doubt == 0)
    return distance;
  return expression<dim>(std::function<double(const Point<dim> &)>(
      [closed, doubt, distance](const Point<dim> &x)
      {
        const double value = distance->value(x);
        return value >= -std::max(closed, doubt) && value <= closed ? 0. : value;
      }));
}

void choose_slave(const Parameters &parameters, const std::string &section,
                  const std::array<bool, 2> &hangs_over, std::optional<unsigned int> &slave)
{
  if (hangs_over[0] && hangs_over[1])
    parameters.reject(section, "Between",
                      "has parts of both sides that hang over the end of the other; give one body "
                      "a vertex where the other ends, by its mesh or Subdivisions");
  for (const unsigned int k : {0, 1})
    if (hangs_over[k] && slave == k)
      parameters.reject(section, "Slave",
                        "has a part that hangs over the end of the other side; give it a vertex "
                        "there, or set automatic");
    else if (hangs_over[k])
      slave = 1 - k;
}

template Expression<2> beyond(double, double, const Expression<2> &);
template Expression<3> beyond(double, double, const Expression<3> &);
} // namespace hpvi
