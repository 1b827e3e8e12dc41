// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/space/box_equilibration.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

BoxModes along_axes(const FullMatrix<double> &A, BoxModes values, const unsigned int n_axes)
{
  const unsigned int n_in = A.n(), n_out = A.m();
  for (unsigned int axis = 0; axis < n_axes; ++axis)
  {
    std::size_t inner = 1, outer = 1;
    for (unsigned int d = 0; d < n_axes; ++d)
      (d < axis ? inner : outer) *= d < axis ? n_out : d > axis ? n_in : 1;
    BoxModes next(inner * n_out * outer);
    for (std::size_t o = 0; o < outer; ++o)
      for (unsigned int i = 0; i < n_out; ++i)
        for (unsigned int j = 0; j < n_in; ++j)
          for (std::size_t k = 0; k < inner; ++k)
            next[k + inner * (i + n_out * o)] += A(i, j) * values[k + inner * (j + n_in * o)];
    values.swap(next);
  }
  return values;
}

BoxModes on_face(const BoxModes &modes, const unsigned int n, const unsigned int face)
{
  const unsigned int axis = face / 2;
  const auto other = tangents<3>(face);
  BoxModes result(n * n);
  for (unsigned int c = 0, number = 0; c < n; ++c)
    for (unsigned int b = 0; b < n; ++b)
      for (unsigned int a = 0; a < n; ++a, ++number)
      {
        const std::array<unsigned int, 3> mode{{a, b, c}};
        result[mode[other[0]] + n * mode[other[1]]] +=
            modes[number] * legendre::at_end(mode[axis], face % 2 == 1);
      }
  return result;
}

namespace
{
/** @p modes, m of them along each axis, times the multilinear function with @p values at the corners: n = m + 1 along each. */
template <std::size_t n_corners>
BoxModes times_hat(const BoxModes &modes, const unsigned int m,
                   const std::array<double, n_corners> &values)
{
  const unsigned int n_axes = n_corners == 8 ? 3 : 2, n = m + 1;
  BoxModes result;
  for (unsigned int v = 0; v < n_corners; ++v)
  {
    if (values[v] == 0)
      continue;
    BoxModes product = modes;
    for (unsigned int axis = 0; axis < n_axes; ++axis)
    {
      const std::size_t inner = std::pow(n, axis), outer = std::pow(m, n_axes - 1 - axis);
      BoxModes next(inner * n * outer);
      for (std::size_t o = 0; o < outer; ++o)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i == 0 ? 0 : i - 1; j < std::min(m, i + 2); ++j)
            for (std::size_t k = 0; k < inner; ++k)
              next[k + inner * (i + n * o)] +=
                  BoxStress::hat_product(v >> axis & 1u, i, j) * product[k + inner * (j + m * o)];
      product.swap(next);
    }
    result.resize(product.size());
    for (std::size_t i = 0; i < product.size(); ++i)
      result[i] += values[v] * product[i];
  }
  return result;
}

std::array<double, 4> on_corners(const std::array<double, 8> &hat, const unsigned int face)
{
  const auto axes = tangents<3>(face);
  std::array<double, 4> result;
  for (unsigned int v = 0; v < 4; ++v)
    result[v] = hat[(v & 1u) << axes[0] | (v >> 1u) << axes[1] | (face % 2) << (face / 2)];
  return result;
}

bool is_zero(const std::array<double, 4> &values)
{
  return values == std::array<double, 4>{};
}
} // namespace

/** The unknowns of a patch: a component of a face each, n^2 of them. */
struct BoxEquilibration::Local
{
  struct Place
  {
    unsigned int member, datum, first; ///< cell of the patch, first of its data, first unknown
    int part;
    double sign;
  };
  std::vector<Place> places;
  std::vector<std::pair<unsigned int, unsigned int>> unknowns; ///< blocks and components
  std::vector<int> key; ///< the same for patches that are alike
};

