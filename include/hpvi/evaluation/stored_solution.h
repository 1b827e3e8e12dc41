// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stored_solution_h
#define hpvi_stored_solution_h

#include <hpvi/discretisation/solution.h>

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
  /** Copy of a solution's displacement; the mesh is referred to, not copied. */
  StoredSolution(const Solution<dim> &solution, double energy = 0);

  /**
   * Read a file made by write(). Throws InputError if it is not whole, or belongs to another problem
   * or another coarse mesh than @p scene, and says what differs.
   */
  StoredSolution(const Scene<dim> &scene, const std::string &file);

  double energy() const; ///< J(u)

  /**
   * The format, a checksum (CRC-32) of all that follows, the entries that make up the problem, J(u),
   * then one line per cell: its path from the coarse mesh, its degree, its coefficients.
   */
  void write(std::ostream &out) const;

  const dealii::Triangulation<dim> &triangulation() const;
  unsigned int degree(unsigned int cell) const;

  /** Coefficients of one active cell, component by component (see Solution::coefficients). */
  const std::vector<double> &coefficients(unsigned int cell) const;

private:
  dealii::Triangulation<dim> own_mesh; ///< empty where the mesh is another's
  const dealii::Triangulation<dim> *mesh;
  std::vector<std::string> problem; ///< entries "Section/Entry = value" of the scene it solves
  double energy_value;
  Degrees degrees;
  std::vector<std::vector<double>> cell_coefficients;
};
} // namespace hpvi

#endif
