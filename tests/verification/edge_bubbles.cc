// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discretisation.h"

#include <deal.II/fe/fe_tools.h>
#include <hpvi/bound/contact_correction.h>

#include <numeric>

namespace
{
using namespace verification;

/** Displacements of degree q in one cell, a column each: @p traces on its boundary, the least energy inside. */
FullMatrix<double> with_least_energy(const FullMatrix<double> &K, const FullMatrix<double> &traces)
{
  const unsigned int n_b = traces.m(), n_i = K.m() - n_b;
  FullMatrix<double> K_ii(n_i, n_i), K_ib(n_i, n_b), forces(n_i, traces.n()),
      inside(n_i, traces.n()), result(K.m(), traces.n());
  K_ii.fill(K, 0, 0, n_b, n_b);
  K_ib.fill(K, 0, 0, n_b, 0);
  K_ib.mmult(forces, traces);
  K_ii.gauss_jordan();
  K_ii.mmult(inside, forces);
  inside *= -1.;
  result.fill(traces, 0, 0, 0, 0);
  result.fill(inside, n_b, 0, 0, 0);
  return result;
}

FullMatrix<double> products(const FullMatrix<double> &left, const FullMatrix<double> &K,
                            const FullMatrix<double> &right)
{
  FullMatrix<double> forces(K.m(), right.n()), result(left.n(), right.n());
  K.mmult(forces, right);
  left.Tmmult(result, forces);
  return result;
}

void expect_equal(const FullMatrix<double> &one, const FullMatrix<double> &other)
{
  ASSERT_EQ(one.m(), other.m());
  ASSERT_EQ(one.n(), other.n());
  for (unsigned int i = 0; i < one.m(); ++i)
    for (unsigned int j = 0; j < one.n(); ++j)
      EXPECT_NEAR(one(i, j), other(i, j), 1e-9 * other.linfty_norm()) << i << ", " << j;
}

/** Against the whole stiffness matrix of degree q, on rectangles, parallelograms and others. */
TEST(EdgeBubbles, HaveTheLeastEnergy)
{
  EdgeBubbles bubbles; // one for all, which must not mistake one cell for another
  for (const std::string corners :
       {"0, 0; 2, 0; 2, 1; 0, 1", "0, 0; 2, 0; 2.5, 1; 0.5, 1", "0, 0; 2, 0; 1.5, 1; 0, 1.2"})
    for (const unsigned int p : {2, 3})
    {
      const Scene<2> scene = shipped_scene("han-6-12", {given::quadrilateral("Geometry", corners)});
      const RandomMesh mesh(scene, 1, 0, p, p);
      const Laboratory lab(scene, mesh);
      const ContactFace<2> &face = lab.contact_space.faces()[0];
      const unsigned int q = p + 3, n = 2;
      FullMatrix<double> on_edge(2 * (q + 1), n);
      for (unsigned int k = 0; k <= q; ++k)
      {
        const double s = lab.tables.gauss_lobatto(q + 1).point(k)[0];
        on_edge(k, 0) = s * (1 - s);
        on_edge(q + 1 + k, 0) = 2 * s * s * (1 - s);
        on_edge(q + 1 + k, 1) = s * (1 - s) * std::pow(s - 0.4, 3);
      }
      const auto energies = bubbles.energies({{&face, on_edge}}, scene, lab.tables);
      const FullMatrix<double> K =
          ElementMatrices<2>(scene, lab.tables).stiffness(face.map, q, face.cell->material_id());
      const LocalNumbering &numbering = lab.tables.numbering(q);
      FullMatrix<double> traces(numbering.n_boundary, n);
      for (unsigned int i = 0; i < on_edge.m(); ++i)
        for (unsigned int j = 0; j < n; ++j)
          traces(numbering.edge[face.face_no][i], j) = on_edge(i, j);
      const FullMatrix<double> b = with_least_energy(K, traces);
      expect_equal(energies.own, products(b, K, b));
      const auto &elements = lab.tables.elements(q);
      FullMatrix<double> raised(elements[q - 1].n_dofs_per_cell(),
                                elements[p - 1].n_dofs_per_cell());
      FETools::get_interpolation_matrix(elements[p - 1], elements[q - 1], raised);
      FullMatrix<double> shapes(raised.m(), lab.tables.numbering(p).n_boundary);
      for (unsigned int i = 0; i < shapes.m(); ++i)
        for (unsigned int j = 0; j < shapes.n(); ++j)
          shapes(i, j) = raised(i, j);
      expect_equal(energies.with_shapes, products(shapes, K, b));
    }
}

/** The four bubbles along the tangent of a face: P_{p+1+i} - P_{p-1+i} of 2s - 1. */
double bubble(const unsigned int p, const unsigned int i, const double s)
{
  return std::legendre(p + 1 + i, 2 * s - 1) - std::legendre(p - 1 + i, 2 * s - 1);
}

/** The one face with stick and slip, where bubbles are on no other. */
const ContactFace<2> *face_of_bubbles(const Solution<2> &solution)
{
  const ContactFace<2> *result = nullptr;
  for (const ContactFace<2> &face : solution.contact_space.faces())
    if (has_transition(face, solution.z, solution.contact_space))
      result = &face;
  return result;
}

/** Energy and gap of w at quadrature points, bubbles included. */
TEST(ContactCorrection, KnowsTheEnergyAndGapOfBubbles)
{
  unsigned int n_cases = 0;
  for (const unsigned int seed : {1, 2, 3, 4, 5, 6})
  {
    const Scene<2> scene = shipped_scene("stick-slip", {{"Exact solution/Transition", "0.1"}});
    const RandomMesh mesh(scene, seed, 3, 3, 6);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    EdgeBubbles bubbles;
    const AdmissibleFriction<2> friction(solution);
    const ContactCorrection<2> slip(solution, lab.discretisation, friction,
                                    AdmissiblePressure<2>(solution), &bubbles);
    const unsigned int n = lab.discretisation.unknowns.n();
    const ContactFace<2> *const face = face_of_bubbles(solution);
    if (!face || slip.unknowns().size() != n + 4)
      continue;
    ++n_cases;
    // w in V_N, and the bubbles, in the cell of the face with degree q
    const unsigned int p = face->degree, q = p + 4, cell = face->cell->active_cell_index();
    Vector<double> w(lab.discretisation.unknowns.expand(
        Vector<double>(slip.unknowns().begin(), slip.unknowns().begin() + n)));
    lab.discretisation.condensation.extend(w);
    const FullMatrix<double> K =
        ElementMatrices<2>(scene, lab.tables).stiffness(face->map, q, face->cell->material_id());
    const Tensor<1, 2> tangent = face->frame(0.5).tangent;
    const auto bubbles_at = [&](const double s)
    {
      double result = 0;
      for (unsigned int i = 0; i < 4; ++i)
        result += slip.unknowns()[n + i] * bubble(p, i, s) / std::sqrt(2.);
      return result;
    };
    FullMatrix<double> traces(lab.tables.numbering(q).n_boundary, 1);
    for (unsigned int k = 0; k <= q; ++k)
      for (unsigned int c = 0; c < 2; ++c)
        traces(lab.tables.numbering(q).edge[face->face_no][c * (q + 1) + k], 0) =
            tangent[c] * bubbles_at(lab.tables.gauss_lobatto(q + 1).point(k)[0]);
    const FullMatrix<double> b = with_least_energy(K, traces);
    const auto &elements = lab.tables.elements(q);
    FullMatrix<double> raised(K.m(), elements[p - 1].n_dofs_per_cell());
    FETools::get_interpolation_matrix(elements[p - 1], elements[q - 1], raised);
    Vector<double> of_cell(raised.n()), x(K.m());
    for (unsigned int i = 0; i < of_cell.size(); ++i)
      of_cell[i] = w[lab.displacement_space.cell_dofs(cell)[i]];
    raised.vmult(x, of_cell);
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] += b(i, 0);
    const double energy = K.matrix_norm_square(x);
    EXPECT_GT(energy, 0.);
    EXPECT_NEAR(slip.energy()[cell], energy, 1e-9 * energy);
    EXPECT_NEAR(slip.total(),
                std::accumulate(slip.energy().begin(), slip.energy().end(), 0.) +
                    2 * std::accumulate(slip.gap().begin(), slip.gap().end(), 0.),
                1e-12 * slip.total());
    // its gap
    Vector<double> rest(solution.u);
    rest -= w;
    const EdgePolynomial v = edge_trace(*face, tangent, lab.displacement_space, lab.tables, rest);
    const unsigned int number = face - lab.contact_space.faces().data(), n_points = 20000;
    double gap = 0;
    for (unsigned int k = 0; k < n_points; ++k)
    {
      const double s = (k + 0.5) / n_points, value = v(s) - bubbles_at(s);
      gap += face->length / n_points * face->friction_bound(face->point(s)) *
             (std::abs(value) - friction.value(number, s) * value);
    }
    EXPECT_NEAR(slip.gap()[number], gap, 1e-6 * gap + 1e-8 * slip.total());
    // Without bubbles it is worse.
    const ContactCorrection<2> in_space(solution, lab.discretisation, friction,
                                        AdmissiblePressure<2>(solution), nullptr);
    EXPECT_LT(slip.total(), in_space.total());
  }
  EXPECT_GE(n_cases, 2u);
}
} // namespace
