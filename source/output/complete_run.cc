// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/version.h>
#include <hpvi/output/complete_run.h>
#include <hpvi/reader/scene_reader.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS // as the parser still does; silences its note
#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <fstream>

namespace hpvi
{
namespace
{
/** Empty where there is none, or it is no JSON. */
boost::property_tree::ptree summary_in(const std::filesystem::path &directory)
{
  std::ifstream file(directory / "summary.json");
  boost::property_tree::ptree summary;
  try
  {
    boost::property_tree::read_json(file, summary);
  }
  catch (const boost::property_tree::ptree_error &)
  {
    return {};
  }
  return summary;
}
} // namespace

bool is_complete_run(const std::filesystem::path &directory)
{
  const boost::property_tree::ptree summary = summary_in(directory);
  return summary.get<std::string>("status", "") == "done" &&
         summary.get<std::string>("program", "") == "hpvi " + version();
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
  const boost::property_tree::ptree summary = summary_in(directory);
  std::vector<std::string> result;
  if (const auto files = summary.get_child_optional("input_files"))
    for (const auto &file : *files)
      result.push_back(file.second.data());
  return result;
}

template std::vector<std::string> input_files_of(const Scene<2> &);
template std::vector<std::string> input_files_of(const Scene<3> &);
} // namespace hpvi
