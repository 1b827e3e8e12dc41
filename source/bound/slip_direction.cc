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

/** Runs of faces of Coulomb's law that follow each other without a corner: [first, end). */
std::vector<std::pair<unsigned int, unsigned int>>
smooth_runs(const std::vector<ContactFace<2>> &faces)
{
  std::vector<std::pair<unsigned int, unsigned int>> result;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (knows_pressure(faces[k]))
    {
      if (!result.empty() && result.back().second == k && follow(faces[k - 1], faces[k]))
        ++result.back().second;
      else
        result.emplace_back(k, k + 1);
    }
  return result;
}

/** The end of a face that does not touch the one behind it, 0 or 1: where its run comes from. */
unsigned int first_end(const std::vector<ContactFace<2>> &faces, const unsigned int face,
                       const std::pair<unsigned int, unsigned int> &run)
{
  if (run.second - run.first == 1)
    return 0;
  const bool is_last = face + 1 == run.second;
  const ContactFace<2> &other = faces[is_last ? face - 1 : face + 1], &own = faces[face];
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
  for (const auto &run : smooth_runs(faces))
    for (unsigned int begin = run.first; begin < run.second;)
    {
      unsigned int end = begin;
      while (end < run.second && !result[end])
        ++end;
      if (end == begin)
      {
        ++begin;
        continue;
      }
      const auto at = [&](const unsigned int face, const bool is_behind)
      {
        const unsigned int first = first_end(faces, face, run);
        return result[face](is_behind ? 1. - first : first);
      };
      const bool has_before = begin > run.first, has_after = end < run.second;
      const double before = has_before  ? at(begin - 1, true)
                            : has_after ? at(end, false)
                                        : 0.,
                   after = has_after ? at(end, false) : before;
      double length = 0, from = 0;
      for (unsigned int k = begin; k < end; ++k)
        length += faces[k].length;
      double value = before;
      std::vector<std::array<double, 2>> values;
      for (unsigned int k = begin; k < end; ++k)
      {
        from += faces[k].length;
        double next = before + (after - before) * from / length;
        if (k + 1 < end || !has_after)
        {
          const double s = 1. - first_end(faces, k, run);
          next = with_room(next, faces[k].friction_coefficient(faces[k].point(s)),
                           contact.slip(k, s), contact.room(k, s));
        }
        if (k == begin && !has_before)
        {
          const double s = first_end(faces, k, run);
          value = with_room(value, faces[k].friction_coefficient(faces[k].point(s)),
                            contact.slip(k, s), contact.room(k, s));
        }
        values.push_back({{value, next}});
        value = next;
      }
      for (unsigned int k = begin; k < end; ++k)
      {
        std::array<double, 2> ends = values[k - begin];
        if (first_end(faces, k, run) == 1)
          std::swap(ends[0], ends[1]);
        result[k] = [ends](const double s) { return (1. - s) * ends[0] + s * ends[1]; };
      }
      begin = end;
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
  for (const auto &[first, end] : smooth_runs(faces))
  {
    const auto holds = [&, first = first, end = end](const unsigned int k)
    { return k >= first && k < end && acts(faces[k]) && slips[k].mode == Slip::nowhere; };
    const auto holds_near = [&](const unsigned int other, const unsigned int k) {
      return holds(other) || (acts(faces[other]) && sticks_near(faces[other], faces[k], solution));
    };
    std::vector<double> direction(faces.size());
    const bool is_closed = end - first > 2 && follow(faces[end - 1], faces[first]);
    for (unsigned int k = first; k < end; ++k)
    {
      // At an end of contact there is no neighbour that could slip in its place.
      const bool before = k > first ? holds_near(k - 1, k) : !is_closed || holds_near(end - 1, k),
                 after = k + 1 < end ? holds_near(k + 1, k) : !is_closed || holds_near(first, k);
      result.sticks[k] = holds(k) && before && after &&
                         contact.largest_slip(k) <= 1e-11 * largest; // w has taken it away
      if (acts(faces[k]) && !result.sticks[k])
        direction[k] = slips[k].direction;
    }
    // One direction on each part between faces that stick.
    for (unsigned int begin = first; begin < end;)
    {
      unsigned int last = begin;
      double found = 0;
      for (; last < end && !result.sticks[last]; ++last)
        if (direction[last] != 0.)
        {
          result.contradicts = result.contradicts || found * direction[last] < 0.;
          found = direction[last];
        }
      for (unsigned int k = begin; k < last; ++k)
        result.direction[k] = [sign = found != 0. ? found : 1.](double) { return sign; };
      if (last > begin)
        begin = last;
      for (; last < end && result.sticks[last]; ++last)
        result.direction[last] = [](double) { return 0.; };
      if (last > begin)
      {
        const unsigned int back = last - 1;
        const std::pair<unsigned int, unsigned int> run{first, end};
        where +=
            (where.empty() ? "" : ", ") + printable(faces[begin].condition->name) +
            (is_closed && last - begin == end - first
                 ? " sticks all around"
                 : " sticks from " + to_string(faces[begin].point(first_end(faces, begin, run))) +
                       " to " + to_string(faces[back].point(1. - first_end(faces, back, run))));
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
