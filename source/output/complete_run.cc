// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/version.h>
#include <hpvi/output/complete_run.h>
#include <hpvi/output/json_tree.h>
#include <hpvi/output/summary.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>

namespace hpvi
{
namespace
{
JsonTree summary_in(const std::filesystem::path &directory)
{
  return json_tree(content_of(directory / "summary.json")).value_or(JsonTree());
}
} // namespace

bool is_complete_run(const std::filesystem::path &directory)
{
  const JsonTree summary = summary_in(directory);
  return words_of(summary, "status") == text(RunStatus::done) &&
         words_of(summary, "program") == "hpvi " + version();
}

template <int dim>
std::vector<std::string> input_files_of(const Scene<dim> &scene)
{
  std::vector<std::string> result =
      entries_of(effective_parameters(scene), [](const std::string &, const std::string &entry)
                 { return entry == "File" || entry == "Reference solution"; });
  const auto is_empty = [](const std::string &entry)
  { return entry.find(" = content ") == std::string::npos; };
  result.erase(std::remove_if(result.begin(), result.end(), is_empty), result.end());
  return result;
}

std::vector<std::string> input_files_of(const std::filesystem::path &directory)
{
  const JsonTree summary = summary_in(directory);
  std::vector<std::string> result;
  if (const JsonTree *const files = member(summary, "input_files"))
    for (const auto &file : *files)
      result.push_back(file.second.data());
  return result;
}

template std::vector<std::string> input_files_of(const Scene<2> &);
template std::vector<std::string> input_files_of(const Scene<3> &);
} // namespace hpvi