BoxEquilibration::BoxEquilibration(const PrimalSpace<3> &space, const std::vector<BoxModes> &forces,
                                   const Sides &sides)
    : space(space), n(space.tables.only().degree + 2), m(n - 1), forces(forces), sides(sides),
      cells(space.dof_handler.get_triangulation().n_active_cells())
{
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    cells[cell->active_cell_index()] = cell;
  find_classes();
  find_faces();
  find_hats();
  const LegendreTables tables;
  for (unsigned int part = 0; part < 4; ++part)
  {
    const FullMatrix<double> &a = tables.part(m, part % 2), &b = tables.part(m, part / 2);
    FullMatrix<double> &both = parts.emplace_back(m * m, m * m);
    for (unsigned int i = 0; i < m * m; ++i)
      for (unsigned int j = 0; j < m * m; ++j)
        both(i, j) = a(i % m, j % m) * b(i / m, j / m);
  }
}

void BoxEquilibration::find_classes()
{
  std::vector<types::material_id> materials;
  for (const auto &cell : cells)
  {
    const Tensor<1, 3> size = PrimalSpace<3>::extent(cell);
    lengths.push_back(std::cbrt(size[0] * size[1] * size[2]));
    const auto is_alike = [&](const BoxStress &element)
    { return (lengths.back() * element.size - size).norm() < 1e-10 * size.norm(); };
    unsigned int number = 0;
    while (number < elements.size() &&
           (materials[number] != cell->material_id() || !is_alike(*elements[number])))
      ++number;
    if (number == elements.size())
    {
      elements.push_back(std::make_unique<const BoxStress>(space.tables.only().degree, size,
                                                           space.scene.material_of(cell)));
      materials.push_back(cell->material_id());
    }
    classes.push_back(number);
  }
}

/** The whole face beside quarters is that of the larger cell. */
void BoxEquilibration::find_faces()
{
  faces.resize(cells.size());
  unsigned int n_blocks = 0;
  for (const auto &cell : cells)
    for (const unsigned int face : cell->face_indices())
    {
      const bool is_own = cell->at_boundary(face) || cell->neighbor(face)->has_children() ||
                          (!cell->neighbor_is_coarser(face) &&
                           cell->neighbor(face)->active_cell_index() > cell->active_cell_index());
      if (is_own)
        faces[cell->active_cell_index()][face] = {n_blocks++, -1, 1.};
    }
  for (const auto &cell : cells)
    for (const unsigned int face : cell->face_indices())
    {
      if (cell->at_boundary(face) || cell->neighbor(face)->has_children())
        continue;
      const auto other = cell->neighbor(face);
      const unsigned int block = faces[other->active_cell_index()][face ^ 1u].block;
      if (cell->neighbor_is_coarser(face))
      {
        int part = 0;
        const auto axes = tangents<3>(face);
        for (unsigned int s = 0; s < 2; ++s)
          part += cell->center()[axes[s]] > other->center()[axes[s]] ? 1 << s : 0;
        faces[cell->active_cell_index()][face] = {block, part, -1.};
      }
      else if (other->active_cell_index() < cell->active_cell_index())
        faces[cell->active_cell_index()][face] = {block, -1, -1.};
    }
  tractions.resize(n_blocks);
}

/** Trilinear functions of vertices that do not hang. */
void BoxEquilibration::find_hats()
{
  const FE_Q<3> linear(1);
  DoFHandler<3> vertices(space.dof_handler.get_triangulation());
  vertices.distribute_dofs(linear);
  AffineConstraints<double> hanging;
  DoFTools::make_hanging_node_constraints(vertices, hanging);
  hanging.close();
  std::vector<std::map<unsigned int, std::array<double, 8>>> by_dof(vertices.n_dofs());
  std::vector<types::global_dof_index> dofs(8);
  for (const auto &cell : vertices.active_cell_iterators())
  {
    cell->get_dof_indices(dofs);
    const auto add =
        [&](const types::global_dof_index dof, const unsigned int corner, const double value)
    {
      by_dof[dof]
          .emplace(cell->active_cell_index(), std::array<double, 8>{})
          .first->second[corner] += value;
    };
    for (unsigned int v = 0; v < 8; ++v)
      if (const auto *const entries = hanging.get_constraint_entries(dofs[v]))
        for (const auto &[dof, weight] : *entries)
          add(dof, v, weight);
      else
        add(dofs[v], v, 1.);
  }
  const auto place = [this](const unsigned int cell, const unsigned int d)
  { return std::lround(cells[cell]->center()[d] / (1e-6 * space.scene.geometry.radius())); };
  for (const auto &hats : by_dof)
  {
    if (hats.empty()) // it hangs
      continue;
    Patch &patch = patches.emplace_back();
    for (const auto &[cell, hat] : hats)
      patch.cells.push_back(cell);
    std::sort(patch.cells.begin(), patch.cells.end(),
              [&](const unsigned int a, const unsigned int b)
              {
                for (unsigned int d = 3; d-- > 0;)
                  if (place(a, d) != place(b, d))
                    return place(a, d) < place(b, d);
                return false;
              });
    for (const unsigned int cell : patch.cells)
      patch.hats.push_back(hats.at(cell));
  }
}

