// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/contact/multiplier_trace.h>

#include <numeric>

namespace hpvi
{
using namespace dealii;

template <int dim>
MultiplierTrace<dim>::MultiplierTrace(const ContactSpace<dim> &contact_space,
                                      const Vector<double> &z)
{
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    const auto first = z.begin() + face.first_multiplier;
    pieces.push_back({face.condition->id,
                      face.point(0.),
                      face.point(1.) - face.point(0.),
                      {first, first + face.n_multipliers},
                      face.normal_points,
                      {}});
    for (const unsigned int i : face.pressures)
      pieces.back().pressures.push_back(z[i]);
  }
}

template <int dim>
Vector<double> MultiplierTrace<dim>::values(const ContactSpace<dim> &finer,
                                            const ShapeTables<dim> &tables) const
{
  Vector<double> result(finer.n_multipliers());
  auto piece = pieces.begin();
  const auto place = [&](const Point<dim> &x)
  { return (x - piece->begin) * piece->edge / piece->edge.norm_square(); };
  const auto holds = [&](const ContactFace<dim> &face)
  {
    const double s = place(face.point(0.5));
    return piece->boundary == face.condition->id && s > 0 && s < 1;
  };
  for (const ContactFace<dim> &face : finer.faces())
  {
    while (piece != pieces.end() && !holds(face))
      ++piece;
    if (piece == pieces.end())
      break;
    const auto at = [&](const unsigned int unknown)
    { return place(finer.multipliers()[unknown].x); };
    for (const unsigned int unknown : face.pressures)
    {
      const std::vector<double> basis = lagrange_basis(piece->normal_points, at(unknown));
      result[unknown] =
          std::inner_product(basis.begin(), basis.end(), piece->pressures.begin(), 0.);
    }
    if (piece->values.empty())
      continue;
    const auto &basis = tables.gauss_lagrange(piece->values.size());
    for (unsigned int i = 0; i < face.n_multipliers; ++i)
      for (unsigned int k = 0; k < basis.size(); ++k)
        result[face.first_multiplier + i] +=
            piece->values[k] * basis[k].value(at(face.first_multiplier + i));
  }
  return result;
}

template class MultiplierTrace<2>;
} // namespace hpvi
