// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/multiplier_trace.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The polynomial through @p values at the points of @p gauss, at s. */
double interpolate(const Quadrature<1> &gauss, const std::vector<double> &values, const double s)
{
  double sum = 0;
  for (unsigned int i = 0; i < values.size(); ++i)
  {
    double product = values[i];
    for (unsigned int j = 0; j < values.size(); ++j)
      if (j != i)
        product *= (s - gauss.point(j)[0]) / (gauss.point(i)[0] - gauss.point(j)[0]);
    sum += product;
  }
  return sum;
}
} // namespace

template <int dim>
MultiplierTrace<dim>::MultiplierTrace(const ContactSpace<dim> &contact_space,
                                      const Vector<double> &lambda)
{
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    const auto first = lambda.begin() + face.first_multiplier;
    pieces.push_back({face.condition->id,
                      face.point(0.),
                      face.point(1.) - face.point(0.),
                      {first, first + face.n_multipliers}});
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
    if (piece->values.empty())
      continue;
    for (unsigned int i = 0; i < face.n_multipliers; ++i)
      result[face.first_multiplier + i] =
          interpolate(tables.gauss(piece->values.size()), piece->values,
                      place(face.point(tables.gauss(face.n_multipliers).point(i)[0])));
  }
  return result;
}

template class MultiplierTrace<2>;
} // namespace hpvi
