// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/probe_marks.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
std::string in_words(const Probe<dim> &probe, const std::string &length_unit)
{
  switch (probe.kind)
  {
  case ProbeKind::point:
    return "at " + to_string(probe.at);
  case ProbeKind::disc:
    return "mean over the disc of radius " + with_unit(probe.size, length_unit) + " about " +
           to_string(probe.at);
  case ProbeKind::boundary:
    return "mean along " + probe.side;
  case ProbeKind::line:
    return text(probe.n_points) + " points from " + to_string(probe.from) + " to " +
           to_string(probe.to);
  }
  return {};
}
} // namespace

template <int dim>
std::string probes_in_words(const Scene<dim> &scene)
{
  std::string lines;
  for (const Probe<dim> &probe : scene.probes)
    lines += "probe " + probe.name + ": " + in_words(probe, scene.length_unit) + "\n";
  return lines;
}

namespace
{
/** The name stands beside it. */
void add_name(SceneSheet &sheet, const Probe<2> &probe, const PagePoint &at,
              const PageVector &outward)
{
  sheet.drawing.add(
      {at, outward, 20., {{probe.name, false, mark_colours::probe}}, "probe", probe.name});
}

void draw_cross(SceneSheet &sheet, const PagePoint &at)
{
  constexpr double arm = 4.;
  sheet.drawing.strokes({{at - PageVector({arm, arm}), at + PageVector({arm, arm})},
                         {at - PageVector({arm, -arm}), at + PageVector({arm, -arm})}},
                        "class=\"probe\" " + stroke(mark_colours::probe, 1.4));
}

/** Beside the boundary, inside, where nothing else is drawn. */
void draw_boundary(SceneSheet &sheet, const Probe<2> &probe, const std::vector<OutlinePart> &parts)
{
  constexpr double inset = 4.;
  const OutlinePart *longest = nullptr;
  for (const OutlinePart &part : parts)
  {
    if (std::find(probe.on.begin(), probe.on.end(), part.boundary) == probe.on.end())
      continue;
    if (!longest || part.length() > longest->length())
      longest = &part;
    std::vector<PagePoint> line;
    for (const Station &place : sheet.stations(part, 4., true))
      line.push_back(place.at - inset * place.normal);
    sheet.drawing.line(line, "class=\"probe\" " + stroke(mark_colours::probe, 1.6));
  }
  if (!longest)
    return;
  const Station middle = sheet.station(*longest, 0.35);
  add_name(sheet, probe, middle.at - inset * middle.normal, -middle.normal);
}

void draw_line(SceneSheet &sheet, const Probe<2> &probe)
{
  const PagePoint from = sheet.page(probe.from), to = sheet.page(probe.to);
  sheet.drawing.line({from, to}, "class=\"probe\" stroke-dasharray=\"2 4\" " +
                                     stroke(mark_colours::probe, 1.6));
  const PageVector way = to - from;
  const double length = way.norm();
  const PageVector across =
      length > 0 ? PageVector({-way[1] / length, way[0] / length}) : PageVector({0., -1.});
  add_name(sheet, probe, from + 0.5 * way, across);
}
} // namespace

void draw_probes(SceneSheet &sheet, const std::vector<OutlinePart> &parts)
{
  for (const Probe<2> &probe : sheet.scene.probes)
  {
    sheet.drawing.begin("probe", probe.name);
    if (probe.kind == ProbeKind::boundary)
      draw_boundary(sheet, probe, parts);
    else if (probe.kind == ProbeKind::line)
      draw_line(sheet, probe);
    else
    {
      const PagePoint at = sheet.page(probe.at);
      if (probe.kind == ProbeKind::disc)
        sheet.drawing.circle(at, sheet.scale * probe.size,
                             "class=\"probe\" fill=\"none\" " + stroke(mark_colours::probe, 1.4));
      else
        draw_cross(sheet, at);
      add_name(sheet, probe, at, PageVector({0.7071, 0.7071}));
    }
    sheet.drawing.end();
  }
}

template std::string probes_in_words(const Scene<2> &);
template std::string probes_in_words(const Scene<3> &);
} // namespace hpvi
