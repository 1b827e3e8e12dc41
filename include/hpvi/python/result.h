// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_python_result_h
#define hpvi_python_result_h

#include <hpvi/output/record.h>
#include <hpvi/python/scene_text.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** The cells of a step, in the order of all results by cell. */
struct MeshArrays
{
  std::vector<double> vertices; ///< x, y[, z], one after the other
  std::vector<long> cells;      ///< vertices of each cell: counterclockwise, in space as VTK counts
  std::vector<long> degrees;    ///< p of each cell
  std::vector<long> bodies;     ///< of each cell, in the order of the scene; 0 where there is one
};

/** Places, and what the discrete solution is there; NaN outside the body. */
struct PointArrays
{
  std::vector<double> x;      ///< as many numbers as dimensions, one point after the other
  std::vector<double> u;      ///< likewise [length]
  std::vector<double> stress; ///< nine numbers a point, row by row [stress]
};

/**
 * The steps of a run so far, and the solution of the last of them, as plain numbers. What is asked of the solution throws
 * NotAtHand while the run is between two steps, and after a run that was broken off there.
 */
class Result
{
public:
  virtual ~Result() = default;

  virtual unsigned int dimension() const = 0;
  std::string length_unit, stress_unit;
  std::vector<Record> steps;         ///< of convergence.csv
  std::string stopped_by;            ///< why there is no next step; empty: there is one
  std::vector<std::string> warnings; ///< of the last step

  virtual std::vector<Record> contact() const = 0;         ///< contact-NN.csv
  virtual std::vector<Record> forces() const = 0;          ///< of forces.csv
  virtual std::vector<Record> loading() const = 0;         ///< loading.csv; empty without a history
  virtual std::vector<Record> contact_history() const = 0; ///< contact-history.csv, likewise
  virtual std::vector<Record> cycles() const = 0;          ///< cycles.csv, likewise
  virtual std::vector<std::pair<std::string, std::vector<Record>>>
  probe_lines() const = 0; ///< by name
  virtual MeshArrays mesh() const = 0;
  /** In the body of this name; empty: in any. Throws std::invalid_argument where there is none of it. */
  virtual PointArrays at(const std::vector<double> &points, const std::string &body) const = 0;
  /** At n points a direction and cell, ends included, cell by cell, x slowest. */
  virtual PointArrays grid(unsigned int n) const = 0;
  virtual std::vector<double> bound_by_cell() const = 0; ///< empty: there is no bound
  virtual std::vector<double> indicator_by_cell() const = 0;
  virtual std::string no_bound() const = 0; ///< why there is none
};

/** What is asked for is not there (now); one line. */
class NotAtHand : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** Whoever listens wants the run to end: passes through it, and its line stands in summary.json. */
class BrokenOff : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** What hears of a run; both may throw BrokenOff. */
struct Listener
{
  std::function<void()> between;                                 ///< stages, some hundred a second
  std::function<bool(const std::shared_ptr<Result> &)> finished; ///< a step; false: no more of them
};

/**
 * Solves on one process, with files in @p directory unless that is empty. Throws InputError, NumericalFailure, OutputFailure,
 * BrokenOff.
 */
std::shared_ptr<Result> solve(const SceneText &scene, const std::string &directory,
                              const Listener &listener);

/** InputError, NumericalFailure, OutputFailure, MemoryError or RuntimeError: as what Python shall raise @p error. */
std::string exception_name(const std::exception &error);

std::string line_of(const std::exception &error); ///< failure_line()
} // namespace hpvi

#endif
