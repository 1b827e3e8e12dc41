// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/bound/pressure_neighbourhoods.h>
#include <hpvi/solvers/inequality_program.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Negative pressures that are taken for round-off, relative to the largest pressure. */
constexpr double round_off = 1e-13;

/** What pressures of some faces have to have in common with z_n. */
enum class Balance
{
  force_and_moment, ///< of each patch
  force             ///< of all
};

/** The program that neighbouring faces share. */
class NeighbourhoodProgram
{
public:
  NeighbourhoodProgram(std::vector<PressedFace *> faces, double scale);

  bool solve(Balance balance); ///< set t of the faces; false: there are none

private:
  InequalityProgram start() const;
  bool add_balance(InequalityProgram &program) const;
  bool add_force(InequalityProgram &program) const;
  bool add_rims(InequalityProgram &program) const;
  void add_bound(unsigned int face, double s, InequalityProgram &program) const;
  unsigned int unknown(const unsigned int face, const unsigned int end) const
  {
    return first[face] + end * faces[face]->n;
  }

  const std::vector<PressedFace *> faces;
  const double scale;
  std::vector<unsigned int> first;
};

NeighbourhoodProgram::NeighbourhoodProgram(std::vector<PressedFace *> some_faces,
                                           const double scale)
    : faces(std::move(some_faces)), scale(scale), first{0}
{
  for (const PressedFace *face : faces)
    first.push_back(first.back() + 2 * face->n);
}

InequalityProgram NeighbourhoodProgram::start() const
{
  FullMatrix<double> H(first.back(), first.back());
  Vector<double> h(first.back());
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; end < 2; ++end)
      for (unsigned int i = 0; i < faces[k]->n; ++i)
      {
        const double weight = faces[k]->weight * faces[k]->length;
        H(unknown(k, end) + i, unknown(k, end) + i) = weight;
        h[unknown(k, end) + i] =
            weight * faces[k]->wanted[end][i] - faces[k]->length * faces[k]->openness[i];
      }
  return InequalityProgram(H, h);
}

/** Force and moment at each vertex, over the faces of the neighbourhood. */
bool NeighbourhoodProgram::add_balance(InequalityProgram &program) const
{
  std::map<unsigned int, std::array<Vector<double>, 2>> rows;
  std::map<unsigned int, std::array<double, 2>> values;
  const double origin = faces[0]->origin, unit = std::abs(faces[0]->step);
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; end < 2; ++end)
    {
      const PressedFace &face = *faces[k];
      auto &[force, moment] = rows[face.vertices[end]];
      auto &[of_force, of_moment] = values[face.vertices[end]];
      if (force.size() == 0)
      {
        force.reinit(first.back());
        moment.reinit(first.back());
      }
      const double offset = (face.origin - origin) / unit, step = face.step / unit;
      const unsigned int i = unknown(k, end);
      force[i] = face.length / unit * mean_factor;
      moment[i] = face.length / unit * (offset + step / 2) * mean_factor;
      moment[i + 1] = face.length / unit * step / 2 * slope_factor;
      of_force += face.force[end] / unit;
      of_moment += (offset * face.force[end] + step * face.moment[end]) / unit;
    }
  for (const auto &[vertex, row] : rows)
    for (unsigned int k = 0; k < 2; ++k)
      if (!program.add_equality(row[k], values[vertex][k]))
        return false;
  return true;
}

/** The force of all faces, and `t_a = psi_a pi`: `s t_0 = (1 - s) t_1` at as many points as that has coefficients. */
bool NeighbourhoodProgram::add_force(InequalityProgram &program) const
{
  Vector<double> force(first.back());
  double of_force = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; end < 2; ++end)
    {
      force[unknown(k, end)] = mean_factor * faces[k]->length / faces[0]->length;
      of_force += faces[k]->force[end] / faces[0]->length;
    }
  if (!program.add_equality(force, std::max(0., of_force)))
    return false;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int i = 0, n = faces[k]->n; i <= n; ++i)
    {
      const double s = 0.5 - 0.5 * std::cos(numbers::PI * i / n);
      const Vector<double> L = legendre_basis(n, s);
      Vector<double> row(first.back());
      for (unsigned int j = 0; j < n; ++j)
      {
        row[unknown(k, 0) + j] = s * L[j];
        row[unknown(k, 1) + j] = (s - 1.) * L[j];
      }
      if (!program.add_equality(row, 0.))
        return false;
    }
  return true;
}

/** A skew face has no traction at the rim of a patch, where the shear would have to follow it. */
bool NeighbourhoodProgram::add_rims(InequalityProgram &program) const
{
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int end = 0; faces[k]->is_skew && end < 2; ++end)
    {
      const Vector<double> L = legendre_basis(faces[k]->n, 1. - end);
      Vector<double> row(first.back());
      std::copy(L.begin(), L.end(), row.begin() + unknown(k, end));
      if (!program.add_equality(row, 0.))
        return false;
    }
  return true;
}

/** pi(s) >= 0 */
void NeighbourhoodProgram::add_bound(const unsigned int face, const double s,
                                     InequalityProgram &program) const
{
  const Vector<double> L = legendre_basis(faces[face]->n, s);
  Vector<double> row(first.back());
  for (unsigned int end = 0; end < 2; ++end)
    std::copy(L.begin(), L.end(), row.begin() + unknown(face, end));
  program.add_inequality(row, 0.);
}

