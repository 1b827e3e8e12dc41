/* SPDX-License-Identifier: LGPL-2.1-or-later
 * A block that is pushed along a plane: where does it stick, where does it slip?
 * Example 5.2 of P. Doersek, hp-Finite Element Methods for Variational Inequalities,
 * on uniform meshes, with a Lagrange multiplier for Tresca's friction.
 */

// @sect3{Include files}
//
// All of these are known from step-8, save one: polynomials in one variable. The multiplier is made
// of them, and so is the displacement along an edge, whose zeros will be needed in the end.
#include <deal.II/base/convergence_table.h>
#include <deal.II/base/function.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>

namespace TrescaFriction
{
using namespace dealii;

// @sect3{The problem}
//
// A square of 4 mm x 4 mm in plane stress. Its right edge is clamped, its left edge is pushed to
// the right and slightly down, its top edge is free. The bottom edge lies on a plane that it can
// neither leave nor enter, $u_n = 0$, and friction resists sliding there with a traction of at most
// $g$:
// @f{align*}{
//   |T_t| &\le g,
//   \\ |T_t| < g &\Rightarrow u_t = 0,
//   \\ |T_t| = g &\Rightarrow u_t = -\alpha\, T_t \text{ with some } \alpha \ge 0.
// @f}
// Numbers in stresses are kN/mm^2. With the flag @p colorize the box gives its edges the numbers
// left 0, right 1, bottom 2, top 3.
namespace Problem
{
constexpr double size = 4., young = 15., poisson = 0.4, friction_bound = 4.5;
constexpr types::boundary_id left = 0, right = 1, bottom = 2;

/** The traction on the left edge. */
Tensor<1, 2> traction(const Point<2> &x)
{
  return Tensor<1, 2>({1.5 * (5. - x[1]), -0.75});
}

/** Hooke's law in plane stress, where the thickness is free to change. */
SymmetricTensor<2, 2> stress(const SymmetricTensor<2, 2> &strain)
{
  const double factor = young / (1. - poisson * poisson);
  return factor * ((1. - poisson) * strain + poisson * trace(strain) * unit_symmetric_tensor<2>());
}
} // namespace Problem

// @sect3{The quadratic program}
//
// After the displacement has been eliminated, what is left is to find the multiplier $z$, one
// number per point where friction is asked for:
// @f{align*}{
//   q(z) = \tfrac 12 z^T S z - d^T z \to \min, \qquad \ell \le z \le u.
// @f}
// Without the walls this were one linear system, which conjugate gradients solve. MPRGP,
// <i>modified proportioning with reduced gradient projections</i> (Dost&aacute;l and Sch&ouml;berl,
// 2005), still uses conjugate gradients on the components that are free, the <i>face</i>, and knows
// two more steps to find out which these are. The gradient $r = Sz - d$ is split into the part
// $\varphi$ on free components and the part $\beta$ that would pull components off the walls they
// sit at. At the minimum both are zero: this is what Karush, Kuhn and Tucker ask for.
class Mprgp
{
public:
  struct Steps
  {
    unsigned int cg = 0, expansion = 0, proportioning = 0;
  };

  Mprgp(const FullMatrix<double> &S, const Vector<double> &d, const Vector<double> &lower,
        const Vector<double> &upper)
      : S(S), d(d), lower(lower), upper(upper), free_gradient(d.size()), chopped_gradient(d.size())
  {
  }

  Steps solve(Vector<double> &z, double tolerance);

private:
  void split(const Vector<double> &z, const Vector<double> &r);
  void project(Vector<double> &z) const;
  double distance_to_wall(const Vector<double> &z, const Vector<double> &direction) const;
  double reduced_product(const Vector<double> &z, const Vector<double> &gradient,
                         double length) const;

