// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/version.h>
#include <hpvi/output/finished_run.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS // as the parser still does; silences its note
#include <boost/property_tree/json_parser.hpp>

#include <fstream>

namespace hpvi
{
bool is_finished_run(const std::filesystem::path &directory)
{
  std::ifstream file(directory / "summary.json");
  if (!file)
    return false;
  boost::property_tree::ptree summary;
  try
  {
    boost::property_tree::read_json(file, summary);
  }
  catch (const boost::property_tree::ptree_error &)
  {
    return false;
  }
  return summary.get<std::string>("status", "") == "done" &&
         summary.get<std::string>("program", "") == "hpvi " + version();
}
} // namespace hpvi
