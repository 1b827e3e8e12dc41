// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_row_element_h
#define hpvi_row_element_h

#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/energy_rule.h>
#include <hpvi/bound/traction_energy.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/material.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <optional>
#include <vector>

namespace hpvi
{
/**
 * The Raviart-Thomas fields of degree k on [-1,1]^2, Q_{k+1,k} x Q_{k,k+1}, by what they are made of: k^2 bubbles
 * `curl N_a(xi) N_b(eta)`, N_a the integral of L_a from -1; for each face and i <= k the field with flux L_i there, towards growing
 * xi or eta, and no divergence but its mean; and (k+1)^2 with divergence L_i(xi) L_j(eta) and no flux, none for that which is
 * constant: fluxes and divergence that are in balance have it from the fluxes. At
 * n x n Gauss points, xi fastest. Beside them the corner_stress() of marked corners.
 */
struct RowTable
{
  /** Bit c of @p marked_corners marks corner c. */
  RowTable(unsigned int degree, unsigned int n_gauss, unsigned int marked_corners);

  unsigned int n_fields() const
  {
    return of_divergence() + (k + 1) * (k + 1);
  }
  unsigned int of_face(const unsigned int face) const
  {
    return k * k + face * (k + 1);
  }
  unsigned int of_divergence() const
  {
    return k * k + 4 * (k + 1);
  }

  /** xi and eta component of all fields, and their divergence, at reference coordinates in [0,1]. */
  std::array<std::vector<double>, 3> at(const dealii::Point<2> &reference) const;

  const unsigned int k, n_gauss;
  std::vector<unsigned int> corners;    ///< marked
  std::vector<dealii::Point<2>> points; ///< in [0,1]^2
  std::vector<double> weights;          ///< their sum is 4

  /**
   * Each component of a field is @p factor times one product: along its own direction N_i, (1 - x)/2 or (1 + x)/2, number @p x of these k + 2, along
   * the other L_l. Products are counted by `x (k + 1) + l`. Its divergence is L_x(xi) L_l(eta). Factor 0: the component is zero.
   */
  struct Product
  {
    unsigned int number = 0;
    double factor = 0;
  };
  static constexpr unsigned int divergence = 2; ///< behind the xi and the eta component
  std::array<std::vector<Product>, 3> products; ///< by field

  std::vector<double> own, other; ///< those functions at Gauss points, (k + 2) x n and (k + 1) x n

  dealii::Quadrature<2> at_corners; ///< for what corner stresses have to do with polynomials
  std::array<dealii::FullMatrix<double>, 2>
      interpolation; ///< by direction: from Gauss points to these, points x n
  std::vector<std::vector<std::array<double, 3>>> corner_stresses; ///< by corner and point

private:
  void set_products();
  void set_corners(const dealii::QGauss<1> &gauss);
};

/** What a cell is to its rows of stress, besides its material: all in units of h. */
struct RowShape
{
  dealii::types::material_id material;
  const Material *law;
  CellMap<2> map; ///< [length]
  double h;       ///< h^2 is a quarter of the area of the corners' quadrilateral [length]
  std::array<double, 4>
      densities; ///< by face: flux on [-1,1] over the traction that StressEdge counts [length]
  double antisymmetry;             ///< C_K of CellConstants
  bool is_in_cell_on_axis = false; ///< is it a box of a cell that has a face on the axis?

  /** Of a body of revolution, whose rows are those of `2 pi x s`. */
  bool is_axisymmetric() const
  {
    return law->plane == PlaneModel::axisymmetric;
  }

  /** Of such a body: that along the axis, where rows vanish. */
  std::optional<unsigned int> face_on_axis() const
  {
    return is_axisymmetric() ? axis_face(map) : std::nullopt;
  }

  /** Is C_K for (int q^2/w)^{1/2}, without a mean? */
  bool has_slices() const
  {
    return is_in_cell_on_axis || face_on_axis();
  }
};

/** A stress by its fields, row by row, and the amplitudes of its corner stresses; or derivatives by them. */
struct RowFields
{
  explicit RowFields(const RowTable &table)
      : fields(2 * table.n_fields()), corners(table.corners.size())
  {
  }

