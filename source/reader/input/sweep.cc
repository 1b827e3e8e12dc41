// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/input/sweep.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>

namespace hpvi
{
namespace
{
[[noreturn]] void reject(const std::string &text, const std::string &problem_and_remedy)
{
  throw InputError("hpvi: --sweep " + printable(text) + ": " + problem_and_remedy);
}

/** The parts of @p text between separators outside of parentheses, trimmed; `||` is an operator of expressions. */
std::vector<std::string> split(const std::string &text, const char separator)
{
  std::vector<std::string> parts(1);
  int depth = 0;
  for (std::size_t k = 0; k < text.size(); ++k)
  {
    const char c = text[k];
    depth = std::max(0, depth + (c == '(') - (c == ')'));
    const bool is_doubled =
        c == '|' && ((k > 0 && text[k - 1] == '|') || (k + 1 < text.size() && text[k + 1] == '|'));
    if (c == separator && depth == 0 && !is_doubled)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (std::string &part : parts)
    part = dealii::Utilities::trim(part);
  return parts;
}

std::string name_of(const std::string &path)
{
  const std::size_t slash = path.rfind('/');
  return single_spaced(slash == std::string::npos ? path : path.substr(slash + 1));
}

std::string normal(const std::string &path)
{
  const std::size_t slash = path.rfind('/');
  return (slash == std::string::npos ? "" : single_spaced(path.substr(0, slash)) + "/") +
         name_of(path);
}

/** A longer one would be no name of a file; the number behind it tells values apart. */
std::string part_of_name(const std::string &value)
{
  std::string part = value.substr(0, 100);
  for (char &c : part)
    if (!('a' <= c && c <= 'z') && !('A' <= c && c <= 'Z') && !('0' <= c && c <= '9') && c != '.' &&
        c != '-' && c != '+')
      c = '_';
  return part;
}

/** All combinations of those of @p scenes with the values of one more entry. */
std::vector<SweptScene> combined(const std::vector<SweptScene> &scenes, const SweptEntry &entry)
{
  std::vector<SweptScene> result;
  for (const SweptScene &scene : scenes)
    for (const std::string &value : entry.values)
    {
      result.push_back(scene);
      result.back().overrides.emplace_back(entry.path, value);
      result.back().directory +=
          (scene.directory.empty() ? "" : ",") + name_of(entry.path) + "=" + part_of_name(value);
    }
  return result;
}
} // namespace

SweptEntry swept_entry(const std::string &text)
{
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    reject(text, "has no '='; write --sweep \"Section/Entry=a, b, c\" with quotes around it");
  SweptEntry entry{normal(text.substr(0, equals)), {}};
  if (name_of(entry.path).empty())
    reject(text, "names no entry; write Section/Entry=a, b, c");
  if (entry.path == "Dimension")
    reject(text, "plane scenes and those in space have other entries; write a scene of each");
  const std::string values = text.substr(equals + 1);
  entry.values = split(values, '|');
  if (entry.values.size() == 1)
    entry.values = split(values, ',');
  std::set<std::string> known;
  for (const std::string &value : entry.values)
    if (value.empty())
      reject(text, "has no value before or after a separator; give values a, b, c or a | b | c");
    else if (!known.insert(value).second)
      reject(text, "has the value " + printable(value) + " twice; remove one");
  return entry;
}

bool is_same_entry(const std::string &path, const std::string &other)
{
  return normal(path) == normal(other);
}

std::string SweptScene::words() const
{
  std::string result;
  for (const auto &[path, value] : overrides)
    result += (result.empty() ? "" : ", ") + path + " = " + value;
  return printable(result, 400);
}

std::vector<SweptScene> swept_scenes(const std::vector<SweptEntry> &entries)
{
  std::set<std::string> paths, names;
  std::vector<SweptScene> scenes(1);
  for (const SweptEntry &entry : entries)
  {
    if (!paths.insert(entry.path).second)
      reject(entry.path, "is swept twice; give all its values at once");
    scenes = combined(scenes, entry);
  }
  for (SweptScene &scene : scenes)
    names.insert(scene.directory);
  std::set<std::string> taken;
  for (SweptScene &scene : scenes)
    if (!taken.insert(scene.directory).second)
    {
      const std::string name = scene.directory;
      for (unsigned int k = 2; names.count(scene.directory) > 0; ++k)
        scene.directory = name + "_" + std::to_string(k);
      names.insert(scene.directory);
    }
  return scenes;
}
} // namespace hpvi
