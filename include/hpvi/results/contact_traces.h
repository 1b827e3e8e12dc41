// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_traces_h
#define hpvi_contact_traces_h

#include <hpvi/plane/solution.h>
#include <hpvi/results/elastic_strain.h>
#include <hpvi/results/field.h>

namespace hpvi
{
/** u_N and sigma(u_N) at the points of a table on one contact face. */
template <int dim>
class ContactTraces
{
public:
  ContactTraces(const FieldFace<dim> &face, const ShapeTable<dim> &table, const Field<dim> &field)
      : ContactTraces(face.face_no, *face.condition, field.scene, face.cell->material_id(),
                      face.map, table, field.coefficients(face.cell))
  {
  }

  /** At Gauss points of a face of the reduced path. */
  ContactTraces(const ContactFace<dim> &face, const unsigned int n_gauss,
                const Solution<dim> &solution)
      : ContactTraces(face.face_no, *face.condition, solution.scene, face.cell->material_id(),
                      face.map, solution.tables.face(face.degree, face.face_no, n_gauss),
                      solution.coefficients(face.cell->active_cell_index()))
  {
  }

  dealii::Tensor<1, dim> displacement(const unsigned int q) const
  {
    dealii::Tensor<1, dim> u;
    for (unsigned int c = 0; c < dim; ++c)
      u[c] = values[c * table.points.size() + q];
    return u;
  }

  dealii::SymmetricTensor<2, dim> sigma(const unsigned int q) const
  {
    dealii::Tensor<2, dim> reference;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int j = 0; j < dim; ++j)
        reference[c][j] = derivatives[c * table.derivatives.m() + q * table.rows_per_point + j];
    const ElasticStrain<dim> strain =
        elastic_strain(scene, material, map, table.points[q], displacement(q),
                       reference * dealii::invert(map.jacobian(table.points[q])));
    return law.stress(strain.in_plane, strain.hoop);
  }

  /** sigma n - G: what the plane exerts, without an applied traction G. */
  dealii::Tensor<1, dim> traction(const unsigned int q) const
  {
    const dealii::Point<dim> x = map.point(table.points[q]);
    dealii::Tensor<1, dim> result = sigma(q) * map.normal(face_no, table.points[q]);
    for (unsigned int c = 0; c < dim; ++c)
      if (condition.traction[c])
        result[c] -= condition.traction[c]->value(x);
    return result;
  }

  /** Its part along the direction of contact, n or d: positive pulls. */
  double normal_traction(const unsigned int q) const
  {
    return traction(q) * condition.held_direction(map.normal(face_no, table.points[q]));
  }

private:
  ContactTraces(const unsigned int face_no, const BoundaryCondition<dim> &condition,
                const Scene<dim> &scene, const dealii::types::material_id material,
                const CellMap<dim> &map, const ShapeTable<dim> &table,
                const std::vector<double> &coefficients)
      : face_no(face_no), condition(condition), scene(scene), material(material),
        law(scene.materials[material]), map(map), table(table),
        values(evaluate(table.values, coefficients)),
        derivatives(evaluate(table.derivatives, coefficients))
  {
  }

  const unsigned int face_no;
  const BoundaryCondition<dim> &condition;
  const Scene<dim> &scene;
  const dealii::types::material_id material;
  const HookesLaw<dim> law;
  const CellMap<dim> map;
  const ShapeTable<dim> &table;
  const std::vector<double> values, derivatives; ///< component by component
};

/** -T_n at one point of a contact face. */
template <int dim>
struct PressurePoint
{
  dealii::Point<dim> x;
  double pressure; ///< positive presses [stress]
  double weight;   ///< of a Gauss rule, times ds; 0 at an unknown of the multiplier
};

/**
 * At one Gauss point more in a direction than u_N has nodes, at which T_n of an affine cell is exact, and
 * then where the multiplier has its unknowns.
 */