  std::vector<double> fields, corners;
};

/**
 * One cell: stresses in energy, `(s, C^-1 s)^{1/2}` by its parts and `theta^{1/2} C_K (s_12 - s_21)`, at the points of its table. A corner stress is
 * known by its products with what is there, a polynomial through these points.
 *
 * In a body of revolution rows are those of `w s`, w = 2 pi x, and the first has no datum: `w s_tt = x Div r_1 + x w F_r` is the stress around the
 * axis. Energies have 1/w, what is antisymmetric has not.
 */
class RowValues
{
public:
  RowValues(const RowTable &table, const RowShape &shape);

  static constexpr double theta = 16;

  const RowTable &table;
  const bool is_axisymmetric;
  const unsigned int n_parts; ///< the last is the antisymmetric one

  /** In energy at all points, n_parts x points, and corner stresses by their amplitudes. */
  struct Stress
  {
    explicit Stress(const RowValues &of)
        : values(of.n_parts * of.table.points.size()), corners(of.table.corners.size())
    {
    }

    std::vector<double> values, corners;
  };

  void add(const RowFields &fields, Stress &stress) const;

  RowFields derivatives(const Stress &stress) const; ///< of half its square by all fields

  double square(const Stress &stress,
                bool is_antisymmetric) const; ///< of the last part, or of the others

  /** Components of sigma, the third around the axis. */
  using Components = std::array<double, 4>;

  /** Both squares, the last part behind, of @p fields less @p sigma at the points of any rule of the whole cell. */
  std::array<double, 2> squares(const RowShape &shape, const RowFields &fields,
                                const dealii::Quadrature<2> &rule,
                                const std::vector<Components> &sigma) const;

  /** Subtracts `psi sigma` at one point, and @p around in the direction around the axis. */
  void subtract(unsigned int q, const dealii::SymmetricTensor<2, 2> &sigma, double psi,
                Stress &stress, double around = 0.) const;

  RowFields antisymmetric_mean() const; ///< int (s_12 - s_21) by all fields

  /** On a face: by fields of @p row, all N_i of the component along it but those of its ends. */
  std::vector<RowFields> along(unsigned int face, unsigned int row) const;

  /**
   * Products in energy of all bubbles of the table, row by row, of @p corners, and of all edges in the order of TractionEnergy times
   * @p scale of their face: n x n.
   */
  std::vector<double> products(const std::vector<RowFields> &corners,
                               const std::array<double, 4> &scale) const;

  /** A field of one row. */
  struct Column
  {
    unsigned int row, field;
    double factor;
  };

  /** Those without flux and without data; in a body of revolution divergences of the first row are among them. */
  std::vector<Column> bubbles() const;

private:
  /** [part][xi or eta component, or divergence] of one row at one point. */
  using Frame = std::array<std::array<double, 3>, 5>;

  std::array<Frame, 2> frames_at(const dealii::Tensor<2, 2> &J, double radius) const;
  unsigned int n_components(unsigned int row) const; ///< that count
  void set_corners(const RowShape &shape);
  std::vector<Column> columns(const std::array<double, 4> &scale) const;
  void add_products(const std::vector<Column> &columns, unsigned int stride, unsigned int n_corners,
                    std::vector<double> &result) const;
  std::vector<double> weight(unsigned int row, unsigned int d, unsigned int other_row,
                             unsigned int e) const;
  std::vector<double> at_points(const double *coefficients, unsigned int d) const;
  void add_moments(const std::vector<double> &values, unsigned int d, double *result) const;

