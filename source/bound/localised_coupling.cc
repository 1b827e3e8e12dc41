// SPDX-License-Identifier: LGPL-2.1-or-later

// theta from above. A partition of unity compares T with wedges at both ends of contact, whose couplings are known, up to terms
// without derivatives. Where moments of v and of T v on each cell vanish, these have explicit constants: kappa. What is left is a
// finite matrix. doc/coulomb.md has both theorems.
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/coulomb_coupling.h>
#include <hpvi/bound/localised_coupling.h>
#include <hpvi/plane/mesh.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** |v - Pi v|^2 <= this h^2 |eps(v)|^2 on a square of side h, Pi the projection on rigid motions; the least is 0.1435. */
constexpr double square_constant = 0.1532;

/** kappa may exceed the largest coupling of half planes and wedges by so much before cells are bisected. */
constexpr double surplus = 1.05, largest_share = 0.06;

/** Cells of kappa at most. */
constexpr unsigned int most_cells = 1000;

/** Of slopes of mu_f chi between samples. */
constexpr double reserve = 1.1;

double square(const double x)
{
  return x * x;
}

/** What holds v on a side beside contact. */
enum class Held
{
  nothing,
  normal, ///< alone
  all,
  other ///< what no model body has
};

Held held_on(const BoundaryCondition<2> &condition, const Tensor<1, 2> &normal)
{
  if (condition.plate || condition.has_contact() || condition.spring)
    return Held::other;
  unsigned int n_held = 0;
  bool along_normal = true;
  const auto add = [&](const Tensor<1, 2> &direction)
  {
    ++n_held;
    along_normal = along_normal && std::abs(cross_product_2d(normal) * direction) < 1e-9;
  };
  for (unsigned int c = 0; c < 2; ++c)
    if (condition.displacement[c])
      add(Point<2>::unit_vector(c));
  if (condition.symmetry)
    add(normal);
  return n_held == 0    ? Held::nothing
         : along_normal ? Held::normal
         : n_held == 2  ? Held::all
                        : Held::other;
}

/** An edge of the boundary of the coarse mesh in the frame of the strip. */
struct SideEdge
{
  std::array<Point<2>, 2> ends;
  const BoundaryCondition<2> *condition;
  Tensor<1, 2> normal;
};
} // namespace

ContactStrip::ContactStrip(const Scene<2> &scene)
{
  const auto set_reason = [&](const std::string &reason)
  {
    if (why_none.empty())
      why_none = reason;
  };
  if (scene.has_pairs())
    set_reason("bodies touch each other");
  if (scene.materials.size() != 1 || scene.materials.front().orthotropy)
    set_reason("the material is not one that is isotropic");
  if (scene.is_axisymmetric())
    set_reason("the body is one of revolution");
  if (scene.has_springs())
    set_reason("there are springs");
  if (!why_none.empty())
    return;
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  std::vector<SideEdge> edges;
  const BoundaryCondition<2> *contact = nullptr;
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const CellMap<2> map = map_of<2>(cell);
    if (!map.is_affine())
      set_reason("not all cells are parallelograms");
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f))
      {
        const auto id = cell->face(f)->boundary_id();
        const BoundaryCondition<2> *condition =
            id < scene.boundaries.size() ? &scene.boundaries[id] : nullptr;
        edges.push_back({{{cell->face(f)->vertex(0), cell->face(f)->vertex(1)}},
                         condition,
                         map.normal(f, point_on_face<2>(f, Point<1>(0.5)))});
        if (condition && condition->friction.knows_pressure())
        {
          if (condition->contact_direction)
            set_reason("contact is along a direction");
          if (contact && contact != condition)
            set_reason("more than one side has friction");
          contact = condition;
        }
      }
  }
  if (!contact)
    set_reason("no side has friction");
  if (why_none.empty())
    set(edges, *contact, scene.materials.front(), set_reason);
}