bool NeighbourhoodProgram::solve(const Balance balance)
try
{
  InequalityProgram program = start();
  if (balance == Balance::force ? !add_force(program) : !add_balance(program) || !add_rims(program))
    return false;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (unsigned int i = 0, n = 2 * faces[k]->n; i <= n; ++i)
      add_bound(k, 0.5 - 0.5 * std::cos(numbers::PI * i / n), program);
  // As in AdmissibleFriction, extremes that stand out become points as well.
  bool stands_out = true;
  for (unsigned int round = 0; stands_out && round < 30; ++round)
  {
    if (!program.solve())
      return false;
    stands_out = false;
    for (unsigned int k = 0; k < faces.size(); ++k)
    {
      for (unsigned int end = 0; end < 2; ++end)
        std::copy_n(program.minimiser().begin() + unknown(k, end), faces[k]->n,
                    faces[k]->t[end].begin());
      const EdgePolynomial pi = faces[k]->pressure();
      for (const double s : pi.extremes())
        if (pi(s) < -0.1 * round_off * scale)
        {
          stands_out = true;
          add_bound(k, s, program);
        }
    }
  }
  return std::all_of(faces.begin(), faces.end(),
                     [&](const PressedFace *face) { return face->least() >= -round_off * scale; });
}
catch (const NumericalFailure &)
{
  return false;
}

/** Neighbouring faces that are solved for as one; numbers along the boundary. */
struct Neighbourhood
{
  unsigned int first, last;
  bool is_solved = false;
};

/** All faces, and the neighbourhoods of those on which z_n is negative somewhere. */
class Neighbourhoods
{
public:
  Neighbourhoods(std::map<unsigned int, PressedFace> &faces, double scale);

  bool solve(); ///< false: a face has no admissible pressure

private:
  bool are_neighbours(unsigned int k) const;
  bool solve(const Neighbourhood &neighbourhood);
  bool redistribute(Neighbourhood &neighbourhood);
  bool grow(Neighbourhood &neighbourhood) const;
  void merge();

  std::map<unsigned int, PressedFace> &faces; ///< by their number
  const double scale;
  std::vector<Neighbourhood> all;
};

Neighbourhoods::Neighbourhoods(std::map<unsigned int, PressedFace> &faces, const double scale)
    : faces(faces), scale(scale)
{
  for (const auto &[k, face] : faces)
    if (face.least() < -round_off * scale)
      all.push_back({k, k});
}

/** Are faces k and k + 1 two of one straight boundary with a common vertex? */
bool Neighbourhoods::are_neighbours(const unsigned int k) const
{
  const auto one = faces.find(k), other = faces.find(k + 1);
  if (one == faces.end() || other == faces.end() || one->second.boundary != other->second.boundary)
    return false;
  for (const unsigned int vertex : one->second.vertices)
    for (const unsigned int same : other->second.vertices)
      if (vertex == same)
        return true;
  return false;
}

bool Neighbourhoods::solve(const Neighbourhood &neighbourhood)
{
  std::vector<PressedFace *> members;
  for (unsigned int k = neighbourhood.first; k <= neighbourhood.last; ++k)
  {
    members.push_back(&faces.at(k));
    members.back()->is_balanced = true;
  }
  return NeighbourhoodProgram(members, scale).solve(Balance::force_and_moment);
}

/**
 * No pressure has the moment of a force that stands in a corner. So each face on which z_n is negative
 * keeps its force alone, and the neighbourhood shrinks to these.
 */
bool Neighbourhoods::redistribute(Neighbourhood &neighbourhood)
{
  Neighbourhood rest{neighbourhood.last, neighbourhood.first, true};
  for (unsigned int k = neighbourhood.first; k <= neighbourhood.last; ++k)
  {
    PressedFace &face = faces.at(k);
    face.take_own_parts();
    if (face.least() >= -round_off * scale)
      continue;
    if (!NeighbourhoodProgram({&face}, scale).solve(Balance::force))
      return false;
    face.is_balanced = false;
    rest.first = std::min(rest.first, k);
    rest.last = k;
  }
  neighbourhood = rest;
  return true;
}

bool Neighbourhoods::grow(Neighbourhood &neighbourhood) const
{
  constexpr unsigned int largest = 12;
  if (neighbourhood.last - neighbourhood.first >= largest)
    return false;
  const bool before = neighbourhood.first > 0 && are_neighbours(neighbourhood.first - 1),
             behind = are_neighbours(neighbourhood.last);
  neighbourhood.first -= before;
  neighbourhood.last += behind;
  return before || behind;
}

/** One of two that overlap, to be solved anew. */
void Neighbourhoods::merge()
{
  std::vector<Neighbourhood> merged;
  for (const Neighbourhood &next : all)
    if (!merged.empty() && next.first <= merged.back().last)
      merged.back() = {std::min(merged.back().first, next.first),
                       std::max(merged.back().last, next.last)};
    else
      merged.push_back(next);
  all = merged;
}

bool Neighbourhoods::solve()
{
  while (
      std::any_of(all.begin(), all.end(), [](const Neighbourhood &one) { return !one.is_solved; }))
  {
    for (Neighbourhood &one : all)
      if (!one.is_solved)
      {
        one.is_solved = solve(one);
        if (!one.is_solved && !grow(one) && !redistribute(one))
          return false;
      }
    merge();
  }
  return true;
}
} // namespace

bool press(std::map<unsigned int, PressedFace> &faces, const double scale)
{
  return Neighbourhoods(faces, scale).solve();
}
} // namespace hpvi