  const FullMatrix<double> &S;
  const Vector<double> &d, &lower, &upper;
  Vector<double> free_gradient, chopped_gradient; ///< $\varphi$ and $\beta$
};

// At a wall, only that part of the gradient counts which points away from it. (All steps go along
// the negative gradient: at the lower wall, a negative component would carry $z$ inside.)
void Mprgp::split(const Vector<double> &z, const Vector<double> &r)
{
  for (unsigned int i = 0; i < z.size(); ++i)
  {
    const bool at_lower = z[i] == lower[i], at_upper = z[i] == upper[i];
    free_gradient[i] = at_lower || at_upper ? 0. : r[i];
    chopped_gradient[i] = (at_lower && r[i] < 0.) || (at_upper && r[i] > 0.) ? r[i] : 0.;
  }
}

// The projection on a box acts on each component for itself. It also puts a component that
// round-off left a hair inside its wall on the wall: the comparisons in <code>split()</code> are
// for equality. A hair is small beside $z$: walls may be zero or infinite.
void Mprgp::project(Vector<double> &z) const
{
  const double hair = 1e-14 * z.linfty_norm();
  for (unsigned int i = 0; i < z.size(); ++i)
  {
    if (z[i] < lower[i] + hair)
      z[i] = lower[i];
    if (z[i] > upper[i] - hair)
      z[i] = upper[i];
  }
}

double Mprgp::distance_to_wall(const Vector<double> &z, const Vector<double> &direction) const
{
  double result = std::numeric_limits<double>::infinity();
  for (unsigned int i = 0; i < z.size(); ++i)
    if (direction[i] != 0.)
      result = std::min(result, (z[i] - (direction[i] > 0. ? lower[i] : upper[i])) / direction[i]);
  return result;
}

// A part of the gradient times itself <i>after</i> the walls have cut it: what it can still
// achieve.
double Mprgp::reduced_product(const Vector<double> &z, const Vector<double> &gradient,
                              const double length) const
{
  Vector<double> moved(z);
  moved.add(-length, gradient);
  project(moved);
  moved.sadd(-1., 1., z);
  return (moved * gradient) / length;
}

// The iteration. As long as the free part of the gradient outweighs the chopped one, it pays to go
// on minimising on the present face: by a CG step if that stays between the walls, else by an
// <i>expansion step</i>, which goes to the first wall and then on along the projected gradient, by
// a fixed length that lowers $q$ for sure, to take in many walls at once. When the chopped part is
// the larger one, a <i>proportioning step</i> leaves the walls along it.
//
// The fixed length has to be below $2/\|S\|$; the largest row sum is a bound of the norm.
Mprgp::Steps Mprgp::solve(Vector<double> &z, const double tolerance)
{
  Steps steps;
  const double fixed_length = 1.95 / S.linfty_norm();
  Vector<double> r(z.size()), p(z.size()), Sp(z.size());
  const auto compute_gradient = [&]()
  {
    S.vmult(r, z);
    split(z, r -= d);
  };
  const auto move = [&](const double length)
  {
    z.add(-length, p);
    project(z);
    r.add(-length, Sp);
    split(z, r);
  };

  project(z);
  compute_gradient();
  p = free_gradient;
  while (std::hypot(free_gradient.l2_norm(), chopped_gradient.l2_norm()) > tolerance * d.l2_norm())
  {
    AssertThrow(steps.cg + steps.expansion + steps.proportioning < 10000,
                ExcMessage("MPRGP has not converged."));
    const bool proportional = reduced_product(z, chopped_gradient, fixed_length) <=
                              reduced_product(z, free_gradient, fixed_length);
    if (!proportional)
      p = chopped_gradient;
    S.vmult(Sp, p);
    const double curvature = p * Sp, cg_length = (p * r) / curvature;
    const double wall = distance_to_wall(z, p);

    if (!proportional)
    {
      move(std::min(cg_length, wall));
      p = free_gradient;
      ++steps.proportioning;
    }
    else if (cg_length <= wall)
    {
      move(cg_length);
      p.sadd(-(free_gradient * Sp) / curvature, 1., free_gradient);
      ++steps.cg;
    }
    else
    {
      move(wall);
      z.add(-fixed_length, free_gradient);
      project(z);
      compute_gradient();
      p = free_gradient;
      ++steps.expansion;
    }
  }
  return steps;
}

// @sect3{The class of the program}
//
// Step-8 with three additions: the rows of $B$, which couple displacement and multiplier; the
// multiplier; the energies.
//
// The multiplier $\lambda$ stands for the traction of friction, $T_t = -g\lambda$, and lives on the
// contact edges alone: on each a polynomial of degree $p-2$, with no continuity asked for at
// vertices. Its unknowns are the values at the $p-1$ Gauss points of the edge, where $|\lambda| \le
// 1$ is asked for. The degree is two below that of the displacement because then each multiplier is
// seen by some displacement (the inf-sup condition), with a constant that does not depend on the
// mesh: with more multipliers some would be left undetermined.
class Block
{
public:
  explicit Block(unsigned int degree);
  void run(unsigned int n_meshes);

private:
  void make_mesh(unsigned int n_cells);
  void setup_system();
  void assemble_body();
  void assemble_contact();
  void solve();
  void compute_energies();
  void output_results(unsigned int mesh) const;

  template <class Visit>
  void for_each_contact_edge(const Quadrature<1> &quadrature, UpdateFlags flags,
                             const Visit &visit) const;