template <class Edges, class SetReason>
void ContactStrip::set(const Edges &edges, const BoundaryCondition<2> &contact,
                       const Material &material, const SetReason &set_reason)
{
  const auto first = std::find_if(edges.begin(), edges.end(),
                                  [&](const auto &edge) { return edge.condition == &contact; });
  inwards = -first->normal;
  along = cross_product_2d(first->normal);
  origin = first->ends[0];
  double low = 0, high = 0, covered = 0, off = 0;
  for (const auto &edge : edges)
    if (edge.condition == &contact)
    {
      for (const Point<2> &end : edge.ends)
      {
        const Point<2> place = in_frame(end);
        low = std::min(low, place[0]);
        high = std::max(high, place[0]);
        off = std::max(off, std::abs(place[1]));
      }
      covered += (edge.ends[1] - edge.ends[0]).norm();
    }
  length = high - low;
  origin += low * along;
  const double small = 1e-9 * length;
  if (off > small || std::abs(covered - length) > small)
    return set_reason("contact is not one straight line");
  height = std::numeric_limits<double>::infinity();
  for (const auto &edge : edges)
  {
    const Point<2> a = in_frame(edge.ends[0]), b = in_frame(edge.ends[1]);
    if (edge.condition != &contact && std::max(a[0], b[0]) > small &&
        std::min(a[0], b[0]) < length - small)
      height = std::min(height, std::max(0., std::min(a[1], b[1])));
  }
  for (unsigned int end = 0; end < 2; ++end)
  {
    // Sides beside the strip, from contact on as far as what holds them is the same.
    const double x = end * length;
    double reach = 0;
    std::optional<Held> held;
    for (bool goes_on = true; goes_on;)
    {
      goes_on = false;
      for (const auto &edge : edges)
      {
        const Point<2> a = in_frame(edge.ends[0]), b = in_frame(edge.ends[1]);
        const double from = std::min(a[1], b[1]), to = std::max(a[1], b[1]);
        if (std::abs(a[0] - x) > small || std::abs(b[0] - x) > small ||
            std::abs(from - reach) > small || to <= reach)
          continue;
        const Held own = edge.condition ? held_on(*edge.condition, edge.normal) : Held::nothing;
        if (held && *held != own)
          continue;
        held = own;
        reach = to;
        goes_on = true;
      }
    }
    if (!held)
      return set_reason("contact does not end at a right angle");
    if (*held == Held::other)
      return set_reason("a side at the end of contact has a condition for which no wedge is known");
    height = std::min(height, reach);
    const double right_angle = numbers::PI / 2, half_plane = half_plane_coupling(material);
    wedges[end] = *held == Held::nothing ? free_wedge_coupling(right_angle)
                  : *held == Held::normal
                      ? half_plane
                      : std::max(half_plane, clamped_wedge_coupling(right_angle, material));
  }
  if (!(height > small))
    set_reason("the body has no rectangle above contact");
}

Point<2> ContactStrip::in_frame(const Point<2> &x) const
{
  return Point<2>((x - origin) * along, (x - origin) * inwards);
}

bool ContactStrip::reaches(const Point<2> &place) const
{
  return place[0] > 0 && place[0] < length && place[1] < height;
}

std::array<Tensor<1, 2>, 2> ContactStrip::gradients(const Point<2> &place) const
{
  const double a = numbers::PI / (2 * length), b = numbers::PI / (2 * height),
               c = std::cos(a * place[0]), s = std::sin(a * place[0]), d = std::cos(b * place[1]),
               e = std::sin(b * place[1]);
  return {{-a * s * d * along - b * c * e * inwards, a * c * d * along - b * s * e * inwards}};
}

// @sect3{kappa}

