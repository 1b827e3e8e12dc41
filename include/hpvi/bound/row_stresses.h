// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_row_stresses_h
#define hpvi_row_stresses_h

#include <hpvi/bound/boundary_tractions.h>
#include <hpvi/bound/cut_element.h>
#include <hpvi/bound/patch_problem.h>
#include <hpvi/bound/row_element.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** Stresses by rows near sigma(u_N) and near its products with hat functions, on cells of any shape. */
class RowStresses
{
public:
  /**
   * @p cache must outlive this object, and its elements must stay as long as this is asked for stresses. @p joints: cells are cut where edges
   * of the other body end.
   */
  RowStresses(const Solution<2> &solution, const VertexPatches &patches,
              const BoundaryTractions &boundary, const JointTractions *joints,
              EquilibrationCache &cache);

  /** Data of `psi sigma` with divergence `sigma grad psi - psi F`. */
  PatchCell patch_cell(unsigned int cell, unsigned int hat) const;

  struct Distance
  {
    double square;       ///< |sym s - sigma(u_N)|^2 in energy
    double antisymmetry; ///< C_K |s_12 - s_21|, part of the oscillation
  };

  /** For tractions on the faces in the order of TractionEnergy. */
  Distance distance(unsigned int cell, const std::vector<double> &tractions) const;

  /** s, by rows, at reference coordinates in [0,1]. */
  dealii::Tensor<2, 2> value(unsigned int cell, const std::vector<double> &tractions,
                             const dealii::Point<2> &reference) const;

  double missed_force(unsigned int cell) const; ///< |F - Pi F| on the cell

  /** |tau - Pi tau| on a face on which tau has pieces, zero on others; of a cell on the axis over the root of 2 pi x. */
  double missed_traction(unsigned int cell, unsigned int face) const;

  /** What contact exerts on a part of such a face, towards growing reference coordinates: by x and y, from begin to end. */
  struct JointPart
  {
    double begin, end;
    std::array<std::vector<double>, 2> components;
  };
  std::vector<JointPart> joint_parts(unsigned int cell, unsigned int face) const;

private:
  class BeyondSpace;
  /** All of a cell, or a box of it between cuts. */
  struct Part
  {
    unsigned int cell;
    dealii::BoundingBox<2> box; ///< in reference coordinates of the cell
    CellMap<2> map;
    const RowElement *element;
    double h;                       ///< of the element [length]
    std::vector<double> divergence; ///< (k+1)^2 of each row, of -F
    double missed_force = 0;
    std::vector<double> tractions = {}; ///< that the slave exerts, in the order of TractionEnergy
  };

  struct Cell
  {
    std::vector<Part> parts;
    std::optional<Part> whole;          ///< of a curved cell that is cut
    unsigned int n_xi;                  ///< of them along xi
    const CutElement *joined = nullptr; ///< of several parts
    CutElement::Data data;              ///< for that, without hats
    double h;
    std::vector<double> gradients, defects; ///< by hat
  };

  /** Of the four bilinear psi of a cell in one part. */
  struct OfVertices
  {
    std::array<std::vector<double>, 4> divergence; ///< (k+1)^2 of each row
    std::array<std::vector<double>, 4> tractions;  ///< that the slave exerts
    std::array<double, 4> moment{}; ///< that Lemma 4 of doc/bound.md adds [stress length^2]
    std::array<std::vector<double>, 4> gradients;
    std::array<RowElement::Conditions, 4> defects;
  };

  /** sigma in the plane, and around the axis of a body of revolution. */
  struct PointStress
  {
    dealii::SymmetricTensor<2, 2> in_plane;
    double around = 0;
  };

  /** psi and its slopes by reference coordinates. */
  struct Hat
  {
    double value;
    dealii::Tensor<1, 2> slope;
  };

  void cut(unsigned int cell);
  static bool is_whole(const Part &part);
  bool has_moment(const Part &part) const;
  bool is_on(const Part &part, unsigned int face) const;
  const JointEdge *cut_edge(unsigned int cell, unsigned int face) const;
  EquilibrationCache::Signature key(const Part &part) const;
  RowShape shape_of(const Part &part) const;
  Hat hat(const Part &part, unsigned int v, const dealii::Point<2> &at) const;
  ShapeTable<2> table_in(const Part &part, const dealii::Quadrature<2> &rule) const;
  std::vector<PointStress> sigma(const Part &part, unsigned int n_gauss) const;
  std::vector<PointStress> sigma_at(const Part &part, const ShapeTable<2> &table) const;
  double around(const Part &part, const PointStress &stress, const dealii::Point<2> &at,
                const Hat &psi) const;
  unsigned int data_points(const Part &part) const;
  void add_stress(const Part &part, OfVertices &result) const;
  void add_loads(Part &part, OfVertices &result);
  template <class Load>
  void add_load(const Part &part, const LoadRule<2> &rule, const Load &load,
                const BeyondSpace *beyond, std::vector<double> *of_force, OfVertices &result) const;
  void add_work_beyond(const Part &part, unsigned int face, const BeyondSpace &beyond,
                       OfVertices &result) const;
  void add_joints(const Part &part, OfVertices &result) const;
  OfVertices data_of(Part &part);
  void balance_parts(Cell &cell, std::vector<OfVertices> &data);
  void set_gradients(const Part &part, OfVertices &data) const;
  static TractionEnergy energy_of(const Cell &cell);
  void set_cell(unsigned int cell);
  void join_parts();
  std::vector<PointStress> stress_at_points(const Part &part, const RowTable &table) const;
  void subtract_initial(const Part &part, const std::vector<dealii::Point<2>> &points,
                        std::vector<PointStress> &stress) const;
  RowValues::Stress difference(const Part &part, const RowValues &values,
                               const RowFields &fields) const;
  std::array<double, 2> squares_at_corners(const Part &part, const RowFields &fields) const;
  std::array<double, 2> squares(const Part &part, const std::vector<double> &tractions) const;
  void set_missed_force(Part &part);
  std::vector<std::vector<double>> tractions_of_parts(unsigned int cell,
                                                      const std::vector<double> &tractions) const;
  RowValues::Stress residual(const Part &part, const std::vector<double> &tractions,
                             RowFields &fields) const;

  const Solution<2> &solution;
  const VertexPatches &patches;
  const BoundaryTractions &boundary;
  const JointTractions *const joints;
  EquilibrationCache &cache;
  std::vector<Cell> cells;
};

/** Where an initial strain, or in a body of revolution a body force, is cut inside a cell, in words; else empty. These stresses know none of its pieces. */
std::string cut_inside_cell(const Solution<2> &solution);
} // namespace hpvi

#endif
