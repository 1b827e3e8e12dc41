// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_drawing_kind_h
#define hpvi_drawing_kind_h

#include <string>

namespace hpvi
{
/** What a file is, by its content: its name says nothing. Gmsh goes by the name, and runs what it does not know as a script. */
struct DrawingKind
{
  std::string name;  ///< step, iges, brep, geo, msh, unv, bdf, vtk or inp; empty: unknown
  std::string words; ///< for messages
  double unit = 0;   ///< of a drawing that has one [mm]
  std::string unit_name = {};

  std::string occ_unit() const; ///< its unit in the words of OpenCASCADE
  std::string origin(const std::string &wanted_unit) const; ///< as in "a STEP file, lengths in mm"
  bool is_cad() const;
  bool has_cells() const; ///< is it a mesh?
};

DrawingKind kind_of_drawing(const std::string &path);

/** In millimetres, of mm, cm, m, um, inch and ft; 0: unknown. */
double millimetres(const std::string &unit);

/** Those that it knows, for an entry. */
extern const char *const length_units;
} // namespace hpvi

#endif
