// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/geometry.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** With 0 for coordinates that are the rest of numbers of @p size. */
template <int dim>
Tensor<1, dim> without_round_off(Tensor<1, dim> x, const double size)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(x[d]) < 1e-14 * size)
      x[d] = 0;
  return x;
}
} // namespace

template <int dim>
Tensor<1, dim> RigidBodyMotion<dim>::at(const Point<dim> &x, const unsigned int body) const
{
  static_assert(dim == 2, "a rotation is a number");
  if (body > 0)
    return others.at(body - 1).at(x);
  const Tensor<1, dim> arm = x - centre;
  return translation + rotation * Tensor<1, dim>({-arm[1], arm[0]});
}

template <int dim>
Tensor<1, dim> RigidBodyMotion<dim>::jump(const Point<dim> &x, const TouchingBodies &bodies) const
{
  return bodies[1] == no_body ? at(x, bodies[0]) : at(x, bodies[0]) - at(x, bodies[1]);
}

template <int dim>
double RigidBodyMotion<dim>::largest_translation() const
{
  double largest = translation.norm();
  for (const RigidBodyMotion<dim> &other : others)
    largest = std::max(largest, other.translation.norm());
  return largest;
}

template <int dim>
double RigidBodyMotion<dim>::largest_rotation() const
{
  double largest = std::abs(rotation);
  for (const RigidBodyMotion<dim> &other : others)
    largest = std::max(largest, std::abs(other.rotation));
  return largest;
}

template <int dim>
bool RigidBodyMotion<dim>::is_translation() const
{
  return largest_rotation() == 0.;
}

template <int dim>
void RigidBodyMotion<dim>::add(const double factor, const RigidBodyMotion<dim> &other)
{
  translation += factor * other.translation;
  rotation += factor * other.rotation;
  for (unsigned int b = 0; b < others.size(); ++b)
    others[b].add(factor, other.others[b]);
}

template <int dim>
std::string RigidBodyMotion<dim>::direction() const
{
  std::ostringstream text;
  if (!others.empty())
  {
    const double moves = 1e-9 * largest_translation(), turns = 1e-9 * largest_rotation();
    RigidBodyMotion<dim> first = *this;
    first.others.clear();
    std::vector<RigidBodyMotion<dim>> all{first};
    all.insert(all.end(), others.begin(), others.end());
    for (const RigidBodyMotion<dim> &one : all)
      if (one.translation.norm() > moves || std::abs(one.rotation) > turns)
        text << (text.str().empty() ? "" : " and ") << one.name << ' ' << one.direction();
  }
  else if (is_translation())
    text << "along (" << without_round_off(translation / translation.norm(), 1.) << ')';
  else
  {
    const Tensor<1, dim> arm = Tensor<1, dim>({-translation[1], translation[0]}) / rotation;
    text << "about (" << without_round_off(centre + arm, centre.norm() + arm.norm()) << ')';
  }
  return text.str();
}

template <int dim>
RigidBodyMotion<dim> sum(const std::vector<RigidBodyMotion<dim>> &motions,
                         const Vector<double> &coefficients)
{
  RigidBodyMotion<dim> result = motions.front();
  result.add(-1., motions.front());
  for (unsigned int j = 0; j < motions.size(); ++j)
    result.add(coefficients[j], motions[j]);
  return result;
}

template <int dim>
RigidBodyMotion<dim> combined(const std::vector<RigidBodyMotion<dim>> &motions,
                              const Vector<double> &coefficients)
{
  Vector<double> known(coefficients);
  for (double &coefficient : known) // a rotation by round-off would be one about a far point
    if (std::abs(coefficient) < 1e-10 * coefficients.linfty_norm())
      coefficient = 0;
  return sum(motions, known);
}

template struct RigidBodyMotion<2>;
template RigidBodyMotion<2> sum(const std::vector<RigidBodyMotion<2>> &, const Vector<double> &);
template RigidBodyMotion<2> combined(const std::vector<RigidBodyMotion<2>> &,
                                     const Vector<double> &);
} // namespace hpvi
