// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/output/output.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/scene_picture.h>
#include <hpvi/program/draw_scene.h>
#include <hpvi/reader/input/parameters.h>

#include <iostream>

namespace hpvi
{
void draw_scene(const Scene<2> &scene, const std::string &directory)
{
  const std::string name = "scene.svg", picture = scene_picture(scene); // first: it may be refused
  const ResultDirectory results(directory, results::picture, {scene.file});
  if (const std::error_code error = results.write(name, picture))
    throw OutputFailure(results.name() + ": " + name + " cannot be written: " + error.message());
  std::cout << "picture in " << printable(directory, 400) << '/' << name << std::endl;
}
} // namespace hpvi
