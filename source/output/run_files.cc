// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/input_error.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/run_files.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS // as the parser still does; silences its note
#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <sstream>

namespace hpvi
{
namespace fs = std::filesystem;

std::optional<JsonTree> json_tree(const std::string &text)
{
  JsonTree tree;
  std::istringstream in(text);
  try
  {
    boost::property_tree::read_json(in, tree);
  }
  catch (const boost::property_tree::ptree_error &)
  {
    return std::nullopt;
  }
  return tree;
}

const JsonTree *member(const JsonTree &tree, const std::string &name)
{
  const auto found = tree.find(name);
  return found == tree.not_found() || found->second.data() == "null" ? nullptr : &found->second;
}

std::string words_of(const JsonTree &tree, const std::string &name)
{
  const JsonTree *const found = member(tree, name);
  return found ? found->data() : "";
}

std::optional<double> number_of(const JsonTree &tree, const std::string &name)
{
  return number(words_of(tree, name));
}

namespace
{
/** Of a larger solution the picture would take longer than it is worth. */
constexpr std::uintmax_t largest_field = 100000000; // bytes

/** The file of the solution, or its pieces in the order of the processes. */
std::vector<fs::path> field_files(const fs::path &home, const unsigned int step)
{
  std::error_code ignored;
  if (const fs::path whole = home / numbered("solution", step, ".vtu");
      fs::is_regular_file(whole, ignored))
    return {whole};
  std::vector<fs::path> pieces;
  for (unsigned int rank = 0;; ++rank)
  {
    const fs::path piece = home / numbered("solution", step, "." + std::to_string(rank) + ".vtu");
    if (!fs::is_regular_file(piece, ignored))
      return pieces;
    pieces.push_back(piece);
  }
}

void read_field(RunFiles &files, const fs::path &home, const unsigned int step,
                const unsigned int dim)
{
  const std::vector<fs::path> names = field_files(home, step);
  std::uintmax_t size = 0;
  std::error_code ignored;
  for (const fs::path &name : names)
    size += fs::file_size(name, ignored);
  const std::string all = numbered("solution", step, ".vtu");
  if (names.empty())
    files.no_field = "there is no " + all + "; set Output/VTU = true to have this picture";
  else if (size > largest_field)
    files.no_field = all + " is too large for this picture; ParaView shows it";
  if (!files.no_field.empty())
    return;
  try
  {
    for (const fs::path &name : names)
      add_vtu(files.field, content_of(name), dim);
  }
  catch (const InputError &error)
  {
    files.field = {};
    files.no_field = all + " cannot be drawn: " + error.what();
  }
}
} // namespace

RunFiles read_run(const std::string &directory, const std::string &summary, const unsigned int dim)
{
  const fs::path home(directory);
  RunFiles files;
  if (const std::optional<JsonTree> tree = json_tree(summary))
    files.summary = *tree;
  else
    throw InputError("its summary.json is no JSON; run the scene again");
  if (words_of(files.summary, "program").rfind("hpvi ", 0) != 0)
    throw InputError("its summary.json is not one of hpvi; name the directory of a run's results");
  files.steps = records(content_of(home / "convergence.csv"));
  const auto n_steps = static_cast<std::size_t>(number_of(files.summary, "steps").value_or(0));
  if (files.steps.size() < n_steps)
    throw InputError("its convergence.csv has fewer steps than summary.json; run the scene again");
  files.steps.resize(n_steps); // a run that is killed may have begun to write of the next one
  if (n_steps == 0)
  {
    files.no_field = "no step is finished";
    return files;
  }
  files.loads = records(content_of(home / "loading.csv"));
  files.history = records(content_of(home / "contact-history.csv"));
  files.cycles = records(content_of(home / "cycles.csv"));
  files.forces = records(content_of(home / "forces.csv"));
  const std::string last = words_of(files.steps.back(), "step");
  files.forces.erase(std::remove_if(files.forces.begin(), files.forces.end(),
                                    [&](const Record &row)
                                    { return words_of(row, "step") != last; }),
                     files.forces.end());
  files.contact = records(content_of(home / numbered("contact", n_steps, ".csv")));
  files.mesh = content_of(home / numbered("mesh", n_steps, ".svg"));
  read_field(files, home, n_steps, dim);
  return files;
}
} // namespace hpvi
