// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/input/expressions.h>

#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/mu_parser_internal.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <muParser.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <regex>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of the coordinates, and of the pressure of contact behind them. */
template <int dim>
using Variables = std::array<double, dim + 1>;

/** muParser for @p text, with the constants and functions of deal.II's FunctionParser. Throws mu::ParserError. */
template <int dim>
void initialise(mu::Parser &parser, const std::string &text,
                const std::map<std::string, double> &constants, const bool knows_pressure,
                Variables<dim> &variables)
{
  for (const auto &[name, value] : constants)
    parser.DefineConst(name, value);
  double *variable = variables.data();
  for (const std::string &name :
       Utilities::split_string_list(FunctionParser<dim>::default_variable_names()))
    parser.DefineVar(name, variable++);
  if (knows_pressure)
    parser.DefineVar("p", variable);
  using namespace internal::FunctionParser;
  const std::vector<std::pair<const char *, double (*)(double)>> functions = {
      {"int", mu_int},     {"ceil", mu_ceil}, {"cot", mu_cot}, {"csc", mu_csc},
      {"floor", mu_floor}, {"sec", mu_sec},   {"log", mu_log}, {"erfc", mu_erfc}};
  for (const auto &[name, function] : functions)
    parser.DefineFun(name, function);
  parser.DefineFun("pow", mu_pow);
  parser.DefineFun("if", mu_if);
  parser.DefineOprt("|", mu_or, 1);
  parser.DefineOprt("&", mu_and, 2);
  // deal.II allows a space behind the name of a function.
  parser.SetExpr(std::regex_replace(text, std::regex("\\s+\\("), "("));
  parser.Eval();
}

/**
 * What muParser says about @p text, empty where it understands it: deal.II's FunctionParser would print five lines to
 * stderr before it throws.
 */
template <int dim>
std::string complaint(const std::string &text, const std::map<std::string, double> &constants,
                      const bool knows_pressure = false)
{
  Variables<dim> variables{};
  mu::Parser parser;
  try
  {
    initialise<dim>(parser, text, constants, knows_pressure, variables);
    return {};
  }
  catch (const mu::ParserError &error)
  {
    return printable(error.GetMsg());
  }
}

