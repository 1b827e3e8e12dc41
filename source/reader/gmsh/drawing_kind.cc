// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/deck/deck_cards.h>
#include <hpvi/reader/gmsh/drawing_kind.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

namespace hpvi
{
namespace
{
const std::vector<std::pair<std::string, double>> units = {
    {"mm", 1}, {"cm", 10}, {"m", 1000}, {"um", 1e-3}, {"km", 1e6}, {"inch", 25.4}, {"ft", 304.8}};

std::string beginning_of(const std::string &path, const std::size_t length)
{
  std::string text(length, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(text.data(), length);
  text.resize(in.gcount());
  return text;
}

bool begins(const std::string &text, const std::string &start)
{
  return text.compare(0, start.size(), start) == 0;
}

std::string without_blanks(std::string text)
{
  text.erase(std::remove_if(text.begin(), text.end(),
                            [](const unsigned char c) { return std::isspace(c); }),
             text.end());
  return text;
}

/** From the first word on. */
std::string trimmed_start(const std::string &text)
{
  return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

/** In column 73 a letter for the section, S first, then a number. */
bool is_iges(const std::string &text)
{
  return text.size() > 80 && text[72] == 'S' && text.find('\n') >= 80 &&
         text.substr(73, 7).find_first_not_of(" 01") == std::string::npos;
}

bool is_bdf(const std::string &text)
{
  const auto has = [&](const char *const word) { return text.find(word) != std::string::npos; };
  return (has("\nGRID") && (has("\nCQUAD") || has("\nCTRIA") || has("\nCBAR") || has("\nCTETRA") ||
                            has("\nCHEXA") || has("\nCPENTA"))) ||
         (has("BEGIN BULK") && has("\nGRID"));
}

bool is_unv(const std::string &text)
{
  const std::string start = trimmed_start(text);
  return begins(start, "-1\n") || begins(start, "-1\r\n") || begins(start, "-1 ");
}

double unit_called(const std::string &name)
{
  const auto found = std::find_if(units.begin(), units.end(),
                                  [&](const auto &unit) { return unit.first == name; });
  return found == units.end() ? 0 : found->second;
}

/** The statement in which LENGTH_UNIT stands: one with a conversion comes before those of SI, on which it is built. */
std::string unit_of_step(const std::string &path)
{
  const std::string text = without_blanks(beginning_of(path, std::filesystem::file_size(path)));
  static const std::map<std::string, std::string> names = {
      {"$", "m"}, {".MILLI.", "mm"}, {".CENTI.", "cm"}, {".MICRO.", "um"}, {".KILO.", "km"}};
  std::string found;
  for (std::size_t at = text.find("LENGTH_UNIT()"); at != std::string::npos;
       at = text.find("LENGTH_UNIT()", at + 1))
  {
    const std::size_t begin = text.rfind(';', at), end = text.find(';', at);
    const std::string statement = text.substr(begin + 1, end - begin - 1);
    if (statement.find("CONVERSION_BASED_UNIT('INCH") != std::string::npos)
      return "inch";
    if (statement.find("CONVERSION_BASED_UNIT('FOOT") != std::string::npos)
      return "ft";
    const std::size_t si = statement.find("SI_UNIT(");
    if (si == std::string::npos || !found.empty())
      continue;
    const auto name = names.find(statement.substr(si + 8, statement.find(',', si) - si - 8));
    if (name != names.end())
      found = name->second;
  }
  return found.empty() ? "mm" : found;
}

/** The fourteenth word of the global section, which has texts as 5HWORDS. */
std::string unit_of_iges(const std::string &path)
{
  std::ifstream in(path);
  std::string global;
  for (std::string line; std::getline(in, line);)
    if (line.size() > 72 && line[72] == 'G')
      global += line.substr(0, 72);
  std::vector<std::string> words(1);
  for (std::size_t k = 0; k < global.size() && words.size() < 15; ++k)
    if (const std::size_t h = global.find_first_not_of("0123456789", k);
        words.back().empty() && h != std::string::npos && h > k && global[h] == 'H')
    {
      const std::size_t n = std::stoul(global.substr(k, std::min<std::size_t>(h - k, 6)));
      words.back() = global.substr(h + 1, n);
      k = h + n;
    }
    else if (global[k] == ',')
      words.emplace_back();
    else
      words.back() += global[k];
  static const std::map<std::string, std::string> names = {
      {"1", "inch"}, {"2", "mm"}, {"4", "ft"}, {"6", "m"}, {"7", "km"}, {"9", "um"}, {"10", "cm"}};
  const auto name = words.size() < 14 ? names.end() : names.find(without_blanks(words[13]));
  return name == names.end() ? "mm" : name->second;
}
} // namespace

std::string DrawingKind::occ_unit() const
{
  std::string name = unit_name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](const unsigned char c) { return std::toupper(c); });
  return name;
}

std::string DrawingKind::origin(const std::string &wanted_unit) const
{
  if (unit == 0)
    return words;
  return words + ", lengths in " +
         (wanted_unit.empty() || wanted_unit == unit_name
              ? unit_name
              : wanted_unit + " from the file's " + unit_name);
}

bool DrawingKind::is_cad() const
{
  return name == "step" || name == "iges" || name == "brep";
}

bool DrawingKind::has_cells() const
{
  return !is_cad() && name != "geo";
}

const char *const length_units = "mm, cm, m, um, km, inch or ft";

double millimetres(const std::string &unit)
{
  return unit_called(unit);
}

DrawingKind kind_of_drawing(const std::string &path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    return {};
  const std::string text = beginning_of(path, 1 << 16), start = trimmed_start(text);
  if (begins(start, "ISO-10303-21"))
  {
    const std::string unit = unit_of_step(path);
    return {"step", "a STEP file", millimetres(unit), unit};
  }
  if (is_iges(text))
  {
    const std::string unit = unit_of_iges(path);
    return {"iges", "an IGES file", millimetres(unit), unit};
  }
  if (begins(start, "DBRep_DrawableShape") || begins(start, "CASCADE Topology V"))
    return {"brep", "a BREP file of OpenCASCADE"};
  if (begins(text, "# vtk DataFile"))
    return {"vtk", "a VTK file"};
  // Of other beginnings, a byte order mark among them, Gmsh takes a mesh for a script.
  if (begins(text, "$MeshFormat") || begins(text, "$NOD") ||
      (begins(text, "$Comments") && text.find("\n$MeshFormat") != std::string::npos))
    return {"msh", "a mesh file of Gmsh"};
  if (is_unv(text))
    return {"unv", "an UNV file"};
  if (is_bdf(text))
    return {"bdf", "a deck of Nastran"};
  if (looks_like_deck(text))
    return {"inp", "a deck of CalculiX or Abaqus"};
  if (std::filesystem::path(path).extension() == ".geo" &&
      text.find("$MeshFormat") == std::string::npos)
    return {"geo", "a script of Gmsh"};
  return {};
}
} // namespace hpvi
