// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_field_h
#define hpvi_primal_field_h

#include <hpvi/results/field.h>
#include <hpvi/space/primal_space.h>

#include <array>
#include <memory>
#include <vector>

namespace hpvi
{
/** The field of the primal path: u of nodal values, which knows its neighbours, and lambda by ContactDof. */
template <int dim>
class PrimalField : public Field<dim>
{
public:
  using typename Field<dim>::Cell;

  /** All of them live as long as this. */
  PrimalField(const PrimalSpace<dim> &space, const ShapeTables<dim> &tables,
              const DistributedVector &u, const std::vector<ContactVector<dim>> &lambda);

  std::vector<double> coefficients(const Cell &cell) const override;
  double largest_displacement() const override;
  ContactTraction<dim> traction(const FieldFace<dim> &face,
                                const dealii::Point<dim> &reference) const override;
  double bound(const FieldFace<dim> &face, const dealii::Point<dim> &reference) const override;
  Tangential<dim> past_slip(const FieldFace<dim> &face, const dealii::Point<dim> &x) const override;
  dealii::Tensor<1, dim> opposite(const FieldFace<dim> &face,
                                  const dealii::Point<dim> &reference) const override;
  dealii::Tensor<1, dim> change_opposite(const FieldFace<dim> &face,
                                         const dealii::Point<dim> &reference) const override;
  std::vector<dealii::types::material_id>
  materials_opposite(const FieldFace<dim> &face) const override;
  const std::vector<ExertedTraction<dim>> &exerted() const override;
  std::vector<double> friction_cuts(const FieldFace<dim> &face) const override;
  std::vector<MultiplierPoint<dim>> multiplier_points(const FieldFace<dim> &face,
                                                      double negligible) const override;
  const ShapeTable<dim> &multiplier_table(const FieldFace<dim> &face) const override;
  std::vector<PressureValue<dim>> pressures(const FieldFace<dim> &face) const override;
  double contact_work() const override;
  std::unique_ptr<const Field<dim>> round_off_probe(const Scene<dim> &unloaded) const override;

private:
  PrimalField(const Scene<dim> &scene, const PrimalSpace<dim> &space,
              const ShapeTables<dim> &tables, std::shared_ptr<const DistributedVector> u,
              std::shared_ptr<const std::vector<ContactVector<dim>>> lambda);

  void find_exerted();
  dealii::Tensor<1, dim> displacement_opposite(const FieldFace<dim> &face,
                                               const dealii::Point<dim> &reference,
                                               const dealii::Point<dim> &x,
                                               const std::vector<double> &values) const;
  unsigned int number_of(const FieldFace<dim> &face) const;
  const BoxTables<dim> &tables_of(const FieldFace<dim> &face) const
  {
    return space.tables.of(face.cell);
  }
  ContactTraction<dim> multiplier(const FieldFace<dim> &face, unsigned int k) const;

  const PrimalSpace<dim> &space;
  const std::shared_ptr<const DistributedVector> u;
  const std::shared_ptr<const std::vector<ContactVector<dim>>> lambda;
  std::vector<const ContactDofFace<dim> *>
      contact_dof_faces; ///< by face; null: it has no contact dofs
  std::vector<std::vector<ShapeTable<dim>>>
      moment_tables; ///< by degree and number of a face of the unit cell
  std::vector<double> far, past_far,
      far_change; ///< opposite to faces: now, in the load step before, less that
  std::vector<ExertedTraction<dim>> on_masters;
};
} // namespace hpvi

#endif
