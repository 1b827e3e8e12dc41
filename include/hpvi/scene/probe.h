// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_probe_h
#define hpvi_probe_h

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <string>
#include <vector>

namespace hpvi
{
/** What a probe takes its displacement from. */
enum class ProbeKind
{
  point, ///< u at Probe::at
  disc,  ///< the mean of u over the disc about Probe::at with the radius Probe::size, in the plane
  boundary, ///< the mean of u along Probe::on
  line      ///< u and stress at Probe::n_points points from Probe::from to Probe::to
};

/** A place of which results tell displacement and stress: `subsection Probe NAME`. */
template <int dim>
struct Probe
{
  std::string name; ///< columns of convergence.csv begin with it, a line has files of its own
  ProbeKind kind = ProbeKind::point;
  dealii::Point<dim> at;                      ///< of a point or a disc
  double size = 0;                            ///< of a disc, its radius [length]
  std::string side;                           ///< `On`: a side or a part of one
  std::vector<dealii::types::boundary_id> on; ///< what that is: a side has its parts with it
  dealii::Point<dim> from, to;                ///< of a line, its ends
  unsigned int n_points = 0;                  ///< likewise, ends included, at equal distances

  /** Has it a mean displacement, of which an interval may be guaranteed? A value at a point has none. */
  bool is_mean() const
  {
    return kind == ProbeKind::disc || kind == ProbeKind::boundary;
  }

  /** The point number @p k of a line. */
  dealii::Point<dim> point(const unsigned int k) const
  {
    return k + 1 < n_points ? from + double(k) / (n_points - 1) * (to - from) : to;
  }
};

/** Those of convergence.csv that @p probe has; of a line none. */
template <int dim>
std::vector<std::string> columns_of(const Probe<dim> &probe);
} // namespace hpvi

#endif
