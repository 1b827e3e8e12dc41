// SPDX-License-Identifier: LGPL-2.1-or-later
// What is left of fifty drawings is a body, or one line.
#include "drawing_files.h"

#include <random>

namespace
{
using namespace drawings;

/** Of what is left of a file: one line, or a body. */
TEST(DamagedDrawings, AreReadOrRefused)
{
  const Folder folder;
  folder.draw(bracket + saved({"a.step", "a.brep"}) + "Mesh.Binary = 1; Mesh 2;\n" +
              saved({"a.msh", "a.unv", "a.vtk"}));
  std::mt19937 random(1);
  const std::vector<std::string> files = {"a.step", "a.brep", "a.msh", "a.unv", "a.vtk"};
  for (unsigned int n = 0; n < 50; ++n)
  {
    const std::string &file = files[n % files.size()];
    std::string text = folder.text(file);
    const std::size_t at = random() % text.size();
    if (n % 3 == 0)
      text.resize(at);
    else if (n % 3 == 1)
      for (std::size_t k = 0; k < 5; ++k)
        text[random() % text.size()] = char(random() % 256);
    else
      text.erase(at, random() % 200);
    const std::string damaged = folder.write("damaged" + fs::path(file).extension().string(), text);
    const std::string message = failure_of<InputError>(
        [&]() {
          read_drawing(damaged, 2, {}, {0.25, 2000});
        });
    EXPECT_EQ(message.find('\n'), std::string::npos) << file << n;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 11);
}
} // namespace