  const unsigned int n_weighted;                   ///< parts with 1/w: all on the axis
  const double antisymmetry;                       ///< theta^{1/2} C_K
  std::array<std::vector<Frame>, 2> frames;        ///< by row and point
  std::array<std::array<double, 4>, 4> compliance; ///< L of C^-1 in xx, yy, xy and around
  std::vector<double> roots;                       ///< of weights times det DF/h^2
  std::vector<double> turns;                       ///< w, or 1
  /** By corner: products of `B S`, B = DF there, with what is 1 at one point in one part: as Stress::values. */
  std::vector<std::vector<double>> corner_moments;
  /** Of two corner stresses, the last part and the others: corners x corners. */
  std::array<std::vector<double>, 2> corner_products;
};

/**
 * Stresses s on a cell of any shape whose rows are fields of a RowTable by the contravariant map, `s_i = DF r_i/det DF`:
 *
 *     det DF div s_i = Div r_i,     (s n)_i ds = (r_i nu) dt,
 *
 * so that divergence and tractions are polynomials on the reference cell whatever F is (doc/bound.md). s need not be symmetric:
 * energies are those of its symmetric part, and `theta C_K^2 |s_12 - s_21|^2` beside them. Data belong to such a stress whose
 * antisymmetric part has mean zero if forces and moment are in balance: three conditions `N'r = 0`. In a body of revolution that mean is
 * a condition on bubbles, and the force along the axis the only one on data; in a cell on the axis bubbles let the rows vanish there, and
 * tractions of the faces beside it are zero at their ends.
 */
class RowElement
{
public:
  /** @p table must outlive this object. */
  RowElement(const RowTable &table, const RowShape &shape);

  const RowTable &table;
  const RowValues values;
  const std::optional<unsigned int> face_on_axis;
  const unsigned int n_conditions;
  const std::array<double, 4> scale; ///< RowShape::densities over h
  const EnergyRule rule;             ///< for upper bounds of energies
  /** Of balance first; then, in a cell on the axis, those that rows of tractions vanish at their ends on it: face_of_end(). */
  using Conditions = std::array<double, 5>;
  Conditions lengths{}; ///< of the columns of N before they had length 1

  TractionEnergy energy() const;

  unsigned int n_motions() const ///< conditions of balance
  {
    return values.is_axisymmetric ? 1 : 3;
  }

  /** The face of condition @p c from the second on, in a cell on the axis. */
  unsigned int face_of_end(const unsigned int c) const
  {
    return (*face_on_axis < 2 ? 2 : 0) + (c - 1) / 2;
  }

  /** The first whose divergence is a datum. */
  unsigned int first_row() const
  {
    return values.is_axisymmetric ? 1 : 0;
  }

  /** Moments `(d, z)` of divergences, (k+1)^2 of each row, with the motions of N: what N' r takes off. */
  Conditions moments(const double *divergence) const;

  /** What makes an energy least that @p fields has these @p derivatives of. */
  RowFields best_bubbles(const RowFields &derivatives, const RowFields &fields) const;

  /** Those of @p derivatives by tractions with the best bubbles, n_edges. */
  std::vector<double> reduced(const RowFields &derivatives, const RowFields &fields) const;

private:
  void set_conditions(const RowShape &shape);
  void set_constraints(const RowShape &shape);
  void set_ends();
  unsigned int n_bubbles() const
  {
    return bubbles.size() + table.corners.size();
  }
  std::vector<double> missing(const std::vector<double> &of_bubbles, const RowFields &fields) const;
  std::vector<double> by_edges(const RowFields &derivatives) const;
  std::vector<double> by_bubbles(const RowFields &derivatives) const;
  void add_corners(const RowShape &shape);
  unsigned int n_edges() const
  {
    return 8 * (table.k + 1);
  }

  std::vector<double> L, W, G,
      N; ///< of bubbles; L^-1 times bubbles x edges; edges x edges; edges x 3
  std::vector<double> N_divergence; ///< 2 (k+1)^2 x 3
  const std::vector<RowValues::Column> bubbles;
  /** What bubbles make zero: by fields; L^-1 by bubbles; what is left by edges. */
  std::vector<RowFields> constraints;
  std::vector<double> by_bubbles_of, by_edges_of;
  dealii::FullMatrix<double> inverse; ///< of products of the second

  std::vector<RowFields> corners; ///< each corner's stress less what has its fluxes: bubbles, too
};

/** B of a corner's stress `B S`: s = B S DF'/det DF is symmetric where it is not zero, at the corner. */
dealii::Tensor<2, 2> corner_frame(const RowShape &shape, unsigned int corner);
} // namespace hpvi

#endif
