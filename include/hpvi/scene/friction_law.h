// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_law_h
#define hpvi_friction_law_h

#include <hpvi/scene/expression.h>
#include <hpvi/scene/friction_limit.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** What a law makes of a bound and a coefficient. */
enum class FrictionForm
{
  automatic, ///< the one that is given alone: |T_t| <= g of Tresca, |T_t| <= mu_f max(0, p) of Coulomb
  limited, ///< |T_t| <= min(mu_f max(0, p), g): Coulomb's, until the material shears
  cohesive ///< |T_t| <= g + mu_f max(0, p), where unilateral contact is open also
};

/** mu_f(x, p) of pressures p >= 0; null: mu_f(x) for all of them. */
template <int dim>
using CoefficientByPressure =
    std::shared_ptr<const std::function<double(const dealii::Point<dim> &, double)>>;

/** The entries by which messages name a law, in the order in which they are asked about. */
extern const std::vector<std::string> friction_entries;

/**
 * What resists sliding on a contact boundary: `|T_t| <= limit(x, p)` for the pressure p = -T_n. Code sets the
 * functions; everybody else asks what follows from them.
 */
template <int dim>
struct FrictionLaw
{
  Expression<dim> bound;       ///< g(x) >= 0 [stress]; null: none
  Expression<dim> coefficient; ///< mu_f(x) >= 0, of #by_pressure mu_f(x, 0); null: none
  FrictionForm form = FrictionForm::automatic;
  CoefficientByPressure<dim> by_pressure = nullptr; ///< mu_f(x, p) p grows with p and is concave

  explicit operator bool() const; ///< is there any friction, if only on a part?

  /** Does the limit follow the pressure? Then no energy is minimised, and each friction needs a pressure beside it. */
  bool knows_pressure() const;

  /** Is the limit a constant and a multiple of the pressure? */
  bool is_proportional() const;

  FrictionLimit at(const dealii::Point<dim> &x) const;
  double limit(const dealii::Point<dim> &x, double p) const; ///< [stress]
  double slope(const dealii::Point<dim> &x, double p) const; ///< of limit() over p

  /** The functions of the law by themselves, 0 where it has none. */
  double bound_at(const dealii::Point<dim> &x) const;
  double coefficient_at(const dealii::Point<dim> &x) const;

  /** The same law with the functions 1: what acts wherever the boundary is. */
  FrictionLaw everywhere() const;

  std::string name() const;            ///< as in "Coulomb's law"
  std::string entry() const;           ///< one of friction_entries
  std::string entry_to_raise() const;  ///< what gives more friction, for remedies
  std::string limit_in_words() const;  ///< as in "Friction coefficient times the pressure"
  std::string factor_in_words() const; ///< what follows entry() to make the limit, with a blank

  /** An entry that contradicts another or has no sound value at one of some points, and what to say of it. */
  struct Problem
  {
    std::string entry, words;
  };
  std::optional<Problem> problem(const std::vector<dealii::Point<dim>> &points) const;

  /** The same of #by_pressure at @p x for pressures up to @p largest [stress], see FrictionLimit::flaw(). */
  std::optional<Problem> problem(const dealii::Point<dim> &x, double largest) const;
};
} // namespace hpvi

#endif