FrictionOnStrip::FrictionOnStrip(const ContactStrip &strip,
                                 const std::vector<ContactFace<2>> &faces,
                                 const FrictionAlong &friction)
{
  constexpr unsigned int n = 24; // pieces of a face
  struct Sample
  {
    double x, value;
  };
  std::vector<std::vector<Sample>> of_faces;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    if (!faces[k].condition->friction.knows_pressure() || friction.on_face(k, 0.5).sticks)
      continue;
    std::vector<Sample> samples;
    for (unsigned int i = 0; i <= n; ++i)
    {
      const double s = 0.5 * (1 - std::cos(numbers::PI * i / n));
      samples.push_back({strip.in_frame(faces[k].point(s))[0], friction.on_face(k, s).coefficient});
    }
    if (samples.front().x > samples.back().x)
      std::reverse(samples.begin(), samples.end());
    of_faces.push_back(samples);
  }
  std::sort(of_faces.begin(), of_faces.end(),
            [](const auto &a, const auto &b) { return a.front().x < b.front().x; });
  // Where the body sticks v_t is zero, and mu_f chi may be anything: a straight line between what it is at both ends.
  const Sample *last = nullptr;
  for (const auto &samples : of_faces)
    for (const Sample &sample : samples)
    {
      if (!last)
        pieces.push_back({0., sample.x, std::abs(sample.value), 0.});
      else if (sample.x > last->x + 1e-12 * strip.length)
      {
        const double slope = reserve * std::abs(sample.value - last->value) / (sample.x - last->x);
        pieces.push_back({last->x, sample.x,
                          std::max(std::abs(sample.value), std::abs(last->value)) +
                              (reserve - 1) * slope * (sample.x - last->x),
                          slope});
      }
      last = &sample;
    }
  if (last)
    pieces.push_back({last->x, strip.length, std::abs(last->value), 0.});
}

FrictionOnStrip::Range FrictionOnStrip::between(const double from, const double to) const
{
  Range result{0., 0.};
  for (const Piece &piece : pieces)
    if (piece.from < to && piece.to > from)
    {
      result.largest = std::max(result.largest, piece.largest);
      result.slope = std::max(result.slope, piece.slope);
    }
  return result;
}

namespace
{
/** The smallest box in the frame of the strip that has a cell. */
struct Box
{
  Box(const ContactStrip &strip, const Triangulation<2>::cell_iterator &cell)
  {
    for (unsigned int v = 0; v < 4; ++v)
    {
      const Point<2> place = strip.in_frame(cell->vertex(v));
      for (unsigned int d = 0; d < 2; ++d)
      {
        low[d] = v == 0 ? place[d] : std::min(low[d], place[d]);
        high[d] = v == 0 ? place[d] : std::max(high[d], place[d]);
      }
    }
  }

  /** Is a part of it in the rectangle of the strip? */
  bool meets(const ContactStrip &strip) const
  {
    const double small = 1e-9 * strip.length;
    return high[0] > small && low[0] < strip.length - small && high[1] > small &&
           low[1] < strip.height - small;
  }

  Point<2> low, high;
};

/** What a cell has of kappa: `kappa^2 = max of_v/(1 - max of_X)`. */
struct CellShare
{
  double of_v = 0, of_X = 0;
};

CellShare share_of(const Triangulation<2>::cell_iterator &cell, const ContactStrip &strip,
                   const FrictionOnStrip &friction, const Material &material)
{
  const Box box(strip, cell);
  if (!box.meets(strip))
    return {};
  const double x0 = std::max(0., box.low[0]), x1 = std::min(strip.length, box.high[0]),
               y0 = std::max(0., box.low[1]), y1 = std::min(strip.height, box.high[1]);
  const double a = numbers::PI / (2 * strip.length), b = numbers::PI / (2 * strip.height),
               c2 = square(std::cos(b * y0)), s2 = square(std::sin(b * y1)),
               sc = y0 * b <= numbers::PI / 4 && y1 * b >= numbers::PI / 4
                        ? 0.5
                        : std::max(0.5 * std::sin(2 * b * y0), 0.5 * std::sin(2 * b * y1)),
               t0 = square(strip.wedges[0]), t1 = square(strip.wedges[1]);
  const auto wedge = [&](const double x)
  { return t0 * square(std::cos(a * x)) + t1 * square(std::sin(a * x)); };
  const double T = std::max(wedge(x0), wedge(x1));
  const auto [m, slope] = friction.between(x0, x1);
  // q of Korn's inequality: by an affine map from a square, v by its transpose, so that rigid motions stay what they are.
  const Tensor<2, 2> J = map_of<2>(cell).jacobian(Point<2>(0.5, 0.5));
  const double squares = J.norm_square(), det = std::abs(determinant(J)),
               root = std::sqrt(std::max(0., squares * squares - 4 * det * det)),
               largest = 0.5 * (squares + root), smallest = det * det / largest,
               kappa = material.kolosov(),
               stiffness = (kappa + 1) / (2 * (kappa - 1)), // (lambda + 2 mu)/(2 mu)
      q2 = square_constant * largest * largest / smallest * stiffness;
  const double m0 = c2 * m * m * T,
               m1 = std::hypot(c2 * m * (slope * T + a * m * std::abs(t1 - t0) / 2),
                               b * m * m * T * sc),
               m2 =
                   c2 * std::max(t0, t1) * (slope * slope + a * a * m * m) + b * b * s2 * m * m * T;
  return {m0 + 2 * std::sqrt(q2) * m1 + q2 * m2, 4 * q2 * (a * a * c2 + b * b * s2)};
}
} // namespace

