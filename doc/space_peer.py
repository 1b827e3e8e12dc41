#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""space_peer.py N...: prm/slab.prm by GetFEM on 2N x 2N x N elements: Q2 displacements, a Q1 multiplier for friction,
Newton's method on the augmented equations with MUMPS. Prints [unknowns, J, CPU seconds] for each N as JSON."""
import json
import sys
import time

import getfem as gf
import numpy as np


def solve(n):
    begin = time.process_time()
    mesh = gf.Mesh("cartesian", np.linspace(0, 4, 2 * n + 1), np.linspace(0, 4, 2 * n + 1), np.linspace(0, 2, n + 1))
    faces = mesh.outer_faces()
    normals = mesh.normal_of_faces(faces)
    left, right, bottom = 1, 2, 3
    for region, axis, sign in ((left, 0, -1), (right, 0, 1), (bottom, 1, -1)):
        mesh.set_region(region, faces[:, normals[axis] * sign > 0.9])
    integration = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,6)"))

    def field(degree):
        result = gf.MeshFem(mesh, 3)
        result.set_fem(gf.Fem(f"FEM_QK(3,{degree})"))
        return result

    # What is held leaves the space; friction has the components along the plane.
    whole, traction = field(2), field(1)
    below = whole.basic_dof_on_region(bottom)
    held = np.union1d(whole.basic_dof_on_region(right), below[below % 3 == 1])
    u_space = gf.MeshFem("partial", whole, np.setdiff1d(np.arange(whole.nbdof()), held))
    below = traction.basic_dof_on_region(bottom)
    t_space = gf.MeshFem("partial", traction, below[below % 3 != 1])

    model = gf.Model("real")
    model.add_fem_variable("u", u_space)
    model.add_fem_variable("t", t_space)
    for name, value in (("la", 15 * 0.4 / (1.4 * 0.2)), ("mu", 15 / 2.8), ("g", 4.5), ("r", 15. * n)):
        model.add_initialized_data(name, [value])
    load = "[1.5*(5-X(2)),-0.75,0.5]"
    model.add_isotropic_linearized_elasticity_brick(integration, "u", "la", "mu")
    model.add_linear_term(integration, f"-{load}.Test_u", left)
    model.add_nonlinear_term(integration, "-t.Test_u", bottom)
    model.add_nonlinear_term(integration, "(1/r)*(t-Ball_projection(t-r*u,g)).Test_t", bottom)
    model.solve("max_iter", 60, "max_res", 1e-9, "lsolver", "mumps")

    def integral(term, region):
        return gf.asm_generic(integration, 0, term, region, model)

    energy = (integral("0.5*((la*Trace(Grad_u)*Id(3)+2*mu*Sym(Grad_u)):Grad_u)", -1) - integral(f"{load}.u", left)
              + integral("g*Norm(u)", bottom))
    return [u_space.nbdof(), float(energy), time.process_time() - begin]


gf.util_trace_level(0)
print(json.dumps([solve(int(n)) for n in sys.argv[1:]]))
