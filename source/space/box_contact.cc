// SPDX-License-Identifier: LGPL-2.1-or-later

// @sect3{What contact exerts}
//
// The stress of u_N along a face with the mean of the multiplier, as far as the law allows it: a polynomial whose Bernstein coefficients
// are in a convex set is in it everywhere.
#include <hpvi/space/box_bound_stages.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The largest t <= 1 with |mean + t (c - mean)| <= 1. */
double within_disc(const Tensor<1, 2> &mean, const Tensor<1, 2> &c)
{
  const Tensor<1, 2> d = c - mean;
  const double a = d * d, b = mean * d, rest = std::max(0., 1 - mean * mean);
  if (a + 2 * b <= rest)
    return 1.;
  return a > 0 ? std::max(0., (std::sqrt(b * b + a * rest) - b) / a) : 1.;
}
} // namespace

ContactTractions BoxBound::tractions(const ContactDofFace<3> &face, const BoxStress &element) const
{
  ContactTractions result;
  const unsigned int axis = face.face / 2, m = p + 1;
  const auto axes = tangents<3>(face.face);
  const Vector<double> coefficients = modes(face.cell, u);
  const CellMap<3> map = map_of<3>(face.cell);
  const BoundaryCondition<3> &condition = space.condition(face.cell, face.face);
  const double sign = face.face % 2 ? 1. : -1.;
  const auto at_gauss = [&](const unsigned int component)
  {
    return along_axes(of.to_gauss,
                      on_face(element.stress(coefficients, component, axis), m, face.face), 2);
  };
  result.has_friction = face.has_friction();
  result.has_pressure = face.has_pressure();
  double area = 0;
  for (unsigned int k = 0; k < space.tables.only().n_contact_dofs(); ++k)
    area += space.contact[face.first() + k].area;
  if (face.has_pressure())
  {
    double mean = 0, of_stress = 0;
    for (unsigned int k = 0; k < space.tables.only().n_contact_dofs(); ++k)
      mean +=
          space.contact[face.pressure + k].area / area * std::max(0., lambda[face.pressure + k][0]);
    BoxModes values = at_gauss(axis);
    at_points(of.gauss, 2,
              [&](const unsigned int q, const auto &, const double weight)
              { of_stress -= weight * values[q]; });
    for (double &value : values)
      value = mean - value - of_stress;
    result.pressure = along_axes(of.from_gauss, values, 2);
    const double least = *std::min_element(result.pressure.begin(), result.pressure.end()),
                 t = least >= 0 ? 1. : mean / (mean - least);
    for (double &coefficient : result.pressure)
      coefficient = std::max(0., mean + t * (coefficient - mean));
  }
  const BoxModes pressure = at(of.gauss_values, result.pressure);
  if (face.has_friction())
  {
    Tensor<1, 2> mean, of_stress;
    for (unsigned int k = 0; k < space.tables.only().n_contact_dofs(); ++k)
      for (unsigned int s = 0; s < 2; ++s)
        for (unsigned int t = 0; t < 2; ++t)
          mean[t] += space.contact[face.friction + k].area / area * lambda[face.friction + k][s] *
                     face.direction(face.tangential(s))[axes[t]];
    if (mean.norm() > 1)
      mean /= mean.norm();
    std::array<BoxModes, 2> values{{at_gauss(axes[0]), at_gauss(axes[1])}};
    at_points(of.gauss, 2,
              [&](const unsigned int q, const std::array<double, 3> &x, const double weight)
              {
                const double g =
                    condition.friction.limit(map.point(on_cell_face(face.face, x)), pressure[q]);
                Tensor<1, 2> value = mean;
                if (g > 0)
                  value = -sign / g * Tensor<1, 2>({values[0][q], values[1][q]});
                if (value.norm() > 1)
                  value /= value.norm();
                for (unsigned int t = 0; t < 2; ++t)
                  values[t][q] = value[t];
                of_stress += weight * value;
              });
    for (unsigned int t = 0; t < 2; ++t)
    {
      for (double &value : values[t])
        value += mean[t] - of_stress[t];
      result.lambda[t] = along_axes(of.from_gauss, values[t], 2);
    }
    double t = 1;
    for (unsigned int j = 0; j < result.lambda[0].size(); ++j)
      t = std::min(t, within_disc(mean, Tensor<1, 2>({result.lambda[0][j], result.lambda[1][j]})));
    for (unsigned int s = 0; s < 2; ++s)
      for (double &coefficient : result.lambda[s])
        coefficient = mean[s] + t * (coefficient - mean[s]);
  }
  return result;
}

