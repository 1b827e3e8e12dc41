// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/display_name.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/face_contact.h>
#include <hpvi/bound/slip_direction.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
bool knows_pressure(const ContactFace<2> &face)
{
  return face.condition->friction.knows_pressure();
}

/** Does anything make chi known on the face? */
bool acts(const ContactFace<2> &face)
{
  return face.n_multipliers > 0 && !face.friction.vanishes();
}

/** Do two faces meet without a corner? */
bool follow(const ContactFace<2> &a, const ContactFace<2> &b)
{
  const double near = 1e-9 * (a.length + b.length);
  for (const double of_a : {0., 1.})
    for (const double of_b : {0., 1.})
      if (a.point(of_a).distance(b.point(of_b)) < near)
        return (a.node_frame(of_a).normal - b.node_frame(of_b).normal).norm() < 1e-6;
  return false;
}

/** Faces of Coulomb's law that follow each other without a corner, perhaps all around. */
struct Run
{
  std::vector<unsigned int> faces;
  bool is_closed = false;

  /** Lets a closed one begin at the first of its faces that is @p wanted. */
  template <class Wanted>
  void begin_at(const Wanted &wanted)
  {
    if (is_closed)
      std::rotate(faces.begin(), std::find_if(faces.begin(), faces.end(), wanted), faces.end());
  }
};

std::vector<Run> smooth_runs(const std::vector<ContactFace<2>> &faces)
{
  std::vector<Run> result;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (knows_pressure(faces[k]))
    {
      if (result.empty() || result.back().faces.back() + 1 != k || !follow(faces[k - 1], faces[k]))
        result.emplace_back();
      result.back().faces.push_back(k);
    }
  for (Run &run : result)
    run.is_closed =
        run.faces.size() > 2 && follow(faces[run.faces.back()], faces[run.faces.front()]);
  return result;
}

/** The end of the face at a place of a run that does not touch the one behind it, 0 or 1: where the run comes from. */
unsigned int first_end(const std::vector<ContactFace<2>> &faces, const unsigned int place,
                       const Run &run)
{
  if (run.faces.size() == 1)
    return 0;
  const bool is_last = place + 1 == run.faces.size();
  const ContactFace<2> &other = faces[run.faces[is_last ? place - 1 : place + 1]],
                       &own = faces[run.faces[place]];
  const auto distance = [&](const unsigned int end)
  {
    return std::min(own.point(end).distance(other.point(0.)),
                    own.point(end).distance(other.point(1.)));
  };
  const unsigned int near = distance(0) < distance(1) ? 0 : 1;
  return is_last ? near : 1 - near;
}

/** Does a face stick, where slip ends on it, in the half beside another one? */
bool sticks_near(const ContactFace<2> &face, const ContactFace<2> &other,
                 const Solution<2> &solution)
{
  const bool at_begin =
      face.point(0.).distance(other.point(0.5)) < face.point(1.).distance(other.point(0.5));
  const QGauss<1> &gauss = solution.tables.gauss(face.n_multipliers);
  unsigned int n_near = 0;
  for (unsigned int i = 0; i < face.n_multipliers; ++i)
    if (at_begin ? gauss.point(i)[0] < 0.5 : gauss.point(i)[0] > 0.5)
    {
      ++n_near;
      if (const unsigned int k = face.first_multiplier + i;
          solution.contact_space.multipliers()[k].friction.vanishes() ||
          slip_at(k, solution.z, solution.contact_space) != 0.)
        return false;
    }
  return n_near > 0;
}

/** Nearest to @p chi, within [-1, 1], of those for which no room is missing. */
double with_room(const double chi, const double mu, const double u_t, const double room)
{
  const double share = mu * std::abs(u_t) > 0. ? std::max(0., room) / (mu * std::abs(u_t)) : 2.;
  return u_t > 0. ? std::max(chi, std::max(-1., 1. - share))
                  : std::min(chi, std::min(1., share - 1.));
}
} // namespace

