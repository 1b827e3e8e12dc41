// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/collection.h>

#include <cstdlib>
#include <regex>

namespace hpvi
{
void add_to_pvd(GrowingText &pvd, const double time, const std::string &file)
{
  const std::string head = "<?xml version=\"1.0\"?>\n"
                           "<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
                    end = "  </Collection>\n</VTKFile>\n";
  pvd.same = pvd.text.empty() ? 0 : pvd.text.size() - end.size();
  pvd.text.resize(pvd.same);
  pvd.text += (pvd.same == 0 ? head : "") + "    <DataSet timestep=\"" + text(time) +
              "\" part=\"0\" file=\"" + file + "\"/>\n" + end;
}

std::vector<std::pair<std::string, std::string>> collected(const std::vector<std::string> &files)
{
  static const std::regex pattern("(solution|contact)-[0-9]+\\.p?vtu");
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::string &file : files)
    if (std::smatch match; std::regex_match(file, match, pattern))
      result.emplace_back(match[1].str() + ".pvd", file);
  return result;
}

GrowingText first_of_pvd(const std::string &pvd, const unsigned int n_steps)
{
  static const std::regex entry(
      "timestep=\"([^\"]+)\" part=\"0\" file=\"([a-z]+-([0-9]{2,9})\\.[a-z]+)\"");
  GrowingText result;
  for (std::sregex_iterator found(pvd.begin(), pvd.end(), entry), end; found != end; ++found)
    if (std::stoul((*found)[3]) <= n_steps)
      add_to_pvd(result, std::strtod((*found)[1].str().c_str(), nullptr), (*found)[2]);
  result.same = 0;
  return result;
}
} // namespace hpvi
