// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_vertex_solver_h
#define hpvi_vertex_solver_h

#include <hpvi/space/multigrid_level.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <map>
#include <set>

namespace hpvi
{
/**
 * Corrects on a coarsest mesh of many cells by displacements of degree one on the same cells, of which algebraic multigrid
 * (ML) has an assembled matrix: p = 1 below p. With P, which interpolates and takes contact dofs of it, that matrix is
 *
 *     P'AP + sum_k w_k S_k w_k',    w_k the mean int psi_k u / int psi_k at the corners of the face,
 *
 * S being H where a contact dof slips, and A's own block where one is held: what the correction moves there is set to zero
 * on the mesh, which costs just that energy. So no corner is held, whatever the normals of its faces are. Where another body lies
 * opposite w_k has the corners there, too, of any process, with what a moment of the jump takes of them.
 */
class VertexSolver
{
public:
  using Vector = MultigridLevel<float>::Vector;

  /** @p level must outlive it, and has no hanging nodes. Collective. */
  explicit VertexSolver(const MultigridLevel<float> &level);

  /** With the states of the level; set up anew where more than a fiftieth of them has changed. Collective. */
  void linearise();

  /** x += P M P'r with one cycle M of ML; r is lost. Collective. */
  void correct(Vector &x, Vector &r) const;

private:
  using Block = MultigridLevel<float>::Block;
  using VertexVector = dealii::LinearAlgebra::distributed::Vector<double>;

  struct Cell ///< one of this process
  {
    std::array<unsigned int, 8> vertices; ///< local elements of their first component
    unsigned int end;                     ///< of its #nodes
  };
  struct Node ///< which takes its value from this cell
  {
    unsigned int local;   ///< element of its first component
    unsigned short shape; ///< in #weights
  };
  struct ContactFace
  {
    std::vector<dealii::types::global_dof_index> vertices; ///< their first components
    std::vector<std::vector<double>> means;                ///< w_k
    const ContactDofFace<3> *face;
  };

  void number();
  void copy_constraint(const PrimalSpace<3>::Cell &cell,
                       const std::vector<dealii::types::global_dof_index> &of_mesh,
                       unsigned int corner, unsigned int component,
                       const std::vector<dealii::types::global_dof_index> &own);
  void assemble();
  void find_contact();
  void find_opposite();
  void add_opposite(ContactFace &face) const;
  void add_contact();
  void add(const ContactFace &face, unsigned int k, const std::vector<unsigned int> &components,
           std::size_t contact_dof);
  Block stiffness(std::size_t k) const;

  const MultigridLevel<float> &level;
  const DegreeTables<3> linear; ///< of degree one
  const BoxTables<3> &tables;   ///< those
  dealii::DoFHandler<3> dof_handler;
  dealii::AffineConstraints<double>
      constraints; ///< as of the mesh, with zeros for what is prescribed; plates have masters of their own
  dealii::IndexSet relevant; ///< with those masters
  std::vector<Cell> cells;
  std::vector<Node> nodes;
  std::vector<std::array<double, 8>>
      weights; ///< of corners, by shape function of one degree of the mesh after the other
  std::vector<unsigned int> first_weights; ///< by degree
  std::vector<ContactFace> faces;
  /** Corners that a node of a master takes its value from, first components with weights, by that of the node. */
  std::map<dealii::types::global_dof_index,
           std::vector<std::pair<dealii::types::global_dof_index, double>>>
      opposite;
  std::set<dealii::types::global_dof_index> held; ///< constrained ones of #faces, of any process
  struct Constrained ///< a local element, and those of the same corner or plate that it depends on
  {
    unsigned int element;
    std::vector<std::pair<unsigned int, double>> others;
  };
  std::vector<Constrained> constrained; ///< of this process
  dealii::TrilinosWrappers::SparseMatrix A;
  std::vector<Block> inserted; ///< S in A, of each contact dof
  std::vector<bool> was_held;  ///< when ML was set up
  std::vector<double> motions;
  std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> amg;
  mutable VertexVector residual, correction; ///< with all corners of this process's cells
  mutable Vector change;
};
} // namespace hpvi

#endif