bool is_number(const std::string &text, double &value)
{
  char *end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

template <int dim>
std::string message(const std::string &place, const std::string &problem, const Point<dim> &x,
                    const double value, const std::string &remedy)
{
  const std::string shown = std::isnan(value) ? "nan" : to_string(value); // it may have a sign
  return place + ": " + problem + " at " + to_string(x) + ": " + shown + "; " + remedy;
}

unsigned int number_of_this_thread()
{
  static std::atomic<unsigned int> n_threads(0);
  thread_local const unsigned int own = n_threads++;
  return own;
}

/**
 * A function of a point, and of the pressure there where @p knows_pressure. muParser's variables are one thread's at a time: each thread has
 * a parser of its own, and threads beyond sixteen share.
 */
template <int dim>
class ParsedFunction : public Function<dim>
{
public:
  ParsedFunction(const std::string &text, const std::map<std::string, double> &constants,
                 const bool knows_pressure)
      : text(text), constants(constants), knows_pressure(knows_pressure)
  {
  }

  double value(const Point<dim> &x, const unsigned int = 0) const override
  {
    return under_pressure(x, 0);
  }

  double under_pressure(const Point<dim> &x, const double p) const
  {
    const Parser &parser = parsers[number_of_this_thread() % parsers.size()];
    const std::lock_guard<std::mutex> lock(parser.mutex);
    if (!parser.is_made)
      initialise<dim>(parser.function, text, constants, knows_pressure, parser.variables);
    parser.is_made = true;
    for (unsigned int d = 0; d < dim; ++d)
      parser.variables[d] = x[d];
    parser.variables[dim] = p;
    return parser.function.Eval();
  }

private:
  struct Parser
  {
    mutable std::mutex mutex;
    mutable bool is_made = false;
    mutable Variables<dim> variables{};
    mutable mu::Parser function;
  };

  const std::string text;
  const std::map<std::string, double> constants;
  const bool knows_pressure;
  std::array<Parser, 16> parsers;
};

/** Does it say the pressure? */
bool names_pressure(const std::string &text)
{
  static const std::regex pressure("(^|[^A-Za-z0-9_.])p($|[^A-Za-z0-9_(])");
  return std::regex_search(text, pressure);
}

/** @p function, which must be finite wherever it is asked. */
template <int dim>
std::shared_ptr<const Function<dim>> finite(const std::shared_ptr<const Function<dim>> &function,
                                            const std::string &place, const std::string &shown,
                                            const bool has_time)
{
  const auto value = [=](const Point<dim> &x)
  {
    const double result = function->value(x);
    if (!std::isfinite(result))
      throw InputError(message(place, shown + " is not finite", x, result,
                               "give an expression that is finite everywhere it applies"),
                       has_time);
    return result;
  };
  return std::make_shared<ScalarFunctionFromFunctionObject<dim>>(value);
}

/** For messages about values. */
std::string with_time(const std::map<std::string, double> &constants)
{
  const auto t = constants.find("t");
  return t == constants.end() ? "" : " with t = " + to_string(t->second);
}

/** The sign of comparison that begins at @p i; empty where none does. */
std::string comparison_at(const std::string &text, const std::size_t i)
{
  for (const char *const sign : {"<=", ">=", "==", "!=", "<", ">"})
    if (text.compare(i, std::strlen(sign), sign) == 0)
      return sign;
  return {};
}

/** Comparisons in a row, between parentheses or signs that bind less: a < b, or a < b < c. */
struct Comparisons
{
  std::size_t begin = 0; ///< of the operand that is being read
  std::vector<std::string> operands, signs;

  void add(const std::string &text, const std::size_t end)
  {
    operands.push_back(printable(Utilities::trim(text.substr(begin, end - begin))));
  }

  /** As x > 0.4 && x < 0.6 for 0.4 < x < 0.6: what stands in the middle comes first. */
  std::string one_by_one() const
  {
    const std::string &first = signs[0];
    const std::string turned = (first[0] == '<'   ? ">"
                                : first[0] == '>' ? "<"
                                                  : first.substr(0, 1)) +
                               first.substr(1);
    std::string result = operands[1] + " " + turned + " " + operands[0];
    for (std::size_t k = 1; k < signs.size(); ++k)
      result += " && " + operands[k] + " " + signs[k] + " " + operands[k + 1];
    return result;
  }
};

/** The first chain of comparisons in @p text, one by one; empty where there is none. */
std::string unchained(const std::string &text)
{
  std::vector<Comparisons> levels(1); // of parentheses
  for (std::size_t i = 0; i <= text.size(); ++i)
  {
    Comparisons &level = levels.back();
    const char c = i < text.size() ? text[i] : ')';
    if (const std::string sign = comparison_at(text, i); !sign.empty())
    {
      level.add(text, i);
      level.signs.push_back(sign);
      i += sign.size() - 1;
      level.begin = i + 1;
    }
    else if (c == '(')
      levels.push_back({i + 1, {}, {}});
    else if (std::strchr("&|?:,)", c) != nullptr)
    {
      level.add(text, i);
      if (level.signs.size() > 1)
        return level.one_by_one();
      if (c == ')' && levels.size() > 1)
        levels.pop_back();
      else
        level = {i + 1, {}, {}};
    }
  }
  return {};
}

bool is_absent(const std::string &text, const std::string &absent)
{
  double value;
  return absent == "0" ? is_number(text, value) && value == 0. : lower_case(text) == absent;
}
} // namespace

template <int dim>
ExpressionReader<dim>::ExpressionReader(const Parameters &parameters,
                                        std::map<std::string, double> constants,
                                        const std::string &remark)
    : parameters(parameters), constants(std::move(constants)), remark(remark)
{
}

template <int dim>
template <std::size_t n_components>
std::array<typename ExpressionReader<dim>::Expression, n_components>
ExpressionReader<dim>::read(const std::string &section, const std::string &name,
                            const std::string &absent, const std::vector<Point<dim>> &points,
                            const ExactField &exact) const
{
  std::array<Expression, n_components> result;
  if (parameters.text(section, name).empty())
    return result;
  const auto is_exact = [&exact](const std::string &part)
  { return exact && lower_case(part) == "exact"; };
  std::vector<std::string> parts = split_components(parameters.text(section, name));
  if (parts.size() == 1 && is_exact(parts[0]))
    parts.resize(n_components, "exact");
  if (parts.size() != n_components)
    parameters.reject(section, name,
                      "has " + std::to_string(parts.size()) + " component(s) instead of " +
                          std::to_string(n_components) + "; separate components by ';'");
  for (unsigned int c = 0; c < n_components; ++c)
    if (is_exact(parts[c]))
      result[c] = make_exact(section, name, exact, c);
    else if (!is_absent(parts[c], absent))
      result[c] = make_function(section, name, parts[c], points);
  return result;
}

