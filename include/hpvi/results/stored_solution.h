// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stored_solution_h
#define hpvi_stored_solution_h

#include <hpvi/plane/mesh.h>
#include <hpvi/results/field.h>

#include <ostream>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * A displacement field by itself: polynomials on the active cells of a mesh that descends from the
 * coarse mesh of a scene. It can be kept in a file, so that an overkill solution serves as
 * reference for many runs.
 */
template <int dim>
class StoredSolution
{
public:
  /**
   * Read a file made by write_solution(). Throws InputError if it is not whole, or belongs to another problem
   * or another coarse mesh than @p scene, and says what differs.
   */
  StoredSolution(const Scene<dim> &scene, const std::string &file);

  double energy() const; ///< J(u)

  const dealii::Triangulation<dim> &triangulation() const;
  unsigned int degree(unsigned int cell) const;

  /** Coefficients of one active cell, component by component (see Field::coefficients). */
  const std::vector<double> &coefficients(unsigned int cell) const;

private:
  dealii::Triangulation<dim> mesh;
  double energy_value;
  Degrees degrees;
  std::vector<std::vector<double>> cell_coefficients;
};

/**
 * The format, a checksum (CRC-32) of all that follows, the entries that make up the problem, @p energy = J(u),
 * then one line per cell: its path from the coarse mesh, its degree, its coefficients. Collective; the first
 * process writes.
 */
template <int dim>
void write_solution(std::ostream &out, const Field<dim> &field, double energy);
} // namespace hpvi

#endif