const GivenTractions *BoxEquilibration::given(const unsigned int cell,
                                              const unsigned int face) const
{
  return cells[cell]->at_boundary(face) ? &sides.at({cell, face}) : nullptr;
}

BoxEquilibration::Local BoxEquilibration::local(const Patch &patch) const
{
  Local result;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> numbers;
  for (unsigned int member = 0; member < patch.cells.size(); ++member)
  {
    const unsigned int cell = patch.cells[member];
    result.key.push_back(classes[cell]);
    result.key.push_back(std::lround(4096 * lengths[cell] / lengths[patch.cells[0]]));
    for (const double value : patch.hats[member])
      result.key.push_back(std::lround(value * 4096));
    for (unsigned int face = 0; face < 6; ++face)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const GivenTractions *const known = given(cell, face);
        if ((known && known->is_given[c]) || is_zero(on_corners(patch.hats[member], face)))
          continue;
        const Use &use = faces[cell][face];
        const auto [number, is_new] = numbers.emplace(std::pair(use.block, c), numbers.size());
        if (is_new)
          result.unknowns.emplace_back(use.block, c);
        result.places.push_back(
            {member, element(cell).on_face(face, c), number->second * m * m, use.part, use.sign});
        for (const int part :
             {int(result.places.back().datum), int(number->second), use.part, int(use.sign)})
          result.key.push_back(part);
      }
    result.key.push_back(-2);
  }
  return result;
}

/** Of the energy of a cell, by the first of the patch. */
double BoxEquilibration::weight(const Patch &patch, const unsigned int member) const
{
  return std::pow(lengths[patch.cells[member]] / lengths[patch.cells[0]], 3);
}

/** Of one cell: what its hat makes of sigma(u), its loads and given tractions. */
std::vector<double> BoxEquilibration::gradient(const Patch &patch, const unsigned int member,
                                               const Vector<double> &u) const
{
  const unsigned int cell = patch.cells[member];
  const std::array<double, 8> &hat = patch.hats[member];
  const BoxStress &of_cell = element(cell);
  std::vector<double> data(3 * of_cell.n_row()), result(data.size() + BoxStress::n_conditions);
  of_cell.add_hat(hat, u, result);
  for (unsigned int c = 0; c < 3 && !forces[cell].empty(); ++c)
  {
    const auto first = forces[cell].begin() + c * m * m * m;
    const BoxModes product = times_hat(BoxModes(first, first + m * m * m), m, hat);
    for (unsigned int i = 0; i < product.size(); ++i)
      data[c * of_cell.n_row() + i] = -lengths[cell] * product[i];
  }
  for (unsigned int face = 0; face < 6; ++face)
    if (const GivenTractions *const known = given(cell, face))
      for (unsigned int c = 0; c < 3; ++c)
        if (known->is_given[c] && !known->modes[c].empty())
        {
          const BoxModes product = times_hat(known->modes[c], m, on_corners(hat, face));
          std::copy(product.begin(), product.end(), data.begin() + of_cell.on_face(face, c));
        }
  of_cell.add_data(data, result);
  for (unsigned int i = 0; i < data.size(); ++i)
    result[i] *= weight(patch, member);
  return result;
}

