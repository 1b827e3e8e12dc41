// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coarse_mesh_h
#define hpvi_coarse_mesh_h

#include <hpvi/scene/curve.h>

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace hpvi
{
/** Quadrilaterals with named edges along the boundary, straight or curved: a body that is no regular grid. */
struct CoarseMesh
{
  static constexpr unsigned int inside = dealii::numbers::invalid_unsigned_int;

  struct Cell
  {
    std::array<unsigned int, 4> vertices; ///< counterclockwise
    unsigned int surface = 0;             ///< index into surfaces
    unsigned int body = 0;                ///< index into Geometry::bodies, where there are several
  };

  /** One on the boundary, counterclockwise around the body; or one between two cells, curved or with a name. */
  struct Edge
  {
    std::array<unsigned int, 2> vertices;
    unsigned int boundary = inside;  ///< index into boundaries
    CurvePiece curve = {};           ///< from the first vertex to the second; none: straight
    unsigned int interface = inside; ///< index into interfaces, of one inside that has a name
  };

  std::vector<dealii::Point<2>> vertices;
  std::vector<Cell> cells;
  std::vector<Edge> edges; ///< all on the boundary, then those inside that have a name or a curve
  std::vector<std::string> boundaries; ///< names by number; an empty one has no name, it is last
  std::vector<std::string> surfaces;   ///< likewise
  std::vector<std::string> interfaces; ///< of named curves inside, likewise
  std::string origin = {};  ///< of a drawing what it is, as in "a STEP file, lengths in mm"
  bool is_numbered = false; ///< are boundaries numbers of curves of a drawing?
  std::vector<std::string> remarks = {}; ///< for users, on what its reader has changed
};
/** Curves of a mesh by the vertices of their edges, from the first to the second in either direction. */
class EdgeCurves
{
public:
  explicit EdgeCurves(const CoarseMesh &mesh);

  CurvePiece operator()(unsigned int from, unsigned int to) const; ///< none: straight

  const CoarseMesh &mesh;

private:
  std::map<std::array<unsigned int, 2>, CurvePiece> curves;
};

/** A cell of it as the blend of its edges (W. J. Gordon, C. A. Hall, DOI 10.1007/BF01436298), curves taken exactly. */
class BlendedCell
{
public:
  BlendedCell(const EdgeCurves &curves, unsigned int cell);

  /** At (s, t) in [0,1]^2: s along the first edge, t along the second. */
  dealii::Point<2> point(double s, double t) const;

  /** det d(x, y)/d(s, t) [area]. */
  double determinant(double s, double t) const;

  /** At a corner between the curves that meet there [degrees]. */
  double angle(unsigned int corner) const;

private:
  dealii::Point<2> along(unsigned int edge, double s) const;          ///< counterclockwise
  dealii::Tensor<1, 2> derivative(unsigned int edge, double s) const; ///< likewise

  std::array<dealii::Point<2>, 4> corners; ///< counterclockwise
  std::array<CurvePiece, 4> curves;        ///< from each corner to the next
};

/** Cells that no finite element should have. */
struct CellFlaw
{
  dealii::Point<2> at;
  double angle = 0;       ///< at a corner [degrees], the largest of all
  bool is_folded = false; ///< det J <= 0 there
};

/** The worst of @p mesh: a folded one, else that with the largest angle. */
CellFlaw worst_cell(const CoarseMesh &mesh);
} // namespace hpvi

#endif