  const unsigned int degree;
  Triangulation<2> triangulation;
  const FESystem<2> fe;
  DoFHandler<2> dof_handler;
  AffineConstraints<double> constraints;
  SparsityPattern sparsity_pattern;
  SparseMatrix<double> system_matrix;
  Vector<double> system_rhs, solution;

  const QGauss<1> multiplier_points;
  std::vector<Vector<double>> B; ///< a row per multiplier
  Vector<double> multiplier;

  Mprgp::Steps steps;
  ConvergenceTable table;
};

Block::Block(const unsigned int degree)
    : degree(degree), fe(FE_Q<2>(degree), 2), dof_handler(triangulation),
      multiplier_points(degree - 1)
{
}

// @sect3{Mesh and unknowns}
//
// Two conditions are linear and need no multiplier: the right edge does not move, and the bottom
// edge does not move along its normal, which is the second axis.
void Block::make_mesh(const unsigned int n_cells)
{
  triangulation.clear();
  GridGenerator::subdivided_hyper_rectangle(triangulation, {n_cells, n_cells}, Point<2>(),
                                            Point<2>(Problem::size, Problem::size),
                                            /*colorize=*/true);
}

void Block::setup_system()
{
  dof_handler.distribute_dofs(fe);
  constraints.clear();
  VectorTools::interpolate_boundary_values(dof_handler, Problem::right,
                                           Functions::ZeroFunction<2>(2), constraints);
  const FEValuesExtractors::Scalar second(1);
  VectorTools::interpolate_boundary_values(dof_handler, Problem::bottom,
                                           Functions::ZeroFunction<2>(2), constraints,
                                           fe.component_mask(second));
  constraints.close();

  DynamicSparsityPattern pattern(dof_handler.n_dofs());
  DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, /*keep_constrained=*/false);
  sparsity_pattern.copy_from(pattern);
  system_matrix.reinit(sparsity_pattern);
  system_rhs.reinit(dof_handler.n_dofs());
  solution.reinit(dof_handler.n_dofs());
}

// @sect3{The elastic body}
//
// $a(u,v) = \int \sigma(u) : \varepsilon(v)$ and $L(v) = \int_{\Gamma_N} G \cdot v$, as in step-8.
void Block::assemble_body()
{
  const QGauss<2> quadrature(degree + 1);
  const QGauss<1> face_quadrature(degree + 1);
  FEValues<2> values(fe, quadrature, update_gradients | update_JxW_values);
  FEFaceValues<2> face_values(fe, face_quadrature,
                              update_values | update_quadrature_points | update_JxW_values);
  const FEValuesExtractors::Vector displacement(0);
  const unsigned int n = fe.n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n, n);
  Vector<double> cell_rhs(n);
  std::vector<types::global_dof_index> dofs(n);

  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    cell_matrix = 0;
    cell_rhs = 0;
    values.reinit(cell);
    for (const unsigned int q : values.quadrature_point_indices())
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto stress = Problem::stress(values[displacement].symmetric_gradient(i, q));
        for (unsigned int j = 0; j < n; ++j)
          cell_matrix(i, j) +=
              stress * values[displacement].symmetric_gradient(j, q) * values.JxW(q);
      }
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == Problem::left)
      {
        face_values.reinit(cell, face);
        for (const unsigned int q : face_values.quadrature_point_indices())
          for (unsigned int i = 0; i < n; ++i)
            cell_rhs[i] += Problem::traction(face_values.quadrature_point(q)) *
                           face_values[displacement].value(i, q) * face_values.JxW(q);
      }
    cell->get_dof_indices(dofs);
    constraints.distribute_local_to_global(cell_matrix, cell_rhs, dofs, system_matrix, system_rhs);
  }
}

// @sect3{Friction}
//
// The edges of the bottom, one after the other. Three functions below walk along them, each with
// its own quadrature. On the bottom of a cell deal.II's face quadrature runs from left to right,
// like the reference coordinate of the polynomials below.
template <class Visit>
void Block::for_each_contact_edge(const Quadrature<1> &quadrature, const UpdateFlags flags,
                                  const Visit &visit) const
{
  FEFaceValues<2> values(fe, quadrature, flags);
  unsigned int edge = 0;
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == Problem::bottom)
      {
        values.reinit(cell, face);
        visit(edge++, cell, values);
      }
}

