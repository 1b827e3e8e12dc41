// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/boundary_reader.h>
#include <hpvi/reader/closed_forms/closed_form.h>
#include <hpvi/reader/material_reader.h>
#include <hpvi/reader/pretension_reader.h>
#include <hpvi/reader/probe_reader.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/shapes/mesh_from_file.h>
#include <hpvi/reader/shapes/shape.h>
#include <hpvi/scene/geometry.h>
#include <hpvi/scene/material.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace hpvi
{
using namespace dealii;

std::string in_space(std::string text)
{
  const std::vector<std::pair<std::string, std::string>> changes{
      {"x and y", "x, y and z"},
      {"(x,y)", "(x,y,z)"},
      {"Fx; Fy", "Fx; Fy; Fz"},
      {"ux; uy", "ux; uy; uz"},
      {"Gx; Gy", "Gx; Gy; Gz"},
      {"gx; gy", "gx; gy; gz"},
      {", per thickness stress length^2", ""},
      {", per thickness stress length", ""},
      {"Small rotation of a rigid plate about that point, counterclockwise [radians]; empty: free",
       "Small rotation rx; ry; rz of a rigid plate about that point [radians], `free` by "
       "component; "
       "empty: free"},
      {"Moment on a rigid plate about that point, counterclockwise [stress length^3]",
       "Moment Mx; My; Mz on a rigid plate about that point [stress length^3], `free` as in Force"},
      {"u_t t", "u_t"},
      {"u_t, T_t those along (-dy, dx), per", "u_t, T_t what vectors have beside it, per"},
      {"dx; dy", "dx; dy; dz"},
      {"e1; e2; e12", "e1; e2; e3; e12; e13; e23"}};
  for (const auto &[plane, space] : changes)
    if (const std::size_t begin = text.find(plane); begin != std::string::npos)
      text.replace(begin, plane.size(), space);
  return text;
}

namespace
{
template <typename Pattern>
std::shared_ptr<const Patterns::PatternBase> matching(const Pattern &pattern)
{
  return std::make_shared<Pattern>(pattern);
}

std::string joined(const std::vector<std::string> &words, const std::string &separator)
{
  std::string result;
  for (const std::string &word : words)
    result += (result.empty() ? "" : separator) + word;
  return result;
}

void add(std::vector<Entry> &entries, const std::vector<Entry> &more)
{
  entries.insert(entries.end(), more.begin(), more.end());
}

void add_problem_entries(std::vector<Entry> &entries, const int dim,
                         const std::vector<std::string> &materials, const UserNames &names)
{
  const auto text = matching(Patterns::Anything());

  entries.insert(
      entries.end(),
      {{"", "Title", "", text, "one line of text", "One line for humans; empty: the file's name."},
       {"", "Dimension", "2", matching(Patterns::Integer(2, 3)), "2 or 3",
        "2: the plane. 3: space, a box with entries of three components."},
       {"Units", "Length", "", text, "a label", "Label of lengths; nothing is converted."},
       {"Units", "Stress", "", text, "a label", "Label of stresses; nothing is converted."}});
  if (names.bodies.empty())
    add(entries, dim == 2 ? geometry_entries<2>() : geometry_entries<3>());
  for (const std::string &body : names.bodies)
    add(entries, body_entries(dim, body));
  for (const std::string &pair : names.pairs)
    add(entries, pair_entries(pair));
  for (const std::string &material : materials)
    add(entries, material_entries(dim, material));
  entries.insert(
      entries.end(),
      {{"Body force", "Expression", "", text, "Fx; Fy or nothing",
        "Force per volume Fx; Fy as expressions of x and y [stress/length]; empty: none."},
       {"Body force", "Gravity", "", text, "gx; gy or nothing",
        "Force per mass gx; gy as expressions of x and y; each Material's Density times it is "
        "added "
        "to Expression; empty: none."},
       {"Temperature", "Expression", "", text, "one expression or nothing",
        "Temperature T(x,y) above that of the body without stress; each Material's Thermal "
        "expansion "
        "times it is an initial strain; empty: 0."}});
}

void add_method_entries(std::vector<Entry> &entries)
{
  const auto fraction = matching(Patterns::Double(std::numeric_limits<double>::min(), 1));
  const auto positive = matching(Patterns::Integer(1));
  const auto degree = matching(Patterns::Integer(1, 20));
  const std::string section = "Adaptivity";

  entries.insert(
      entries.end(),
      {{section, "Method", "hpa3", one_of(method_names), "one of " + joined(method_names, " "),
        "hup2, hup3, hup4: bisect every cell, p = 2, 3, 4. hap2, hap3, hap4: bisect cells with "
        "large indicator. pu: raise p everywhere. hpa1: bisect the first cells by indicator, raise "
        "p on the next. hpa2: bisect or raise p by the decay of Legendre coefficients. hpa3: "
        "the same where the indicator exceeds a share of the largest. hpa4: hpa3 in strides, each "
        "to "
        "a tenth of the error or to the tolerance: several layers and degrees at once, by what is "
        "expected of cells."},
       {section, "Smoothness reading", "joint", one_of(reading_names), "plain or joint",
        "How hpa2, hpa3 and hpa4 read the decay rate (4.81): joint: one fit of the scaled "
        "Euclidean norm "
        "over the displacement components, whatever the frame; plain: one fit per component, the "
        "smaller slope."},
       {section, "Indicator", "bound", one_of(indicator_names), "residual or bound",
        "What marks cells. bound: their shares of the guaranteed bound (Error/Bound), or the "
        "indicator where there is none. residual: the indicator eta_K (4.50)."},
       {section, "Start degree", "0", matching(Patterns::Integer(0, 20)), "an integer from 0 to 20",
        "Degree of every cell of the coarse mesh; 0: the method's own (hupN, hapN: N; pu, hpa1: 2; "
        "hpa2, hpa3, hpa4: 3)."},
       {section, "Maximum degree", "12", degree, "an integer from 1 to 20",
        "Cells of this degree are bisected where p would rise."},
       {section, "hap threshold", "0.5", fraction, "a number in (0, 1]",
        "hap: bisect where eta_K > threshold * mean(eta_K)."},
       {section, "hpa1 bisected fraction", "0.1", fraction, "a number in (0, 1]",
        "hpa1: fraction of cells bisected."},
       {section, "hpa1 raised fraction", "0.1", fraction, "a number in (0, 1]",
        "hpa1: fraction of cells, next in order, whose degree is raised."},
       {section, "hpa2 marked fraction", "0.2", fraction, "a number in (0, 1]",
        "hpa2: fraction of cells refined."},
       {section, "hpa2 decay threshold", "1", matching(Patterns::Double(0)), "a number >= 0",
        "hpa2: raise p where the decay rate b exceeds this, bisect elsewhere."},
       {section, "hpa3 threshold", "0.2", fraction, "a number in (0, 1]",
        "hpa3: refine cells where eta_K > threshold * max(eta_K)."},
       {section, "hpa3 decay threshold", "0.8", matching(Patterns::Double(0)), "a number >= 0",
        "hpa3: raise p where the decay rate b exceeds this, bisect elsewhere."},
       {section, "Maximum steps", "16", positive, "a positive integer",
        "Number of adaptive steps, the first on the coarse mesh."},
       {section, "Maximum unknowns", "1000000", positive, "a positive integer",
        "No step is started after one with as many free displacement unknowns; a coarse mesh with "
        "more of them is refused."},
       {section, "Maximum seconds", "0", matching(Patterns::Double(0)), "a number >= 0",
        "No step is started after this time of computing; 0: no limit."},
       {section, "Tolerance", "automatic", word_or("automatic", Patterns::Double(0)),
        "automatic or a number >= 0",
        "Stop where the relative error falls below, as Tolerance on knows it; 0: never. automatic: "
        "1e-3, but 0 where Maximum steps, Maximum unknowns or Maximum seconds is named, in a load "
        "history, with an exact or a reference solution, and where one is written; scene.prm says "
        "which."},
       {section, "Tolerance on", "bound", matching(Patterns::Anything()),
        "residual, bound, or a number that may have an interval",
        "bound: the guaranteed bound of |u - u_N|_a/|u_N|_a, or the indicator with a warning where "
        "none is guaranteed. residual: the relative indicator eta/((2 mu)^(1/2) |u_N|_a), with "
        "2 mu + 2 lambda for 2 mu where nu < 0. normal_resultant, friction_resultant, NAME_ux or "
        "NAME_uy of a Probe NAME, or NAME for both: the half-width of its guaranteed interval over "
        "its value; where it has none a warning says why, and other limits end the run. "
        "error_estimate_equilibrated: the bound without the factor that Coulomb's law makes, an "
        "estimate where no bound is known."}});
}

void add_loading_entries(std::vector<Entry> &entries)
{
  const std::string section = "Loading";
  entries.insert(
      entries.end(),
      {{section, "Steps", "", word_or("", Patterns::Integer(1, 10000)),
        "an integer from 1 to 10000, or nothing",
        "Number n of load steps: every expression may use t, which runs through 1/n, 2/n, ..., 1, "
        "and friction acts on the increment of the tangential displacement; empty: no history."},
       {section, "Adapt", "every step", one_of(load_adaptivity_names), "first step or every step",
        "first step: the mesh of the first load step stays, or of the first whose solution is not "
        "exact, as that of no load is. every step: each load step adapts that of the one before; "
        "without Adaptivity/Tolerance until its relative indicator is no more than a fifth above "
        "that of the first. The limits of Adaptivity hold for each load step."},
       {section, "Until steady", "", word_or("", Patterns::Double(1e-12, 0.5)),
        "a share from 1e-12 to 0.5, or nothing",
        "Repeats the load steps from t = 0 to 1 as a cycle until the energy that friction "
        "dissipates in one differs from that in the one before by less than this share, or is less "
        "than this share of the largest, as where contact shakes down; empty: they are gone "
        "through once."},
       {section, "Maximum cycles", "20", matching(Patterns::Integer(2, 1000)),
        "an integer from 2 to 1000", "Of Until steady: no cycle is begun after this many."}});
}

void add_program_entries(std::vector<Entry> &entries)
{
  const auto boolean = matching(Patterns::Bool());
  const std::string yes_no = "true or false";
  entries.insert(
      entries.end(),
      {{"Solver", "Path", "auto", one_of(path_names), "auto, reduced or primal",
        "reduced: a quadratic program for the multipliers, with a dense matrix. primal: Newton's "
        "method on displacements and moments of contact, sparse throughout; boxes, one degree for "
        "all cells of a body (hup, hap), bilateral or tangential contact with Tresca friction. "
        "auto: primal "
        "in space, on several processes, and where it offers what the scene asks for and the first "
        "mesh has so many multipliers that their dense algebra would take longer, from about 800 "
        "on; else reduced."},
       {"Solver", "Linear", "automatic", one_of(linear_names),
        "automatic, multigrid, amg or direct",
        "primal in space. multigrid: conjugate gradients without a matrix, with geometric "
        "multigrid, "
        "degrees 2 to 4; amg: with a matrix and algebraic multigrid; direct: a sparse "
        "factorisation, which the plane always has. automatic: multigrid where the coarse mesh has "
        "at most 20000 unknowns, else amg. What breaks down gives way to the next one."},
       {"Solver", "Primal tolerance", "0", matching(Patterns::Double(0, 1)), "a number in [0, 1]",
        "primal: Newton's method stops where its residual is below this part of the load vector; "
        "0: where what it leaves is below a hundredth of the estimated error."},
       {"Solver", "QP solver", "active set", one_of(qp_solver_names), "mprgp or active set",
        "mprgp: conjugate gradients on faces, the thesis's; active set: Newton's method with dense "
        "Cholesky factorisations, and mprgp where that cycles. Both end at the same tolerance."},
       {"Solver", "QP warm start", "true", boolean, yes_no,
        "Start from the multiplier of the previous step; false: from zero, as in the thesis."},
       {"Solver", "QP tolerance", "1e-12",
        matching(Patterns::Double(std::numeric_limits<double>::min(), 1)), "a number in (0, 1]",
        "Stop where the projected gradient is below this, relative to the right-hand side."},
       {"Solver", "QP maximum multiplications", "100000", matching(Patterns::Integer(1)),
        "a positive integer", "Products with S before the solver gives up (exit status 2)."},
       {"Solver", "Diagonal scaling", "true", boolean, yes_no, "Scale S by its diagonal."},
       {"Solver", "Coulomb solver", "newton", one_of(coulomb_method_names), "newton or fixed point",
        "newton: semismooth Newton on pressures and frictions at once, with fallbacks. fixed "
        "point: "
        "problems of Tresca, each with the bounds mu_f max(0, -T_n) of the last, accelerated."},
       {"Solver", "Check uniqueness", "false", boolean, yes_no,
        "Solve Coulomb friction in each step from a second start, too, where all that frictionless "
        "contact closes sticks, and warn where another equilibrium is found. Costs about as much "
        "as solving every step without a warm start: the time for the multipliers doubles at "
        "least. That nothing is found is no proof."},
       {"Solver", "Normal contact", "automatic", one_of(normal_contact_names),
        "automatic, nodes or multiplier",
        "How unilateral contact is discretised. multiplier: a pressure >= 0 at the Gauss points of "
        "each edge, of the same degree as the friction. nodes: u_n <= u_0 at its Gauss-Lobatto "
        "points, the thesis's set; not in space, with Path = primal or Coulomb friction. "
        "automatic: "
        "nodes where they are offered, else multiplier; scene.prm says which."},
       {"Solver", "Multiplier degree offset", "-2", matching(Patterns::Integer(-20, 4)),
        "an integer from -20 to -1, best -2",
        "The multiplier has degree p + offset on a contact edge of degree p. -2, the thesis's, and "
        "less: stable, whatever mesh and degrees. -1: a warning, the inf-sup constant falls like h "
        "and is 0 where displacements are prescribed at both ends of the contact. 0 and more: "
        "S is singular; refused but by --inf-sup, which measures the constant."},
       {"Solver", "Condition number", "false", boolean, yes_no,
        "Report the condition number of S, raw and scaled; costs an eigenvalue computation."},
       {"Solver", "Threads", "0", matching(Patterns::Integer(0, 64)), "an integer from 0 to 64",
        "On how many threads a step is computed; 0: all cores that the process may use, or as many "
        "as OMP_NUM_THREADS says. Results "
        "are the same to the last bit, whatever the number. Without effect, which is one, on the "
        "primal path, in space and on several processes, in sweeps and in Python, which have a "
        "core for each scene, and where ulimit says how much memory may be mapped."},
       {"Output", "Steps", "all", one_of(output_steps_names), "all or last",
        "Of which steps the files with a number in their name are kept: all, or the last one, and "
        "of "
        "a load history the last one of each load step. While a run goes on, that is the last one "
        "that is finished."},
       {"Output", "VTU", "true", boolean, yes_no,
        "Write solution-NN.vtu, contact-NN.vtu where there is contact, and a .pvd of each: for "
        "ParaView."},
       {"Output", "Mesh picture", "false", boolean, yes_no,
        "Has no effect any more: hpvi --report DIR draws the mesh."},
       {"Output", "Contact tables", "true", boolean, yes_no, "Write contact-NN.csv."},
       {"Output", "Report", "false", boolean, yes_no,
        "Has no effect any more: hpvi --report DIR makes the report."},
       {"Output", "Reference solution", "false", boolean, yes_no,
        "Write the last step's displacement to reference.dat, for Error/Reference solution."},
       {"Error", "Bound", "true", one_of({"true", "false", "last step"}),
        "true, false or last step",
        "Compute the guaranteed bound of the error, where there is one (doc/bound.md). true: of "
        "each step; on meshes of files, where cells are no parallelograms, around an axis and "
        "under Coulomb's law it takes longer than the step itself, and a file that does not name "
        "it has last step there. last step: of the last one alone, which saves most of its time; "
        "cells are "
        "marked by Indicator = residual then, and where Tolerance on asks for the bound or an "
        "interval the first step has it, too, and those that may meet the tolerance by their "
        "indicator."},
       {"Error", "Coupling", "estimated", one_of({"estimated", "localised"}),
        "estimated or localised",
        "What the bound of Coulomb's law knows of the coupling of friction and pressure. "
        "estimated: a matrix of its own mesh, and a twentieth more. localised: from above, by the "
        "known couplings of both ends of contact, and a matrix for what they leave; where contact "
        "is one straight side of one isotropic body without springs, with free, held or symmetric "
        "sides at right angles beside it. It takes up to some seconds a bound."},
       {"Error", "Bound on distorted cells", "false", boolean, yes_no,
        "Has no effect any more: bodies of any shape have their bound."},
       {"Error", "Reference solution", "", matching(Patterns::Anything()), "a file name or nothing",
        "File reference.dat of an overkill run with the same coarse mesh: errors are measured "
        "against it. Without effect where an exact solution is named."}});
}
/** What only a plane scene has. */
bool is_of_the_plane(const Entry &entry)
{
  return entry.name == "Shear" ||
         (entry.section == "Solver" &&
          (entry.name.rfind("QP ", 0) == 0 || entry.name == "Diagonal scaling" ||
           entry.name == "Coulomb solver" || entry.name == "Check uniqueness" ||
           entry.name == "Threads")) ||
         (entry.section == "Error" &&
          (entry.name == "Bound on distorted cells" || entry.name == "Coupling"));
}

/** The same entries for a body in space: points of three components, a method that it offers. */
void take_to_space(std::vector<Entry> &entries)
{
  entries.erase(std::remove_if(entries.begin(), entries.end(), is_of_the_plane), entries.end());
  const auto change = [&](const std::string &path, const std::string &value, const auto &pattern,
                          const std::string &wanted)
  {
    for (Entry &entry : entries)
      if (entry.path() == path)
      {
        entry.default_value = value;
        entry.pattern = matching(pattern);
        entry.wanted = wanted;
      }
  };
  for (Entry &entry : entries)
  {
    entry.wanted = in_space(entry.wanted);
    entry.documentation = in_space(entry.documentation);
    if (entry.name == "Rotation")
      entry.wanted = "rx; ry; rz or nothing";
    else if (entry.name == "Moment")
      entry.wanted = "Mx; My; Mz or nothing";
  }
  change("Dimension", "3", Patterns::Integer(3, 3), "2 or 3");
  change("Solver/Normal contact", "automatic",
         Patterns::Selection(joined(normal_contact_names, "|")), "automatic or multiplier");
  change("Adaptivity/Method", "hap2", Patterns::Selection(joined(method_names, "|")),
         "hup2, hup3, hup4, hap2, hap3 or hap4");
  for (Entry &entry : entries)
    if (entry.path() == "Error/Bound")
    {
      entry.default_value = "last step";
      entry.documentation =
          "Compute the guaranteed bound of the error (doc/space.md) of each step, or of the last "
          "one alone: of one body of boxes that supports hold, on one process. Under Coulomb's law "
          "it is an estimate. A file that does not name it has false for mesh files and several "
          "bodies.";
    }
    else if (entry.path() == "Exact solution/Solution")
      entry.documentation += " In space it is that of plane strain, the same for each z.";
}
} // namespace

std::vector<Entry> scene_entries(const int dim, const UserNames &names)
{
  std::vector<Entry> entries;
  std::vector<std::string> materials{""};
  materials.insert(materials.end(), names.materials.begin(), names.materials.end());
  add_problem_entries(entries, dim, materials, names);
  add(entries, closed_form_entries());
  for (const std::string &side : names.sides)
    if (!side.empty()) // edges of a mesh in no group are free
    {
      add(entries, boundary_entries(side));
      if (names.is_from_file && dim == 2)
        add(entries, curve_entries(side));
    }
  for (const std::string &interface : names.interfaces)
    add(entries, curve_entries(interface));
  for (const std::string &part : names.parts)
  {
    add(entries, part_entries(part, names.sides));
    add(entries, boundary_entries(part));
  }
  for (const std::string &pretension : names.pretensions)
    add(entries, pretension_entries(pretension));
  for (const std::string &probe : names.probes)
    add(entries, probe_entries(dim, probe));
  add_loading_entries(entries);
  add_method_entries(entries);
  add_program_entries(entries);
  if (dim == 3)
    take_to_space(entries);
  return entries;
}
} // namespace hpvi
