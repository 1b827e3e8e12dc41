// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_curved_bodies_h
#define hpvi_space_curved_bodies_h

#include "grid.h"

#include <set>

#include <unistd.h>

namespace space
{
/** Gone when the tests are over: load steps read them again. */
struct TemporaryFiles
{
  ~TemporaryFiles()
  {
    for (const std::string &name : names)
      std::filesystem::remove(name);
  }

  std::set<std::string> names;
};

/** Bodies `one` and `other` of two grids, in contact at `one.@p side` and `other.@p opposite`, the sides of boundary_names(). */
inline Scene<3> two_bodies(const Grid &one, const Grid &other,
                           const std::pair<std::string, std::string> &between,
                           const Overrides &entries)
{
  const std::string name =
      std::filesystem::temp_directory_path() /
      ("curved-bodies-" + std::to_string(getpid())); // processes write their own
  one.write(name + "-one.msh");
  other.write(name + "-other.msh");
  std::ofstream out(name + ".prm");
  out << "set Dimension = 3\n";
  for (const char *const body : {"one", "other"})
    out << "subsection Body " << body << "\n  set Shape = file\n  set File = " << name << "-"
        << body << ".msh\nend\n";
  out << "subsection Contact joint\n  set Between = one." << between.first << ", other."
      << between.second << "\nend\n";
  out.close();
  static TemporaryFiles files;
  for (const char *const end : {"-one.msh", "-other.msh", ".prm"})
    files.names.insert(name + end);
  Scene<3> scene = read_scene<3>(name + ".prm", entries);
  scene.solver.primal_tolerance = 1e-11;
  return scene;
}

/** A quarter of a ring around the z axis from radius @p inner to inner + 1, half as high as 1, of @p n cells around and @p layers along z. */
inline Grid quarter_ring(const double inner, const unsigned int n, const unsigned int layers = 1,
                         const unsigned int n_nodes = 27)
{
  return {{{std::max(1U, n / 2), n, layers}},
          [inner](const Point<3> &x)
          {
            const double r = inner + x[0], angle = numbers::PI / 2 * x[1];
            return Point<3>(r * std::cos(angle), r * std::sin(angle), 0.5 * x[2]);
          },
          false,
          Grid::everywhere,
          n_nodes};
}

/** A ring of radii 1 and 2 in one of 2 and 3, in plane strain, with @p n and @p m cells around. */
inline Scene<3> two_rings(const unsigned int n, const unsigned int m, const Overrides &entries)
{
  Overrides all{{"Material/Young's modulus", "200"},
                {"Material/Poisson's ratio", "0.3"},
                {"Contact joint/Closed within", "0.01"},
                {"Adaptivity/Maximum steps", "1"}};
  for (const char *const body : {"one", "other"})
    for (const char *const side : {"front", "back", "bottom", "top"})
      all.emplace_back("Boundary " + std::string(body) + "." + side + "/Symmetry", "true");
  all.insert(all.end(), entries.begin(), entries.end());
  return two_bodies(quarter_ring(1, n), quarter_ring(2, m, 2), {"right", "left"}, all);
}

/** Lame, sigma_r = A - B/r^2, u_r = (1 + nu)/E ((1 - 2 nu) A r + B/r): the overlap that presses both rings together by 1. */
inline double overlap_of_rings()
{
  const double outer = 0.4 * 0.8 * 2 + 7.2 / 2, inner = -0.4 * 4 / 3 * 2 - 4. / 3 / 2;
  return 1.3 / 200 * (outer - inner);
}
} // namespace space

#endif