// The rows $B_{ij} = b(v_j, \psi_i) = \int_{\Gamma_C} g\, \psi_i\, v_{j,t}$. The tangent is the
// first axis, and $\psi_i$ is the Lagrange polynomial that is one at the Gauss point $i$ of its
// edge and zero at the others. The integrand has degree $2p-2$, so that $p$ Gauss points integrate
// it exactly.
void Block::assemble_contact()
{
  B.clear();
  const QGauss<1> quadrature(degree);
  const auto psi = Polynomials::generate_complete_Lagrange_basis(multiplier_points.get_points());
  const FEValuesExtractors::Scalar tangential(0);
  Vector<double> row(fe.n_dofs_per_cell());
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  for_each_contact_edge(quadrature, update_values | update_JxW_values,
                        [&](const unsigned int, const auto &cell, const FEFaceValues<2> &values)
                        {
                          cell->get_dof_indices(dofs);
                          for (const auto &psi_i : psi)
                          {
                            row = 0;
                            for (const unsigned int q : values.quadrature_point_indices())
                              for (unsigned int j = 0; j < row.size(); ++j)
                                row[j] += Problem::friction_bound *
                                          psi_i.value(quadrature.point(q)[0]) *
                                          values[tangential].value(j, q) * values.JxW(q);
                            B.emplace_back(dof_handler.n_dofs());
                            constraints.distribute_local_to_global(row, dofs, B.back());
                          }
                        });
}

// @sect3{Solving}
//
// The discrete problem is
// @f{align*}{
//   A x + B^T z = f, \qquad (w - z)^T B x \le 0 \quad \text{for all } |w_i| \le 1,\ |z_i| \le 1.
// @f}
// The first equation gives $x = A^{-1}(f - B^T z)$; put into the second it leaves the quadratic
// program with $S = B A^{-1} B^T$ and $d = B A^{-1} f$. There are few multipliers, so each column
// of $A^{-1}B^T$ may cost a solution with the factors of $A$, and $S$ may be dense.
//
// The rows of $B$ are longer where edges are, and $S$ is the worse conditioned for it. To solve for
// $y_i = z_i / s_i$ with $s_i = S_{ii}^{-1/2}$ undoes that; a box remains a box.
void Block::solve()
{
  SparseDirectUMFPACK A_inverse;
  A_inverse.initialize(system_matrix);
  Vector<double> without_friction(system_rhs.size());
  A_inverse.vmult(without_friction, system_rhs);

  const unsigned int n = B.size();
  std::vector<Vector<double>> columns(n, Vector<double>(system_rhs.size()));
  FullMatrix<double> S(n, n);
  Vector<double> d(n), scale(n), upper(n), y(n);
  for (unsigned int j = 0; j < n; ++j)
  {
    A_inverse.vmult(columns[j], B[j]);
    scale[j] = 1. / std::sqrt(B[j] * columns[j]);
    upper[j] = 1. / scale[j];
    d[j] = scale[j] * (B[j] * without_friction);
  }
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      S(i, j) = scale[i] * (B[i] * columns[j]) * scale[j];
  Vector<double> lower(upper);
  lower *= -1.;

  steps = Mprgp(S, d, lower, upper).solve(y, 1e-12);

  multiplier = y;
  multiplier.scale(scale);
  solution = without_friction;
  for (unsigned int i = 0; i < n; ++i)
    solution.add(-multiplier[i], columns[i]);
  constraints.distribute(solution);
}

// @sect3{Energies}
//
// The displacement minimises $J(v) = \frac 12 a(v,v) - L(v) + \int_{\Gamma_C} g\,|v_t|$ over the
// continuous space. The discrete pair is a saddle point of the Lagrangian, in which $\lambda v_t$
// stands for $|v_t|$. The difference of the two, the <i>slack</i>, says how well the discrete
// friction law holds between the Gauss points.
//
// The absolute value wants care, because a quadrature formula would not see the kinks. Along an
// edge $u_t$ is a polynomial; between its zeros the integral of $|u_t|$ is a difference of its
// primitive. The zeros come one derivative after the other: between two zeros of the derivative a
// polynomial is monotone, and bisection finds its one zero.
namespace
{
/** 0, the zeros of @p q inside (0,1) in order, and 1. */
std::vector<double> pieces(const Polynomials::Polynomial<double> &q)
{
  if (q.degree() == 0)
    return {0., 1.};
  std::vector<double> result = {0.};
  const std::vector<double> monotone = pieces(q.derivative());
  for (unsigned int k = 0; k + 1 < monotone.size(); ++k)
  {
    double a = monotone[k], b = monotone[k + 1];
    if (!(q.value(a) * q.value(b) < 0.))
      continue;
    const bool rises = q.value(b) > 0.;
    while (b - a > 1e-15)
    {
      const double middle = 0.5 * (a + b);
      ((q.value(middle) > 0.) == rises ? b : a) = middle;
    }
    result.push_back(0.5 * (a + b));
  }
  result.push_back(1.);
  return result;
}

/** The integral of |q| over (0,1). */
double absolute_integral(const Polynomials::Polynomial<double> &q)
{
  const Polynomials::Polynomial<double> primitive = q.primitive();
  const std::vector<double> ends = pieces(q);
  double sum = 0;
  for (unsigned int k = 0; k + 1 < ends.size(); ++k)
    sum += std::abs(primitive.value(ends[k + 1]) - primitive.value(ends[k]));
  return sum;
}
} // namespace

