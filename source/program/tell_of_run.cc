// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/output/output.h>
#include <hpvi/output/report.h>
#include <hpvi/output/run_files.h>
#include <hpvi/program/tell_of_run.h>
#include <hpvi/reader/scene_reader.h>

#include <iostream>
#include <memory>

namespace hpvi
{
namespace
{
/** Another run may be writing there, and a page of this name may be another's. */
std::unique_ptr<ResultDirectory> opened(const std::string &directory)
{
  try
  {
    return std::make_unique<ResultDirectory>(directory, results::report,
                                             std::vector<std::string>());
  }
  catch (const InputError &error)
  {
    const std::string what = error.what();
    throw InputError(what.substr(0, what.rfind("; ")) +
                     "; wait until that run is over, or move that file away");
  }
}

template <int dim>
std::string report_of(const std::string &directory)
{
  const Scene<dim> scene = read_scene<dim>(directory + "/scene.prm");
  try
  {
    return report(scene, directory, content_of(directory + "/summary.json"));
  }
  catch (const InputError &error)
  {
    throw InputError("hpvi: --report " + printable(directory, 400) + ": " + error.what());
  }
}
} // namespace

void tell_of_run(const std::string &directory)
{
  const std::unique_ptr<ResultDirectory> results = opened(directory);
  const std::string name = "report.html", page = scene_dimension(directory + "/scene.prm", {}) == 3
                                                     ? report_of<3>(directory)
                                                     : report_of<2>(directory);
  if (const std::error_code error = results->write(name, page))
    throw OutputFailure(results->name() + ": " + name + " cannot be written: " + error.message());
  std::cout << "report in " << printable(directory, 400) << '/' << name << std::endl;
}
} // namespace hpvi
