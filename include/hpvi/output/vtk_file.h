// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_vtk_file_h
#define hpvi_vtk_file_h

#include <cstddef>
#include <string>
#include <vector>

namespace hpvi
{
/** Numbers that belong to the points or cells of a grid, a tuple each. */
struct VtkArray
{
  std::string name;
  std::string type; ///< as VTK calls it, Float32
  unsigned int n_components;
  std::string unit;  ///< empty: none
  std::string bytes; ///< as they stand in memory
};

/** Of numbers of the type float, double, std::int32_t or std::uint8_t. */
template <class Number>
VtkArray vtk_array(const std::string &name, const std::vector<Number> &numbers,
                   unsigned int n_components = 1, const std::string &unit = "");

/** Kinds of cells, as VTK numbers them. */
enum class VtkCell : unsigned char
{
  vertex = 1,
  poly_line = 4,
  quadrilateral = 9,
  hexahedron = 12,
  lagrange_quadrilateral = 70,
  lagrange_hexahedron = 72
};

/**
 * An unstructured grid as a file of VTK in XML, as its readers, ParaView's among them, have it: each array in one block that zlib
 * has compressed, in base64. Units stand where VTK has a place for them, the key UNITS_LABEL of an array, and in its attribute `units`.
 * Equal grids are equal files.
 */
class VtkGrid
{
public:
  /** @p number: of the step, field data TIME and CYCLE. */
  explicit VtkGrid(unsigned int number) : number(number)
  {
  }

  std::vector<double> points; ///< x, y, z of each
  std::vector<VtkArray> point_data, cell_data;

  void add_cell(VtkCell kind,
                const std::vector<int> &nodes); ///< @p nodes: of points, in VTK's order

  /** An own file, or the piece of one process. */
  std::string vtu() const;

  /** What names the files @p pieces, whose arrays are those of this one. */
  std::string pvtu(const std::vector<std::string> &pieces) const;

private:
  unsigned int number;
  std::vector<int> connectivity, offsets;
  std::vector<unsigned char> kinds;
};

/**
 * The nodes of VTK's line, quadrilateral or hexahedron of degree @p n with equidistant nodes, in VTK's order: corners, edges, faces,
 * inside. Each is a number of the same nodes when x runs fastest, then y, then z.
 */
template <int dim>
std::vector<int> lagrange_nodes(unsigned int n);
} // namespace hpvi

#endif
