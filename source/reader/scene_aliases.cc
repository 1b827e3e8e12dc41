// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/scene_aliases.h>
#include <hpvi/reader/scene_entries.h>

namespace hpvi
{
namespace
{
std::vector<Alias> hints_about_body()
{
  const std::string elasticity = "\"Material/Young's modulus\" and \"Material/Poisson's ratio\"";
  return {{{"e", "young", "modulus", "elastic modulus", "modulus of elasticity", "stiffness"},
           "set \"Material/Young's modulus\""},
          {{"nu", "poisson", "poisson number"}, "set \"Material/Poisson's ratio\""},
          {{"lambda", "shear modulus", "bulk modulus", "lame parameters", "elasticity"},
           "set " + elasticity},
          {{"rho", "weight", "g", "self weight"},
           "weight is \"Material/Density\" times \"Body force/Gravity\" = gx; gy"},
          {{"domain", "box", "width", "height", "length", "dimensions", "corner"},
           "the body lies between \"Geometry/Lower corner\" and \"Geometry/Upper corner\""},
          {{"mesh", "mesh size", "grid", "cells", "elements", "element size", "resolution", "nx",
            "ny", "n", "h", "refinement", "refinements", "refinement levels", "initial refinement",
            "global refinement"},
           "\"Geometry/Subdivisions\" makes the coarse mesh, and \"Adaptivity/Method\" refines it"},
          {{"2d", "3d", "dim", "space"}, "set \"Dimension\" to 2 or 3, outside of subsections"},
          {{"constants", "constant", "function constants", "variables", "parameters"},
           "no names can be declared; expressions know x and y and the constants pi, E, nu and mu"},
          {{"name", "description"}, "set \"Title\", outside of subsections"}};
}

std::vector<Alias> hints_about_conditions()
{
  return {
      {{"force", "forces", "load", "loads", "surface load", "line load", "point load", "neumann",
        "neumann boundary", "surface force", "surface traction"},
       "a load on a boundary is \"Boundary top/Traction\" = Gx; Gy, a force per area, and one in "
       "the body \"Body force/Expression\" = Fx; Fy"},
      {{"volume force", "volume load", "body load", "body forces"},
       "set \"Body force/Expression\" = Fx; Fy"},
      {{"fixed", "fix", "clamped", "clamp", "support", "supports", "dirichlet",
        "dirichlet boundary", "constraint", "constraints", "held", "u", "ux", "uy", "uz"},
       "a support is \"Boundary left/Displacement\" = ux; uy, with `free` for a component that may "
       "move"},
      {{"roller", "sliding", "symmetry plane"},
       "a plane of symmetry is \"Boundary left/Symmetry\" = true, one that the body rubs along "
       "\"Boundary left/Contact\" = bilateral"},
      {{"obstacle", "foundation", "clearance", "interference", "penetration"},
       "set \"Boundary bottom/Gap\", with \"Boundary bottom/Contact\" = unilateral"},
      {{"unilateral", "bilateral", "frictionless", "contact type", "contact pair"},
       "set \"Boundary bottom/Contact\" to bilateral, unilateral or tangential"},
      {{"friction", "coefficient", "friction law", "coulomb", "coulomb friction", "tresca",
        "tresca friction", "mu_f", "mu", "coefficient of friction"},
       "friction is \"Boundary bottom/Friction bound\", Tresca's, or \"Boundary "
       "bottom/Friction coefficient\", Coulomb's; a shear modulus follows from \"Material/Young's "
       "modulus\" and \"Material/Poisson's ratio\""},
      {{"thermal", "heat", "temperature change", "thermal strain", "eigenstrain", "prestress",
        "prestrain", "shrinkage"},
       "strains without load are \"Material/Initial strain\" = e1; e2; e12, or "
       "\"Material/Thermal expansion\" with \"Temperature/Expression\""},
      {{"springs", "foundation stiffness", "bedding", "elastic foundation", "winkler",
        "winkler foundation"},
       "an elastic foundation is \"Boundary bottom/Spring\" = kn; kt"},
      {{"penalty", "contact stiffness", "penalty parameter"},
       "contact has no constant to choose; remove it"}};
}

std::vector<Alias> hints_about_method()
{
  return {{{"degree", "order", "polynomial degree", "element order", "p", "finite element"},
           "set \"Adaptivity/Start degree\""},
          {{"steps", "max steps", "number of steps", "iterations"},
           "the number of adaptive steps is \"Adaptivity/Maximum steps\", that of load steps "
           "\"Loading/Steps\""},
          {{"time", "t", "time step", "time steps", "end time", "final time", "load steps"},
           "a load history has \"Loading/Steps\", in which t runs from 0 to 1"},
          {{"max unknowns", "maximum dofs", "max dofs"}, "set \"Adaptivity/Maximum unknowns\""},
          {{"max seconds", "time limit"}, "set \"Adaptivity/Maximum seconds\""},
          {{"error", "accuracy", "precision"}, "set \"Adaptivity/Tolerance\""},
          {{"adaptive", "adaptive refinement", "refine", "strategy"}, "set \"Adaptivity/Method\""},
          {{"probe", "probes", "sensor", "gauge", "gauges", "output point", "output points",
            "evaluation point", "evaluation points"},
           "a place of which results tell displacement and stress has a subsection Probe NAME, "
           "with At = x, y, On = a boundary, or From and To"},
          {{"pretension", "pre-tension", "preload", "bolt", "bolts", "bolt load", "bolt force",
            "bolt preload", "tightening"},
           "a bolt that is tightened has a subsection Pretension NAME, with Through = x1, y1; x2, "
           "y2, a cut, and Force"},
          {{"output directory", "directory", "folder"},
           "the directory is that of the option --output"}};
}

/** Between bodies, where the names of entries are others. */
std::vector<Alias> hints_about_pairs()
{
  return {{{"contact", "contact type", "type", "unilateral", "bilateral", "tangential", "tied",
            "glued", "frictionless"},
           "set \"Contact joint/Law\" to unilateral, bilateral, tied or tangential",
           "Contact "},
          {{"obstacle", "clearance", "interference", "penetration", "distance"},
           "set \"Contact joint/Gap\"",
           "Contact "},
          {{"sides", "surfaces", "master", "bodies"},
           "the two sides are \"Contact joint/Between\" = BODY.side, BODY.side",
           "Contact "}};
}

/** Of curves inside of a body, which have a shape and nothing else. */
std::vector<Alias> hints_about_curves_inside(const std::vector<std::string> &interfaces)
{
  std::vector<Alias> result;
  for (const std::string &curve : interfaces)
    result.push_back({{},
                      "it is a curve inside of the body, which has Curve alone, for nothing acts "
                      "there; for contact along it let each side be a Body NAME, by its Surfaces, "
                      "and write a subsection Contact NAME between them",
                      "Boundary " + curve});
  return result;
}

const std::vector<std::string> words_of_orthotropy = {"orthotropic",
                                                      "orthotropy",
                                                      "anisotropic",
                                                      "anisotropy",
                                                      "transversely isotropic",
                                                      "e1",
                                                      "e2",
                                                      "e3",
                                                      "ex",
                                                      "ey",
                                                      "ez",
                                                      "nu12",
                                                      "nu13",
                                                      "nu23",
                                                      "nu21",
                                                      "nuxy",
                                                      "g12",
                                                      "g13",
                                                      "g23",
                                                      "gxy",
                                                      "fibre angle",
                                                      "fiber angle",
                                                      "orientation",
                                                      "material angle",
                                                      "fibres",
                                                      "theta",
                                                      "material orientation"};

std::vector<Alias> hints_in_plane()
{
  return {
      {words_of_orthotropy,
       "set \"Material/Elasticity\" = orthotropic, \"Material/Young's moduli\" = E1, E2, E3, "
       "\"Material/Poisson's ratios\" = nu12, nu13, nu23, \"Material/Shear moduli\" = G12 and "
       "\"Material/Angle\""},
      {{"axes"}, "set \"Material/Angle\" = degrees of axis 1 against x"},
      {{"normal", "contact normal", "normal direction", "direction"},
       "contact is along the normal of the body, or along \"Boundary bottom/Contact direction\" = "
       "dx; dy"},
      {{"size"}, "the body lies between \"Geometry/Lower corner\" and \"Geometry/Upper corner\""},
      {{"boundary front", "boundary back"}, "only space has it; set \"Dimension\" to 3"},
      {{"plane strain", "plane stress", "axisymmetric", "axisymmetry", "axial symmetry"},
       "set \"Material/Plane\" to stress, strain or axisymmetric"}};
}

std::vector<Alias> hints_in_space()
{
  return {{words_of_orthotropy,
           "set \"Material/Elasticity\" = orthotropic, \"Material/Young's moduli\" = E1, E2, E3, "
           "\"Material/Poisson's ratios\" = nu12, nu13, nu23, \"Material/Shear moduli\" = G12, "
           "G13, G23 and \"Material/Axes\" = x1, y1, z1; x2, y2, z2"},
          {{"angle"}, "set \"Material/Axes\" = x1, y1, z1; x2, y2, z2, vectors along axes 1 and 2"},
          {{"plane", "plane strain", "plane stress"}, "only a body in the plane has it; remove it"},
          {{"thickness"}, "only a body in the plane has it; remove it"},
          {{"normal", "contact normal", "normal direction", "direction"},
           "contact is along the normal of the body, or along \"Boundary bottom/Contact "
           "direction\" = dx; dy"},
          {{"size"},
           "the body lies between \"Geometry/Lower corner\" and \"Geometry/Upper corner\", and a "
           "probe in space has no disc"},
          {{"shear"}, "space has two tangents; write \"Boundary top/Traction\" = Gx; Gy"},
          {{"corners"}, "space has no shape but the box; remove it"},
          {{"qp solver", "qp warm start", "qp tolerance", "qp maximum multiplications",
            "diagonal scaling", "coulomb solver", "check uniqueness"},
           "only the reduced path of the plane has it; remove it"},
          {{"threads"},
           "a body in space has one thread of each process; start several, mpirun -np N hpvi, and "
           "remove it"},
          {{"bound on distorted cells"},
           "cells of space that are no boxes have no guaranteed bound of the error; remove it"}};
}
} // namespace

std::vector<Alias> scene_aliases(const int dim, const std::vector<std::string> &boundaries,
                                 const std::vector<std::string> &interfaces)
{
  std::vector<Alias> aliases{
      {{"boundary", "boundaries", "boundary condition", "boundary conditions", "bc"},
       "conditions stand in the subsections Boundary " + listed(boundaries, "and")},
      {{"rigid plate", "rigid body", "platen", "rigid punch", "resultant", "nodal force"},
       "a boundary that a resultant presses as a whole has \"Boundary top/Rigid\" = true and "
       "\"Boundary top/Force\" = Fx; Fy"}};
  for (const std::vector<Alias> &some :
       {hints_about_curves_inside(interfaces), hints_about_pairs(),
        dim == 2 ? hints_in_plane() : hints_in_space(), hints_about_body(),
        hints_about_conditions(), hints_about_method()})
    aliases.insert(aliases.end(), some.begin(), some.end());
  for (Alias &hint : aliases)
    if (dim == 3)
      hint.remedy = in_space(hint.remedy);
  return aliases;
}
} // namespace hpvi
