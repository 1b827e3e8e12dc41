#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""getfem_peer.py CASE even|graded|regraded N [DEGREE [PENALTY]]: a scene of hpvi by GetFEM on an even mesh of N cells along the shorter
side, or on one that is graded towards singular points and the ends of zones.
Displacements Qk, multipliers of contact and friction Q(k-1) in the augmented equations of Alart and Curnier; or a penalty of
PENALTY E/h. Prints as JSON what problems are compared by, and the wall and CPU seconds without the import."""
import json
import sys
import time

import getfem as gf
import numpy as np

import problems

IMPORTED = time.monotonic(), time.process_time()


def mesh_of(x, y):
    mesh = gf.Mesh("cartesian", x, y)
    faces = mesh.outer_faces()
    normals = mesh.normal_of_faces(faces)
    for number, axis, sign in ((1, 0, -1), (2, 0, 1), (3, 1, -1), (4, 1, 1)):  # left, right, bottom, top
        mesh.set_region(number, faces[:, normals[axis] * sign > 0.9])
    return mesh


LEFT, RIGHT, BOTTOM, TOP = 1, 2, 3, 4
NO_SOLUTION = 3  # status of a peer that gives up, unlike that of a mistake


class Problem:
    """A model of GetFEM, and what the four have in common in it."""

    def __init__(self, degree):
        self.degree, self.model, self.alive = degree, gf.Model("real"), []  # what GetFEM uses without keeping it

    def field(self, mesh, degree, components=2):
        space = gf.MeshFem(mesh, components)
        space.set_fem(gf.Fem(f"FEM_QK(2,{degree})"))
        lines = [len(np.unique(axis.round(9))) - 1 for axis in mesh.pts()]
        if space.nbdof() != components * np.prod([degree * n + 1 for n in lines]):
            sys.exit(NO_SOLUTION)  # GetFEM has united unknowns that lie near each other beside their cells
        return space

    def data(self, **values):
        for name, value in values.items():
            self.model.add_initialized_data(name, [float(value)])

    def moduli(self, E, nu, stress=False):
        la, mu = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
        self.data(la=2 * la * mu / (la + 2 * mu) if stress else la, mu=mu)

    def displacement(self, mesh, held, name="u"):
        """Components (region, row) of @p held are zero and leave the space."""
        space = self.field(mesh, self.degree)
        self.alive.append(space)
        if held:
            out = np.concatenate([[i for i in space.basic_dof_on_region(region) if i % 2 == row] for region, row in held])
            self.alive.append(gf.MeshFem("partial", space, np.setdiff1d(np.arange(space.nbdof()), out)))
        self.model.add_fem_variable(name, self.alive[-1])
        return space, gf.MeshIm(mesh, gf.Integ(f"IM_GAUSS_PARALLELEPIPED(2,{2 * self.degree + 2})"))

    def multiplier(self, mesh, name, region):
        space = self.field(mesh, self.degree - 1, 1)
        self.alive += [space, gf.MeshFem("partial", space, space.basic_dof_on_region(region))]
        self.model.add_fem_variable(name, self.alive[-1])

    def solve(self):
        _, converged = self.model.solve("max_iter", 100, "max_res", 1e-9, "lsolver", "mumps")
        if not converged:
            sys.exit(NO_SOLUTION)

    def integral(self, integration, term, region):
        return float(gf.asm_generic(integration, 0, term, region, self.model))


def contact_terms(law, penalty):
    """Virtual works and conditions of a side y = 0 of a body above it: pressure p, friction t on the body along x."""
    pressure = "pos_part(p+r*(-u(2)-gap))"
    if penalty:
        push = "r*pos_part(-u(2)-gap)"
        terms = [f"-{push}*Test_u(2)"] if law != "tresca" else []
        if law == "coulomb":
            terms.append(f"-Ball_projection(-s*u(1),f*{push})*Test_u(1)")
        if law == "tresca":
            terms.append("-Ball_projection(-s*u(1),g)*Test_u(1)")
        return terms
    terms = [] if law == "tresca" else ["-p*Test_u(2)", f"(1/r)*(p-{pressure})*Test_p"]
    if law == "coulomb":
        terms += ["-t*Test_u(1)", f"(1/r)*(t-Ball_projection(t-r*u(1),f*{pressure}))*Test_t"]
    if law == "tresca":
        terms += ["-t*Test_u(1)", "(1/r)*(t-Ball_projection(t-r*u(1),g))*Test_t"]
    return terms


def block(x, y, law, degree, penalty, moduli, load, held, size, **data):
    """A block on a plane: what Hertz, SSNV128 and Example 5.2 have in common."""
    mesh = mesh_of(x, y)
    problem = Problem(degree)
    problem.moduli(**moduli)
    problem.data(**data)
    space, integration = problem.displacement(mesh, held)
    r = moduli["E"] * (penalty / min(np.diff(x).min(), np.diff(y).min()) if penalty else 10 / size)
    problem.data(r=r, s=r / 10)
    model = problem.model
    model.add_isotropic_linearized_elasticity_brick(integration, "u", "la", "mu")
    if law == "hertz":
        model.add_initialized_fem_data("gap", *gap_field(problem, mesh))
    elif law == "coulomb":
        problem.data(gap=0)
    if not penalty:
        if law != "tresca":
            problem.multiplier(mesh, "p", BOTTOM)
        if law != "hertz":
            problem.multiplier(mesh, "t", BOTTOM)
    for term in contact_terms(law, penalty):
        model.add_nonlinear_term(integration, term, BOTTOM)
    for expression, region in load:
        model.add_linear_term(integration, f"-({expression}).Test_u", region)
    if law == "hertz":
        nodes = space.basic_dof_nodes()[:, ::2]
        model.add_initialized_fem_data("exact", space, np.array(problems.hertz_displacement(*nodes)).T.ravel())
        for region in (LEFT, RIGHT, TOP):
            model.add_Dirichlet_condition_with_simplification("u", region, "exact")
    problem.solve()
    push = "r*pos_part(-u(2)-gap)" if penalty else "p"
    drag = (f"Ball_projection(-s*u(1),{'g' if law == 'tresca' else f'f*{push}'})" if penalty else "t")
    # Zones by values in the nodes of the multiplier: pressing where p + r (..) > 0, slip where |t - r u| > bound.
    nodes = problem.field(mesh, max(1, degree - 1), 1)
    line = nodes.basic_dof_on_region(BOTTOM)
    places = nodes.basic_dof_nodes(line)[0]

    def ends(expression):
        return problems.crossings(places, problem.model.interpolation(expression, nodes)[line])

    result = {"unknowns": int(space.nbdof())}
    shift = "(-u(2)-gap)*r" if penalty else "p+r*(-u(2)-gap)"
    trial = "-s*u(1)" if penalty else "t-r*u(1)"
    if law == "hertz":
        return {**result, "force": problem.integral(integration, push, BOTTOM), "ends": ends(shift)}
    if law == "coulomb":
        return {**result, "force": problem.integral(integration, drag, BOTTOM),
                "ends": ends(shift)[:1] + ends(f"abs({trial})-f*pos_part({shift})")[-1:]}
    return {**result, "force": problem.integral(integration, drag, BOTTOM), "ends": ends(f"abs({trial})-g")[:1]}


def gap_field(problem, mesh):
    space = problem.field(mesh, 2, 1)
    return space, problems.HERTZ["gap"] * space.basic_dof_nodes()[0] ** 2


def hertz(lines, degree, penalty):
    return block(*lines, "hertz", degree, penalty, {"E": 200., "nu": 0.3}, [], [], 2.)


def ssnv128(lines, degree, penalty):
    return block(*lines, "coulomb", degree, penalty, {"E": 1.3e5, "nu": 0.2}, [("[150,0]", LEFT), ("[0,-50]", TOP)],
                 [(RIGHT, 0)], 40., f=1)


def example_5_2(lines, degree, penalty):
    return block(*lines, "tresca", degree, penalty, {"E": 15., "nu": 0.4, "stress": True}, [("[1.5*(5-X(2)),-0.75]", LEFT)],
                 [(RIGHT, 0), (RIGHT, 1), (BOTTOM, 1)], 4., g=4.5)


def shrink_fit(lines, degree, penalty):
    """Bodies of revolution: a shaft, in a hub."""
    y = lines[1][lines[1] < 30 + 1e-9]
    shaft, hub = mesh_of(lines[0], lines[1]), mesh_of(lines[2], y)
    fit = 5
    faces = shaft.region(RIGHT)
    shaft.set_region(fit, faces[:, [shaft.pts_from_cvid(cell)[0][1].mean() < 30 for cell in faces[0]]])
    problem = Problem(degree)
    model = problem.model
    problem.moduli(210000., 0.3)
    r = 210000. * (penalty / np.diff(y).min() if penalty else 10 / 20)
    problem.data(r=r, s=r / 10, f=0.15)
    spaces = []
    for mesh, name, held in ((shaft, "u", [(LEFT, 0)]), (hub, "v", [(TOP, 1)])):
        space, integration = problem.displacement(mesh, held, name)
        spaces.append((space, integration))
        round_about = f"(Trace(Grad_{name})+{name}(1)/X(1))*(Div_Test_{name}+Test_{name}(1)/X(1))"
        model.add_linear_term(integration, f"2*pi*X(1)*(la*{round_about}+2*mu*(Sym(Grad_{name}):Grad_Test_{name}"
                              f"+{name}(1)*Test_{name}(1)/sqr(X(1))))")
    integration = spaces[0][1]
    model.add_linear_term(integration, "-2*pi*X(1)*20*Test_u(2)", TOP)
    model.add_interpolate_transformation_from_expression("onto", shaft, hub, "X")
    deep, slip = "(u(1)-Interpolate(v,onto)(1)+0.02)", "(u(2)-Interpolate(v,onto)(2))"
    if penalty:
        push = f"(r*pos_part({deep}))"
        pressing, trial = f"r*{deep}", f"(-s*{slip})"
        drag = f"Ball_projection({trial},f*{push})"
    else:
        problem.multiplier(shaft, "p", fit)
        problem.multiplier(shaft, "t", fit)
        push, drag, pressing, trial = "p", "t", f"(p+r*{deep})", f"(t-r*{slip})"
        model.add_nonlinear_term(integration, f"2*pi*X(1)/r*((p-pos_part({pressing}))*Test_p"
                                 f"+(t-Ball_projection({trial},f*pos_part({pressing})))*Test_t)", fit)
    model.add_nonlinear_term(integration, f"2*pi*X(1)*({push}*(Test_u(1)-Interpolate(Test_v,onto)(1))"
                             f"-{drag}*(Test_u(2)-Interpolate(Test_v,onto)(2)))", fit)
    problem.solve()
    nodes = problem.field(shaft, max(1, degree - 1), 1)
    line = nodes.basic_dof_on_region(fit)
    places = nodes.basic_dof_nodes(line)[1]
    value = zone_values(problem, spaces, places, penalty, r)
    return {"unknowns": int(spaces[0][0].nbdof() + spaces[1][0].nbdof()), "ends": problems.crossings(places, value),
            "force": problem.integral(integration, f"2*pi*X(1)*{push}", fit)}


def zone_values(problem, spaces, places, penalty, r):
    """|t - r slip| - f p at places of the fit: positive where it slips."""
    model, at = problem.model, np.vstack([np.full_like(places, 20), places])

    def values(name, space):
        return model.interpolation(name, at, space.mesh())

    u = values("u", spaces[0][0]).reshape(-1, 2)
    v = values("v", spaces[1][0]).reshape(-1, 2)
    deep, slip = u[:, 0] - v[:, 0] + 0.02, u[:, 1] - v[:, 1]
    if penalty:
        return abs(r / 10 * slip) - 0.15 * np.maximum(r * deep, 0)
    p, t = values("p", spaces[0][0]), values("t", spaces[0][0])
    return abs(t - r * slip) - 0.15 * np.maximum(p + r * deep, 0)


def main():
    case, kind, n = sys.argv[1], sys.argv[2], int(sys.argv[3])
    degree = int(sys.argv[4]) if len(sys.argv) > 4 else 2
    penalty = float(sys.argv[5]) if len(sys.argv) > 5 else 0.
    gf.util_trace_level(0)
    result = globals()[case](problems.lines(case, kind, n), degree, penalty)
    result.update(wall=time.monotonic() - IMPORTED[0], cpu=time.process_time() - IMPORTED[1])
    print(json.dumps(result))


main()
