// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/bound/contact_correction.h>
#include <hpvi/bound/correction_search.h>

#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
ContactCorrection<dim>::ContactCorrection(const Solution<dim> &solution,
                                          const Discretisation<dim> &discretisation,
                                          const AdmissibleFriction<dim> &friction,
                                          const AdmissiblePressure<dim> &pressure,
                                          EdgeBubbles *const bubbles)
{
  const CorrectionSearch<dim> search(solution, discretisation, friction, pressure, bubbles);
  typename CorrectionSearch<dim>::Candidate best = search.nothing();
  uncorrected = best.gaps;
  best = search.best(std::move(best));
  depth = best.penetration;
  jump = best.opening;
  face_gaps = std::move(best.gaps);
  w = std::move(best.w);
  cell_energies = search.energies(w);
  for (unsigned int face = 0; face < face_gaps.size(); ++face)
  {
    slips.push_back(search.slip(face, w));
    penetrations.push_back(search.penetration_along(face, w));
  }
}

template <int dim>
const EdgePolynomial &ContactCorrection<dim>::slip(const unsigned int face) const
{
  return slips[face];
}

template <int dim>
const EdgePolynomial &ContactCorrection<dim>::penetration_along(const unsigned int face) const
{
  return penetrations[face];
}

template <int dim>
const std::vector<double> &ContactCorrection<dim>::gap() const
{
  return face_gaps;
}

template <int dim>
const std::vector<double> &ContactCorrection<dim>::uncorrected_gap() const
{
  return uncorrected;
}

template <int dim>
const std::vector<double> &ContactCorrection<dim>::energy() const
{
  return cell_energies;
}

template <int dim>
double ContactCorrection<dim>::penetration() const
{
  return depth;
}

template <int dim>
double ContactCorrection<dim>::opening() const
{
  return jump;
}

template <int dim>
const Vector<double> &ContactCorrection<dim>::unknowns() const
{
  return w;
}

template <int dim>
double ContactCorrection<dim>::total() const
{
  return 2. * sum(face_gaps) + sum(cell_energies);
}

template <int dim>
double energy_change(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
                     const Vector<double> &v)
{
  const Vector<double> all = discretisation.unknowns.expand(v);
  double result = BorderedMatrix{discretisation.system.A, {}}.energy(v) / 2. -
                  solution.z * solution.spaces->contact_operator.moments(all);
  Vector<double> moved(solution.u);
  moved += all;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
  {
    const auto work = [&](const Vector<double> &u)
    {
      return friction_gap(face, slip_trace(face, solution.displacement_space, solution.tables, u),
                          solution.tables);
    };
    result += work(moved) - work(solution.u);
  }
  return result;
}

template class ContactCorrection<2>;
template double energy_change(const Solution<2> &, const Discretisation<2> &,
                              const Vector<double> &);
} // namespace hpvi
