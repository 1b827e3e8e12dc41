#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""drawings.py HPVI: five drawings, made here as STEP files by a script of Gmsh, from file to forces in one command each: a bracket, a lug on
a pin, a pair of gears, a dovetail, an O-ring in its groove. Forces are those of statics."""
import math
import pathlib
import re
import unittest

import runs

HELPER = str(pathlib.Path(runs.PROGRAM).parent / "hpvi_drawing")
KERNEL = 'SetFactory("OpenCASCADE");\n'


def polygon(number, points):
    """Faces with straight edges; their points, lines and loops have numbers from 100 times that of the face on."""
    first, n = 100 * number, len(points)
    lines = [f"Point({first + k}) = {{{x:.17g}, {y:.17g}, 0}};" for k, (x, y) in enumerate(points)]
    lines += [f"Line({first + k}) = {{{first + k}, {first + (k + 1) % n}}};" for k in range(n)]
    return "\n".join([*lines, f"Curve Loop({number}) = {{{first}:{first + n - 1}}}; Plane Surface({number}) = {{{number}}};"]) + "\n"


def gear(number, centre, axis, pitch=4., tip=4.6, hub=2.5, wide=0.6, teeth=12, pressure=20.):
    """A sector of a gear with one tooth, whose flanks are involutes; the tooth points along the angle axis."""
    base = pitch * math.cos(math.radians(pressure))
    involute = lambda r: math.tan(math.acos(base / r)) - math.acos(base / r)
    half = lambda r: math.pi / (2 * teeth) + involute(pitch) - involute(max(r, base))
    at = lambda r, angle: (centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle))
    radii = [base + (tip - base) * (k / 12) ** 2 for k in range(13)]
    right, left = [at(r, axis - half(r)) for r in radii], [at(r, axis + half(r)) for r in radii[::-1]]
    ends = [at(base, axis + wide), at(hub, axis + wide), at(hub, axis - wide), at(base, axis - wide)]
    points, first = [*right, *left, *ends, centre], 100 * number
    lines = [f"Point({first + k}) = {{{x:.17g}, {y:.17g}, 0}};" for k, (x, y) in enumerate(points)]
    p = lambda k: first + k
    lines += [f"Spline({p(0)}) = {{{p(0)}:{p(12)}}};", f"Circle({p(1)}) = {{{p(12)}, {p(30)}, {p(13)}}};", f"Spline({p(2)}) = {{{p(13)}:{p(25)}}};",
              f"Circle({p(3)}) = {{{p(25)}, {p(30)}, {p(26)}}};", f"Line({p(4)}) = {{{p(26)}, {p(27)}}};", f"Circle({p(5)}) = {{{p(27)}, {p(30)}, {p(28)}}};",
              f"Line({p(6)}) = {{{p(28)}, {p(29)}}};", f"Circle({p(7)}) = {{{p(29)}, {p(30)}, {p(0)}}};",
              f"Curve Loop({number}) = {{{p(0)}:{p(7)}}}; Plane Surface({number}) = {{{number}}};"]
    return "\n".join(lines) + "\n"


class Drawings(runs.RunTest):
    file = "drawing.step"

    def draw(self, script):
        """A STEP file, saved by a script of Gmsh that this process of the program runs."""
        (self.home / "drawing.geo").write_text(KERNEL + script + 'Save "drawing.step";\n')
        done = runs.subprocess.run([HELPER, "geo", self.home / "drawing.geo", "2", "0", "12", "1", "-", "60", "8000"], capture_output=True, check=False)
        self.assertTrue((self.home / "drawing.step").exists(), done.stdout[-300:])

    def scene(self, settings, bodies=()):
        """Bodies are surfaces by their numbers."""
        file = {"Shape": "file", "File": self.file}
        sections = {f"Body {name}": {**file, "Surfaces": k + 1} for k, name in enumerate(bodies)} or {"Geometry": file}
        entries = {f"{section}/{entry}": value for section, own in sections.items() for entry, value in own.items()}
        return self.written({**entries, **settings})

    def curves(self, bodies=()):
        """By the name of each that --validate tells: length, ends."""
        # A scene has to hold its bodies; which curves there are the refusal of another one says.
        refused = runs.run_program([runs.PROGRAM, "--validate", self.scene({"Boundary none/Symmetry": "true"}, bodies)])[2]
        names = re.split(", | and ", refused[refused.index("this scene has: "):].split(": ", 1)[1].strip())
        held = {f"Boundary {name}/Displacement": "0; 0" for name in names}
        shown = runs.run_program([runs.PROGRAM, "--validate", self.scene(held, bodies)])
        found = re.findall(r"^boundary (\S+): .*length (\S+), from \((\S+), (\S+)\) to \((\S+), (\S+)\)", shown[1], re.M)
        self.assertTrue(found, shown)
        for line in [f"body {body}: drawing.step, " for body in bodies] or ["body: drawing.step, "]:
            self.assertIn(f"\n{line}a STEP file, lengths in mm, from (", shown[1])
        return {name: (float(length), ((float(a), float(b)), (float(c), float(d)))) for name, length, a, b, c, d in found}

    def curve(self, curves, *places, body="", length=None):
        """The one of a body that ends at both places, in whatever order."""
        near = lambda a, b: math.dist(a, b) < 1e-3
        own = [name for name, (size, ends) in curves.items() if name.startswith(body)
               and all(any(near(end, place) for end in ends) for place in places) and (length is None or abs(size - length) < 1e-2)]
        self.assertEqual(len(own), 1, (places, own, curves))
        return own[0]

    def forces(self, settings, bodies=()):
        """By name: Fx, Fy, normal; and the point about which moments are, with them."""
        shown = self.run_scene("Output/VTU=false", "Error/Bound=false", "Adaptivity/Maximum steps=4",
                               scene=self.scene({"Material/Young's modulus": 1000, **settings}, bodies))
        moments = {name: (float(m), (float(x), float(y))) for name, m, x, y in
                   re.findall(r"^support (\S+): force .*, moment (\S+) about \((\S+) (\S+)\)", shown, re.M)}
        rows = self.rows("forces.csv")
        number = lambda row, key: float(row[key] or "nan")
        last = [row for row in rows if row["step"] == rows[-1]["step"]]
        return {row["name"]: tuple(number(row, key) for key in ("Fx", "Fy", "normal")) for row in last if row["kind"] != "load"}, moments

    def near(self, value, expected, share=1e-6):
        self.assertLess(abs(value - expected), share * abs(expected), (value, expected))

    def test_bracket(self):
        self.draw("""Point(1) = {0, 0, 0}; Point(2) = {6, 0, 0}; Point(3) = {6, 1.2, 0}; Point(4) = {2, 1.2, 0}; Point(5) = {1.2, 2, 0};
