// SPDX-License-Identifier: LGPL-2.1-or-later
// What libFuzzer calls with bytes: a scene, and from the word $MeshFormat on the mesh body.msh beside it. The reader of
// scenes takes it or throws InputError with one printable line; what it took, printed, is taken again and printed alike.
#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include <unistd.h>

namespace
{
using namespace hpvi;

[[noreturn]] void complain(const std::string &problem, const std::string &text)
{
  std::fprintf(stderr, "%s:\n%s\n", problem.c_str(), text.c_str());
  std::abort();
}

/** A directory of this process, as long as it lives. */
class Directory
{
public:
  Directory()
  {
    std::filesystem::create_directory(path);
  }

  ~Directory()
  {
    std::filesystem::remove_all(path);
  }

  std::string file(const std::string &name) const
  {
    return (path / name).string();
  }

private:
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("reader-" + std::to_string(getpid()));
};

const Directory &directory()
{
  static const Directory own;
  return own;
}

std::string write(const std::string &name, const std::string &bytes)
{
  std::ofstream(directory().file(name), std::ios::binary) << bytes;
  return directory().file(name);
}

/** Control characters of ASCII alone: a line may quote what the file says in any language. */
void check_line(const std::string &line)
{
  const bool is_printable = std::none_of(
      line.begin(), line.end(),
      [](const char c) { return (static_cast<unsigned char>(c) < ' ') || c == '\x7f'; });
  if (line.empty() || line.size() > 1100 || !is_printable)
    complain("no line", line);
}

template <int dim>
std::string printed(const std::string &file)
{
  return read_scene<dim>(file).parameters->print(false);
}

template <int dim>
void read_twice(const std::string &scene)
{
  const std::string once = printed<dim>(scene);
  std::string again;
  try
  {
    again = printed<dim>(write("printed.prm", once));
  }
  catch (const InputError &error)
  {
    complain("what is printed is refused", once + error.what());
  }
  if (again != once)
    complain("what is printed is read otherwise", once + again);
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *const data, const std::size_t size)
{
  const std::string bytes(reinterpret_cast<const char *>(data), size);
  const std::size_t mesh = bytes.find("$MeshFormat");
  const std::string scene = write("scene.prm", bytes.substr(0, mesh));
  write("body.msh", mesh == std::string::npos ? "" : bytes.substr(mesh));
  try
  {
    if (scene_dimension(ParameterFile(scene)) == 3)
      read_twice<3>(scene);
    else
      read_twice<2>(scene);
  }
  catch (const InputError &error)
  {
    check_line(error.what());
  }
  catch (const NumericalFailure &failure) // more memory than there is
  {
    check_line(failure.what());
  }
  return 0;
}
