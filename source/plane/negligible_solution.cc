// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/negligible_solution.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** No load, no prescribed displacement, no past slip, no overlap: then u = 0 and z = 0 solve the discrete problem. */
template <int dim>
bool nothing_acts(const Discretisation<dim> &discretisation, const DataScale &scale)
{
  const auto &multipliers = discretisation.spaces->contact_space.multipliers();
  return scale.displacement == 0 && discretisation.system.f.all_zero() &&
         std::none_of(multipliers.begin(), multipliers.end(),
                      [](const ContactMultiplier<dim> &multiplier)
                      {
                        return multiplier.kind == ContactMultiplier<dim>::Kind::friction
                                   ? multiplier.gap != 0
                                   : multiplier.gap < 0;
                      });
}
} // namespace

template <int dim>
double negligible_energy(const Scene<dim> &scene)
{
  const DataScale &past = scene.past_data;
  return round_off_of_data * round_off_of_data * past.stress * past.displacement *
         std::pow(scene.geometry.diameter(), dim - 1);
}

template <int dim>
bool drop_round_off(const Discretisation<dim> &discretisation, const double energy,
                    Vector<double> &z, Vector<double> &u)
{
  const DataScale scale = data_scale(discretisation.scene);
  const bool is_zero = nothing_acts(discretisation, scale);
  if (!is_zero && z.size() > 0 && z.linfty_norm() > round_off_of_data * scale.stress &&
      energy > negligible_energy(discretisation.scene))
    return false;
  z = 0.;
  if (!is_zero && u.linfty_norm() > round_off_of_data * scale.displacement)
    return false;
  u = 0.;
  return true;
}

template double negligible_energy(const Scene<2> &);
template double negligible_energy(const Scene<3> &);
template bool drop_round_off(const Discretisation<2> &, double, Vector<double> &, Vector<double> &);
} // namespace hpvi
