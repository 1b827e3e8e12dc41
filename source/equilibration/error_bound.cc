// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/equilibration/admissible_friction.h>
#include <hpvi/equilibration/data_error.h>
#include <hpvi/equilibration/error_bound.h>
#include <hpvi/equilibration/slip_correction.h>

#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

std::vector<double> ErrorBound::indicators() const
{
  std::vector<double> result;
  for (const double square : squares)
    result.push_back(std::sqrt(square));
  return result;
}

ErrorBound ErrorBounds::compute(const Solution<2> &solution,
                                const Discretisation<2> &discretisation)
{
  const AdmissibleFriction<2> friction(solution);
  const EquilibratedStress stress(
      solution,
      [&](const unsigned int face, const unsigned int end)
      { return friction.part(face, end).coefficients(); },
      cache);
  const SlipCorrection<2> correction(solution, discretisation, friction);
  const DataError data(solution, stress);

  const auto sum = [](const std::vector<double> &values)
  { return std::accumulate(values.begin(), values.end(), 0.); };
  ErrorBound result;
  result.squares.resize(stress.squares.size());
  double oscillation = 0;
  for (unsigned int cell = 0; cell < result.squares.size(); ++cell)
  {
    result.squares[cell] = std::pow(std::sqrt(stress.squares[cell]) + data.oscillation[cell], 2) +
                           correction.energy()[cell];
    oscillation += data.oscillation[cell] * data.oscillation[cell];
  }
  const auto &faces = solution.contact_space.faces();
  for (unsigned int face = 0; face < faces.size(); ++face)
    result.squares[faces[face].cell->active_cell_index()] += 2 * correction.gap()[face];

  const double eta_square = sum(stress.squares), gap = sum(correction.gap()),
               w = std::sqrt(sum(correction.energy()));
  result.stress = std::sqrt(eta_square);
  result.slip = std::sqrt(2 * gap + w * w);
  result.oscillation = std::sqrt(oscillation);
  result.data = data.lift;
  result.total = result.oscillation + std::sqrt(eta_square + 2 * gap +
                                                std::pow(w + result.data + result.oscillation, 2));
  result.energy = std::pow(result.stress + result.data + result.oscillation, 2) / 2 +
                  sum(correction.uncorrected_gap());
  result.imbalance = stress.defect;
  return result;
}
} // namespace hpvi
