// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_gmsh_file_h
#define hpvi_gmsh_file_h

#include <hpvi/scene/curve.h>

#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** Elements by Gmsh's number of their type. */
struct ElementKind
{
  const char *name; ///< for messages, in the plural; null: unknown
  unsigned int dim;
  unsigned int n_nodes; ///< 0 where elements of the kind are not read
  unsigned int n_corners;
};

ElementKind element_kind(std::int64_t type);

/** What stands in a mesh file, or in what a drawing was meshed to: nodes, elements, names of physical groups. */
struct GmshFile
{
  using Group = std::pair<unsigned int, std::int64_t>; ///< dimension, tag

  struct Node
  {
    std::int64_t tag;
    dealii::Point<3> at;
  };

  struct Element
  {
    std::int64_t type;
    std::int64_t group = 0;  ///< tag of its physical group; 0: none
    std::int64_t entity = 0; ///< tag of the curve, surface or volume of the drawing; 0: unknown
    std::size_t number = 0;  ///< that the file gives it; 0: none
    /** Indices into nodes: corners, middles of edges, in space of faces, the centre. */
    std::array<unsigned int, 27> nodes = {};
  };

  std::vector<Node> nodes;
  std::vector<Element> elements; ///< but for points
  std::map<Group, std::string> names;
  std::map<std::array<unsigned int, 2>, CurvePiece> curves; ///< between nodes, the smaller first
  bool is_drawing = false;                                  ///< have we meshed it?
  bool is_numbered = false; ///< are its curves called by their numbers, as they are in no groups?
  std::string origin = {};  ///< what the file is, for users
  std::vector<std::string> remarks = {}; ///< on what became of it

  void set_curve(unsigned int from, unsigned int to, const CurvePiece &piece);
  CurvePiece curve(unsigned int from,
                   unsigned int to) const; ///< none: straight, or by nodes of elements

  /** Of elements that are there once for each of several groups the one of the smallest group stays, of equal ones the first. */
  void take_smallest_groups();

  /** In quotes, with the word curve or surface: of a group without a name its tag. */
  std::string words(const Group &group) const;
};
} // namespace hpvi

#endif
