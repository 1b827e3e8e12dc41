// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_opposite_faces_h
#define hpvi_opposite_faces_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/common_part.h>
#include <hpvi/scene/curved_face.h>
#include <hpvi/space/contact_dof.h>
#include <hpvi/space/degree_tables.h>
#include <hpvi/space/far_values.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <memory>
#include <vector>

namespace hpvi
{
/** A node of a master, of any process. */
struct OppositeNode
{
  using Dof = dealii::types::global_dof_index;

  dealii::Point<3> x;
  Dof first; ///< of its first component; the others follow
  /** By component: the unconstrained unknowns whose sum, with these weights, is the value there. */
  std::array<std::vector<std::pair<Dof, double>>, 3> entries;

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &x &first;
    for (auto &component : entries)
      archive &component;
  }
};

/** A face of a master, of any process. */
struct MasterFace
{
  std::vector<dealii::Point<3>> corners; ///< of its cell, lexicographic
  unsigned int face = 0;
  dealii::types::boundary_id boundary = 0;
  dealii::types::material_id material = 0;
  unsigned int process = 0, cell = 0; ///< its owner, and the cell by active_cell_index() there
  unsigned int tables = 0;            ///< of its cell, by DegreeTables::number_of()
  std::vector<OppositeNode> nodes;    ///< those on the rim first
  std::vector<dealii::Point<3>>
      curve; ///< of a pair that is curved, as those of CurvedFace; none: it is plane

  CellMap<3> map() const; ///< of a plane one

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &corners &face &boundary &material &process &cell &tables &nodes &curve;
  }
};

/**
 * Of pairs of bodies in space: what of the master lies opposite to faces of the slave, along the normal of the slave. The
 * moments of the jump on a face of the slave are
 *
 *     j = M u_inner + W u_rim - R u_opposite,    R_kd = int psi_k phi_d / int psi_k,
 *
 * phi_d the shape functions of the master at the points opposite. Where both faces are parallelograms these integrals are exact: a
 * face of the slave is cut into what lies opposite to one face of the master each. All faces of masters are known to all processes.
 * In a curved pair the normal of the slave turns, and M, W and R are integrated by one rule on parts of the face.
 */
class OppositeFaces
{
public:
  /** What adds to the moments of a face. */
  struct Row
  {
    unsigned int node;           ///< of #nodes
    std::vector<double> moments; ///< R by Gauss point
    /** Of a curved pair, whose directions e_i turn, instead: `int psi_k phi_d e_i / int psi_k` by i n + k. */
    std::vector<dealii::Tensor<1, 3>> turned;
  };

  /** A part of a slave's face with one face of the master opposite. */
  struct Part
  {
    unsigned int master;                   ///< of #masters
    std::vector<dealii::Point<3>> corners; ///< on the slave's face, in order
    ConvexPolygon polygon; ///< of a curved pair instead, in coordinates of the slave's face
  };

  /** Of a face of a slave in a curved pair, by the rule of its parts: what moves like the master has no jump, to round-off. */
  struct OwnMoments
  {
    std::shared_ptr<const FaceContactDofs> contact_dofs;
    std::vector<dealii::Point<3>> centroids; ///< `int psi_k x / int psi_k`
  };

  /** By #faces of slaves. */
  struct Opposite
  {
    std::vector<Row> rows;
    std::vector<Part> parts;
    OwnMoments own;
  };

  /**
   * @p slaves are the faces with contact dofs, @p master_boundaries says of each boundary whether it may lie opposite to one. Throws
   * NumericalFailure where a face of a slave lies opposite to no face of its master along a part. Collective.
   */
  OppositeFaces(const Scene<3> &scene, const dealii::DoFHandler<3> &dof_handler,
                const DegreeTables<3> &tables, const dealii::AffineConstraints<double> &constraints,
                const std::vector<ContactDofFace<3>> &slaves,
                const std::vector<bool> &master_boundaries);

  const Opposite &operator[](const unsigned int face) const ///< of a slave's face by its number
  {
    return faces[face];
  }

  std::vector<OppositeNode> nodes; ///< that lie opposite to faces of this process
  std::vector<MasterFace> masters; ///< likewise

  const FarValues &nodal() const ///< of all components of nodes, one node after the other
  {
    return *of_nodes;
  }

  const FarValues &unknowns() const ///< of entries of nodes
  {
    return *of_unknowns;
  }

  unsigned int nodal_place(unsigned int node, unsigned int component) const; ///< in nodal()

  /** What lies opposite to a point of a slave's face: a master, of #masters, and a point of its unit cell. */
  struct Place
  {
    unsigned int master;
    dealii::Point<3> reference;
  };

  /** Of @p x on a face of a slave, by its number, with this outer normal. */
  Place place(unsigned int face, const dealii::Point<3> &x,
              const dealii::Tensor<1, 3> &normal) const;

  /** The same in a curved pair, of the point @p own of the slave's unit cell with this map and face of it. */
  Place place_on_curve(unsigned int face, const CellMap<3> &map, unsigned int face_no,
                       const dealii::Point<3> &own) const;

  /** A point of a part: where it lies on the slave's cell, its weight, times ds of the slave's face, and where on the master's. */
  struct PartPoint
  {
    dealii::Point<3> own;
    double weight;
    dealii::Point<3> reference;
  };

  /** Of a rule with @p n points a direction on each triangle. */
  std::vector<PartPoint> points_of(const Part &part, const ContactDofFace<3> &slave,
                                   unsigned int n) const;

  /** u' there, of nodal @p values in the order of nodal(). */
  dealii::Tensor<1, 3> displacement(const Place &place, const std::vector<double> &values) const;

private:
  std::vector<PartPoint> points_on_curve(const Part &part, const ContactDofFace<3> &slave,
                                         unsigned int n) const;

  const DegreeTables<3> &tables;
  void number_nodes(const dealii::IndexSet &owned, MPI_Comm communicator);

  std::vector<Opposite> faces;
  std::vector<CellMap<3>> maps;     ///< of #masters, as the next
  std::vector<CurvedFace> surfaces; ///< without nodes where they are plane
  std::vector<std::vector<unsigned int>>
      places; ///< of the first component of their nodes in nodal()
  std::unique_ptr<const FarValues> of_nodes, of_unknowns;
};
} // namespace hpvi

#endif
