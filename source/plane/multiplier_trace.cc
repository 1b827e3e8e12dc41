// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/multiplier_trace.h>

#include <limits>
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
                      {},
                      face.condition->pair,
                      face.map.is_curved() && face.map.blends()[face.face_no]
                          ? face.map.blends()[face.face_no].curve()
                          : CurvePiece()});
    for (const unsigned int i : face.pressures)
      pieces.back().pressures.push_back(z[i]);
  }
}

template <int dim>
double MultiplierTrace<dim>::Piece::place(const Point<dim> &x) const
{
  return curve ? curve.nearest(x) : (x - begin) * edge / edge.norm_square();
}

template <int dim>
Point<dim> MultiplierTrace<dim>::Piece::point(const double s) const
{
  return curve ? curve.point(s) : begin + s * edge;
}

/** Pressure and friction are the same numbers in the frames of both sides. */
template <int dim>
void MultiplierTrace<dim>::take_opposite(const ContactFace<dim> &face,
                                         const ContactSpace<dim> &finer,
                                         const ShapeTables<dim> &tables,
                                         Vector<double> &result) const
{
  const auto take = [&](const unsigned int unknown, const bool is_pressure)
  {
    const Point<dim> &x = finer.multipliers()[unknown].x;
    const Piece *nearest = nullptr; // along a ring several see the point
    double least = std::numeric_limits<double>::max(), at = 0;
    for (const Piece &piece : pieces)
    {
      if (piece.pair != face.condition->pair)
        continue;
      const double s = piece.place(x), distance = piece.point(s).distance(x);
      if (s < 0 || s > 1 || distance >= least)
        continue;
      nearest = &piece;
      least = distance;
      at = s;
    }
    if (!nearest)
      return;
    const std::vector<double> &values = is_pressure ? nearest->pressures : nearest->values;
    std::vector<double> points = nearest->normal_points;
    if (!is_pressure)
    {
      points.clear();
      for (const Point<1> &point : tables.gauss(values.size()).get_points())
        points.push_back(point[0]);
    }
    const std::vector<double> basis = lagrange_basis(points, at);
    if (!values.empty())
      result[unknown] = std::inner_product(basis.begin(), basis.end(), values.begin(), 0.);
  };
  for (const unsigned int unknown : face.pressures)
    take(unknown, true);
  for (unsigned int i = 0; i < face.n_multipliers; ++i)
    take(face.first_multiplier + i, false);
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
    if (face.condition->pair)
    {
      take_opposite(face, finer, tables, result);
      continue;
    }
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