template <int dim>
typename ExpressionReader<dim>::Expression
ExpressionReader<dim>::make_exact(const std::string &section, const std::string &name,
                                  const ExactField &exact, const unsigned int component) const
{
  const Expression result = exact(component);
  if (result == nullptr)
    parameters.reject(section, name,
                      "asks for the exact solution, but the scene has none; set Exact "
                      "solution/Solution or write an expression");
  return result;
}

template <int dim>
typename ExpressionReader<dim>::Expression
ExpressionReader<dim>::make_function(const std::string &section, const std::string &name,
                                     const std::string &text,
                                     const std::vector<Point<dim>> &points) const
{
  double value;
  if (is_number(text, value))
    return std::make_shared<Functions::ConstantFunction<dim>>(value);
  const auto function =
      std::make_shared<const ParsedFunction<dim>>(checked(section, name, text), constants, false);
  const Expression result =
      finite<dim>(function, parameters.place(section, name),
                  "\"" + printable(text) + "\"" + with_time(constants), constants.count("t") > 0);
  for (const Point<dim> &point : points)
    result->value(point);
  return result;
}

template <int dim>
CoefficientByPressure<dim> ExpressionReader<dim>::make_coefficient(const std::string &section,
                                                                   const std::string &name,
                                                                   const std::string &text) const
{
  const auto function =
      std::make_shared<const ParsedFunction<dim>>(checked(section, name, text), constants, true);
  const auto value = [function, place = parameters.place(section, name),
                      shown = "\"" + printable(text) + "\"" + with_time(constants),
                      has_time = constants.count("t") > 0](const Point<dim> &x, const double p)
  {
    const double result = function->under_pressure(x, p);
    if (!std::isfinite(result))
      throw InputError(message(place, shown + " is not finite under p = " + to_string(p), x, result,
                               "give an expression that is finite for every pressure p >= 0, as "
                               "with max(p, ...) where it divides by p"),
                       has_time);
    return result;
  };
  return std::make_shared<const std::function<double(const Point<dim> &, double)>>(value);
}

template <int dim>
FrictionLaw<dim> ExpressionReader<dim>::read_friction(const std::string &section,
                                                      const std::vector<Point<dim>> &points) const
{
  const std::string name = "Friction coefficient", text = parameters.text(section, name),
                    remedy = "Coulomb's coefficient needs mu_f >= 0";
  FrictionLaw<dim> law;
  law.bound = read_bound(section, "Friction bound", points, "Tresca's bound needs g >= 0");
  if (names_pressure(text))
  {
    law.by_pressure = make_coefficient(section, name, text);
    law.coefficient =
        not_negative(std::make_shared<ScalarFunctionFromFunctionObject<dim>>(
                         [mu = law.by_pressure](const Point<dim> &x) { return (*mu)(x, 0.); }),
                     section, name, points, remedy);
  }
  else
    law.coefficient = read_bound(section, name, points, remedy);
  return law;
}

template <int dim>
std::string ExpressionReader<dim>::checked(const std::string &section, const std::string &name,
                                           const std::string &text) const
{
  check_misreadings(section, name, text);
  // Without spaces deal.II's operators & and | are read in their place.
  const std::string spaced = std::regex_replace(text, std::regex("&&|\\|\\|"), " $& ");
  const std::string problem = objection(spaced, name == friction_entries[1]);
  if (!problem.empty())
    parameters.reject(section, name, "\"" + printable(text) + "\" " + problem);
  return spaced;
}

template <int dim>
std::string ExpressionReader<dim>::objection(const std::string &text,
                                             const bool knows_pressure) const
{
  const std::string problem = complaint<dim>(text, constants, knows_pressure);
  if (problem.empty())
    return {};
  if (!knows_pressure && complaint<dim>(text, constants, true).empty())
    return std::string("uses p, the pressure of contact, which Friction coefficient alone knows; "
                       "write a function of ") +
           (dim == 2 ? "x and y" : "x, y and z");
  std::map<std::string, double> with_time = constants;
  const bool has_time = !with_time.emplace("t", 0.).second;
  if (!has_time && complaint<dim>(text, with_time, knows_pressure).empty())
    return std::string("uses t, the time of a load history, and the scene has none; set "
                       "Loading/Steps or write a function of ") +
           (dim == 2 ? "x and y" : "x, y and z");
  std::vector<std::string> variables = {"x", "y", "z"};
  variables.resize(dim);
  if (knows_pressure)
    variables.push_back("p");
  if (has_time)
    variables.push_back("t");
  std::vector<std::string> names;
  for (const auto &[name, value] : constants)
    if (name != "t")
      names.push_back(name);
  return "is not an expression of " + listed(variables, "and") + " (" + problem +
         "); mend it, constants are " + listed(names, "and") + remark;
}