Point(6) = {1.2, 5, 0}; Point(7) = {0, 5, 0}; Point(8) = {2, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Circle(4) = {4, 8, 5}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 1};
Circle(8) = {4.5, 0.6, 0, 0.3}; Curve Loop(1) = {1:7}; Curve Loop(2) = {8}; Plane Surface(1) = {1, 2};
""")
        curves = self.curves()
        top, tip = self.curve(curves, (1.2, 5), (0, 5)), self.curve(curves, (6, 0), (6, 1.2))
        forces, moments = self.forces({"Boundary wall/Curves": top, "Boundary wall/Displacement": "0; 0", "Boundary tip/Curves": tip,
                                       "Boundary tip/Traction": "0; -1"})
        self.near(forces["wall"][1], 1.2)
        self.near(moments["wall"][0], 1.2 * (6 - moments["wall"][1][0]))

    def test_lug_on_a_pin(self):
        self.draw("""Rectangle(1) = {-20, -20, 0, 80, 40}; Disk(2) = {0, 0, 0, 10};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Disk(4) = {0, 0, 0, 10}; Disk(5) = {0, 0, 0, 4};
BooleanDifference(6) = { Surface{4}; Delete; }{ Surface{5}; Delete; };
""")
        bodies = ("lug", "pin")
        curves = self.curves(bodies)
        end, bore = self.curve(curves, (60, -20), (60, 20)), self.curve(curves, body="pin", length=8 * math.pi)
        forces, _ = self.forces({f"Boundary {end}/Traction": "1; 0", f"Boundary {bore}/Displacement": "0; 0", "Contact seat/Between": "automatic",
                                 "Contact seat/Friction coefficient": 0.2}, bodies)
        self.near(forces[bore][0], -40)

    def test_gears(self):
        # Both flanks pass through the pitch point, opened by 0.0005 radians.
        half = math.pi / 24
        self.draw(gear(1, (0, 0), math.pi / 2 + half) + gear(2, (0, 8), -math.pi / 2 + half + 0.0005))
        bodies = ("driver", "driven")
        curves = self.curves(bodies)
        base = 4 * math.cos(math.radians(20))
        hubs = [self.curve(curves, body=body, length=2 * 0.6 * 2.5) for body in bodies]
        flanks = []
        for body, centre in zip(bodies, ((0, 0), (0, 8))):
            steep = [name for name, (_, ends) in curves.items() if name.startswith(body + ".") and abs(ends[0][0]) < 0.6 and abs(ends[1][0]) < 0.6
                     and {round(math.dist(end, centre), 2) for end in ends} == {round(base, 2), 4.6}]
            flanks.append(min(steep, key=lambda name: abs(sum(end[0] for end in curves[name][1]))))
        forces, moments = self.forces({f"Boundary {hubs[0]}/Displacement": "0.003*y; -0.003*x", f"Boundary {hubs[1]}/Displacement": "0; 0",
                                       "Contact mesh/Between": ", ".join(flanks)}, bodies)
        for hub, centre in zip(hubs, ((0, 0), (0, 8))):
            Fx, Fy, _ = forces[hub]
            M, about = moments[hub]
            whole = M + (about[0] - centre[0]) * Fy - (about[1] - centre[1]) * Fx
            # Along the line of action, which touches both base circles.
            self.near(abs(Fy / Fx), math.tan(math.radians(20)), 1e-2)
            self.near(abs(whole), math.hypot(Fx, Fy) * base, 1e-2)

    def test_dovetail(self):
        self.draw(polygon(1, [(0, 0), (12, 0), (12, 4), (5, 11), (5, 22), (0, 22)])
                  + polygon(2, [(11.5, 4.5), (13, 3), (20, 2), (20, 14), (7, 13), (5.5, 10.5)]))
        bodies = ("root", "disc")
        curves = self.curves(bodies)
        blade, middle = self.curve(curves, (5, 22), (0, 22)), self.curve(curves, (0, 22), (0, 0))
        rim, flank = self.curve(curves, (20, 2), (20, 14)), self.curve(curves, (12, 4), (5, 11))
        seat = self.curve(curves, (11.5, 4.5), (5.5, 10.5))
        forces, _ = self.forces({f"Boundary {blade}/Traction": "0; 2", f"Boundary {middle}/Symmetry": "true", f"Boundary {rim}/Displacement": "0; 0",
                                 "Contact flank/Between": f"{flank}, {seat}"}, bodies)
        self.near(forces[rim][1], -10)
        normal = next(force[2] for name, force in forces.items() if name.startswith(flank))
        self.near(abs(normal), 10 * math.sqrt(2))

    def test_o_ring(self):
        self.draw("""Disk(1) = {0, 2, 0, 2}; Rectangle(2) = {0, -1, 0, 4, 6};
