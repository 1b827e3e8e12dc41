// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_multiplier_trace_h
#define hpvi_multiplier_trace_h

#include <hpvi/plane/contact_space.h>

#include <optional>
#include <vector>

namespace hpvi
{
/** A multiplier that outlives its mesh: the starting value of the next, finer one. */
template <int dim>
class MultiplierTrace
{
public:
  /** Of nothing: zero everywhere. */
  MultiplierTrace() = default;

  MultiplierTrace(const ContactSpace<dim> &contact_space, const dealii::Vector<double> &z);

  /**
   * z_N at the Gauss points of @p finer, whose faces are faces of the old mesh or parts of
   * them; zero where the old face had no multipliers. Between bodies the side that has them may have changed.
   */
  dealii::Vector<double> values(const ContactSpace<dim> &finer,
                                const ShapeTables<dim> &tables) const;

private:
  struct Piece
  {
    dealii::types::boundary_id boundary;
    dealii::Point<dim> begin;
    dealii::Tensor<1, dim> edge;
    std::vector<double> values;        ///< of friction at its Gauss points
    std::vector<double> normal_points; ///< as in ContactFace, along the edge
    std::vector<double> pressures;     ///< there
    std::optional<unsigned int> pair;  ///< of bodies, on either side
    CurvePiece curve;                  ///< what the edge follows; none: straight

    double place(const dealii::Point<dim> &x) const; ///< of the nearest point, in [0,1] on it
    dealii::Point<dim> point(double s) const;
  };

  void take_opposite(const ContactFace<dim> &face, const ContactSpace<dim> &finer,
                     const ShapeTables<dim> &tables, dealii::Vector<double> &result) const;

  std::vector<Piece> pieces; ///< in the order of the faces
};
} // namespace hpvi

#endif
