// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_solution_field_h
#define hpvi_solution_field_h

#include <hpvi/plane/solution.h>
#include <hpvi/results/field.h>

namespace hpvi
{
/** The field of the reduced path; face k is that of ContactSpace::faces(). */
template <int dim>
class SolutionField : public Field<dim>
{
public:
  using typename Field<dim>::Cell;

  /** @p solution lives as long as this. */
  explicit SolutionField(const Solution<dim> &solution);

  std::vector<double> coefficients(const Cell &cell) const override;
  double largest_displacement() const override;
  ContactTraction<dim> traction(const FieldFace<dim> &face,
                                const dealii::Point<dim> &reference) const override;
  double bound(const FieldFace<dim> &face, const dealii::Point<dim> &reference) const override;
  Tangential<dim> past_slip(const FieldFace<dim> &face, const dealii::Point<dim> &x) const override;
  std::vector<ContactSegment<dim>> segments(const FieldFace<dim> &face) const override;
  dealii::Tensor<1, dim> opposite(const FieldFace<dim> &face,
                                  const dealii::Point<dim> &reference) const override;
  std::vector<double> friction_cuts(const FieldFace<dim> &face) const override;
  std::vector<MultiplierPoint<dim>> multiplier_points(const FieldFace<dim> &face,
                                                      double negligible) const override;
  const ShapeTable<dim> &multiplier_table(const FieldFace<dim> &face) const override;
  std::vector<PressureValue<dim>> pressures(const FieldFace<dim> &face) const override;
  double contact_work() const override;
  std::unique_ptr<const Field<dim>> round_off_probe(const Scene<dim> &unloaded) const override;

private:
  explicit SolutionField(std::shared_ptr<const Solution<dim>> solution);

  const ContactFace<dim> &contact_face(const FieldFace<dim> &face) const;
  double coordinate(const FieldFace<dim> &face, const dealii::Point<dim> &reference) const;

  const std::shared_ptr<const Solution<dim>>
      kept; ///< a solution of its own, or one that is borrowed
  const Solution<dim> &solution;
};
} // namespace hpvi

#endif
