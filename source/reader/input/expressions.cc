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
/**
 * What muParser says about @p text, empty where it understands it: the same functions as in deal.II's
 * FunctionParser, which would print five lines to stderr before it throws.
 */
template <int dim>
std::string complaint(const std::string &text, const std::map<std::string, double> &constants)
{
  double zero = 0;
  mu::Parser parser;
  for (const auto &[name, value] : constants)
    parser.DefineConst(name, value);
  for (const std::string &name :
       Utilities::split_string_list(FunctionParser<dim>::default_variable_names()))
    parser.DefineVar(name, &zero);
  for (const char *const name : {"int", "ceil", "cot", "csc", "floor", "sec", "log", "erfc"})
    parser.DefineFun(name, internal::FunctionParser::mu_log);
  parser.DefineFun("pow", internal::FunctionParser::mu_pow);
  parser.DefineFun("if", internal::FunctionParser::mu_if);
  parser.DefineOprt("|", internal::FunctionParser::mu_or, 1);
  parser.DefineOprt("&", internal::FunctionParser::mu_and, 2);
  try
  {
    // deal.II allows a space behind the name of a function.
    parser.SetExpr(std::regex_replace(text, std::regex("\\s+\\("), "("));
    parser.Eval();
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

/** deal.II's parser has a lock for each value, which threads would hand to one another: each of them has a parser of its own here. */
template <int dim>
class ParserByThread : public Function<dim>
{
public:
  ParserByThread(const std::string &text, const std::map<std::string, double> &constants)
      : text(text), constants(constants)
  {
  }

  double value(const Point<dim> &x, const unsigned int = 0) const override
  {
    static std::atomic<unsigned int> n_threads(0);
    thread_local const unsigned int own = n_threads++;
    const Parser &parser = parsers[own % parsers.size()]; // two threads may share one
    std::call_once(parser.is_made,
                   [&]()
                   {
                     parser.function = std::make_unique<FunctionParser<dim>>(1);
                     parser.function->initialize(FunctionParser<dim>::default_variable_names(),
                                                 text, constants);
                   });
    return parser.function->value(x);
  }

private:
  struct Parser
  {
    mutable std::once_flag is_made;
    mutable std::unique_ptr<FunctionParser<dim>> function;
  };

  const std::string text;
  const std::map<std::string, double> constants;
  std::array<Parser, 16> parsers;
};

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
  check_misreadings(section, name, text);
  // Without spaces deal.II's operators & and | are read in their place.
  const std::string spaced = std::regex_replace(text, std::regex("&&|\\|\\|"), " $& ");
  const std::string problem = objection(spaced);
  if (!problem.empty())
    parameters.reject(section, name, "\"" + printable(text) + "\" " + problem);
  const auto function = std::make_shared<const ParserByThread<dim>>(spaced, constants);
  const Expression result =
      finite<dim>(function, parameters.place(section, name),
                  "\"" + printable(text) + "\"" + with_time(constants), constants.count("t") > 0);
  for (const Point<dim> &point : points)
    result->value(point);
  return result;
}

template <int dim>
std::string ExpressionReader<dim>::objection(const std::string &text) const
{
  const std::string problem = complaint<dim>(text, constants);
  if (problem.empty())
    return {};
  std::map<std::string, double> with_time = constants;
  const bool has_time = !with_time.emplace("t", 0.).second;
  if (!has_time && complaint<dim>(text, with_time).empty())
    return std::string("uses t, the time of a load history, and the scene has none; set "
                       "Loading/Steps or write a function of ") +
           (dim == 2 ? "x and y" : "x, y and z");
  const std::string variables = dim == 2 ? (has_time ? "x, y and t" : "x and y")
                                         : (has_time ? "x, y, z and t" : "x, y and z");
  std::vector<std::string> names;
  for (const auto &[name, value] : constants)
    if (name != "t")
      names.push_back(name);
  return "is not an expression of " + variables + " (" + problem + "); mend it, constants are " +
         listed(names, "and") + remark;
}

template <int dim>
typename ExpressionReader<dim>::Expression
ExpressionReader<dim>::read_bound(const std::string &section, const std::string &name,
                                  const std::vector<Point<dim>> &points,
                                  const std::string &remedy) const
{
  const Expression g = read<1>(section, name, "0", points)[0];
  if (g == nullptr)
    return nullptr;
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
template std::array<ExpressionReader<3>::Expression, 3>
ExpressionReader<3>::read<3>(const std::string &, const std::string &, const std::string &,
                             const std::vector<Point<3>> &, const ExactField &) const;
} // namespace hpvi
