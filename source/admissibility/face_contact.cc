// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/admissibility/face_contact.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
Slip slip_of(const ContactFace<dim> &face, const Solution<dim> &solution)
{
  unsigned int n_forward = 0, n_backward = 0;
  for (unsigned int k = 0; k < face.n_multipliers; ++k)
  {
    const unsigned int i = face.first_multiplier + k;
    const double wall = (1. - 1e-10) * solution.contact_space.multipliers()[i].bound;
    n_forward += solution.z[i] >= wall;
    n_backward += solution.z[i] <= -wall;
  }
  Slip result;
  if (n_forward == 0 && n_backward == 0 && face.n_multipliers > 0)
    result.mode = Slip::nowhere;
  else if (n_forward < face.n_multipliers && n_backward < face.n_multipliers)
    result.mode = Slip::partly;
  if (n_forward == 0 || n_backward == 0)
    result.direction = n_forward > 0 ? 1. : n_backward > 0 ? -1. : 0.;
  return result;
}
} // namespace

template <int dim>
std::vector<Slip> slips_of(const Solution<dim> &solution)
{
  std::vector<Slip> result;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    result.push_back(slip_of(face, solution));
  return result;
}

void free_neighbours(std::vector<Slip> &slips)
{
  const std::vector<Slip> discrete(slips);
  for (unsigned int k = 0; k + 1 < slips.size(); ++k)
    for (const auto &[one, other] : {std::pair(k, k + 1), std::pair(k + 1, k)})
      if (discrete[one].mode == Slip::nowhere && discrete[other].is_directed_everywhere())
        slips[one] = {Slip::partly, discrete[other].direction};
}

double Opening::gap(const EdgePolynomial &rest) const
{
  const std::vector<double> pi = pressure.coefficients(), r = rest.coefficients();
  return -0.5 *
         std::inner_product(pi.begin(), pi.begin() + std::min(pi.size(), r.size()), r.begin(), 0.);
}

template <int dim>
Opening opening_of(const unsigned int number, const Solution<dim> &solution,
                   const Unknowns<dim> &unknowns, const AdmissiblePressure<dim> &pressure,
                   const LegendreTables &tables)
{
  const ContactFace<dim> &face = solution.contact_space.faces()[number];
  unsigned int n_pressing = 0;
  for (const unsigned int i : face.pressures)
    n_pressing += solution.z[i] > 0.;
  Opening result{
      n_pressing == 0                      ? Opening::open
      : n_pressing < face.pressures.size() ? Opening::partly
                                           : Opening::closed,
      trace_of(face, face.frame(0.5).normal, solution, unknowns, tables.from_nodes(face.degree)),
      pressure.value(number)};
  const std::vector<double> gap = gap_at_nodes(face, solution.tables, tables).coefficients();
  for (unsigned int i = 0; i < gap.size(); ++i)
    result.penetration.u[i] -= gap[i];
  return result;
}

void free_neighbours(std::vector<std::optional<Opening>> &openings)
{
  std::vector<bool> is_open;
  for (const auto &opening : openings)
    is_open.push_back(opening && opening->mode == Opening::open);
  for (unsigned int k = 0; k < openings.size(); ++k)
    if (openings[k] && openings[k]->mode == Opening::closed &&
        ((k > 0 && is_open[k - 1]) || (k + 1 < is_open.size() && is_open[k + 1])))
      openings[k]->mode = Opening::partly;
}

template std::vector<Slip> slips_of(const Solution<2> &);
template Opening opening_of(unsigned int, const Solution<2> &, const Unknowns<2> &,
                            const AdmissiblePressure<2> &, const LegendreTables &);
} // namespace hpvi