template <int dim>
std::vector<PressurePoint<dim>> pressure_points(const FieldFace<dim> &face, const Field<dim> &field)
{
  const ShapeTable<dim> &table = field.tables.face(face.degree(), face.face_no, face.degree() + 1);
  const ContactTraces<dim> traces(face, table, field);
  std::vector<PressurePoint<dim>> result;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const FaceFrame<dim> frame = face.frame(table.points[q]);
    result.push_back({frame.x,
                      face.condition->has_pressure()
                          ? field.traction(face, table.points[q]).pressure
                          : -traces.normal_traction(q),
                      table.weights[q] * frame.measure});
  }
  for (const PressureValue<dim> &unknown : field.pressures(face))
    result.push_back({unknown.x, unknown.pressure, 0.});
  return result;
}

/**
 * u_N in one direction along a contact face: along a straight one the polynomial through its values at p+1 Gauss points, along a curve, where
 * the direction turns, that of each component; where another body lies opposite, less what that one does.
 */
template <int dim>
class EdgeDisplacement
{
public:
  /** Along the tangent, or along the normal. */
  EdgeDisplacement(const FieldFace<dim> &face, const Field<dim> &field, const bool is_tangential)
      : table(field.tables.face(face.degree(), face.face_no, face.degree() + 1)),
        basis(field.tables.gauss_lagrange(face.degree() + 1)), nodal(face.degree() + 1), face(face),
        field(field), is_tangential(is_tangential)
  {
    static_assert(dim == 2, "one coordinate along a face");
    const std::vector<double> values = evaluate(table.values, field.coefficients(face.cell));
    for (unsigned int k = 0; k < nodal.size(); ++k)
    {
      const dealii::Tensor<1, dim> direction = direction_at(table.points[k]);
      for (unsigned int c = 0; c < dim; ++c)
      {
        const double value = values[c * nodal.size() + k];
        components[c].push_back(value);
        nodal[k] += direction[c] * value;
      }
    }
  }

  /** Counted from where the load step began. */
  void subtract_past(const FieldFace<dim> &face, const Field<dim> &field)
  {
    for (unsigned int k = 0; k < nodal.size(); ++k)
    {
      const double slip = field.past_slip(face, face.map.point(table.points[k]));
      nodal[k] -= slip;
      past.push_back(slip);
    }
  }

  /** At reference coordinate s in [0,1] of the face. */
  double operator()(const double s) const
  {
    const dealii::Point<dim> reference =
        point_on_face<dim>(face.face_no, dealii::Point<dim - 1>(s));
    double sum = 0;
    if (face.map.is_curved())
    {
      const dealii::Tensor<1, dim> direction = direction_at(reference);
      for (unsigned int k = 0; k < nodal.size(); ++k)
      {
        double value = past.empty() ? 0. : -past[k];
        for (unsigned int c = 0; c < dim; ++c)
          value += direction[c] * components[c][k];
        sum += value * basis[k].value(s);
      }
    }
    else
      for (unsigned int k = 0; k < nodal.size(); ++k)
        sum += nodal[k] * basis[k].value(s);
    return face.condition->pair ? sum - direction_at(reference) * field.opposite(face, reference)
                                : sum;
  }

private:
  const ShapeTable<dim> &table;
  const std::vector<dealii::Polynomials::Polynomial<double>> &basis;
  std::vector<double> nodal;
  const FieldFace<dim> &face;
  const Field<dim> &field;
  const bool is_tangential;
  std::array<std::vector<double>, dim> components; ///< of u_N at the points of the table
  std::vector<double> past;                        ///< slip there, if it is subtracted

  dealii::Tensor<1, dim> direction_at(const dealii::Point<dim> &reference) const
  {
    const FaceFrame<dim> frame = face.frame(reference);
    return is_tangential ? frame.tangents[0] : frame.normal;
  }
};
} // namespace hpvi

#endif
