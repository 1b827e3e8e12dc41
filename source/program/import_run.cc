// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/text.h>
#include <hpvi/output/output.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/program/import_run.h>
#include <hpvi/reader/deck/deck_scene.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace hpvi
{
namespace
{
namespace fs = std::filesystem;

const std::vector<std::string> files = {"mesh.msh", "import.txt", "scene.prm"};

std::string list_of(const DeckScene &deck)
{
  const auto part = [](const std::string &head, std::vector<std::string> lines)
  {
    std::string text = lines.empty() ? "" : head + ":\n";
    for (const std::string &line : lines)
      text += "  " + line + "\n";
    return text;
  };
  const std::string all = part("left out", deck.left_out) + part("said in other words", deck.meant);
  return all.empty() ? "nothing is left out\n" : all;
}

/** Files that are there have to be those of an import. */
void check_files(const fs::path &directory)
{
  std::error_code error;
  const bool is_own = content_of(directory / "scene.prm").find("by hpvi --import") < 200;
  for (const std::string &file : files)
    if (fs::exists(fs::symlink_status(directory / file, error)) && !is_own)
      throw InputError("output directory '" + printable(directory.string(), 400) + "': has " +
                       file + ", which no import has written; choose another one with --output");
  fs::create_directories(directory, error);
  if (!fs::is_directory(directory, error))
    throw InputError("output directory '" + printable(directory.string(), 400) +
                     "': cannot be made; choose another one with --output");
}
} // namespace

void import_deck_into(const std::string &file, const std::string &directory)
{
  const DeckScene deck = import_deck(file);
  const std::string list = list_of(deck);
  check_files(directory);
  const std::string texts[] = {deck.mesh, list, deck.scene};
  for (unsigned int k = 0; k < files.size(); ++k)
    if (const std::error_code error =
            write_whole(fs::path(directory) / files[k], texts[k], ".import"))
      throw OutputFailure("output directory '" + printable(directory, 400) + "': " + files[k] +
                          " cannot be written: " + error.message());
  std::cout << "scene in " << printable(directory, 400) << "/scene.prm, its mesh in mesh.msh, this "
            << "list in import.txt\n"
            << list << std::flush;
}
} // namespace hpvi
