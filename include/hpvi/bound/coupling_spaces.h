// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coupling_spaces_h
#define hpvi_coupling_spaces_h

#include <hpvi/bound/slip_direction.h>

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hpvi
{
/** The largest eigenvalue of a symmetric tridiagonal matrix, by bisection of Sturm's sequence. */
double largest_of_tridiagonal(const std::vector<double> &diagonal,
                              const std::vector<double> &beside);

/** What `C D Y D` has without D, C and Y symmetric positive semidefinite and D diagonal. */
class CouplingMatrices
{
public:
  /** Throws NumericalFailure where C is not regular. */
  CouplingMatrices(const dealii::FullMatrix<double> &C, dealii::FullMatrix<double> Y);

  /** Of `C D Y D`: by Lanczos' method, to 1e-8. */
  double largest_eigenvalue(const dealii::Vector<double> &D) const;

private:
  std::vector<double> L; ///< `C = L L'`, by columns, zeros included
  dealii::FullMatrix<double> Y;
};

/** Compliance S of all multipliers of contact in a space. */
class ContactCompliance
{
public:
  /** Stabilised where a motion is free, which leaves tractions that push along it no finite compliance. */
  ContactCompliance(const Scene<2> &scene, std::shared_ptr<const Spaces<2>> spaces,
                    CondensedElements<2> &elements);

  /**
   * `C = S_FF - S_Fb S_bb^-1 S_bF` and `Y = (S^-1)_PP` for friction F, its pressures P and b where v is @p held. The last two are
   * kept. Throws NumericalFailure where S is not regular.
   */
  const CouplingMatrices &matrices(const std::vector<unsigned int> &friction,
                                   const std::vector<unsigned int> &pressures,
                                   const std::vector<unsigned int> &held);

  const std::shared_ptr<const Spaces<2>> spaces;

private:
  struct Known
  {
    std::vector<unsigned int> friction, held;
    CouplingMatrices matrices;
  };

  dealii::FullMatrix<double> S;
  std::list<Known> kept; ///< the last one first
};

/** An edge of a cell as a part of one of a coarse cell, whose bisections make all others, along curves too. */
struct EdgePart
{
  EdgePart(dealii::Triangulation<2>::cell_iterator cell, unsigned int face);

  unsigned int coarse_cell, face;
  double begin, end; ///< in [0,1]

  double length() const
  {
    return end - begin;
  }

  double at(const double s) const ///< of the coarse edge where that of the part is @p s
  {
    return begin + s * length();
  }

  bool is_of_same_edge(const EdgePart &other) const
  {
    return coarse_cell == other.coarse_cell && face == other.face;
  }

  bool has_middle_of(const EdgePart &other) const
  {
    return is_of_same_edge(other) && other.at(0.5) > begin && other.at(0.5) < end;
  }

  EdgePart half(const bool is_second) const
  {
    EdgePart result(*this);
    (is_second ? result.begin : result.end) = at(0.5);
    return result;
  }

  bool operator==(const EdgePart &other) const
  {
    return is_of_same_edge(other) && begin == other.begin && end == other.end;
  }
};

/** mu_f chi along contact, by places: what each mesh may ask for. */
class FrictionAlong
{
public:
  /** Of faces of a solution, which must outlive this object like chi. @p sticks by face; empty: nowhere. */
  FrictionAlong(const std::vector<ContactFace<2>> &faces, const SlipDirection &chi,
                const std::vector<bool> &sticks);

  struct Value
  {
    double coefficient; ///< mu_f chi
    bool sticks;
  };

  /** At @p s in [0,1] of an edge of any mesh; throws NumericalFailure, with the @p place, where no face is. */
  Value operator()(const EdgePart &edge, double s, const dealii::Point<2> &place) const;

  /** At @p s in [0,1] of a face. */
  Value on_face(unsigned int face, double s) const;

  /** What it does on an edge whose halves, quarters, ... the faces are, or that is one of a face. */
  struct Variation
  {
    double height = 0;   ///< of mu_f chi: largest less smallest value
    double shortest = 0; ///< length of the shortest face there
  };
  Variation along(const EdgePart &edge) const;

  double largest() const; ///< |mu_f chi|

  /** Edges of the faces with mu_f chi that is not zero in the middle, and where that is. */
  std::vector<std::pair<EdgePart, dealii::Point<2>>> acting() const;

private:
  static constexpr unsigned int n_samples = 5; ///< of a face, equidistant, ends included

  /** A face. */
  struct Part
  {
    EdgePart edge;
    unsigned int face;
    std::array<double, n_samples> samples;
  };

  const std::vector<ContactFace<2>> &faces;
  const SlipDirection &chi;
  const std::vector<bool> sticks;
  std::vector<Part> parts;
};

/** How fine a space of CouplingSpaces is. */
struct CouplingResolution
{
  unsigned int degree = 5;
  unsigned int layers = 5; ///< of bisection towards ends of contact with friction
  double variation = 0.6;  ///< of mu_f chi along an edge, over the largest
  double shortest = 1.;    ///< edge that is bisected for it, over faces of the solution there
  bool is_of_step = false; ///< degrees p + 1 on the mesh of the step, as between bodies
};

/**
 * Spaces in which theta is computed, with what is kept of them from step to step. theta is a number of the body, of
 * friction and of chi, and not of the mesh of a step. Where contact is that of one body on a foundation, the space has cells
 * of one degree on the coarse mesh of the scene, bisected towards ends of contact and where mu_f chi varies. As long
 * as that gives the same mesh, only chi changes. Between bodies it is the mesh of the step, with degrees p + 1.
 */
class CouplingSpaces
{
public:
  explicit CouplingSpaces(const CouplingResolution &resolution = {});
  ~CouplingSpaces();

  /** The space for friction of @p solution; throws what Discretisation throws. Good until the next call but one. */
  ContactCompliance &of(const Solution<2> &solution, const FrictionAlong &friction);

  /** The space of degrees p + 1 on the mesh of @p solution; null: of() has a better one. */
  std::unique_ptr<ContactCompliance> raised(const Solution<2> &solution);

private:
  void begin(const Solution<2> &solution);
  std::vector<EdgePart> wanted_edges(const FrictionAlong &friction) const;
  std::shared_ptr<const Spaces<2>> space_with(const std::vector<EdgePart> &edges) const;

  const CouplingResolution resolution;

  /** Of the first solution; a scene of its own stays alive. */
  std::shared_ptr<const Spaces<2>> first;
  std::shared_ptr<const Scene<2>> own_scene;
  const Scene<2> *scene = nullptr;

  std::unique_ptr<CondensedElements<2>> elements;
  /** One of contact with friction. */
  struct CoarseEdge
  {
    EdgePart edge;
    std::array<bool, 2> ends; ///< does contact end there, or turn?
  };
  std::vector<CoarseEdge> coarse_edges;                                ///< in the order of cells
  std::list<std::pair<std::vector<EdgePart>, ContactCompliance>> kept; ///< the last one first

  static std::vector<CoarseEdge> coupled_edges(const dealii::Triangulation<2> &coarse,
                                               const Scene<2> &scene);
};

} // namespace hpvi

#endif
