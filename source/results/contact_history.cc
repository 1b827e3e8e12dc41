// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/contact_history.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
using Vector3 = std::array<double, 3>;

Vector3 three(const double number)
{
  return {{number, 0, 0}};
}

template <int dim>
Vector3 three(const Tensor<1, dim> &vector)
{
  Vector3 result{};
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = vector[d];
  return result;
}

double product(const Vector3 &a, const Vector3 &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 difference(const Vector3 &a, const Vector3 &b)
{
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}

double distance(const Vector3 &a, const Vector3 &b)
{
  return std::sqrt(product(difference(a, b), difference(a, b)));
}

/** What the points know of the place @p x, which may lie between two of them, and is often the one numbered @p guess. */
PointHistory history_at(std::vector<PointHistory> &points, const Vector3 &x,
                        const std::size_t guess, const bool has_neighbours)
{
  if (points.empty())
    return {};
  const auto is_at = [&](const PointHistory &point)
  { return distance(point.x, x) <= 1e-12 * point.face_length; };
  if (guess < points.size() && is_at(points[guess]))
    return points[guess];
  const auto nearest = std::min_element(points.begin(), points.end(),
                                        [&](const PointHistory &a, const PointHistory &b)
                                        { return distance(a.x, x) < distance(b.x, x); });
  if (!has_neighbours || is_at(*nearest))
    return *nearest;
  PointHistory result = *nearest;
  for (const int side : {-1, 1})
  {
    const auto k = nearest - points.begin() + side;
    if (k < 0 || k >= static_cast<std::ptrdiff_t>(points.size()))
      continue;
    PointHistory other = points[k];
    const Vector3 line = difference(other.x, nearest->x);
    const double length = std::sqrt(product(line, line)),
                 s = product(difference(x, nearest->x), line) / (length * length);
    // Beyond a gap in the boundary there is no neighbour.
    if (s <= 0 || length > 0.5001 * (other.face_length + nearest->face_length))
      continue;
    const auto from = nearest->numbers(), to = other.numbers(), now = result.numbers();
    for (std::size_t i = 0; i < now.size(); ++i)
      *now[i] = (1 - s) * *from[i] + s * *to[i];
  }
  return result;
}

template <int dim>
void add(const ContactPoint<dim> &point, const bool has_friction, const double dt,
         PointHistory &history)
{
  // Without friction nobody asks for slip, which is the jump itself then.
  const Vector3 jump = three(point.tangential_jump),
                slip = has_friction ? three(point.slip) : difference(jump, history.jump);
  history.jump = jump;
  const double pressure = std::max(0., -point.normal_traction);
  history.x = three(point.x);
  history.face_length = point.face_length;
  history.pressure = std::max(history.pressure, pressure);
  history.shear = std::max(history.shear, size_of(point.tangential_traction));
  history.tension = std::max(history.tension, point.surface_stress);
  const ContactMode mode = point.mode();
  if (mode == ContactMode::open)
    history.open += dt;
  if (mode != ContactMode::slip)
    return;
  const double length = std::sqrt(product(slip, slip));
  history.path += length;
  history.dissipated += std::max(0., -product(three(point.tangential_traction), slip));
  history.rubbed += pressure * length;
  for (unsigned int d = 0; d < 3; ++d)
  {
    history.slip[d] += slip[d];
    history.lowest[d] = std::min(history.lowest[d], history.slip[d]);
    history.highest[d] = std::max(history.highest[d], history.slip[d]);
  }
}
} // namespace

double PointHistory::slip_range() const
{
  return distance(highest, lowest);
}

std::array<double *, 20> PointHistory::numbers()
{
  return {{&face_length, &pressure,   &shear,      &tension, &path,      &dissipated, &rubbed,
           &open,        &slip[0],    &slip[1],    &slip[2], &lowest[0], &lowest[1],  &lowest[2],
           &highest[0],  &highest[1], &highest[2], &jump[0], &jump[1],   &jump[2]}};
}

template <int dim>
void add_load_step(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                   const double dt, std::vector<ContactHistory> &histories)
{
  for (const ContactState<dim> &state : contact)
  {
    const auto known = std::find_if(histories.begin(), histories.end(),
                                    [&](const ContactHistory &history)
                                    { return history.boundary == state.boundary; });
    ContactHistory &history = known == histories.end() ? histories.emplace_back() : *known;
    history.boundary = state.boundary;
    std::vector<PointHistory> points;
    for (const ContactPoint<dim> &point : state.points)
    {
      points.push_back(history_at(history.points, three(point.x), points.size(), dim == 2));
      add(point, bool(scene.boundaries[state.boundary].friction), dt, points.back());
    }
    history.points = points;
  }
}

template void add_load_step(const Scene<2> &, const std::vector<ContactState<2>> &, double,
                            std::vector<ContactHistory> &);
template void add_load_step(const Scene<3> &, const std::vector<ContactState<3>> &, double,
                            std::vector<ContactHistory> &);
} // namespace hpvi
