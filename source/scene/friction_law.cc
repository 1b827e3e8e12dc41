// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/friction_law.h>

#include <hpvi/base/formatting.h>
#include <hpvi/base/numbers.h>
#include <hpvi/base/text.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

const std::vector<std::string> friction_entries = {"Friction bound", "Friction coefficient",
                                                   "Friction law"};

template <int dim>
FrictionLaw<dim>::operator bool() const
{
  return bound || coefficient;
}

template <int dim>
bool FrictionLaw<dim>::knows_pressure() const
{
  return coefficient != nullptr;
}

template <int dim>
bool FrictionLaw<dim>::is_proportional() const
{
  return form != FrictionForm::limited && !by_pressure;
}

template <int dim>
FrictionLimit FrictionLaw<dim>::at(const Point<dim> &x) const
{
  FrictionLimit result{bound_at(x), coefficient_at(x)};
  if (form == FrictionForm::limited)
    result = {0., coefficient_at(x), bound_at(x)};
  if (by_pressure && result.coefficient > 0.)
    result.relative = [mu = by_pressure, x, at_zero = result.coefficient](const double p)
    { return (*mu)(x, p) / at_zero; };
  return result;
}

template <int dim>
double FrictionLaw<dim>::limit(const Point<dim> &x, const double p) const
{
  return at(x).limit(p);
}

template <int dim>
double FrictionLaw<dim>::slope(const Point<dim> &x, const double p) const
{
  return at(x).slope(p);
}

template <int dim>
double FrictionLaw<dim>::bound_at(const Point<dim> &x) const
{
  return bound ? bound->value(x) : 0.;
}

template <int dim>
double FrictionLaw<dim>::coefficient_at(const Point<dim> &x) const
{
  return coefficient ? coefficient->value(x) : 0.;
}

template <int dim>
FrictionLaw<dim> FrictionLaw<dim>::everywhere() const
{
  FrictionLaw result(*this);
  for (Expression<dim> *function : {&result.bound, &result.coefficient})
    if (*function)
      *function = expression<dim>(1.);
  result.by_pressure = nullptr;
  return result;
}

template <int dim>
std::string FrictionLaw<dim>::name() const
{
  if (form != FrictionForm::automatic)
    return form == FrictionForm::limited ? "limited Coulomb friction" : "cohesive Coulomb friction";
  return by_pressure   ? "Coulomb friction by pressure"
         : coefficient ? "Coulomb's law"
                       : "Tresca's law";
}

template <int dim>
std::string FrictionLaw<dim>::entry() const
{
  if (form != FrictionForm::automatic)
    return "Friction law";
  return coefficient ? "Friction coefficient" : "Friction bound";
}

template <int dim>
std::string FrictionLaw<dim>::entry_to_raise() const
{
  return form == FrictionForm::automatic ? entry() : "Friction bound and Friction coefficient";
}

template <int dim>
std::string FrictionLaw<dim>::limit_in_words() const
{
  if (form != FrictionForm::automatic)
    return "what Friction law allows";
  return entry() + (coefficient ? " times the pressure" : "");
}

template <int dim>
std::string FrictionLaw<dim>::factor_in_words() const
{
  return coefficient && form == FrictionForm::automatic ? "times the pressure " : "";
}

template <int dim>
std::optional<typename FrictionLaw<dim>::Problem>
FrictionLaw<dim>::problem(const std::vector<Point<dim>> &points) const
{
  const bool has_both = bound && coefficient;
  if (has_both && form == FrictionForm::automatic)
    return Problem{"Friction coefficient",
                   "stands beside Friction bound; keep Coulomb's law or Tresca's, or set Friction "
                   "law = limited or cohesive"};
  if (!has_both && form != FrictionForm::automatic)
    return Problem{"Friction law",
                   "takes a bound and a coefficient; give both Friction bound and Friction "
                   "coefficient, or remove it"};
  for (const bool is_bound : {true, false})
    for (const Point<dim> &x : points)
      if (const double value = is_bound ? bound_at(x) : coefficient_at(x);
          !(value >= 0 && std::isfinite(value)))
        return Problem{is_bound ? "Friction bound" : "Friction coefficient",
                       "is " + to_string(value) + " at " + to_string(x) +
                           (is_bound ? "; Tresca's bound needs g >= 0"
                                     : "; Coulomb's coefficient needs mu_f >= 0")};
  return {};
}

template <int dim>
std::optional<typename FrictionLaw<dim>::Problem>
FrictionLaw<dim>::problem(const Point<dim> &x, const double largest) const
{
  if (!by_pressure || !(largest > 0.))
    return {};
  const FrictionLimit limit = FrictionLimit{0., coefficient_at(x), infinity, at(x).relative};
  const auto flaw = limit.flaw(largest);
  if (!flaw)
    return {};
  const auto &[from, to, falls] = *flaw;
  const std::string where =
      " from p = " + text(from, 4) + " to p = " + text(to, 4) + " at " + to_string(x);
  if (falls)
    return Problem{"Friction coefficient",
                   "lets friction mu_f p fall from " + text(limit.limit(from), 4) + " to " +
                       text(limit.limit(to), 4) + where +
                       "; let it stay from there on, as with if(p < " + text(from, 4) + ", mu_f, " +
                       text(limit.limit(from), 4) + "/p)"};
  return Problem{
      "Friction coefficient",
      "lets friction mu_f p bend upwards" + where +
          "; give a mu_f by which mu_f p is concave: it falls with p, and not as a step"};
}

template struct FrictionLaw<2>;
template struct FrictionLaw<3>;
} // namespace hpvi