void Block::compute_energies()
{
  double coupling = 0, friction = 0;
  for (unsigned int i = 0; i < B.size(); ++i)
    coupling += multiplier[i] * (B[i] * solution);

  const QGauss<1> points(degree + 1);
  const auto basis = Polynomials::generate_complete_Lagrange_basis(points.get_points());
  const FEValuesExtractors::Scalar tangential(0);
  std::vector<double> slip(points.size());
  const auto add_edge = [&](unsigned int, const auto &cell, const FEFaceValues<2> &values)
  {
    values[tangential].get_function_values(solution, slip);
    Polynomials::Polynomial<double> u_t(degree);
    for (unsigned int q = 0; q < slip.size(); ++q)
    {
      Polynomials::Polynomial<double> term = basis[q];
      u_t += (term *= slip[q]);
    }
    friction += Problem::friction_bound * cell->face(2)->measure() * absolute_integral(u_t);
  };
  for_each_contact_edge(points, update_values, add_edge);

  const double potential = 0.5 * system_matrix.matrix_norm_square(solution) - system_rhs * solution;
  table.add_value("cells", triangulation.n_active_cells());
  table.add_value("dofs", dof_handler.n_dofs() - constraints.n_constraints());
  table.add_value("multipliers", B.size());
  table.add_value("lagrangian", potential + coupling);
  table.add_value("energy", potential + friction);
  table.add_value("slack", friction - coupling);
  table.add_value("CG", steps.cg);
  table.add_value("expansion", steps.expansion);
  table.add_value("proportioning", steps.proportioning);
}

// @sect3{Results}
//
// The displacement for ParaView, and a table along the bottom: where, how far it has slipped, and the
// traction of friction over its bound. A point slips where that is 1 or -1.
void Block::output_results(const unsigned int mesh) const
{
  DataOut<2> data_out;
  data_out.attach_dof_handler(dof_handler);
  data_out.add_data_vector(solution, std::vector<std::string>{"u_x", "u_y"});
  data_out.build_patches(degree);
  std::ofstream vtu("displacement-" + std::to_string(mesh) + ".vtu");
  data_out.write_vtu(vtu);

  std::ofstream contact("contact-" + std::to_string(mesh) + ".csv");
  contact << "x,slip,multiplier\n" << std::setprecision(16);
  const FEValuesExtractors::Scalar tangential(0);
  std::vector<double> slip(multiplier_points.size());
  for_each_contact_edge(multiplier_points, update_values | update_quadrature_points,
                        [&](const unsigned int edge, const auto &, const FEFaceValues<2> &values)
                        {
                          values[tangential].get_function_values(solution, slip);
                          for (const unsigned int q : values.quadrature_point_indices())
                            contact << values.quadrature_point(q)[0] << ',' << slip[q] << ','
                                    << multiplier[edge * slip.size() + q] << '\n';
                        });
}

void Block::run(const unsigned int n_meshes)
{
  for (unsigned int mesh = 0; mesh < n_meshes; ++mesh)
  {
    make_mesh(4u << mesh);
    setup_system();
    assemble_body();
    assemble_contact();
    solve();
    compute_energies();
    output_results(mesh + 1);
  }
  table.set_precision("lagrangian", 12);
  table.set_precision("energy", 12);
  table.set_precision("slack", 3);
  table.set_scientific("slack", true);
  table.write_text(std::cout);
}
} // namespace TrescaFriction

// @sect3{The main function}
//
// The degree of the displacement may be given; the multiplier asks for two at least.
int main(int argc, char **argv)
{
  try
  {
    const int degree = argc > 1 ? dealii::Utilities::string_to_int(argv[1]) : 3;
    AssertThrow(degree >= 2, dealii::ExcMessage("The degree must be 2 or higher."));
    TrescaFriction::Block(degree).run(4);
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what() << std::endl;
    return 1;
  }
}
