// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tangential_trace_h
#define hpvi_tangential_trace_h

#include <hpvi/plane/contact_space.h>

namespace hpvi
{
/**
 * u_t along one contact boundary, between bodies [u]_t, as a function of x [length], which outlives its mesh: where a
 * load step begins to count slip. On every face of a mesh that descends from its own it is one
 * polynomial, of no higher degree, so that quadrature there loses nothing.
 */
template <int dim>
class TangentialTrace : public dealii::Function<dim>
{
  static_assert(dim == 2, "nodes along a straight edge");

public:
  /** Of the displacement @p u on @p boundary, which has contact. */
  TangentialTrace(const ContactSpace<dim> &contact_space,
                  const DisplacementSpace<dim> &displacement_space, const ShapeTables<dim> &tables,
                  const dealii::Vector<double> &u, dealii::types::boundary_id boundary);

  double value(const dealii::Point<dim> &x, unsigned int component = 0) const override;

private:
  /** One face, along the tangent of the boundary; where that turns, a place of its own. */
  struct Piece
  {
    double begin, end;         ///< distance from the origin along the tangent
    std::vector<double> nodes; ///< in [0,1]
    std::vector<double> u_t;   ///< there
    std::array<dealii::Point<dim>, 2> ends;
    CurvePiece curve; ///< between them; none: straight

    double nearest(const dealii::Point<dim> &x) const; ///< in [0,1]
    double value(double s) const;
  };

  void add_jump(const ContactFace<dim> &face, const DisplacementSpace<dim> &space,
                const ShapeTables<dim> &tables, const dealii::Vector<double> &u);
  const Piece &piece_at(const dealii::Point<dim> &x) const;

  bool is_straight = true; ///< all along one line
  dealii::Point<dim> origin;
  dealii::Tensor<1, dim> tangent;
  std::vector<Piece> pieces; ///< in order
};

/** That of @p u along each boundary with friction: what the next load step counts slip from. */
template <int dim>
PastSlip<dim> past_slip(const ContactSpace<dim> &contact_space,
                        const DisplacementSpace<dim> &displacement_space,
                        const ShapeTables<dim> &tables, const dealii::Vector<double> &u);
} // namespace hpvi

#endif
