// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/closed_forms/closed_form.h>
#include <hpvi/reader/closed_forms/hertz.h>
#include <hpvi/reader/closed_forms/partial_slip.h>
#include <hpvi/reader/closed_forms/smooth.h>
#include <hpvi/reader/closed_forms/stick_slip.h>

#include <deal.II/base/patterns.h>

#include <limits>

namespace hpvi
{
using namespace dealii;

const std::vector<ClosedForm> &closed_forms()
{
  static const std::vector<ClosedForm> all{stick_slip_form(), smooth_form(), hertz_form(),
                                           partial_slip_form()};
  return all;
}

namespace
{
const std::string section = "Exact solution";
} // namespace

double ClosedFormData::number(const std::string &entry) const
{
  return parameters.number(section, entry);
}

void ClosedFormData::require_contact(const std::string &contact) const
{
  if (parameters.text(boundary, "Contact") != contact)
    parameters.reject(boundary, "Contact",
                      "is not that of Exact solution/Solution = " +
                          parameters.text(section, "Solution") + "; set Contact = " + contact);
}

double ClosedFormData::require_friction_bound(const std::function<bool(double)> &is_sound) const
{
  const double bound = constant_friction_bound();
  if (!is_sound(bound))
    parameters.reject(boundary, "Friction bound",
                      "must be a positive constant for Exact solution/Solution = " +
                          parameters.text(section, "Solution") +
                          "; give a number, and Contact = bilateral");
  return bound;
}

std::vector<Entry> closed_form_entries()
{
  std::string
      pattern = "none",
      documentation =
          "A closed form to measure errors against, for a body above the contact edge y = 0; "
          "boundaries take it by the word `exact`.";
  std::vector<std::string> names{"none"};
  for (const ClosedForm &form : closed_forms())
  {
    pattern += "|" + form.name;
    names.push_back(form.name);
    documentation += " " + form.documentation;
  }
  const auto number = std::make_shared<Patterns::Double>();
  const auto positive = std::make_shared<Patterns::Double>(std::numeric_limits<double>::min());
  return {{section, "Solution", "none", std::make_shared<Patterns::Selection>(pattern),
           listed(names, "or"), documentation},
          {section, "Transition", "0", number, "a number",
           "Where stick meets slip on y = 0 (smooth: the origin of s; hertz, partial-slip: the "
           "centre of the contact) [length]."},
          {section, "Length", "1", positive, "a positive number",
           "The length L over which the exact solution varies (hertz, partial-slip: half the width "
           "of the contact) [length]."},
          {section, "Pressure", "1", positive, "a positive number",
           "hertz: the largest pressure p_0; partial-slip: the largest friction bound [stress]."},
          {section, "Stick length", "0.5", positive, "a positive number",
           "partial-slip: half the length of the stick zone, below Length [length]."}};
}
} // namespace hpvi
