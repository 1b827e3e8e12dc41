// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cone_newton_h
#define hpvi_cone_newton_h

#include <hpvi/solvers/cone_iterate.h>

#include <utility>
#include <vector>

namespace hpvi
{
/** Newton's method for a ConeProgram: moves an iterate, to which it refers, as CoulombSolver says. */
class ConeNewton
{
public:
  /** What the method assumes of each component. */
  struct State
  {
    std::vector<signed char>
        walls; ///< -1, 0, 1: at the lower side, free, at the upper; slip, stick, slip
    dealii::Vector<double> base; ///< a point on the walls of the components that are fixed
    std::vector<FrictionLimit::Piece> pieces; ///< of the cones, where slip is; none: nothing slips
  };

  explicit ConeNewton(ConeIterate &iterate);

  State stick() const;              ///< all closed, and no point slips
  State predict() const;            ///< from the iterate
  State stick_where_closed() const; ///< the same, where nothing slips

  /** Whole steps. Does the iterate solve the program then? */
  bool step_on_from(State state);

  /** Steps each as long as the residual falls, and in the end whole ones again. */
  bool search_lines();

  unsigned int steps = 0; ///< each one LU factorisation

private:
  /** Of one linear system. */
  struct Unknowns
  {
    /** A component that is `at_zero + slope` times a free one. */
    struct Follower
    {
      unsigned int component;
      double at_zero, slope;
    };
    std::vector<unsigned int> free;
    std::vector<std::vector<Follower>> followers; ///< by free component, what slips with it
    dealii::Vector<double> base;                  ///< with the free ones where they begin
  };

  /** What tells a state from others: its walls, and the slopes along which points slip. */
  using Key = std::pair<std::vector<signed char>, std::vector<double>>;

  Key key_of(const State &state) const;
  State predict_after(const State &last) const;
  bool follow(const State &state);
  Unknowns unknowns_of(const State &state) const;
  std::vector<double> matrix_of(const Unknowns &unknowns, double give) const;
  bool solve_linear_system(const State &state, double give);

  ConeIterate &iterate;
  const ConeProgram &program;
  ConeIterate::Point &point;    ///< of the iterate
  dealii::FullMatrix<double> G; ///< `diag(scale) G L`: the balance in units of energy
  double give = 1;              ///< of the balance where no free component answers to it
};
} // namespace hpvi

#endif
