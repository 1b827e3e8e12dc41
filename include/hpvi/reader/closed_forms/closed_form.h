// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_closed_form_h
#define hpvi_closed_form_h

#include <hpvi/reader/input/parameters.h>
#include <hpvi/scene/exact_solution.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/** What a file says of its exact solution, and what that depends on. */
struct ClosedFormData
{
  const Parameters &parameters;
  const Material &material;
  std::string boundary;                            ///< section of the boundary that is y = 0
  std::function<double()> constant_friction_bound; ///< g along it; NaN where it varies

  double number(const std::string &entry) const; ///< of the section `Exact solution`

  /** Rejects another Contact than @p contact there. */
  void require_contact(const std::string &contact) const;

  /** g, rejected where it varies or @p is_sound is false of it. */
  double require_friction_bound(const std::function<bool(double)> &is_sound) const;
};

/** One value of `Exact solution/Solution`. */
struct ClosedForm
{
  std::string name;
  std::string documentation; ///< sentences for the entry, which begin with the name
  std::function<std::shared_ptr<const ExactSolution<2>>(const ClosedFormData &)> read;
};

/** All that a file may name: the one list of them. */
const std::vector<ClosedForm> &closed_forms();

/** The section `Exact solution`. */
std::vector<Entry> closed_form_entries();
} // namespace hpvi

#endif
