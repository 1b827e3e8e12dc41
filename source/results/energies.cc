// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/base/processes.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/energies.h>
#include <hpvi/results/equilibrium.h>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * The points in (0,1) where a function of one variable vanishes, as far as its samples show. Between samples of one sign its
 * least magnitude is looked for, lest two zeros that are close to each other are missed.
 */
template <class F>
std::vector<double> zeros(const F &function, const unsigned int n_samples)
{
  std::vector<std::pair<double, double>> samples; // a point and the value there
  const auto sample = [&](const double s) { return std::pair<double, double>(s, function(s)); };
  const auto has_sign = [](const double value) { return (value > 0.) - (value < 0.); };
  for (unsigned int k = 0; k <= n_samples; ++k)
    samples.push_back(sample(static_cast<double>(k) / n_samples));
  for (unsigned int k = 0; k <= n_samples; ++k)
  {
    const auto &[left, f_left] = samples[k == 0 ? 1 : k - 1];
    const auto &[right, f_right] = samples[k == n_samples ? k - 1 : k + 1];
    const double sign = has_sign(f_left), f = sign * samples[k].second;
    if (sign * f_right > 0 && f < sign * f_left && f <= sign * f_right)
      samples.push_back(sample(
          boost::math::tools::brent_find_minima([&](const double s) { return sign * function(s); },
                                                std::min(samples[k].first, left),
                                                std::max(samples[k].first, right), 24)
              .first));
  }
  std::sort(samples.begin(), samples.end());
  std::vector<double> result;
  for (unsigned int k = 1; k < samples.size(); ++k)
  {
    const auto &[left, f_left] = samples[k - 1];
    const auto &[right, f_right] = samples[k];
    if (has_sign(f_left) * has_sign(f_right) < 0)
    {
      // Signs alone: products of small values underflow.
      const auto bracket =
          boost::math::tools::bisect([&](const double s) { return has_sign(function(s)); }, left,
                                     right, boost::math::tools::eps_tolerance<double>(48));
      result.push_back(0.5 * (bracket.first + bracket.second));
    }
    else if (f_right == 0. && k + 1 < samples.size())
      result.push_back(right);
  }
  return result;
}

/** int g |u_t| over one face: the pieces of its rule are cut further where u_t changes sign. */
double friction_work(const FieldFace<2> &face, const Field<2> &field)
{
  const std::vector<double> jumps = field.friction_cuts(face);
  if (jumps.empty())
    return 0.;
  EdgeDisplacement<2> u_t(face, field, true);
  u_t.subtract_past(face, field);
  std::vector<double> cuts = zeros(u_t, 8 * face.degree());
  cuts.insert(cuts.end(), jumps.begin(), jumps.end());
  std::sort(cuts.begin(), cuts.end());
  const QGauss<1> &gauss = field.tables.gauss(face.degree() + 2);
  double sum = 0;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = cuts[k + 1] - cuts[k], s = cuts[k] + width * gauss.point(q)[0];
      const Point<2> reference = point_on_face<2>(face.face_no, Point<1>(s));
      const double stretch = // of ds along a curve
          face.map.is_curved() ? face.map.face_measure(face.face_no, reference) / face.area() : 1.;
      sum += stretch * width * gauss.weight(q) *
             field.scene.circumference(face.map.point(reference)) * field.bound(face, reference) *
             std::abs(u_t(s));
    }
  return face.area() * sum;
}

/** Lagrange's basis at Gauss points of (0,1) there, and on its halves, their halves and so on, each made once. */
class HalvedBasis
{
public:
  HalvedBasis(const ShapeTables<3> &tables, const unsigned int degree)
      : gauss(tables.gauss(degree + 1)), basis(tables.gauss_lagrange(gauss.size()))
  {
  }

  /** On part @p number of `2^level`: of function i at Gauss point q at `q n + i`. */
  const double *on_part(const unsigned int level, const unsigned int number)
  {
    const std::size_t place = (std::size_t(1) << level) + number;
    if (place >= parts.size())
      parts.resize(place + 1);
    if (parts[place].empty())
      for (const Point<1> &point : gauss.get_points())
        for (const auto &polynomial : basis)
          parts[place].push_back(polynomial.value(std::ldexp(number + point[0], -int(level))));
    return parts[place].data();
  }

  const QGauss<1> &gauss;

private:
  const std::vector<Polynomials::Polynomial<double>> &basis;
  std::vector<std::vector<double>> parts;
};

/**
 * g |u_t| on a face in space. |u_t| has a kink where u_t vanishes, at points or along curves, and g may jump:
 * squares are cut into four until that changes nothing any more.
 */
