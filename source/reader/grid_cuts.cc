// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/reader/grid_cuts.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double same = 1e-9;          ///< of the axes of the unit cube: nearer lines are one
constexpr unsigned int n_samples = 24, ///< of each interval between grid lines
    n_scans = 5;

using Profile = std::function<double(double)>; ///< along an axis of the unit cube

/** Conditions like x < 0.3 are 1 or 0: what counts is where they are positive. */
double end_between(const Profile &f, const double a, const double b)
{
  std::uintmax_t most = 200;
  const auto narrow =
      boost::math::tools::bisect([&](const double s) { return f(s) > 0 ? 1. : -1.; }, a, b,
                                 boost::math::tools::eps_tolerance<double>(52), most);
  return (narrow.first + narrow.second) / 2;
}

/** Where @p f begins or ends to be positive inside the intervals between @p lines. */
std::vector<double> ends(const Profile &f, const std::vector<double> &lines)
{
  std::vector<double> result;
  for (unsigned int i = 0; i + 1 < lines.size(); ++i)
  {
    const auto at = [&](const unsigned int k)
    { return lines[i] + (lines[i + 1] - lines[i]) * (k + 0.5) / n_samples; };
    for (unsigned int k = 0; k + 1 < n_samples; ++k)
      if ((f(at(k)) > 0) != (f(at(k + 1)) > 0))
        result.push_back(end_between(f, at(k), at(k + 1)));
  }
  return result;
}

bool is_among(const std::vector<double> &lines, const double x)
{
  return std::any_of(lines.begin(), lines.end(),
                     [x](const double line) { return std::abs(line - x) < same; });
}
} // namespace

template <int dim>
void add_lines(Scene<dim> &scene, const unsigned int direction, const std::vector<double> &found,
               const std::string &path)
{
  Geometry<dim> &geometry = scene.geometry;
  std::vector<double> &cuts = geometry.cuts[direction];
  std::ostringstream places;
  for (const double x : found)
    if (!is_among(geometry.grid_lines(direction), x))
    {
      cuts.push_back(x);
      Point<dim> unit;
      unit[direction] = x;
      places << (places.str().empty() ? "" : ", ") << text(geometry.point(unit)[direction], 12);
    }
  std::sort(cuts.begin(), cuts.end());
  if (places.str().empty())
    return;
  std::string cells;
  for (unsigned int d = 0; d < dim; ++d)
    cells += (d > 0 ? " x " : "") + std::to_string(geometry.n_cells(d));
  scene.remarks.push_back("the coarse mesh has " + cells + " cells: " + path +
                          " has a grid line at " + "xyz"[direction] + " = " + places.str());
}

template <int dim>
void cut_side(Scene<dim> &scene, const unsigned int side, const Expression<dim> &where,
              const std::string &path)
{
  if (scene.geometry.shape != Shape::box || dim == 3)
    return; // in space parts are made of coarse faces
  const unsigned int along = side / 2 == 0 ? 1 : 0;
  const Profile f = [&](const double s)
  {
    Point<dim> unit;
    unit[side / 2] = side % 2;
    unit[along] = s;
    return where->value(scene.geometry.point(unit));
  };
  add_lines(scene, along, ends(f, scene.geometry.grid_lines(along)), path);
}

template <int dim>
void cut_body(Scene<dim> &scene, const Expression<dim> &where, const std::string &path)
{
  if (scene.geometry.shape != Shape::box)
    return;
  for (unsigned int d = 0; d < dim; ++d)
  {
    std::vector<double> all, straight;
    // Between grid lines, at places that no symmetry of a curve has in common.
    for (unsigned int k = 0; k < std::pow(n_scans, dim - 1); ++k)
    {
      std::array<std::vector<double>, dim> lines;
      unsigned int n_lines = 1;
      for (unsigned int other = 0; other < dim; ++other)
        if (other != d)
          n_lines *= scene.geometry.n_cells(other);
      for (unsigned int cell = 0; cell < n_lines; ++cell)
      {
        Point<dim> unit;
        for (unsigned int other = 0, rest = cell, scan = k; other < dim; ++other)
          if (other != d)
          {
            const auto across = scene.geometry.grid_lines(other);
            const unsigned int i = rest % (across.size() - 1);
            const double t = std::pow((scan % n_scans + 0.37) / n_scans, 1.13);
            unit[other] = across[i] + (across[i + 1] - across[i]) * t;
            rest /= across.size() - 1;
            scan /= n_scans;
          }
        const std::vector<double> found = ends(
            [&](const double s)
            {
              unit[d] = s;
              return where->value(scene.geometry.point(unit));
            },
            scene.geometry.grid_lines(d));
        for (const double x : found)
          (is_among(all, x) && !is_among(straight, x) ? straight : all).push_back(x);
      }
    }
    add_lines(scene, d, straight, path);
  }
}

template void add_lines(Scene<2> &, unsigned int, const std::vector<double> &, const std::string &);
template void add_lines(Scene<3> &, unsigned int, const std::vector<double> &, const std::string &);
template void cut_side(Scene<2> &, unsigned int, const Expression<2> &, const std::string &);
template void cut_side(Scene<3> &, unsigned int, const Expression<3> &, const std::string &);
template void cut_body(Scene<2> &, const Expression<2> &, const std::string &);
template void cut_body(Scene<3> &, const Expression<3> &, const std::string &);
} // namespace hpvi
