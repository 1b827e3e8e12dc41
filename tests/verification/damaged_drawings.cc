// SPDX-License-Identifier: LGPL-2.1-or-later
// What is left of fifty drawings and decks, or as many as HPVI_DAMAGED says, is a body, or one line.
#include "drawing_files.h"

#include <hpvi/reader/deck/deck_scene.h>

#include <sys/wait.h>

#include <cstdlib>
#include <random>

namespace
{
using namespace drawings;

const std::string deck = R"(*HEADING
two cells, pressed and pulled
*NODE, NSET=ALL
1, 0., 0.
2, 1., 0.
3, 2., 0.
4, 0., 1.
5, 1., 1.
6, 2., 1.
*ELEMENT, TYPE=CPS4, ELSET=PLATE
1, 1, 2, 5, 4
2, 2, 3, 6, 5
*NSET, NSET=LEFT, GENERATE
1, 4, 3
*ELSET, ELSET=_RIGHT_S2
2,
*SURFACE, NAME=RIGHT, TYPE=ELEMENT
_RIGHT_S2, S2
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*SOLID SECTION, ELSET=PLATE, MATERIAL=STEEL
1.
*AMPLITUDE, NAME=RISE
0., 0., 1., 1.
*BOUNDARY
LEFT, 1, 2
*STEP
*STATIC
0.1, 1.
*DSLOAD, AMPLITUDE=RISE
RIGHT, P, -1.
*CLOAD
6, 2, 0.5
3, 2, 0.5
*END STEP
)";

/** Of what is left of a file: one line, or a body. */
TEST(DamagedDrawings, AreReadOrRefused)
{
  const Folder folder;
  folder.draw(bracket + saved({"a.step", "a.brep"}) + "Mesh.Binary = 1; Mesh 2;\n" +
              saved({"a.msh", "a.unv", "a.vtk"}));
  std::mt19937 random(1);
  folder.write("a.inp", deck);
  const std::vector<std::string> files = {"a.step", "a.brep", "a.msh", "a.unv", "a.vtk", "a.inp"};
  const char *const number = std::getenv("HPVI_DAMAGED");
  for (int n = 0; n < (number == nullptr ? 50 : std::atoi(number)); ++n)
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
        [&]()
        {
          read_drawing(damaged, 2, {}, {0.25, 2000});
          if (file == "a.inp")
            import_deck(damaged);
        });
    EXPECT_EQ(message.find('\n'), std::string::npos) << file << n;
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1); // no process is left, nor a file:
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 13);
}
} // namespace