StripCells::StripCells(const Scene<2> &scene, const ContactStrip &strip,
                       const FrictionOnStrip &friction)
    : mesh(std::make_shared<Triangulation<2>>())
{
  make_mesh(scene, *mesh);
  const Material &material = scene.materials.front();
  const double enough = square(surplus * std::max(strip.wedges[0], strip.wedges[1]) *
                               friction.between(0., strip.length).largest);
  for (unsigned int n_marked = 1; n_marked > 0;)
  {
    n_marked = 0;
    double of_v = 0, of_X = 0;
    n_cells = 0;
    for (const auto &cell : mesh->active_cell_iterators())
    {
      const CellShare share = share_of(cell, strip, friction, material);
      of_v = std::max(of_v, share.of_v);
      of_X = std::max(of_X, share.of_X);
      n_cells += share.of_v > 0. || share.of_X > 0.;
      if (share.of_v > enough || share.of_X > largest_share)
      {
        cell->set_refine_flag();
        ++n_marked;
      }
    }
    kappa = of_X < 1. ? std::sqrt(of_v / (1 - of_X)) : std::numeric_limits<double>::infinity();
    if (n_cells + 3 * n_marked >
        most_cells) // bisected further, for the space, it takes no marks along
    {
      for (const auto &cell : mesh->active_cell_iterators())
        cell->clear_refine_flag();
      break;
    }
    mesh->execute_coarsening_and_refinement();
  }
  for (const auto &cell : mesh->active_cell_iterators())
    active.emplace(cell->level(), cell->index());
}

StripCells::Cell StripCells::parent_of(Cell cell) const
{
  while (active.count({cell->level(), cell->index()}) == 0)
    cell = cell->parent();
  return cell;
}

// @sect3{Moments}

