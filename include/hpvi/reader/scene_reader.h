// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_reader_h
#define hpvi_scene_reader_h

#include <hpvi/reader/input/parameters.h>
#include <hpvi/scene/scene.h>

#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** What Adaptivity/Tolerance = automatic stands for where a scene names no other end of its run. */
inline constexpr const char *default_tolerance = "1e-3";

/**
 * Read and check a scene. Solver/Path = auto is settled: the faster one in the plane, on several processes the primal one,
 * which scene.prm says then. Throws InputError with one line (file, entry, value, remedy).
 */
template <int dim>
Scene<dim> read_scene(const ParameterFile &file, SceneUse use = SceneUse::solve,
                      unsigned int n_processes = 1);

/** The same with @p overrides, pairs "Section/Entry", value. */
template <int dim>
Scene<dim> read_scene(const std::string &file,
                      const std::vector<std::pair<std::string, std::string>> &overrides = {},
                      const SceneUse use = SceneUse::solve)
{
  return read_scene<dim>(ParameterFile(file, overrides), use);
}

/**
 * The space dimension that @p file names: 3, or 2, also where that is not said or
 * wrong, which read_scene() finds.
 */
int scene_dimension(const ParameterFile &file);

/** The text of scene.prm, every entry with its value; empty for a scene that was built by code. */
template <int dim>
std::string effective_parameters(const Scene<dim> &scene)
{
  return scene.parameters ? scene.parameters->print(false) : "";
}

/** All entries of a plane scene with defaults and documentation, as a parameter file. */
std::string default_parameters();
} // namespace hpvi

#endif
