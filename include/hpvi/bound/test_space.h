// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_test_space_h
#define hpvi_test_space_h

#include <hpvi/algebra/linear_solver.h>
#include <hpvi/bound/energy_rule.h>
#include <hpvi/bound/part_tables.h>
#include <hpvi/bound/test_motion.h>
#include <hpvi/plane/solution.h>
#include <hpvi/plane/supports.h>

#include <deal.II/lac/sparse_matrix.h>

#include <map>
#include <memory>
#include <vector>

namespace hpvi
{
/** A point at which cells are bisected so often. */
struct GradedPoint
{
  dealii::Point<2> x;
  unsigned int levels;
};

/**
 * Continuous displacements w on a mesh of their own, which descends from the coarse mesh of a scene: fine enough that least
 * energies are near, and bisected again and again at some points, so that w can fall there along a short edge. It does not know
 * the mesh of any u_N, and serves all steps. Of a body with curves, which each step meshes anew, it has the mesh of that step and serves it alone; so that rotations are in it, curved cells have
 * the degree of their edges.
 */
class TestSpace
{
public:
  /**
   * Bisected at @p points. @p solution lends its scene, its tables and the rules of its loads; @p tables are those of
   * spaces before this one.
   */
  TestSpace(const Solution<2> &solution, const std::vector<GradedPoint> &points,
            std::shared_ptr<PartTables> tables);

  /** The lengths of the edges at which the falls of @p motion end, each the last one of its boundary. */
  std::vector<double> lengths(const TestMotion &motion) const;

  /** Of least energy under the conditions of @p motion. */
  dealii::Vector<double> solve(const TestMotion &motion);

  /** |w|_a of the body without springs; also of a w that differs from a rigid motion by round-off alone. */
  double norm(const dealii::Vector<double> &w) const;

  /**
   * `a(u_N, v_i) - L(v_i)` for every displacement unknown, a without springs and L without what plates bear: w
   * times this is F_w. Beside it the absolute terms of each sum.
   */
  struct Residual
  {
    dealii::Vector<double> sum, absolute;
    double rule = 0; ///< what rules of Gauss miss of the sum with w, over |u_N|_a |w|_a
  };
  Residual residual(const Solution<2> &solution) const;

  /** What rules on this mesh miss of initial strains: times |w|_a, of L(w). */
  double strain_error() const
  {
    return missed_strain;
  }

private:
  /** Which combinations of unknowns are held, and the matrix of the others. */
  struct System
  {
    dealii::AffineConstraints<double> homogeneous;
    std::vector<unsigned int> place; ///< by displacement unknown: its row; held ones have none
    std::unique_ptr<const LinearSolver> factor;
  };

  /** A node on a boundary; one in a corner stands once, with those that meet there. */
  struct Node
  {
    std::array<dealii::types::global_dof_index, 2> dofs;
    dealii::Point<2> x;
    std::vector<unsigned int> boundaries;
  };

  /** On the boundary, from vertex to vertex. */
  struct Edge
  {
    unsigned int boundary;
    std::array<dealii::Point<2>, 2> ends;
  };

  void find_nodes();
  void assemble();
  double square_by_strains(const dealii::Vector<double> &w) const;
  std::vector<SupportedNode<2>> held_nodes(const TestMotion &motion) const;
  dealii::AffineConstraints<double> constraints(const TestMotion &motion) const;
  const System &system(const TestMotion &motion);
  static void factorise(const dealii::SparseMatrix<double> &A, System &of);

  const Scene<2> &scene;
  const std::shared_ptr<const Spaces<2>> lender;
  const std::shared_ptr<const dealii::Triangulation<2>> mesh;
  const Degrees degrees;
  const DisplacementSpace<2> space; ///< without supports
  std::vector<Node> nodes;          ///< on the boundary
  std::vector<Edge> edges;
  std::vector<std::shared_ptr<const dealii::FullMatrix<double>>> stiffness; ///< by cell
  dealii::SparsityPattern pattern;
  dealii::SparseMatrix<double> K;
  bool is_exact = true;           ///< are all cells of K parallelograms?
  dealii::Vector<double> applied; ///< L(v_i)
  const double missed_strain;
  std::map<unsigned int, std::unique_ptr<System>> systems; ///< by body
  mutable std::vector<EnergyRule> rules;                   ///< of norm(), by cell
  const std::shared_ptr<PartTables> tables_in_parts;
};
} // namespace hpvi

#endif
