// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/face_contact.h>

#include <algorithm>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
Slip slip_of(const ContactFace<2> &face, const Solution<2> &solution)
{
  unsigned int n_forward = 0, n_backward = 0, n_free = 0;
  for (unsigned int k = 0; k < face.n_multipliers; ++k)
  {
    const unsigned int i = face.first_multiplier + k;
    const double slip = slip_at(i, solution.z, solution.contact_space);
    n_forward += slip > 0.;
    n_backward += slip < 0.;
    n_free += solution.contact_space.multipliers()[i].friction.vanishes();
  }
  Slip result;
  if (n_forward + n_backward + n_free == 0 && face.n_multipliers > 0)
    result.mode = Slip::nowhere;
  else if (std::max(n_forward, n_backward) + n_free < face.n_multipliers)
    result.mode = Slip::partly;
  if (n_forward == 0 || n_backward == 0)
    result.direction = n_forward > 0 ? 1. : n_backward > 0 ? -1. : 0.;
  return result;
}
} // namespace

std::vector<Slip> slips_of(const Solution<2> &solution)
{
  std::vector<Slip> result;
  for (const ContactFace<2> &face : solution.contact_space.faces())
    result.push_back(slip_of(face, solution));
  return result;
}

std::vector<unsigned int> faces_beside(const unsigned int face, const unsigned int reach,
                                       const std::vector<ContactFace<2>> &faces)
{
  std::vector<unsigned int> result;
  for (unsigned int other = face < reach ? 0 : face - reach;
       other < std::min<std::size_t>(face + reach + 1, faces.size()); ++other)
    if (other != face && faces[other].condition == faces[face].condition)
      result.push_back(other);
  return result;
}

void free_neighbours(std::vector<Slip> &slips, const std::vector<ContactFace<2>> &faces)
{
  const std::vector<Slip> discrete(slips);
  for (unsigned int k = 0; k < slips.size(); ++k)
    for (const unsigned int other : faces_beside(k, 1, faces))
      if (discrete[k].mode == Slip::nowhere && discrete[other].is_directed_everywhere())
      {
        const bool is_between = slips[k].direction * discrete[other].direction < 0.;
        slips[k] = {Slip::partly, is_between ? 0. : discrete[other].direction};
      }
}

double Opening::gap(const EdgePolynomial &rest) const
{
  const std::vector<double> pi = pressure.coefficients(), r = rest.coefficients();
  return -0.5 *
         std::inner_product(pi.begin(), pi.begin() + std::min(pi.size(), r.size()), r.begin(), 0.);
}

Opening opening_of(const unsigned int number, const Solution<2> &solution,
                   const Unknowns<2> &unknowns, const AdmissiblePressure<2> &pressure,
                   const LegendreTables &tables)
{
  const ContactFace<2> &face = solution.contact_space.faces()[number];
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

void free_neighbours(std::vector<std::optional<Opening>> &openings,
                     const std::vector<ContactFace<2>> &faces)
{
  std::vector<bool> is_open;
  for (const auto &opening : openings)
    is_open.push_back(opening && opening->mode == Opening::open);
  for (unsigned int k = 0; k < openings.size(); ++k)
    for (const unsigned int other : faces_beside(k, 1, faces))
      if (is_open[other] && openings[k] && openings[k]->mode == Opening::closed)
        openings[k]->mode = Opening::partly;
}

double friction_gap(const ContactFace<2> &face, const EdgePolynomial &v,
                    const ShapeTables<2> &tables, const std::function<double(double)> &l)
{
  if (face.friction.vanishes())
    return 0.;
  std::vector<double> cuts = v.zeros();
  cuts.insert(cuts.end(), face.friction.cuts.begin(), face.friction.cuts.end());
  std::sort(cuts.begin(), cuts.end());
  // l* has degree p + 5, v up to p + 8; the rest is for g.
  const QGauss<1> &gauss = tables.gauss(face.degree + 8);
  double result = 0;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = cuts[k + 1] - cuts[k], s = cuts[k] + width * gauss.point(q)[0];
      const double value = v(s);
      // One difference at a time: where l is the direction of v, nothing is left, not even round-off.
      const double density = std::abs(value) * (l ? 1. - (value < 0. ? -1. : 1.) * l(s) : 1.);
      if (density != 0.)
        result += face.length * width * gauss.weight(q) * density * face.limit_at(s);
    }
  return result;
}
} // namespace hpvi
