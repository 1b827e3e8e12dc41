// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/probe_reader.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int usual_points = 101; ///< of a line that does not say how many
} // namespace

std::vector<Entry> probe_entries(const int dim, const std::string &name)
{
  const std::string section = "Probe " + name, x = dim == 2 ? "x, y" : "x, y, z";
  const auto text = std::make_shared<Patterns::Anything>();
  const std::shared_ptr<const Patterns::PatternBase> point =
      word_or("", Patterns::List(Patterns::Double(), dim, dim));
  std::vector<Entry> entries{
      {section, "At", "", point, "a point " + x + " or nothing",
       "A point of the body. Columns of convergence.csv that begin with the name of the probe hold "
       "its displacement [length] and its stress [stress]; empty: the probe is On a boundary, or "
       "From one point To another."},
      {section, "On", "", text, "the name of a boundary or nothing",
       "A side, with its parts, or a part of one: the displacement is the mean along it, the "
       "stress that of the mean stress there; empty: the probe is At a point, or a line."},
      {section, "From", "", point, "a point " + x + " or nothing",
       "One end of a line, whose displacements and stresses make a table of their own, "
       "probe-NAME-NN.csv; empty: the probe is no line."},
      {section, "To", "", point, "a point " + x + " or nothing", "The other end of the line."},
      {section, "Points", "", word_or("", Patterns::Integer(2, 100000)),
       "an integer from 2 to 100000, or nothing",
       "Number of points of the line, ends included, at equal distances; empty: 101."}};
  if (dim == 2)
    entries.insert(
        entries.begin() + 1,
        {section, "Size", "",
         word_or("", Patterns::Double(std::numeric_limits<double>::min(),
                                      std::numeric_limits<double>::max())),
         "a positive number or nothing",
         "Radius of a disc about At [length], which has to lie in the body: the displacement is "
         "the mean over it, which may have a guaranteed interval, the stress that of the mean "
         "stress; empty: the point, without interval."});
  return entries;
}

namespace
{
/** Of one probe. */
template <int dim>
class ProbeReader
{
public:
  ProbeReader(const Parameters &parameters, const std::string &name, const Scene<dim> &scene)
      : parameters(parameters), section("Probe " + name), scene(scene)
  {
    probe.name = name;
  }

  Probe<dim> read()
  {
    const bool is_at = has("At"), is_on = has("On"), is_line = has("From") || has("To");
    if (!is_at && !is_on && !is_line)
      parameters.reject(section, "At",
                        "is missing; give At = a point, On = a boundary, or From and To");
    if (is_at && (is_on || is_line))
      parameters.reject(section,
                        is_on         ? "On"
                        : has("From") ? "From"
                                      : "To",
                        "stands beside At; a probe has one place, remove one of the two");
    if (is_on && is_line)
      parameters.reject(section, has("From") ? "From" : "To",
                        "stands beside On; a probe has one place, remove one of the two");
    if (!is_at && has("Size"))
      parameters.reject(section, "Size", "is the radius of a disc about At; give At or remove it");
    if (!is_line && has("Points"))
      parameters.reject(section, "Points", "are those of a line; give From and To, or remove it");
    if (is_at)
      read_point();
    else if (is_on)
      read_boundary();
    else
      read_line();
    return probe;
  }

private:
  bool has(const std::string &entry) const
  {
    return parameters.has(section, entry) && !parameters.text(section, entry).empty();
  }

  Point<dim> point(const std::string &entry) const
  {
    return parameters.points<dim>(section, entry).front();
  }

  void read_point()
  {
    probe.at = point("At");
    if (!has("Size"))
      return;
    probe.kind = ProbeKind::disc;
    probe.size = parameters.number(section, "Size");
  }

  /** A side is what its parts leave of it, and these. */
  void read_boundary()
  {
    probe.kind = ProbeKind::boundary;
    probe.side = parameters.text(section, "On");
    std::vector<std::string> all;
    for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    {
      if (!boundary.name.empty() && std::find(all.begin(), all.end(), boundary.name) == all.end())
        all.push_back(boundary.name);
      if (boundary.name == probe.side || scene.boundaries[boundary.side].name == probe.side)
        probe.on.push_back(boundary.id);
    }
    if (probe.on.empty())
      parameters.reject(section, "On", "is no boundary; this scene has: " + listed(all, "and"));
  }

  void read_line()
  {
    probe.kind = ProbeKind::line;
    if (!has("From"))
      parameters.reject(section, "To", "has no From; give both ends of the line");
    if (!has("To"))
      parameters.reject(section, "From", "has no To; give both ends of the line");
    probe.from = point("From");
    probe.to = point("To");
    probe.n_points = has("Points") ? parameters.integer(section, "Points") : usual_points;
  }

  const Parameters &parameters;
  const std::string section;
  const Scene<dim> &scene;
  Probe<dim> probe;
};
} // namespace

template <int dim>
void read_probes(const Parameters &parameters, const std::vector<std::string> &names,
                 Scene<dim> &scene)
{
  for (const std::string &name : names)
    scene.probes.push_back(ProbeReader<dim>(parameters, name, scene).read());
}

template void read_probes(const Parameters &, const std::vector<std::string> &, Scene<2> &);
template void read_probes(const Parameters &, const std::vector<std::string> &, Scene<3> &);
} // namespace hpvi
