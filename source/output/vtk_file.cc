// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>
#include <hpvi/base/formatting.h>
#include <hpvi/output/vtk_file.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
template <class Number>
const char *vtk_type()
{
  if constexpr (std::is_same_v<Number, float>)
    return "Float32";
  else if constexpr (std::is_same_v<Number, double>)
    return "Float64";
  else if constexpr (std::is_same_v<Number, int>)
    return "Int32";
  else
    return "UInt8";
}

/** One block that zlib has compressed, as fast as it can, behind its sizes; no numbers are no block, as of a process without cells. */
void add_encoded(const std::string &bytes, std::string &text)
{
  if (bytes.empty())
  {
    text += base64(std::string(3 * sizeof(std::uint32_t), '\0'));
    return;
  }
  uLongf size = compressBound(bytes.size());
  std::string block(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef *>(block.data()), &size,
                reinterpret_cast<const Bytef *>(bytes.data()), bytes.size(), Z_BEST_SPEED);
  AssertThrow(status == Z_OK, ExcInternalError());
  block.resize(size);
  const std::array<std::uint32_t, 4> head{
      {1, std::uint32_t(bytes.size()), std::uint32_t(bytes.size()), std::uint32_t(size)}};
  text += base64({reinterpret_cast<const char *>(head.data()), sizeof head}) + base64(block);
}

std::string attributes(const VtkArray &array)
{
  return "type=\"" + array.type + "\"" +
         (array.name.empty() ? "" : " Name=\"" + xml_text(array.name) + "\"") +
         (array.n_components == 1
              ? ""
              : " NumberOfComponents=\"" + std::to_string(array.n_components) + "\"") +
         (array.unit.empty() ? "" : " units=\"" + xml_text(array.unit) + "\"");
}

void add_array(const VtkArray &array, std::string &text)
{
  text += "<DataArray " + attributes(array) + " format=\"binary\">\n";
  add_encoded(array.bytes, text);
  if (!array.unit.empty())
    text += "\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" +
            xml_text(array.unit) + "</InformationKey>";
  text += "\n</DataArray>\n";
}

void add_section(const std::string &name, const std::vector<VtkArray> &arrays, std::string &text)
{
  text += "<" + name + ">\n";
  for (const VtkArray &array : arrays)
    add_array(array, text);
  text += "</" + name + ">\n";
}

/** The nodes of hexahedra are numbered as VTK 9 does from this version of its format on; all else is older. */
std::string head(const std::string &type, const bool has_hexahedra)
{
  const std::string order =
#ifdef DEAL_II_WORDS_BIGENDIAN
      "BigEndian";
#else
      "LittleEndian";
#endif
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"" +
         (has_hexahedra ? "2.1" : "0.1") + "\" byte_order=\"" + order +
         "\" header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n";
}
} // namespace

template <class Number>
VtkArray vtk_array(const std::string &name, const std::vector<Number> &numbers,
                   const unsigned int n_components, const std::string &unit)
{
  const char *const begin = reinterpret_cast<const char *>(numbers.data());
  return {name,
          vtk_type<Number>(),
          n_components,
          unit,
          {begin, begin + numbers.size() * sizeof(Number)}};
}

template VtkArray vtk_array(const std::string &, const std::vector<float> &, unsigned int,
                            const std::string &);
template VtkArray vtk_array(const std::string &, const std::vector<double> &, unsigned int,
                            const std::string &);
template VtkArray vtk_array(const std::string &, const std::vector<int> &, unsigned int,
                            const std::string &);
template VtkArray vtk_array(const std::string &, const std::vector<unsigned char> &, unsigned int,
                            const std::string &);

void VtkGrid::add_cell(const VtkCell kind, const std::vector<int> &nodes)
{
  kinds.push_back(static_cast<unsigned char>(kind));
  connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
  offsets.push_back(connectivity.size());
}

