// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coupling_spaces_h
#define hpvi_coupling_spaces_h

#include <hpvi/bound/slip_direction.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hpvi
{
/** `B' A^-1 C`, A symmetric. Throws NumericalFailure where it is not positive definite. */
dealii::FullMatrix<double> reduced(dealii::FullMatrix<double> A,
                                   const dealii::FullMatrix<double> &B,
                                   const dealii::FullMatrix<double> &C);

/** Rows and columns of a matrix. */
dealii::FullMatrix<double> part(const dealii::FullMatrix<double> &A,
                                const std::vector<unsigned int> &rows,
                                const std::vector<unsigned int> &columns);

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

  /** `L' D Y D L`, `C = L L'`: a symmetric matrix with the same eigenvalues. */
  dealii::FullMatrix<double> symmetric(const dealii::Vector<double> &D) const;

  /** `L' A` and `L^-1 A`. */
  dealii::FullMatrix<double> times_factor(const dealii::FullMatrix<double> &A) const;
  dealii::FullMatrix<double> by_factor(const dealii::FullMatrix<double> &A) const;

private:
  std::vector<double> L; ///< `C = L L'`, by columns, zeros included
  dealii::FullMatrix<double> Y;
  mutable dealii::Vector<double> known_D; ///< the last one, with its eigenvalue
  mutable double known_value = 0;
};

/** Compliance S of all multipliers of contact in a space. */
class ContactCompliance
{
public:
  /**
   * Stabilised where a motion is free, which leaves tractions that push along it no finite compliance. @p response hears the
   * displacement of each multiplier.
   */
  ContactCompliance(const Scene<2> &scene, std::shared_ptr<const Spaces<2>> spaces,
                    CondensedElements<2> &elements,
                    const std::function<void(const Solution<2> &)> &response = {});

  const dealii::FullMatrix<double> &matrix() const ///< S
  {
    return S;
  }

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

  bool overlaps(const EdgePart &other) const
  {
    const double little = 1e-9 * std::min(length(), other.length());
    return is_of_same_edge(other) && begin < other.end - little && other.begin < end - little;
  }

  EdgePart between(const double s, const double t) const
  {
    EdgePart result(*this);
    result.begin = at(s);
    result.end = at(t);
    return result;
  }

  bool operator==(const EdgePart &other) const
  {
    return is_of_same_edge(other) && begin == other.begin && end == other.end;
  }
};

/** mu_f chi along contact, by places on either side of it: what each mesh may ask for. */
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

  /** What it does on an edge. */
  struct Variation
  {
    double height = 0;   ///< of mu_f chi: largest less smallest value
    double shortest = 0; ///< length of the shortest face there, or of what is opposite to it
  };
  Variation along(const EdgePart &edge) const;

  double largest() const; ///< |mu_f chi|

  /** A place of friction beside which none of the faces of another space has multipliers; nothing: there is none. */
  std::optional<dealii::Point<2>> missed_by(const std::vector<ContactFace<2>> &others) const;

private:
  static constexpr unsigned int n_samples = 5; ///< of a face, equidistant, ends included

  /** A face, or a part of one with what is opposite on the other body. */
  struct Part
  {
    EdgePart edge;
    unsigned int face;
    double from, to; ///< s on the face at both ends of the edge
    double share;    ///< of the face
    std::array<double, n_samples> samples;
  };
  void add(Part part);
  Value on_part(const Part &part, double place) const;

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
};

/**
 * Spaces in which theta is computed, with what is kept of them from step to step. theta is a number of the bodies, of
 * friction and of chi, and not of the mesh of a step. A space has cells of one degree on the coarse mesh of the scene, bisected
 * towards ends of contact and where mu_f chi varies, on both sides of it. As long as that gives the same mesh, only chi changes.
 * Which side of two bodies has the multipliers is asked there again.
 */
class CouplingSpaces
{
public:
  explicit CouplingSpaces(const CouplingResolution &resolution = {});
  ~CouplingSpaces();

  /** The space for friction of @p solution; throws what Discretisation throws. Good until four other ones have been asked for. */
  ContactCompliance &of(const Solution<2> &solution, const FrictionAlong &friction);

  /** Likewise on a mesh of the scene that is fine enough in other places; each time anew. */
  ContactCompliance
  on(std::shared_ptr<dealii::Triangulation<2>> mesh, const Solution<2> &solution,
     const FrictionAlong &friction,
     const std::function<std::function<void(const Solution<2> &)>(const Spaces<2> &)> &response);

private:
  void begin(const Solution<2> &solution);
  std::vector<EdgePart> wanted_edges(const FrictionAlong &friction) const;
  std::shared_ptr<const Spaces<2>> space_with(const std::vector<EdgePart> &edges,
                                              std::shared_ptr<dealii::Triangulation<2>> mesh) const;

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