namespace
{
/** @p block, of data, in unknowns of whole faces. */
FullMatrix<double> in_unknowns(FullMatrix<double> block, const FullMatrix<double> *const rows,
                               const FullMatrix<double> *const columns)
{
  if (rows)
  {
    FullMatrix<double> product(rows->n(), block.n());
    rows->Tmmult(product, block);
    block = product;
  }
  if (columns)
  {
    FullMatrix<double> product(block.m(), columns->n());
    block.mmult(product, *columns);
    block = product;
  }
  return block;
}
} // namespace

/** Tractions of the least energy on patches with the same matrix; returns the largest defect. */
double BoxEquilibration::solve(const std::vector<const Patch *> &alike, const Local &local,
                               const std::vector<Vector<double>> &u,
                               std::vector<std::vector<double>> &solutions) const
{
  constexpr unsigned int n_conditions = BoxStress::n_conditions;
  const unsigned int n_unknowns = local.unknowns.size() * m * m, n_cells = alike[0]->cells.size(),
                     n_all = n_conditions * n_cells;
  LAPACKFullMatrix<double> H(n_unknowns, n_unknowns), C(n_all, n_unknowns);
  const auto part = [&](const Local::Place &place)
  { return place.part < 0 ? nullptr : &parts[place.part]; };
  for (const Local::Place &row : local.places)
  {
    const BoxStress &of_cell = element(alike[0]->cells[row.member]);
    const double weight_of_cell = weight(*alike[0], row.member);
    for (const Local::Place &column : local.places)
      if (row.member == column.member)
      {
        FullMatrix<double> block(m * m, m * m);
        for (unsigned int i = 0; i < m * m; ++i)
          for (unsigned int j = 0; j < m * m; ++j)
            block(i, j) = of_cell.second(row.datum + of_face(i), column.datum + of_face(j));
        block = in_unknowns(block, part(row), part(column));
        for (unsigned int i = 0; i < m * m; ++i)
          for (unsigned int j = 0; j < m * m; ++j)
            H(row.first + i, column.first + j) +=
                weight_of_cell * row.sign * column.sign * block(i, j);
      }
    FullMatrix<double> conditions(n_conditions, m * m);
    for (unsigned int i = 0; i < n_conditions; ++i)
      for (unsigned int j = 0; j < m * m; ++j)
        conditions(i, j) = of_cell.condition(row.datum + of_face(j), i);
    conditions = in_unknowns(conditions, nullptr, part(row));
    for (unsigned int i = 0; i < n_conditions; ++i)
      for (unsigned int j = 0; j < m * m; ++j)
        C(n_conditions * row.member + i, row.first + j) += row.sign * conditions(i, j);
  }
  LAPACKFullMatrix<double> z(n_unknowns, alike.size()), X(n_unknowns, n_all), S(n_all, n_all),
      right(n_all, alike.size()), of_conditions(n_unknowns, alike.size());
  for (unsigned int k = 0; k < alike.size(); ++k)
  {
    std::vector<std::vector<double>> gradients;
    for (unsigned int member = 0; member < n_cells; ++member)
    {
      gradients.push_back(gradient(*alike[k], member, u[alike[k]->cells[member]]));
      for (unsigned int i = 0; i < n_conditions; ++i)
        right(n_conditions * member + i, k) =
            gradients.back()[gradients.back().size() - n_conditions + i];
    }
    for (const Local::Place &place : local.places)
      for (unsigned int i = 0; i < m * m; ++i)
        if (place.part < 0)
          z(place.first + i, k) += place.sign * gradients[place.member][place.datum + of_face(i)];
        else
          for (unsigned int j = 0; j < m * m; ++j)
            z(place.first + j, k) += place.sign * parts[place.part](i, j) *
                                     gradients[place.member][place.datum + of_face(i)];
  }
  double worst = 0;
  if (n_unknowns > 0)
  {
    for (unsigned int i = 0; i < n_all; ++i)
      for (unsigned int j = 0; j < n_unknowns; ++j)
        X(j, i) = C(i, j);
    H.set_property(LAPACKSupport::symmetric);
    H.compute_cholesky_factorization();
    H.solve(X);
    H.solve(z);
    C.mmult(S, X);
    std::vector<double> schur(n_all * n_all);
    for (unsigned int i = 0; i < n_all; ++i)
      for (unsigned int j = 0; j < n_all; ++j)
        schur[i + n_all * j] = (S(i, j) + S(j, i)) / 2;
    const PivotedCholesky factor(n_all, schur, 1e-10);
    // C t = -right with t = -(z + X l)
    LAPACKFullMatrix<double> left = right;
    left *= -1.;
    C.mmult(left, z, /*adding=*/true);
    LAPACKFullMatrix<double> multipliers(n_all, alike.size());
    for (unsigned int k = 0; k < alike.size(); ++k)
    {
      std::vector<double> b(n_all);
      for (unsigned int i = 0; i < n_all; ++i)
        b[i] = -left(i, k);
      b = factor.solve(b);
      for (unsigned int i = 0; i < n_all; ++i)
        multipliers(i, k) = b[i];
    }
    X.mmult(z, multipliers, /*adding=*/true);
    z *= -1.;
    C.mmult(right, z, /*adding=*/true);
  }
  for (unsigned int k = 0; k < alike.size(); ++k)
  {
    std::vector<double> &solution = solutions[alike[k] - patches.data()];
    for (unsigned int i = 0; i < n_unknowns; ++i)
      solution.push_back(z(i, k));
    for (unsigned int i = 0; i < n_all; ++i)
      worst = std::max(worst, std::abs(right(i, k)));
  }
  return worst;
}

