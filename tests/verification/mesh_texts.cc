// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_texts.h"
#include "../texts.h"

#include <hpvi/base/input_error.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

using namespace hpvi;

namespace
{
const std::string names = R"($PhysicalNames
4
1 3 "bottom"
1 4 "joint"
2 1 "soft part"
2 2 "stiff"
$EndPhysicalNames
)";

const std::string entities = R"($Entities
0 4 2 0
1 0 0 0 1 0 0 1 3 2 1 -2
2 1 0 0 2 0 0 1 3 2 2 -3
3 2 0 0 2 1 0 1 7 2 3 -6
4 1 0 0 1 1 0 1 -4 2 2 -5
1 0 0 0 1 1 0 1 1 0
2 1 0 0 2 1 0 1 2 0
$EndEntities
)";

const std::string tagged_nodes = R"(1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 1.7 0.2 0
8 1.7 0.8 0
9 5 0 0
10 6 0 0
11 6 1 0
12 5 1 0
13 3 1 0
14 3 2 0
15 2 2 0
16 1 0.5 0
17 0.9 1 0
$EndNodes
)";
} // namespace

const std::string two_squares_22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\n" + names +
                                   "$Nodes\n17\n" + tagged_nodes + R"($Elements
6
1 1 2 3 1 1 2
2 1 2 3 2 2 3
3 1 2 4 4 2 5
4 1 2 7 3 3 6
5 3 2 1 1 1 2 5 4
6 3 2 2 2 2 5 6 3
$EndElements
)";

const std::string two_squares_40 = "$MeshFormat\n4 0 8\n$EndMeshFormat\n" + names + entities +
                                   "$Nodes\n1 17\n1 2 0 17\n" + tagged_nodes + R"($Elements
6 6
1 1 1 1
1 1 2
2 1 1 1
2 2 3
4 1 1 1
3 2 5
3 1 1 1
4 3 6
1 2 3 1
5 1 2 5 4
2 2 3 1
6 2 5 6 3
$EndElements
)";

const std::string two_squares_41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names + entities + R"($Nodes
1 17 1 17
2 1 0 17
1
2
3
4
5
6
7
8
9
10
11
12
13
14
15
16
17
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
1.7 0.2 0
1.7 0.8 0
5 0 0
6 0 0
6 1 0
5 1 0
3 1 0
3 2 0
2 2 0
1 0.5 0
0.9 1 0
$EndNodes
$Elements
6 6 1 6
1 1 1 1
1 1 2
1 2 1 1
2 2 3
1 4 1 1
3 2 5
1 3 1 1
4 3 6
2 1 3 1
5 1 2 5 4
2 2 3 1
6 2 5 6 3
$EndElements
)";

const std::string curved_cell_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
1 1 "bottom"
$EndPhysicalNames
$Nodes
9
1 0 0 0
2 2 0 0
3 2 1 0
4 0 1 0
5 1 -0.25 0
6 2 0.5 0
7 1 1 0
8 0 0.5 0
9 1 0.4 0
$EndNodes
$Elements
2
1 8 2 1 1 1 2 5
2 10 2 1 1 1 2 3 4 5 6 7 8 9
$EndElements
)";

const std::string curved_cell_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
1 1 "bottom"
$EndPhysicalNames
$Entities
0 1 1 0
1 0 0 0 2 0 0 1 1 2 1 -2
1 0 0 0 2 1 0 1 1 0
$EndEntities
$Nodes
2 8 1 8
1 1 1 1
5
1 -0.25 0 0.5
2 1 0 7
1
2
3
4
6
7
8
0 0 0
2 0 0
2 1 0
0 1 0
2 0.5 0
1 1 0
0 0.5 0
$EndNodes
$Elements
2 2 1 2
1 1 8 1
1 1 2 5
2 1 16 1
2 1 2 3 4 5 6 7 8
$EndElements
)";

std::string replaced(const std::string &text, const std::string &from, const std::string &to)
{
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from;
  return at == std::string::npos ? text : text.substr(0, at) + to + text.substr(at + from.size());
}

std::string replaced_all(std::string text, const std::string &from, const std::string &to)
{
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

CoarseMesh read_text(const std::string &text)
{
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("hpvi-" + std::to_string(getpid()) + ".msh");
  std::ofstream(path, std::ios::binary) << text;
  struct Remover
  {
    const std::filesystem::path &path;
    ~Remover()
    {
      std::filesystem::remove(path);
    }
  } remover{path};
  return read_mesh_file(path);
}

std::string message_of(const std::string &text)
{
  return failure_of<InputError>([&] { read_text(text); });
}
