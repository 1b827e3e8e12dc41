// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_traces_h
#define hpvi_contact_traces_h

#include <hpvi/discretisation/solution.h>

namespace hpvi
{
/** u_N and sigma(u_N) at the points of one contact face. */
template <int dim>
class ContactTraces
{
public:
  ContactTraces(const ContactFace<dim> &face, const unsigned int n_gauss,
                const Solution<dim> &solution)
      : face(face), law(solution.scene.material_of(face.cell)), map(map_of<dim>(face.cell)),
        table(solution.tables.face(face.degree, face.face_no, n_gauss))
  {
    const std::vector<double> coefficients = solution.coefficients(face.cell->active_cell_index());
    values = evaluate(table.values, coefficients);
    derivatives = evaluate(table.derivatives, coefficients);
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
    return law.stress(reference * dealii::invert(map.jacobian(table.points[q])));
  }

  /** sigma n - G: what the plane exerts, without an applied traction G. */
  dealii::Tensor<1, dim> traction(const unsigned int q) const
  {
    const dealii::Point<dim> x = map.point(table.points[q]);
    dealii::Tensor<1, dim> result = sigma(q) * map.normal(face.face_no, table.points[q]);
    for (unsigned int c = 0; c < dim; ++c)
      if (face.condition->traction[c])
        result[c] -= face.condition->traction[c]->value(x);
    return result;
  }

  /** Its part along n: positive pulls. */
  double normal_traction(const unsigned int q) const
  {
    return traction(q) * map.normal(face.face_no, table.points[q]);
  }

private:
  const ContactFace<dim> &face;
  const HookesLaw<dim> law;
  const CellMap<dim> map;
  const ShapeTable<dim> &table;
  std::vector<double> values, derivatives; ///< component by component
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
 * At one Gauss point more than u_N has nodes, at which T_n of an affine cell is exact, and then where
 * the multiplier has its unknowns.
 */
template <int dim>
std::vector<PressurePoint<dim>> pressure_points(const ContactFace<dim> &face,
                                                const Solution<dim> &solution)
{
  const dealii::QGauss<1> &gauss = solution.tables.gauss(face.degree + 1);
  const ContactTraces<dim> traces(face, gauss.size(), solution);
  std::vector<PressurePoint<dim>> result;
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0];
    const ContactFrame<dim> frame = face.frame(s);
    result.push_back({frame.x,
                      face.condition->has_pressure()
                          ? solution.contact_space.pressure(face, solution.z, s)
                          : -traces.normal_traction(q),
                      gauss.weight(q) * frame.measure});
  }
  for (unsigned int k = 0; k < face.normal_points.size(); ++k)
    result.push_back({face.point(face.normal_points[k]), solution.z[face.pressures[k]], 0.});
  return result;
}

/** u_N in one direction along a straight contact face: the polynomial through its values at p+1 Gauss points. */
template <int dim>
class EdgeDisplacement
{
public:
  EdgeDisplacement(const ContactFace<dim> &face, const Solution<dim> &solution,
                   dealii::Tensor<1, dim> ContactFrame<dim>::*const direction)
      : basis(solution.tables.gauss_lagrange(face.degree + 1)), nodal(face.degree + 1)
  {
    const ShapeTables<dim> &tables = solution.tables;
    const std::vector<double> values =
        evaluate(tables.face(face.degree, face.face_no, face.degree + 1).values,
                 solution.coefficients(face.cell->active_cell_index()));
    for (unsigned int k = 0; k < nodal.size(); ++k)
    {
      const ContactFrame<dim> frame = face.frame(tables.gauss(nodal.size()).point(k)[0]);
      for (unsigned int c = 0; c < dim; ++c)
        nodal[k] += (frame.*direction)[c] * values[c * nodal.size() + k];
    }
  }

  /** Counted from where the load step began. */
  void subtract_past(const ContactFace<dim> &face, const ShapeTables<dim> &tables)
  {
    for (unsigned int k = 0; k < nodal.size(); ++k)
      nodal[k] -= face.past_slip(face.point(tables.gauss(nodal.size()).point(k)[0]));
  }

  /** At reference coordinate s in [0,1] of the face. */
  double operator()(const double s) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < nodal.size(); ++k)
      sum += nodal[k] * basis[k].value(s);
    return sum;
  }

private:
  const std::vector<dealii::Polynomials::Polynomial<double>> &basis;
  std::vector<double> nodal;
};
} // namespace hpvi

#endif