double BoxEquilibration::balance(const std::vector<Vector<double>> &u)
{
  std::map<std::vector<int>, std::vector<const Patch *>> by_key;
  std::vector<Local> locals;
  for (const Patch &patch : patches)
  {
    locals.push_back(local(patch));
    by_key[locals.back().key].push_back(&patch);
  }
  std::vector<const std::vector<const Patch *> *> groups;
  for (const auto &[key, alike] : by_key)
    groups.push_back(&alike);
  std::vector<std::vector<double>> solutions(patches.size());
  std::vector<double> defects(groups.size());
  parallel_for_each(groups.size(), 1,
                    [&](const unsigned int k) {
                      defects[k] = solve(*groups[k], locals[groups[k]->front() - patches.data()], u,
                                         solutions);
                    });
  for (std::vector<double> &traction : tractions)
    traction.assign(3 * m * m, 0.);
  for (const auto &[place, known] : sides)
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < known.modes[c].size() && known.is_given[c]; ++i)
        tractions[faces[place.first][place.second].block][c * m * m + i] = known.modes[c][i];
  for (unsigned int k = 0; k < patches.size(); ++k)
    for (unsigned int i = 0; i < solutions[k].size(); ++i)
    {
      const auto &[block, c] = locals[k].unknowns[i / (m * m)];
      tractions[block][c * m * m + i % (m * m)] += solutions[k][i];
    }
  double largest = 0;
  for (const std::vector<double> &traction : tractions)
    for (const double value : traction)
      largest = std::max(largest, std::abs(value));
  const double defect = *std::max_element(defects.begin(), defects.end());
  return largest > 0 ? defect / largest : 0.;
}

BoxStress::Distance BoxEquilibration::distance(const unsigned int cell,
                                               const Vector<double> &u) const
{
  const BoxStress &of_cell = element(cell);
  std::vector<double> data(3 * of_cell.n_row());
  for (unsigned int i = 0; i < forces[cell].size(); ++i)
  {
    const unsigned int c = i / (m * m * m), mode = i % (m * m * m);
    data[c * of_cell.n_row() + of_face(mode % (m * m)) + n * n * (mode / (m * m))] =
        -lengths[cell] * forces[cell][i];
  }
  for (unsigned int face = 0; face < 6; ++face)
  {
    const Use &use = faces[cell][face];
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < m * m; ++i)
        if (use.part < 0)
          data[of_cell.on_face(face, c) + of_face(i)] =
              use.sign * tractions[use.block][c * m * m + i];
        else
          for (unsigned int j = 0; j < m * m; ++j)
            data[of_cell.on_face(face, c) + of_face(i)] +=
                use.sign * parts[use.part](i, j) * tractions[use.block][c * m * m + j];
  }
  const double volume = std::pow(lengths[cell], 3);
  const auto [square, antisymmetry] = of_cell.distance(data, u);
  return {volume * square, std::sqrt(volume) * antisymmetry};
}
} // namespace hpvi
