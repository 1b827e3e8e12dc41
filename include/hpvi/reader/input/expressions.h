// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_expressions_h
#define hpvi_expressions_h

#include <hpvi/reader/input/parameters.h>
#include <hpvi/scene/friction_law.h>

#include <deal.II/base/function.h>
#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * Turns the text of an entry into functions and tries each of them on the part of the body where it
 * will be used. What it cannot see there, a pole or a negative bound between the points, is an
 * InputError with entry, point and value wherever the function is asked for it.
 */
template <int dim>
class ExpressionReader
{
public:
  using Expression = std::shared_ptr<const dealii::Function<dim>>;

  /** Names and values of what an expression may use beside its coordinates; `t` is the time in a load history. */
  /** @p remark ends messages about names that are not among them. */
  ExpressionReader(const Parameters &parameters, std::map<std::string, double> constants,
                   const std::string &remark = "");

  /** Gives a component of the exact solution's field; null if the scene has no such solution. */
  using ExactField = std::function<Expression(unsigned int component)>;

  /**
   * One function per component; null where the text is @p absent (`free`, or a zero that needs
   * no integration) and everywhere if the entry is empty. With @p exact, the word `exact` stands
   * for a component of that field, or for all of them if it stands alone.
   */
  template <std::size_t n_components>
  std::array<Expression, n_components>
  read(const std::string &section, const std::string &name, const std::string &absent,
       const std::vector<dealii::Point<dim>> &points, const ExactField &exact = {}) const;

  /** Friction bound and Friction coefficient, null where they are empty or zero, without Friction law. */
  FrictionLaw<dim> read_friction(const std::string &section,
                                 const std::vector<dealii::Point<dim>> &points) const;

private:
  Expression make_exact(const std::string &section, const std::string &name,
                        const ExactField &exact, unsigned int component) const;
  /** One function, null where the entry is empty or zero, and nowhere negative, @p remedy says why. */
  Expression read_bound(const std::string &section, const std::string &name,
                        const std::vector<dealii::Point<dim>> &points,
                        const std::string &remedy) const;
  /** @p function, which must be 0 or more wherever it is asked. */
  Expression not_negative(const Expression &function, const std::string &section,
                          const std::string &name, const std::vector<dealii::Point<dim>> &points,
                          const std::string &remedy) const;
  /** A Friction coefficient that says `p`. */
  CoefficientByPressure<dim> make_coefficient(const std::string &section, const std::string &name,
                                              const std::string &text) const;
  Expression make_function(const std::string &section, const std::string &name,
                           const std::string &text,
                           const std::vector<dealii::Point<dim>> &points) const;
  /** What is wrong with @p text, as far as the parser can tell: the end of a message. */
  std::string objection(const std::string &text, bool knows_pressure) const;
  /** @p text as the parser takes it; refused what that takes without complaint, but not as it is meant, and all else. */
  std::string checked(const std::string &section, const std::string &name,
                      const std::string &text) const;
  void check_misreadings(const std::string &section, const std::string &name,
                         const std::string &text) const;

  const Parameters &parameters;
  const std::map<std::string, double> constants; ///< t among them, in a load history
  const std::string remark;
};
} // namespace hpvi

#endif