/** Puts projections of -g lam* and -pi n among the given tractions. */
void BoxBound::give(const ContactDofFace<3> &face, const ContactTractions &of_face)
{
  const unsigned int cell = face.cell->active_cell_index(), axis = face.face / 2;
  const auto axes = tangents<3>(face.face);
  const CellMap<3> map = map_of<3>(face.cell);
  GivenTractions &side = sides.at({cell, face.face});
  const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
  const double sign = face.face % 2 ? 1. : -1., area = size[axes[0]] * size[axes[1]];
  const FullMatrix<double> &projection = of.tables.projection(p + 1, of.fine.size());
  const auto add = [&](const unsigned int component, const BoxModes &values)
  {
    const BoxModes of_component = along_axes(projection, values, 2);
    missed[cell][face.face] += std::sqrt(area * missed_by(of_component, values, 2));
    BoxModes &sum = side.modes[component];
    sum.resize(of_component.size());
    for (unsigned int i = 0; i < sum.size(); ++i)
      sum[i] += of_component[i];
  };
  const BoxModes pressure = at(of.to_fine, of_face.pressure);
  if (of_face.has_pressure)
  {
    BoxModes values = pressure;
    for (double &value : values)
      value *= -sign;
    add(axis, values);
  }
  if (of_face.has_friction)
    for (unsigned int s = 0; s < 2; ++s)
    {
      BoxModes values = along_axes(of.to_fine, of_face.lambda[s], 2);
      at_points(of.fine, 2,
                [&](const unsigned int q, const std::array<double, 3> &x, double)
                {
                  values[q] *=
                      -space.condition(face.cell, face.face)
                           .friction.limit(map.point(on_cell_face(face.face, x)), pressure[q]);
                });
      add(axes[s], values);
    }
}

void BoxBound::take_contact(const BoxEquilibration &elements)
{
  for (const ContactDofFace<3> &face : space.faces)
    contact.push_back(tractions(face, elements.element(face.cell->active_cell_index())));
  join_directions();
  for (unsigned int k = 0; k < contact.size(); ++k)
    give(space.faces[k], contact[k]);
}

/** gap(u_N - w) on one face, and what w changes of the work of friction and of contact. */
double BoxBound::gap(const ContactDofFace<3> &face, const ContactTractions &of_face)
{
  const unsigned int axis = face.face / 2;
  const auto axes = tangents<3>(face.face);
  const auto dofs = face_dofs(face);
  const double sign = face.face % 2 ? 1. : -1.;
  const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
  const double area = size[axes[0]] * size[axes[1]];
  const CellMap<3> map = map_of<3>(face.cell);
  const BoundaryCondition<3> &condition = space.condition(face.cell, face.face);
  std::array<double, 2> by_rule{}, changes{};
  for (const bool is_finer : {false, true})
  {
    const QGauss<1> &rule = is_finer ? of.finer : of.fine;
    const FullMatrix<double> &values = is_finer ? of.to_finer : of.to_fine;
    std::array<BoxModes, 3> u_q, w_q, slip_q;
    for (unsigned int c = 0; c < 3; ++c)
    {
      u_q[c] = at(values, trace_of(u, dofs[c]));
      w_q[c] = at(values, trace_of(w, dofs[c]));
      slip_q[c] = at(values, slip_trace(dofs[c]));
    }
    const std::array<BoxModes, 3> contact_q{{at(values, of_face.lambda[0]),
                                             at(values, of_face.lambda[1]),
                                             at(values, of_face.pressure)}};
    at_points(rule, 2,
              [&](const unsigned int q, const std::array<double, 3> &reference, const double weight)
              {
                const Point<3> x = map.point(on_cell_face(face.face, reference));
                double gap = 0, of_contact = 0, friction = 0, of_u_contact = 0;
                if (of_face.has_friction)
                {
                  const double g = condition.friction.limit(x, contact_q[2][q]);
                  Tensor<1, 2> slip, before;
                  for (unsigned int s = 0; s < 2; ++s)
                  {
                    before[s] = slip_q[axes[s]][q];
                    slip[s] = before[s] - w_q[axes[s]][q];
                    gap -= g * contact_q[s][q] * slip[s];
                    of_contact += g * contact_q[s][q] * w_q[axes[s]][q];
                    of_u_contact += g * contact_q[s][q] * u_q[axes[s]][q];
                  }
                  gap += g * slip.norm();
                  friction += g * (slip.norm() - before.norm());
                }
                if (of_face.has_pressure)
                {
                  const double u_0 = condition.gap ? condition.gap->value(x) : 0.,
                               u_n = sign * u_q[axis][q], w_n = sign * w_q[axis][q];
                  gap += contact_q[2][q] * (u_0 - u_n + w_n);
                  of_contact += contact_q[2][q] * w_n;
                  of_u_contact += contact_q[2][q] * u_n;
                }
                by_rule[is_finer] += weight * area * gap;
                changes[is_finer] += weight * area * (friction + of_contact);
                if (is_finer)
                  work += weight * area * of_u_contact;
              });
  }
  change += changes[1];
  of_rules += std::abs(changes[1] - changes[0]);
  return std::max(0., by_rule[1]) + std::abs(by_rule[1] - by_rule[0]);
}
} // namespace hpvi