StripMoments::StripMoments(const ContactStrip &strip, const StripCells &cells,
                           const Spaces<2> &spaces, const Material &material)
{
  const HookesLaw<2> law(material);
  std::map<std::pair<int, int>, unsigned int> places;
  for (const auto &cell : spaces.displacement_space.dof_handler().active_cell_iterators())
  {
    const StripCells::Cell own(&cell->get_triangulation(), cell->level(), cell->index()),
        parent = cells.parent_of(own);
    const Point<2> centre = parent->center();
    if (!Box(strip, parent).meets(strip))
      continue;
    const unsigned int place = places
                                   .emplace(std::make_pair(parent->level(), parent->index()),
                                            places.size())
                                   .first->second,
                       degree = spaces.displacement_space.degrees()[cell->active_cell_index()];
    const CellMap<2> map = map_of<2>(cell);
    const Tensor<2, 2> J = map.jacobian(Point<2>(0.5, 0.5)), inverse_J = invert(J);
    const ShapeTable<2> &table = spaces.tables->gradients(degree, degree + 2);
    Part part{cell->active_cell_index(), place, FullMatrix<double>(n_kinds, 2 * table.n_shapes)};
    for (unsigned int k = 0; k < table.points.size(); ++k)
    {
      const Point<2> x = map.point(table.points[k]), at = strip.in_frame(x);
      const double dx = table.weights[k] * std::abs(determinant(J));
      const std::array<Tensor<1, 2>, 2> gradients =
          strip.reaches(at) ? strip.gradients(at) : std::array<Tensor<1, 2>, 2>();
      for (unsigned int r = 0; r < 3; ++r)
      {
        Tensor<1, 2> R;
        if (r < 2)
          R[r] = 1.;
        else
          R = cross_product_2d(x - centre) / strip.length;
        std::array<SymmetricTensor<2, 2>, 2> stresses;
        for (unsigned int i = 0; i < 2; ++i)
          stresses[i] = law.stress(outer_product(R, gradients[i]));
        for (unsigned int j = 0; j < table.n_shapes; ++j)
        {
          Tensor<1, 2> gradient;
          for (unsigned int d = 0; d < 2; ++d)
            for (unsigned int e = 0; e < 2; ++e)
              gradient[e] += table.derivatives(k * table.rows_per_point + d, j) * inverse_J[d][e];
          const std::array<Tensor<1, 2>, 2> along{{stresses[0] * gradient, stresses[1] * gradient}};
          for (unsigned int c = 0; c < 2; ++c)
          {
            const unsigned int column = c * table.n_shapes + j;
            part.forms(r, column) += dx * R[c] * table.values(k, j);
            for (unsigned int i = 0; i < 2; ++i)
              part.forms(3 + 3 * i + r, column) += dx * along[i][c];
          }
        }
      }
    }
    parts.push_back(part);
  }
  n_cells = places.size();
}

std::vector<double> StripMoments::of(const Solution<2> &solution) const
{
  std::vector<double> result(n_kinds * n_cells);
  for (const Part &part : parts)
  {
    const std::vector<double> coefficients = solution.coefficients(part.cell);
    for (unsigned int kind = 0; kind < n_kinds; ++kind)
      for (unsigned int j = 0; j < coefficients.size(); ++j)
        result[kind * n_cells + part.place] += part.forms(kind, j) * coefficients[j];
  }
  return result;
}

namespace
{
double largest_eigenvalue(const FullMatrix<double> &A, FullMatrix<double> *const vectors = nullptr,
                          Vector<double> *const values = nullptr)
{
  LAPACKFullMatrix<double> copy(A.m());
  copy = A;
  FullMatrix<double> own_vectors;
  Vector<double> own_values;
  const double infinity = std::numeric_limits<double>::max();
  copy.compute_eigenvalues_symmetric(-infinity, infinity, 0., values ? *values : own_values,
                                     vectors ? *vectors : own_vectors);
  return (values ? *values : own_values)[A.m() - 1];
}
} // namespace

std::pair<double, double> with_complement(const FullMatrix<double> &M, const FullMatrix<double> &W,
                                          const double bound)
{
  const unsigned int n = M.m();
  FullMatrix<double> gram(n, n), vectors, half(n, n), B(n, n);
  Vector<double> eigenvalues;
  W.mTmult(gram, W);
  const double least = 1e-12 * largest_eigenvalue(gram, &vectors, &eigenvalues);
  M.mmult(half, vectors);
  vectors.Tmmult(B, half);
  unsigned int n_complement = 0; // eigenvalues ascend
  while (n_complement < n && eigenvalues[n_complement] < least)
    ++n_complement;
  FullMatrix<double> inner(n_complement, n_complement);
  if (n_complement > 0)
    inner.fill(B, 0, 0, 0, 0);
  for (unsigned int i = 0; i < n_complement; ++i)
    for (unsigned int j = 0; j < n_complement; ++j)
      B(i, j) = i == j ? bound : 0.;
  return {std::max(bound, largest_eigenvalue(B)),
          n_complement > 0 ? largest_eigenvalue(inner) : 0.};
}
} // namespace hpvi