class FrictionWork
{
public:
  FrictionWork(const FieldFace<3> &face, const Field<3> &field, HalvedBasis &basis)
      : face(face), field(field), basis(basis), lines(basis.gauss.size() * basis.gauss.size())
  {
    for (unsigned int v = 0; v < 4; ++v)
      measures[v] = face.map.face_measure(face.face_no,
                                          point_on_face<3>(face.face_no, Point<2>(v % 2, v / 2)));
    const ShapeTable<3> table = tabulate<3>(face.degree(), nodes(), {}, false);
    const std::vector<double> u = evaluate(table.values, field.coefficients(face.cell));
    for (unsigned int k = 0; k < table.points.size(); ++k)
    {
      const FaceFrame<3> frame = face.frame(table.points[k]);
      Tensor<1, 3> value;
      for (unsigned int c = 0; c < 3; ++c)
        value[c] = u[c * table.points.size() + k];
      if (face.map.is_curved()) // u is a polynomial there, its tangential part is none
      {
        slip.push_back(value);
        continue;
      }
      const Tensor<1, 3> past_opposite =
          field.opposite(face, table.points[k]) - field.change_opposite(face, table.points[k]);
      slip.push_back(frame.tangential(value - past_opposite) - field.past_slip(face, frame.x));
    }
  }

  /** On the face, up to @p tolerance on it as a whole. */
  double integral(const double tolerance)
  {
    return integral(0, {{0, 0}}, on_square(0, {{0, 0}}), tolerance);
  }

private:
  using Square = std::array<unsigned int, 2>; ///< its number among `2^level` along each axis

  std::vector<Point<3>> nodes() const
  {
    std::vector<Point<3>> result;
    for (const Point<1> &b : basis.gauss.get_points())
      for (const Point<1> &a : basis.gauss.get_points())
        result.push_back(point_on_face<3>(face.face_no, Point<2>(a[0], b[0])));
    return result;
  }

  /** By one Gauss rule. */
  double on_square(const unsigned int level, const Square &square)
  {
    const QGauss<1> &gauss = basis.gauss;
    const unsigned int n = gauss.size();
    const double width = std::ldexp(1., -int(level));
    // Slip at points along the first axis and nodes along the second.
    const double *const along = basis.on_part(level, square[0]);
    std::fill(lines.begin(), lines.end(), Tensor<1, 3>());
    for (unsigned int q = 0; q < n; ++q)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          lines[q * n + j] += along[q * n + i] * slip[j * n + i];
    const double *const across = basis.on_part(level, square[1]);
    double sum = 0;
    for (unsigned int r = 0; r < n; ++r)
      for (unsigned int q = 0; q < n; ++q)
      {
        const Point<2> on_face(width * (square[0] + gauss.point(q)[0]),
                               width * (square[1] + gauss.point(r)[0]));
        const Point<3> reference = point_on_face<3>(face.face_no, on_face);
        const double bound = field.bound(face, reference);
        if (bound == 0.)
          continue;
        Tensor<1, 3> u;
        for (unsigned int j = 0; j < n; ++j)
          u += across[r * n + j] * lines[q * n + j];
        if (face.condition->pair && !face.map.is_curved()) // no polynomial where its cells end
          u -= face.frame(reference).tangential(field.change_opposite(face, reference));
        double ds = 0;
        if (face.map.is_curved())
        {
          const FaceFrame<3> frame = face.frame(reference);
          if (face.condition->pair)
            u -= field.opposite(face, reference);
          u = frame.tangential(u) - field.past_slip(face, frame.x);
          ds = frame.measure;
        }
        else
          ds = measure(on_face);
        sum += gauss.weight(q) * gauss.weight(r) * ds * bound * u.norm();
      }
    return width * width * sum;
  }

  /** ds over that of the reference face, of a plane one: bilinear. */
  double measure(const Point<2> &x) const
  {
    return (1 - x[1]) * ((1 - x[0]) * measures[0] + x[0] * measures[1]) +
           x[1] * ((1 - x[0]) * measures[2] + x[0] * measures[3]);
  }

  double integral(const unsigned int level, const Square &square, const double whole,
                  const double tolerance)
  {
    constexpr unsigned int most_levels = 7;
    std::array<double, 4> parts;
    const auto part = [&](const unsigned int k) -> Square {
      return {{2 * square[0] + k % 2, 2 * square[1] + k / 2}};
    };
    double sum = 0;
    for (unsigned int k = 0; k < 4; ++k)
      sum += parts[k] = on_square(level + 1, part(k));
    if (level == most_levels || std::abs(sum - whole) <= tolerance)
      return sum;
    sum = 0;
    for (unsigned int k = 0; k < 4; ++k)
      sum += integral(level + 1, part(k), parts[k], tolerance / 2);
    return sum;
  }

  const FieldFace<3> &face;
  const Field<3> &field;
  HalvedBasis &basis;
  std::vector<Tensor<1, 3>> slip;  ///< at nodes(), of the own side alone; of a curved face u
  std::vector<Tensor<1, 3>> lines; ///< of on_square()
  std::array<double, 4> measures;  ///< at the corners
};