template <int dim>
typename ExpressionReader<dim>::Expression
ExpressionReader<dim>::read_bound(const std::string &section, const std::string &name,
                                  const std::vector<Point<dim>> &points,
                                  const std::string &remedy) const
{
  const Expression g = read<1>(section, name, "0", points)[0];
  return g ? not_negative(g, section, name, points, remedy) : nullptr;
}

template <int dim>
typename ExpressionReader<dim>::Expression
ExpressionReader<dim>::not_negative(const Expression &g, const std::string &section,
                                    const std::string &name, const std::vector<Point<dim>> &points,
                                    const std::string &remedy) const
{
  double largest = 0;
  for (const Point<dim> &point : points)
    largest = std::max(largest, std::abs(g->value(point)));
  const auto value = [g, largest, remedy, place = parameters.place(section, name),
                      problem = "is negative" + with_time(constants),
                      has_time = constants.count("t") > 0](const Point<dim> &x)
  {
    const double result = g->value(x);
    if (result < -1e-12 * largest) // round-off, as in sin(2*pi), is no sign
      throw InputError(message(place, problem, x, result, remedy), has_time);
    return std::max(result, 0.);
  };
  const auto bound = std::make_shared<ScalarFunctionFromFunctionObject<dim>>(value);
  for (const Point<dim> &point : points)
    bound->value(point);
  if (is_constant<dim>(g) && !points.empty())
    return g; // a number, which others recognise
  return bound;
}

template <int dim>
void ExpressionReader<dim>::check_misreadings(const std::string &section, const std::string &name,
                                              const std::string &text) const
{
  if (text.empty())
    parameters.reject(section, name, "has an empty component; write 0 for zero");
  static const std::regex random("\\brand(_seed)?\\b");
  if (std::regex_search(text, random))
    parameters.reject(section, name,
                      "\"" + printable(text) +
                          "\" is random, and equal runs must give equal results; write a function "
                          "of x and y");
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    depth += (text[i] == '(') - (text[i] == ')');
    if (text[i] == ',' && depth == 0) // "4,5" would be two numbers, of which the last counts
      parameters.reject(section, name,
                        "\"" + printable(text) +
                            "\" has a comma outside a function's arguments; write decimals with "
                            "'.' and separate components by ';'");
    const bool comparison = (i > 0 && std::strchr("=<>!", text[i - 1]) != nullptr) ||
                            (i + 1 < text.size() && text[i + 1] == '=');
    if (text[i] == '=' && !comparison) // "x=3" would change x
      parameters.reject(section, name,
                        "\"" + printable(text) +
                            "\" assigns a value; write the expression alone, and == "
                            "to compare");
  }
  // "0.4 < x < 0.6" would compare the 0 or 1 of 0.4 < x with 0.6
  if (const std::string remedy = unchained(text); !remedy.empty())
    parameters.reject(section, name,
                      "\"" + printable(text) +
                          "\" compares the 0 or 1 of one comparison with a number; write " +
                          remedy);
}

template class ExpressionReader<2>;
template std::array<ExpressionReader<2>::Expression, 1>
ExpressionReader<2>::read<1>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<2>> &, const ExactField &) const;
template std::array<ExpressionReader<2>::Expression, 2>
ExpressionReader<2>::read<2>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<2>> &, const ExactField &) const;
template std::array<ExpressionReader<2>::Expression, 3>
ExpressionReader<2>::read<3>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<2>> &, const ExactField &) const;
template std::array<ExpressionReader<2>::Expression, 4>
ExpressionReader<2>::read<4>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<2>> &, const ExactField &) const;
template class ExpressionReader<3>;
template std::array<ExpressionReader<3>::Expression, 1>
ExpressionReader<3>::read<1>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<3>> &, const ExactField &) const;
template std::array<ExpressionReader<3>::Expression, 2>
ExpressionReader<3>::read<2>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<3>> &, const ExactField &) const;
template std::array<ExpressionReader<3>::Expression, 3>
ExpressionReader<3>::read<3>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<3>> &, const ExactField &) const;
template std::array<ExpressionReader<3>::Expression, 6>
ExpressionReader<3>::read<6>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<3>> &, const ExactField &) const;
} // namespace hpvi