std::string VtkGrid::vtu() const
{
  const bool has_hexahedra =
      std::count(kinds.begin(), kinds.end(),
                 static_cast<unsigned char>(VtkCell::lagrange_hexahedron)) > 0;
  const std::string step = std::to_string(number);
  std::string text = head("UnstructuredGrid", has_hexahedra) + "<UnstructuredGrid>\n<FieldData>\n";
  for (const std::string name : {"CYCLE", "TIME"})
    text += "<DataArray type=\"Float32\" Name=\"" + name +
            "\" NumberOfTuples=\"1\" format=\"ascii\">" + step + "</DataArray>\n";
  text += "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(points.size() / 3) +
          "\" NumberOfCells=\"" + std::to_string(kinds.size()) + "\">\n";
  add_section("Points", {vtk_array("", points, 3)}, text);
  add_section("Cells",
              {vtk_array("connectivity", connectivity), vtk_array("offsets", offsets),
               vtk_array("types", kinds)},
              text);
  add_section("PointData", point_data, text);
  add_section("CellData", cell_data, text);
  return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string VtkGrid::pvtu(const std::vector<std::string> &pieces) const
{
  std::string text = head("PUnstructuredGrid", false) + "<PUnstructuredGrid GhostLevel=\"0\">\n";
  const auto declare = [&](const std::string &name, const std::vector<VtkArray> &arrays)
  {
    text += "<" + name + ">\n";
    for (const VtkArray &array : arrays)
      text += "<PDataArray " + attributes(array) + "/>\n";
    text += "</" + name + ">\n";
  };
  declare("PPoints", {vtk_array("", std::vector<double>(), 3)});
  declare("PPointData", point_data);
  declare("PCellData", cell_data);
  for (const std::string &piece : pieces)
    text += "<Piece Source=\"" + xml_text(piece) + "\"/>\n";
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

// ---------------------------------------------------------------- nodes

namespace
{
/** Of a node, counted in each direction. */
using Index = std::array<unsigned int, 3>;

template <int dim>
int number_of(const Index &index, const unsigned int n)
{
  int result = 0;
  for (unsigned int d = dim; d-- > 0;)
    result = result * int(n + 1) + int(index[d]);
  return result;
}

/** Corners of a quadrilateral in VTK's order, as 0 or 1 in each direction, and direction and place of its edges. */
constexpr std::pair<unsigned int, unsigned int> corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                                edges[] = {{0, 0}, {1, 1}, {0, 1}, {1, 0}};
} // namespace

template <int dim>
std::vector<int> lagrange_nodes(const unsigned int n)
{
  std::vector<int> nodes;
  const unsigned int top = dim == 3 ? 2 : 1; // a quadrilateral, or two of them
  for (unsigned int k = 0; k < top; ++k)
    for (const auto &[i, j] : corners)
      nodes.push_back(number_of<dim>({{i * n, j * n, k * n}}, n));
  for (unsigned int k = 0; k < top; ++k)
    for (const auto &[direction, place] : edges)
      for (unsigned int s = 1; s < n; ++s)
        nodes.push_back(number_of<dim>(
            direction == 0 ? Index{{s, place * n, k * n}} : Index{{place * n, s, k * n}}, n));
  if (dim == 2)
  {
    for (unsigned int j = 1; j < n; ++j)
      for (unsigned int i = 1; i < n; ++i)
        nodes.push_back(number_of<dim>({{i, j, 0}}, n));
    return nodes;
  }
  for (const auto &[i, j] : corners)
    for (unsigned int s = 1; s < n; ++s)
      nodes.push_back(number_of<dim>({{i * n, j * n, s}}, n));
  for (unsigned int d = 0; d < 3; ++d)
    for (const unsigned int place : {0U, n})
      for (unsigned int t = 1; t < n; ++t)
        for (unsigned int s = 1; s < n; ++s)
        {
          Index index{};
          index[d] = place;
          index[d == 0 ? 1 : 0] = s;
          index[d == 2 ? 1 : 2] = t;
          nodes.push_back(number_of<dim>(index, n));
        }
  for (unsigned int k = 1; k < n; ++k)
    for (unsigned int j = 1; j < n; ++j)
      for (unsigned int i = 1; i < n; ++i)
        nodes.push_back(number_of<dim>({{i, j, k}}, n));
  return nodes;
}

template std::vector<int> lagrange_nodes<2>(unsigned int);
template std::vector<int> lagrange_nodes<3>(unsigned int);
} // namespace hpvi