/** Over all contact of @p field; @p a is twice the strain energy. */
double friction_work(const Field<2> &field, double)
{
  return sum_collectively(field.communicator(),
                          [&]()
                          {
                            double sum = 0;
                            for (const FieldFace<2> &face : field.faces())
                              if (face.condition->friction)
                                sum += friction_work(face, field);
                            return sum;
                          });
}

double friction_work(const Field<3> &field, const double a)
{
  std::map<unsigned int, HalvedBasis> bases; // by degree
  std::vector<FrictionWork> works;
  const auto sum = [&](const double tolerance) // of each face
  {
    return sum_collectively(field.communicator(),
                            [&]()
                            {
                              double all = 0;
                              for (FrictionWork &work : works)
                                all += work.integral(tolerance);
                              return all;
                            });
  };
  collectively(
      field.communicator(),
      [&]()
      {
        for (const FieldFace<3> &face : field.faces())
          if (face.condition->friction)
            works.emplace_back(
                face, field,
                bases.try_emplace(face.degree(), field.tables, face.degree()).first->second);
      });
  const double roughly = sum(std::numeric_limits<double>::infinity());
  // slip that is round-off has no digits to find
  return sum(std::max(1e-8 * roughly, 1e-14 * std::abs(a)));
}
} // namespace

template <int dim>
Energies energies(const Field<dim> &field, const double a, const double work)
{
  const double friction = friction_work(field, a), coupling = field.contact_work();
  const double potential = 0.5 * a - work;
  const double norm =
      std::sqrt(std::max(a, 0.)); // round-off has any sign where nothing is strained
  return {potential + coupling, potential + friction, norm, friction - coupling};
}

namespace
{
/** u_0 in the moments of all pressures. */
template <int dim>
std::vector<double> gaps(const ContactSpace<dim> &contact_space)
{
  std::vector<double> result;
  for (const ContactMultiplier<dim> &multiplier : contact_space.multipliers())
    if (multiplier.kind == ContactMultiplier<dim>::Kind::pressure)
      result.push_back(multiplier.gap);
  return result;
}

/** What acts in one state while the body moves by du and its foundation by du_0. */
struct Acting
{
  double outside = 0;  ///< loads, supports and foundation
  double friction = 0; ///< int z du_t
  double pressure = 0; ///< int p d(u_n - u_0)
  double residual = 0; ///< what has no balance
};

/** @p change of gaps(). */
template <int dim>
Acting acting(const Solution<dim> &state, const Vector<double> &loads, const Vector<double> &du,
              const std::vector<double> &change)
{
  const ReactionWork reactions = reaction_work(state, loads, du);
  Acting result;
  result.outside = std::inner_product(loads.begin(), loads.end(), du.begin(), reactions.supports);
  result.residual = -reactions.elsewhere;
  const Vector<double> moments = state.spaces->contact_operator.moments(du);
  auto du_0 = change.begin();
  for (unsigned int i = 0; i < moments.size(); ++i)
    if (state.contact_space.multipliers()[i].kind == ContactMultiplier<dim>::Kind::friction)
      result.friction += state.z[i] * moments[i];
    else
    {
      result.outside -= state.z[i] * *du_0;
      result.pressure += state.z[i] * (moments[i] - *du_0++);
    }
  return result;
}

Work between(const Acting &last, const Acting &next, const double initial)
{
  return {0.5 * (last.outside + next.outside),
          next.friction,
          0.5 * (last.friction - next.friction + last.pressure + next.pressure),
          0.5 * last.residual,
          0.5 * (last.friction + next.friction),
          initial};
}

double initial_energy(const Solution<2> &solution)
{
  return hpvi::initial_energy(solution.scene, solution.displacement_space, solution.tables,
                              solution.u);
}
} // namespace

template <int dim>
Work work(const Solution<dim> &last, const Solution<dim> &next, const Vector<double> &loads)
{
  Vector<double> du(next.u);
  du -= last.u;
  std::vector<double> change = gaps(next.contact_space);
  const std::vector<double> before = gaps(last.contact_space);
  std::transform(change.begin(), change.end(), before.begin(), change.begin(), std::minus<>());
  return between(
      acting(last,
             load_vector(last.scene, last.displacement_space, last.tables, *last.spaces->loads), du,
             change),
      acting(next, loads, du, change), initial_energy(next));
}

template <int dim>
Work work_from_rest(const Solution<dim> &next, const Vector<double> &loads)
{
  std::vector<double> change = gaps(next.contact_space);
  for (double &gap : change)
    gap = std::min(gap, 0.);
  return between({}, acting(next, loads, next.u, change), initial_energy(next));
}

template Work work(const Solution<2> &, const Solution<2> &, const Vector<double> &);
template Work work_from_rest(const Solution<2> &, const Vector<double> &);
template Energies energies(const Field<2> &, double, double);
template Energies energies(const Field<3> &, double, double);
} // namespace hpvi
