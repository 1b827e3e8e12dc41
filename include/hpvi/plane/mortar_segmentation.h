// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mortar_segmentation_h
#define hpvi_mortar_segmentation_h

#include <hpvi/plane/displacement_space.h>
#include <hpvi/scene/edge_path.h>

#include <memory>
#include <vector>

namespace hpvi
{
/** What a face of the boundary follows in the drawing; a coordinate s of the face is one of the path, or 1 - s. */
struct ExactFace
{
  EdgePath path;
  bool is_reversed = false; ///< does the face run clockwise around its body?

  double on_path(double s) const; ///< and back
};

/** A face of the slave and one of the master that are curved, or at an angle to each other. */
struct FacingFaces
{
  ExactFace slave, master;

  /** What the normal at @p s of the slave's face meets, on the master's, near to @p near. */
  double opposite(double s, double near) const;
};

/** What lies opposite to a face of the slave, between two places where a face of the master ends: one face of the master. */
template <int dim>
struct ContactSegment
{
  using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

  double begin, end; ///< on the slave's face, in [0,1]
  Cell cell;         ///< of the master
  unsigned int face_no, degree;
  double at_begin, at_end; ///< of its face, opposite to begin and end, in [0,1]
  std::shared_ptr<const FacingFaces> drawn = nullptr; ///< null: straight and parallel

  dealii::types::boundary_id boundary() const ///< of the master
  {
    return cell->face(face_no)->boundary_id();
  }

  /** What is opposite to @p s of the slave's face, on the master's. */
  double opposite(const double s) const
  {
    const double between = at_begin + (s - begin) / (end - begin) * (at_end - at_begin);
    return drawn ? drawn->opposite(s, between) : between;
  }
};

/**
 * Of the pairs of a scene on one mesh: which side of each has the multipliers, the slave, and what lies opposite to its
 * faces, the master, along the normal. It is the side with more multipliers, for a coarse slave would spoil a fine master and
 * not the reverse; of equal ones the first of `Between`. Both sides have the same length, so that this is the side with
 * more (p-1)/h. Points and normals are those of the drawing: polynomials of two meshes for one curve differ, and the part of the master
 * that lies opposite would depend on both degrees.
 */
template <int dim>
class MortarSegmentation
{
public:
  using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

  /** @p space must outlive this object. */
  MortarSegmentation(const Scene<dim> &scene, const DisplacementSpace<dim> &space);

  bool is_master(dealii::types::boundary_id boundary) const;

  /** In the order of the slave's face, which they fill; none where no body lies opposite. */
  std::vector<ContactSegment<dim>> segments(const Cell &cell, unsigned int face_no) const;

private:
  struct Face
  {
    Cell cell;
    unsigned int face_no, degree;
    ExactFace drawn;
    double begin = 0, end = 0; ///< along the line on which the bodies touch [length]
  };
  struct ContactInterface
  {
    dealii::types::boundary_id slave, master;
    dealii::Tensor<1, dim> along; ///< that line; null: there is none
    std::vector<Face> faces;
  };

  static ExactFace drawn(const Cell &cell, unsigned int face_no);
  static std::vector<ContactSegment<dim>> on_line(const ContactInterface &pair, const Cell &cell,
                                                  unsigned int face_no);
  static std::vector<ContactSegment<dim>> on_curve(const ContactInterface &pair,
                                                   const ExactFace &slave);

  std::vector<ContactInterface> pairs;
};
} // namespace hpvi

#endif