SlipDirection slip_direction(const Solution<2> &solution, const AdmissibleContact &contact)
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  SlipDirection result(faces.size());
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (knows_pressure(faces[k]) && acts(faces[k]))
      result[k] = [&contact, k](const double s)
      { return std::max(-1., std::min(1., contact.direction(k, s))); };
  for (Run &run : smooth_runs(faces))
  {
    run.begin_at([&](const unsigned int k) { return bool(result[k]); });
    const unsigned int n = run.faces.size();
    for (unsigned int begin = 0; begin < n;)
    {
      unsigned int end = begin;
      while (end < n && !result[run.faces[end]])
        ++end;
      if (end == begin)
      {
        ++begin;
        continue;
      }
      const auto at = [&](const unsigned int place, const bool is_behind)
      {
        const unsigned int first = first_end(faces, place, run);
        return result[run.faces[place]](is_behind ? 1. - first : first);
      };
      const auto with_room_at =
          [&](const double chi, const unsigned int place, const bool is_behind)
      {
        const unsigned int k = run.faces[place], first = first_end(faces, place, run);
        const double s = is_behind ? 1. - first : first;
        return with_room(chi, faces[k].friction_coefficient(faces[k].point(s)), contact.slip(k, s),
                         contact.room(k, s));
      };
      // A closed run that does not begin with an open face goes on with its first one.
      const bool has_before = begin > 0, has_after = end < n || (run.is_closed && has_before);
      const unsigned int next_place = end < n ? end : 0;
      const double before = has_before  ? at(begin - 1, true)
                            : has_after ? at(next_place, false)
                                        : 0.,
                   after = has_after ? at(next_place, false) : before;
      double length = 0, from = 0;
      for (unsigned int place = begin; place < end; ++place)
        length += faces[run.faces[place]].length;
      double value = has_before ? before : with_room_at(before, begin, false);
      std::vector<std::array<double, 2>> values;
      for (unsigned int place = begin; place < end; ++place)
      {
        from += faces[run.faces[place]].length;
        double next = before + (after - before) * from / length;
        if (place + 1 < end || !has_after)
          next = with_room_at(next, place, true);
        values.push_back({{value, next}});
        value = next;
      }
      for (unsigned int place = begin; place < end; ++place)
      {
        std::array<double, 2> ends = values[place - begin];
        if (first_end(faces, place, run) == 1)
          std::swap(ends[0], ends[1]);
        result[run.faces[place]] = [ends](const double s)
        { return (1. - s) * ends[0] + s * ends[1]; };
      }
      begin = end;
    }
  }
  return result;
}

SlipZones slip_zones(const Solution<2> &solution, const AdmissibleContact &contact)
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  const std::vector<Slip> slips = slips_of(solution);
  SlipZones result{std::vector<bool>(faces.size()), SlipDirection(faces.size()), {}, false};
  double largest = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    largest = std::max(largest, contact.largest_slip(k));
  largest = std::max(largest, solution.u.linfty_norm());
  std::string where;
  for (Run &run : smooth_runs(faces))
  {
    const unsigned int n = run.faces.size();
    const auto holds = [&](const unsigned int k)
    { return acts(faces[k]) && slips[k].mode == Slip::nowhere; };
    const auto holds_near = [&](const unsigned int other, const unsigned int k) {
      return holds(other) || (acts(faces[other]) && sticks_near(faces[other], faces[k], solution));
    };
    std::vector<double> direction(faces.size());
    for (unsigned int place = 0; place < n; ++place)
    {
      // At an end of contact there is no neighbour that could slip in its place.
      const unsigned int k = run.faces[place], before = run.faces[(place + n - 1) % n],
                         after = run.faces[(place + 1) % n];
      result.sticks[k] = holds(k) && ((place == 0 && !run.is_closed) || holds_near(before, k)) &&
                         ((place + 1 == n && !run.is_closed) || holds_near(after, k)) &&
                         contact.largest_slip(k) <= 1e-11 * largest; // w has taken it away
      if (acts(faces[k]) && !result.sticks[k])
        direction[k] = slips[k].direction;
    }
    run.begin_at([&](const unsigned int k) { return result.sticks[k]; });
    // One direction on each part between faces that stick.
    for (unsigned int begin = 0; begin < n;)
    {
      unsigned int last = begin;
      double found = 0;
      for (; last < n && !result.sticks[run.faces[last]]; ++last)
        if (const double own = direction[run.faces[last]]; own != 0.)
        {
          result.contradicts = result.contradicts || found * own < 0.;
          found = own;
        }
      for (unsigned int place = begin; place < last; ++place)
        result.direction[run.faces[place]] = [sign = found != 0. ? found : 1.](double)
        { return sign; };
      if (last > begin)
        begin = last;
      for (; last < n && result.sticks[run.faces[last]]; ++last)
        result.direction[run.faces[last]] = [](double) { return 0.; };
      if (last > begin)
      {
        const auto end_of = [&](const unsigned int place, const bool is_behind)
        {
          const unsigned int first = first_end(faces, place, run);
          return to_string(faces[run.faces[place]].point(is_behind ? 1. - first : first));
        };
        where += (where.empty() ? "" : ", ") + printable(faces[run.faces[begin]].condition->name) +
                 (run.is_closed && last - begin == n
                      ? " sticks all around"
                      : " sticks from " + end_of(begin, false) + " to " + end_of(last - 1, true));
        begin = last;
      }
    }
  }
  result.words =
      (where.empty() ? "" : where + ", and ") +
      (where.empty() ? "contact slips only as computed" : "slips elsewhere only as computed");
  return result;
}
} // namespace hpvi