BooleanIntersection(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
""" + polygon(11, [(0, -1), (3, -1), (3, 3), (2.02, 3), (2.02, 0), (0, 0)]) + polygon(12, [(0, 4), (1.9, 4), (1.9, 5), (0, 5)]))
        bodies = ("ring", "groove", "lid")
        curves = self.curves(bodies)
        low, high = self.curve(curves, (0, 0), (2, 2)), self.curve(curves, (2, 2), (0, 4))
        middle = self.curve(curves, (0, 0), (0, 4), body="ring")
        floor, wall = self.curve(curves, (2.02, 0), (0, 0)), self.curve(curves, (2.02, 3), (2.02, 0))
        foot, top, under = self.curve(curves, (0, -1), (3, -1)), self.curve(curves, (1.9, 5), (0, 5)), self.curve(curves, (0, 4), (1.9, 4))
        forces, _ = self.forces({"Material rubber/Young's modulus": 5, "Material rubber/Poisson's ratio": 0.48,
                                 "Body ring/Material": "rubber", f"Boundary {foot}/Displacement": "0; 0", f"Boundary {top}/Displacement": "0; -0.3",
                                 f"Boundary {middle}/Symmetry": "true", "Contact floor/Between": f"{low}, {floor}",
                                 "Contact wall/Between": f"{low}, {wall}", "Contact lid/Between": f"{high}, {under}"}, bodies)
        self.assertGreater(forces[foot][1], 0.1)
        self.near(forces[foot][1], -forces[top][1], 1e-6)
        across = forces[foot][0] + forces[middle][0] + forces[top][0]
        self.assertLess(abs(across), 1e-6 * abs(forces[middle][0]))


if __name__ == "__main__":
    unittest.main()
