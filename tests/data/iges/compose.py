#!/usr/bin/env python3
"""Writes the files of the conformance micro-suite and answers.tsv beside this script: python3 compose.py

A case is a name, its entities and its answers. Each answer is a quantity and a closed form (a Python expression: a number or
a point); the table holds both, and the value. What the quantities mean: tests/io/iges/conformance_test.cpp. This composer
knows nothing of the library; test and oracle read the files only. Files named rowNN_* are the rows of the list of inputs
that OpenCASCADE reads wrongly (docs/oracle-differences.md)."""

import os
import re
from math import *

HERE = os.path.dirname(os.path.abspath(__file__))
DEP, UV, DEF, NOTE, DEPNOTE = "00010000", "00010500", "00000200", "00000100", "00010100"


class File:
    def __init__(self):
        self.entities = []

    def add(self, type, parameters, form=0, status="00000000", matrix=0, colour=0, level=0, label="", structure=0,
            font=0, view=0, weight=0, display=0):
        self.entities.append((type, parameters, form, status, matrix, colour, level, label, structure, font, view, weight, display))
        return 2 * len(self.entities) - 1

    def line(self, points):
        return self.add(110, points, status=DEP)

    def point(self, xyz="0.,0.,0."):
        return self.add(116, xyz + ",0", status=DEP)

    def direction(self, xyz):
        return self.add(123, xyz, status=DEP)

    def text(self):
        def card(data, section, n):
            return f"{data[:72]:<72}{section}{n:>7}\n"

        def wrap(record, width):
            lines, piece, at = [], "", 0
            while at < len(record):
                m = re.match(r"(\d{1,4})H", record[at:])
                end = at + m.end() + int(m.group(1)) if m else at
                cut = [record.find(c, end) for c in ",;"]
                end = min([c for c in cut if c >= 0] or [len(record) - 1]) + 1
                if len(piece) + end - at > width:
                    lines.append(piece)
                    piece = ""
                piece += record[at:end]
                at = end
            return lines + [piece]

        s = [card("trimloop conformance micro-suite: closed-form answers are in answers.tsv", "S", 1)]
        g = [card(line, "G", i + 1) for i, line in enumerate(wrap(
            "1H,,1H;,4Htest,8Htest.igs,8Hby hand ,8Hby hand ,32,38,6,308,15,4Htest,1.,2,2HMM,1,1.,15H20260101.000000,"
            "1.E-6,1000.,6Hauthor,3Horg,11,0,15H20260101.000000,;", 72))]
        d, p = [], []
        for type, parameters, form, status, matrix, colour, level, label, structure, font, view, weight, display in self.entities:
            de, first = len(d) + 1, len(p) + 1
            for line in wrap(f"{type},{parameters};", 64):
                p.append(card(f"{line:<64}{de:>8}", "P", len(p) + 1))
            fields = (type, first, structure, font, level, view, matrix, display)
            d.append(card("".join(f"{x:>8}" for x in fields) + status, "D", de))
            d.append(card(f"{type:>8}{weight:>8}{colour:>8}{len(p) + 1 - first:>8}{form:>8}{'':16}{label:>8}{0:>8}", "D", de + 1))
        t = card(f"S{len(s):>7}G{len(g):>7}D{len(d):>7}P{len(p):>7}", "T", 1)
        return "".join(s + g + d + p) + t


cases = []


def case(name, *answers):
    """Decorates the function that adds the entities."""
    def register(build):
        file = File()
        build(file)
        cases.append((name, file, answers))
        return build
    return register


def one(name, type, parameters, *answers, **fields):
    case(name, *answers)(lambda f: f.add(type, parameters, **fields))


def along(closed, *shares, n=0):
    """Answers 'curve N at S' of a closed form in t, at shares of the parameter range."""
    return [(f"curve {n} at {s}", closed.replace("T", f"({s})")) for s in (shares or (0, 0.1, 0.25, 0.5, 0.8, 1))]


def over(closed, n=0, shares=((0, 0), (0.25, 0.5), (1, 0.75), (0.5, 1))):
    return [(f"surface {n} at {u} {v}", closed.replace("U", f"({u})").replace("V", f"({v})")) for u, v in shares]


# Curves ---------------------------------------------------------------------------------------------------------------
quarter = "5*pi/2"
one("e100_arc_at_height", 100, "3.,1.,2.,6.,2.,1.,7.", *along("(1+5*cos(pi/2*T), 2+5*sin(pi/2*T), 3)"), ("length", quarter))
one("e100_whole_circle", 100, "0.,0.,0.,5.,0.,5.,0.", *along("(5*cos(2*pi*T), 5*sin(2*pi*T), 0)"), ("length", "10*pi"))


@case("e102_line_and_arc", *along("(T*(1+pi/2), 0, 0)", 0, 0.25), *along("(1+sin(T*(1+pi/2)-1), 1-cos(T*(1+pi/2)-1), 0)", 0.5, 0.8, 1),
      ("curves", "1"), ("length", "1+pi/2"))
def _(f):
    line = f.line("0.,0.,0.,1.,0.,0.")
    arc = f.add(100, "0.,1.,1.,1.,0.,2.,1.", status=DEP)
    f.add(102, f"2,{line},{arc}")


for form in (0, 1):
    one(f"e104_{form}_ellipse_quarter", 104, ".04,0.,.25,0.,0.,-1.,0.,5.,0.,0.,2.", *along("(5*cos(pi/2*T), 2*sin(pi/2*T), 0)"), form=form)
hyperbola = "(-2*cosh(asinh(-1)+T*(asinh(2)-asinh(-1))), sinh(asinh(-1)+T*(asinh(2)-asinh(-1))), 0)"
one("e104_2_hyperbola", 104, ".25,0.,-1.,0.,0.,-1.,0.,-2.8284271247461903,-1.,-4.47213595499958,2.", *along(hyperbola), form=2)
one("e104_3_parabola", 104, "1.,0.,0.,0.,-4.,0.,0.,-4.,4.,4.,4.", *along("(-4+8*T, (-4+8*T)**2/4, 0)"), form=3)
one("e106_1_points", 106, "1,2,7.,0.,0.,3.,4.", ("points", "2"), ("point 0", "(0, 0, 7)"), ("point 1", "(3, 4, 7)"), form=1)
one("e106_2_points", 106, "2,2,0.,0.,1.,3.,4.,5.", ("points", "2"), ("point 1", "(3, 4, 5)"), form=2)
one("e106_3_points_with_vectors", 106, "3,2,0.,0.,1.,0.,0.,1.,3.,4.,5.,0.,1.,0.", ("points", "2"), ("point 1", "(3, 4, 5)"), form=3)
one("e106_11_path", 106, "1,3,2.,0.,0.,4.,0.,4.,4.", *along("(8*T, 0, 2)", 0, 0.25), *along("(4, 8*T-4, 2)", 0.75, 1), ("length", "8"), form=11)
one("e106_12_path", 106, "2,3,0.,0.,0.,4.,0.,1.,4.,4.,2.", *along("(8*T, 0, 2*T)", 0, 0.25), *along("(4, 8*T-4, 2*T)", 0.75, 1),
    ("length", "2*sqrt(17)"), form=12)
one("e106_13_path_with_vectors", 106, "3,2,0.,0.,0.,0.,0.,1.,4.,0.,1.,0.,0.,1.", *along("(4*T, 0, T)"), form=13)
one("e106_63_closed", 106, "1,4,0.,0.,0.,3.,0.,0.,3.,0.,0.", ("length", "6+3*sqrt(2)"), ("curve 0 at 0.5", "(1.5, 1.5, 0)"), form=63)
one("e110_0_segment", 110, "1.,2.,3.,4.,6.,3.", *along("(1+3*T, 2+4*T, 3)"), ("length", "5"))
one("e112_two_cubics", 112, "3,2,3,2,0.,2.,3.,0.,1.,0.,0.,0.,0.,1.,0.,1.,0.,0.,0.,2.,1.,0.,0.,4.,4.,1.,0.,1.,0.,0.,0.,"
    "3.,1.,0.,0.,9.,6.,2.,0.,1.,0.,0.,0.", *along("(3*T, 9*T*T, 1)"))
one("e116_point", 116, "1.,2.,3.,0", ("points", "1"), ("point 0", "(1, 2, 3)"))


@case("e123_direction_of_a_plane", ("area", "pi"), ("faces", "1"))
def _(f):
    centre, z, x = f.point("1.,2.,3."), f.direction("0.,0.,2."), f.direction("3.,0.,0.")
    plane = f.add(190, f"{centre},{z},{x}", form=1, status=DEP)
    circle = f.add(100, "3.,1.,2.,2.,2.,2.,2.", status=DEP)
    f.add(144, f"{plane},1,0,{f.add(142, f'1,{plane},0,{circle},2', status=DEP)}")


@case("e124_0_turned_and_moved", ("point 0", "(8, 11, 9)"), ("point 1", "(8, 21, 9)"))
def _(f):
    far = f.add(124, "1.,0.,0.,0.,0.,1.,0.,10.,0.,0.,1.,0.")
    f.add(116, "1.,-1.,0.,0", matrix=f.add(124, "0.,-1.,0.,7.,1.,0.,0.,10.,0.,0.,1.,9."))
    f.add(116, "1.,-1.,0.,0", matrix=f.add(124, "0.,-1.,0.,7.,1.,0.,0.,10.,0.,0.,1.,9.", matrix=far))


@case("e124_10_to_12_finite_element_frames", ("points", "1"))
def _(f):
    for form in (10, 11, 12):
        f.add(124, "1.,0.,0.,1.,0.,1.,0.,2.,0.,0.,1.,3.", form=form)
    f.add(116, "1.,2.,3.,0")


for form, size, shown in ((1, "4.", "4*pi"), (2, "4.,3.", "14"), (3, "4.,3.", "7*pi"), (4, "4.,2.", "4+2*pi")):
    one(f"e125_{form}_flash", 125, "1.,2.," + size, ("length", shown), form=form)


@case("e125_0_flash_of_an_outline", ("curves", "1"), ("length", "2*pi"))
def _(f):
    f.add(125, f"3.,4.,0.,0.,0.,{f.add(100, '0.,0.,0.,1.,0.,1.,0.', status=DEP)}")


r2 = repr(sqrt(0.5))
conics = {2: "arc", 3: "ellipse", 4: "parabola", 5: "hyperbola"}
one("e126_0_cubic", 126, "3,3,1,0,1,0,0.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,3.,0.,3.,3.,6.,0.,1.,0.,0.,1.",
    *along("(3*T, 9*T*T-6*T**3, 6*T**3)"))
one("e126_1_line", 126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,1.,2.,3.,4.,6.,3.,0.,1.,0.,0.,1.", *along("(1+3*T, 2+4*T, 3)"), form=1)
bent = "((1-T)**2+sqrt(2)*T*(1-T)+T*T)"
one("e126_2_circle", 126, f"2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,{r2},1.,5.,0.,0.,5.,5.,0.,0.,5.,0.,0.,1.,0.,0.,1.",
    *along(f"(5*((1-T)**2+sqrt(2)*T*(1-T))/{bent}, 5*(sqrt(2)*T*(1-T)+T*T)/{bent}, 0)"), ("length", quarter), form=2)
one("e126_3_ellipse", 126, f"2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,{r2},1.,5.,0.,0.,5.,2.,0.,0.,2.,0.,0.,1.,0.,0.,1.",
    *along(f"(5*((1-T)**2+sqrt(2)*T*(1-T))/{bent}, 2*(sqrt(2)*T*(1-T)+T*T)/{bent}, 0)"), form=3)
one("e126_4_parabola", 126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,-4.,4.,0.,0.,-4.,0.,4.,4.,0.,0.,1.,0.,0.,1.",
    *along("(-4+8*T, (-4+8*T)**2/4, 0)"), form=4)
one("e126_5_hyperbola", 126, "2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,2.,1.,1.,0.,0.,.5,.5,0.,0.,1.,0.,0.,1.,0.,0.,1.",
    *along("((1-T)*(1+T)/(1+2*T*(1-T)), T*(2-T)/(1+2*T*(1-T)), 0)"), form=5)
one("e126_part_of_its_knots", 126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,.25,.75,0.,0.,1.", *along("(2+4*T, 0, 0)"))


@case("e130_whole_arc_inwards", *along("(3*cos(pi/2*T), 3*sin(pi/2*T), 0)"), ("length", "3*pi/2"))
def _(f):
    arc = f.add(100, "0.,0.,0.,4.,0.,0.,4.", status=DEP)
    f.add(130, f"{arc},1,0,0,0,1.,0.,0.,0.,0.,0.,1.,0.,{pi / 2!r}")


# Surfaces -------------------------------------------------------------------------------------------------------------
flat = "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,"


@case("e108_1_bounded", ("area", "25*pi"), ("faces", "1"))
def _(f):
    circle = f.add(100, "0.,5.,5.,10.,5.,10.,5.", status=DEP)
    f.add(108, f"0.,0.,1.,0.,{circle}", form=1)


@case("e108_-1_hole_by_402_9", ("area", "100-pi"), ("faces", "1"))
def _(f):
    border = f.add(106, "1,5,0.,0.,0.,10.,0.,10.,10.,0.,10.,0.,0.", form=63, status=DEP)
    circle = f.add(100, "0.,5.,5.,6.,5.,6.,5.", status=DEP)
    plane = f.add(108, f"0.,0.,1.,0.,{border}", form=1)
    hole = f.add(108, f"0.,0.,1.,0.,{circle}", form=-1, status=DEP)
    f.add(402, f"1,1,{plane},{hole}", form=9)


@case("e108_0_of_a_trimmed_surface", ("area", "12"), ("faces", "1"))
def _(f):
    plane = f.add(108, "0.,0.,1.,2.,0,0.,0.,0.,0.", status=DEP)
    border = f.add(106, "1,5,2.,0.,0.,4.,0.,4.,3.,0.,3.,0.,0.", form=63, status=DEP)
    f.add(144, f"{plane},1,0,{f.add(142, f'1,{plane},0,{border},2', status=DEP)}")


zeros = ",".join(["0."] * 48)
patch = "0.,8.," + ",".join(["0."] * 14) + ",0.,0.,0.,0.,4." + ",0." * 11 + ",1.,0.,0.,0.,0.,1." + ",0." * 10
one("e114_bilinear_patch", 114, f"3,1,1,1,0.,1.,0.,1.,{patch},{zeros},{zeros},{zeros}", *over("(8*U, 4*V, 1+U*V)"))


@case("e118_1_equal_parameters", *over("(5*(2*U*(1-U)*.6+U*U*2)*(1-V)+10*U*V, 2*V, 0)"), ("area", "20"))
def _(f):
    a = f.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,3.,0.,0.,10.,0.,0.,0.,1.,0.,0.,1.", status=DEP)
    f.add(118, f"{a},{f.line('0.,2.,0.,10.,2.,0.')},0,0", form=1)


@case("e118_1_second_rail_reversed", *over("(10*U, 2*V, 0)"), ("area", "20"))
def _(f):
    f.add(118, f"{f.line('0.,0.,0.,10.,0.,0.')},{f.line('10.,2.,0.,0.,2.,0.')},1,0", form=1)


@case("e118_0_two_arcs", *over("((2+3*V)*cos(pi/2*U), (2+3*V)*sin(pi/2*U), 0)"), ("area", "21*pi/4"))
def _(f):
    a = f.add(100, "0.,0.,0.,2.,0.,0.,2.", status=DEP)
    b = f.add(100, "0.,0.,0.,5.,0.,0.,5.", status=DEP)
    f.add(118, f"{a},{b},0,0")


def parabola_length(x):
    """Of y = x^2 / 4 from 0 to x."""
    return x / 2 * sqrt(1 + x * x / 4) + asinh(x / 2)


def parabola_at(share, end=4.0):
    """x where that share of the length up to `end` is reached: Newton's iteration."""
    x = share * end
    for _ in range(50):
        x -= (parabola_length(x) - share * parabola_length(end)) / sqrt(1 + x * x / 4)
    return x


@case("e118_0_parabola_and_line", *over("(parabola_at(U)*(1-V)+4*U*V, parabola_at(U)**2/4*(1-V)+4*U*V, 3*V)",
                                        shares=((0, 0), (0.1, 0), (0.3, 0.5), (0.5, 0.25), (0.9, 0), (1, 1))))
def _(f):
    a = f.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,2.,0.,0.,4.,4.,0.,0.,1.,0.,0.,1.", status=DEP)
    f.add(118, f"{a},{f.line('0.,0.,3.,4.,4.,3.')},0,0")


@case("e120_cone_about_a_line", ("area", "2*pi*sqrt(13)"), ("faces", "1"))
def _(f):
    f.add(120, f"{f.line('0.,0.,0.,0.,0.,1.')},{f.line('2.,0.,0.,0.,0.,3.')},0.,{2 * pi!r}")


@case("e120_start_angle_not_zero", ("area", "3*pi"), ("low", "(-2, 0, 0)"), ("high", "(0, 2, 3)"))
def _(f):
    f.add(120, f"{f.line('0.,0.,0.,0.,0.,1.')},{f.line('2.,0.,0.,2.,0.,3.')},{pi / 2!r},{pi!r}")


@case("e122_to_its_terminate_point", *over("(1+10*U, 3*V, 4*V)"), ("area", "50"))
def _(f):
    f.add(122, f"{f.line('1.,0.,0.,11.,0.,0.')},1.,3.,4.")


for form, name, answer in ((0, "general", "(8*U, 4*V, 0)"), (1, "plane", "(8*U, 4*V, 0)")):
    one(f"e128_{form}_{name}", 128, flat + "0.,1.,0.,1.", *over(answer), ("area", "32"), form=form)


def of_revolution(poles, weights):
    """A quarter about z: three columns along u for each pole (radius, height) along v."""
    ring = [(1, 0, 1), (1, 1, sqrt(0.5)), (0, 1, 1)]
    w = [repr(a[2] * b) for b in weights for a in ring]
    p = [f"{repr(a[0] * r)},{repr(a[1] * r)},{repr(float(z))}" for r, z in poles for a in ring]
    k = len(poles) - 1
    knots = ",".join(["0."] * (k + 1) + ["1."] * (k + 1))
    return f"2,{k},2,{k},0,0,0,0,0,0.,0.,0.,1.,1.,1.,{knots}," + ",".join(w + p) + ",0.,1.,0.,1."


ring = "((1-U)**2+sqrt(2)*U*(1-U))/((1-U)**2+sqrt(2)*U*(1-U)+U*U)", "(sqrt(2)*U*(1-U)+U*U)/((1-U)**2+sqrt(2)*U*(1-U)+U*U)"
arc = [s.replace("U", "V") for s in ring]
for form, name, poles, weights, radius, height, area in (
        (2, "cylinder", [(2., 0), (2., 3)], (1, 1), "2", "3*V", "3*pi"),
        (3, "cone", [(2., 0), (1., 3)], (1, 1), "(2-V)", "3*V", "3*pi/4*sqrt(10)"),
        (4, "sphere", [(2., 0), (2., 2), (0., 2)], (1, sqrt(0.5), 1), f"2*{arc[0]}", f"2*{arc[1]}", "2*pi"),
        (5, "torus", [(7., 0), (7., 2), (5., 2)], (1, sqrt(0.5), 1), f"(5+2*{arc[0]})", f"2*{arc[1]}", "pi/2*(5*pi+4)"),
        (6, "revolution", [(1., 0), (3., 1), (1., 2)], (1, 1, 1), "(1+4*V*(1-V))", "2*V", None)):
    one(f"e128_{form}_{name}", 128, of_revolution(poles, weights), *over(f"({radius}*{ring[0]}, {radius}*{ring[1]}, {height})"),
        *([("area", area)] if area else []), form=form)
one("e128_7_tabulated", 128, "2,1,2,1,0,0,1,0,0,0.,0.,0.,1.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,2.,0.,4.,4.,0.,0.,0.,5.,0.,"
    "2.,5.,4.,4.,5.,0.,0.,1.,0.,1.", *over("(4*U, 5*V, 8*U*(1-U))"), form=7)
one("e128_8_ruled", 128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,4.,0.,0.,0.,4.,0.,4.,4.,3.,0.,1.,0.,1.",
    *over("(4*U, 4*V, 3*U*V)"), form=8)
one("e128_9_quadric", 128, "2,2,2,2,0,0,1,0,0,0.,0.,0.,1.,1.,1.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,2.,0.,4.,"
    "0.,1.,0.,1.,1.,0.,2.,1.,4.,0.,2.,4.,1.,2.,4.,2.,2.,8.,0.,1.,0.,1.", *over("(2*U, 2*V, 4*U*U+4*V*V)"), form=9)


@case("e140_of_a_cylinder", ("area", "3*3*pi"), ("low", "(-3, 0, 0)"), ("high", "(3, 3, 3)"))
def _(f):
    base = f.add(120, f"{f.line('0.,0.,0.,0.,0.,1.')},{f.line('2.,0.,0.,2.,0.,3.')},0.,{pi!r}", status=DEP)
    f.add(140, f"0.,1.,0.,1.,{base}")


@case("e141_143_border_in_both_spaces", ("area", "16"), ("faces", "1"))
def _(f):
    base = f.add(128, flat + "0.,1.,0.,1.", status=DEP)
    sides = []
    for a, b in (((0, 0), (4, 0)), ((4, 0), (4, 4)), ((4, 4), (0, 4)), ((0, 4), (0, 0))):
        space = f.line(f"{a[0]}.,{a[1]}.,0.,{b[0]}.,{b[1]}.,0.")
        uv = f.add(110, f"{a[0] / 8},{a[1] / 4},0.,{b[0] / 8},{b[1] / 4},0.", status=UV)
        sides.append(f"{space},1,1,{uv}")
    f.add(143, f"1,{base},1,{f.add(141, f'1,3,{base},4,' + ','.join(sides), status=DEP)}")


@case("e142_144_parameter_curves_alone", ("area", "32-4*pi"), ("faces", "1"))
def _(f):
    base = f.add(128, flat + "0.,1.,0.,1.", status=DEP)
    ellipse = f.add(104, f"{1 / .0625!r},0.,4.,-16.,-4.,4.,0.,.75,.5,.75,.5", form=1, status=UV)  # half axes 1/4, 1/2: 2 and 2 mm
    outer = f.add(106, "1,5,0.,0.,0.,1.,0.,1.,1.,0.,1.,0.,0.", form=63, status=UV)
    border = f.add(142, f"1,{base},{outer},0,1", status=DEP)
    hole = f.add(142, f"1,{base},{ellipse},0,1", status=DEP)
    f.add(144, f"{base},1,1,{border},{hole}")


@case("e144_natural_border_and_a_hole", ("area", "32-pi"), ("faces", "1"))
def _(f):
    base = f.add(128, flat + "0.,1.,0.,1.", status=DEP)
    circle = f.add(100, "0.,4.,2.,5.,2.,5.,2.", status=DEP)
    f.add(144, f"{base},0,1,0,{f.add(142, f'1,{base},0,{circle},2', status=DEP)}")


for form in (0, 1):
    for type, name, numbers, border, answers in (
            (190, "plane", "", "0.,1.,2.,4.,2.,4.,2.", [("area", "9*pi")]),
            (192, "cylinder", ",2.", None, [("area", "2*pi*2*4")]),
            (194, "cone", ",2.,45.", None, [("area", "pi*(2+6)*4*sqrt(2)")]),
            (196, "sphere", None, None, [("area", "36*pi")]),
            (198, "torus", ",5.,2.", None, [("area", "40*pi**2")])):
        @case(f"e{type}_{form}_{name}", ("faces", "1"), *answers)
        def _(f):
            centre, z, x = f.point("1.,2.,0."), f.direction("0.,0.,1."), f.direction("1.,0.,0.")
            last = f",{x}" if form else ""
            free = type in (196, 198)
            if type == 196:
                f.add(196, f"{centre},3." + (f",{z},{x}" if form else ""), form=form)
                return
            base = f.add(type, f"{centre},{z}{numbers}{last}", form=form, status="00000000" if free else DEP)
            if free:
                return
            if type == 190:
                loops = [f.add(100, border, status=DEP)]
            else:
                top = 2. if type == 192 else 6.
                loops = [f.add(100, f"0.,1.,2.,3.,2.,3.,2.", status=DEP), f.add(100, f"4.,1.,2.,{1 + top},2.,{1 + top},2.", status=DEP)]
            on = [f.add(142, f"1,{base},0,{c},2", status=DEP) for c in loops]
            f.add(144, f"{base},1,{len(on) - 1},{','.join(map(str, on))}")

# Solids ---------------------------------------------------------------------------------------------------------------
class Shell:
    """The lists of a boundary representation: vertices, edges (curve, from, to), loops of signed edges counted from 1."""
    def __init__(self, f, vertices, edges):
        self.f = f
        self.v = f.add(502, f"{len(vertices)}," + ",".join(f"{float(x)!r},{float(y)!r},{float(z)!r}" for x, y, z in vertices), form=1, status=DEP)
        self.e = f.add(504, f"{len(edges)}," + ",".join(f"{c},{self.v},{a},{self.v},{b}" for c, a, b in edges), form=1, status=DEP)

    def face(self, surface, *loops, sense=1):
        of = []
        for loop in loops:
            uses = [f"1,{self.v},{e[1]},1,0" if isinstance(e, tuple) else f"0,{self.e},{abs(e)},{1 if e > 0 else 0},0" for e in loop]
            of.append(self.f.add(508, f"{len(uses)}," + ",".join(uses), form=1, status=DEP))
        return self.f.add(510, f"{surface},{len(of)},1," + ",".join(map(str, of)), form=1, status=DEP)

    def shell(self, faces, form=1, status=DEP):
        return self.f.add(514, f"{len(faces)}," + ",".join(f"{x},1" for x in faces), form=form, status=status)


def cube(f, a, lo=(0, 0, 0), sides=6):
    corners = [(lo[0] + a * (i & 1), lo[1] + a * (i >> 1 & 1), lo[2] + a * (i >> 2)) for i in range(8)]
    pairs = [(i, i | b) for b in (1, 2, 4) for i in range(8) if not i & b]
    edges = [(f.line(",".join(f"{float(x)!r}" for x in corners[i] + corners[j])), i + 1, j + 1) for i, j in pairs]
    s = Shell(f, corners, edges)

    def edge(i, j):
        return pairs.index((i, j)) + 1 if (i, j) in pairs else -(pairs.index((j, i)) + 1)

    faces = []
    for corner, n in (((0, 2, 3, 1), (0, 0, -1)), ((4, 5, 7, 6), (0, 0, 1)), ((0, 1, 5, 4), (0, -1, 0)), ((2, 6, 7, 3), (0, 1, 0)),
                      ((0, 4, 6, 2), (-1, 0, 0)), ((1, 3, 7, 5), (1, 0, 0)))[:sides]:
        at = f.point(",".join(f"{float(x)!r}" for x in corners[corner[0]]))
        plane = f.add(190, f"{at},{f.direction(','.join(f'{float(x)!r}' for x in n))}", status=DEP)
        faces.append(s.face(plane, [edge(corner[k], corner[(k + 1) % 4]) for k in range(4)]))
    return s, faces


box = "(0, 0, 0)"
one("e150_block", 150, "2.,3.,4.,1.,1.,1.,0.,1.,0.,0.,0.,1.", ("volume", "24"), ("area", "52"), ("low", "(-2, 1, 1)"), ("high", "(1, 3, 5)"))
one("e152_wedge", 152, "4.,3.,2.,1.", ("volume", "15"), ("area", "15+8+2+6+6*sqrt(2)"), ("low", box), ("high", "(4, 3, 2)"))
one("e154_cylinder", 154, "5.,2.,1.,2.,3.,0.,1.,0.", ("volume", "20*pi"), ("area", "28*pi"), ("low", "(-1, 2, 1)"), ("high", "(3, 7, 5)"))
one("e156_frustum", 156, "4.,3.,1.", ("volume", "52*pi/3"), ("area", "10*pi+4*pi*sqrt(20)"), ("low", "(-3, -3, 0)"), ("high", "(3, 3, 4)"))
one("e158_ball", 158, "3.,1.,2.,3.", ("volume", "36*pi"), ("area", "36*pi"), ("low", "(-2, -1, 0)"), ("high", "(4, 5, 6)"))
one("e160_torus", 160, "5.,2.,1.,0.,0.,0.,1.,0.", ("volume", "40*pi**2"), ("area", "40*pi**2"), ("low", "(-6, -2, -7)"), ("high", "(8, 2, 7)"))
one("e168_ellipsoid", 168, "4.,3.,2.", ("volume", "32*pi"), ("low", "(-4, -3, -2)"), ("high", "(4, 3, 2)"))


@case("e162_0_closed_to_the_axis", ("volume", "3*pi"), ("area", "3*pi+2*pi+12"))
def _(f):
    f.add(162, f"{f.line('2.,0.,0.,2.,0.,3.')},.25")


@case("e162_1_beside_the_axis", ("volume", "40*pi**2"), ("area", "40*pi**2"))
def _(f):
    f.add(162, f"{f.add(100, '0.,5.,0.,7.,0.,7.,0.', status=DEP)},1.,0.,0.,0.,0.,1.,0.", form=1)


@case("e164_pushed_at_an_angle", ("volume", "16"), ("low", "(0, 0, 0)"), ("high", "(5, 2, 4)"))
def _(f):
    f.add(164, f"{f.add(106, '1,5,0.,0.,0.,2.,0.,2.,2.,0.,2.,0.,0.', form=63, status=DEP)},5.,3.,0.,4.")


for form, operator, name, volume, area in ((0, 1, "union", "8+7*pi/6", "24-3*pi/4+7*pi/2"), (0, 2, "intersection", "pi/6", "pi/2+3*pi/4"),
                                           (1, 3, "difference", "8-pi/6", "24-3*pi/4+pi/2")):
    @case(f"e180_{form}_{name}", ("volume", volume), ("area", area), ("solids", "1"))
    def _(f):
        if form:  # form 1: an operand is a boundary representation
            s, faces = cube(f, 2)
            block = f.add(186, f"{s.shell(faces)},1,0", status=DEP)
        else:
            block = f.add(150, "2.,2.,2.", status=DEP)
        f.add(180, f"3,-{block},-{f.add(158, '1.', status=DEP)},{operator}", form=form)


@case("e182_component", ("volume", "5"), ("low", "(5, 0, 0)"), ("high", "(10, 1, 1)"))
def _(f):
    bar = f.add(150, "10.,1.,1.", status=DEP)
    gap = f.add(150, "2.,3.,3.,3.,-1.,-1.", status=DEP)
    f.add(182, f"{f.add(180, f'3,-{bar},-{gap},3', status=DEP)},8.,.5,.5")


@case("e184_0_assembly_430_0_instance", ("solids", "3"), ("volume", "4*pi"), ("low", "(-1, -1, -1)"), ("high", "(11, 11, 1)"))
def _(f):
    ball = f.add(158, "1.", status=DEP)
    there = f.add(124, "1.,0.,0.,10.,0.,1.,0.,0.,0.,0.,1.,0.")
    turned = f.add(124, "0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.")
    f.add(184, f"2,{ball},{ball},0,{there}", matrix=turned)
    f.add(430, f"{ball}", matrix=there)


@case("e186_cube", ("volume", "27"), ("area", "54"), ("solids", "1"), ("faces", "6"), ("edges", "12"))
def _(f):
    s, faces = cube(f, 3)
    f.add(186, f"{s.shell(faces)},1,0")


@case("e186_cube_with_a_void", ("volume", "26"), ("area", "60"), ("solids", "1"), ("faces", "12"))
def _(f):
    outer, inner = cube(f, 3), cube(f, 1, (1, 1, 1))
    f.add(186, f"{outer[0].shell(outer[1])},1,1,{inner[0].shell(inner[1])},0")


@case("e514_2_open_shell", ("area", "45"), ("faces", "5"), ("solids", "0"))
def _(f):
    s, faces = cube(f, 3, sides=5)
    s.shell(faces, form=2, status="00000000")


@case("e186_cylinder_with_its_seam", ("volume", "12*pi"), ("area", "20*pi"), ("faces", "3"), ("edges", "3"))
def _(f):
    low, high = f.point("0.,0.,0."), f.point("0.,0.,3.")
    up, down, x = f.direction("0.,0.,1."), f.direction("0.,0.,-1."), f.direction("1.,0.,0.")
    bottom = f.add(100, "0.,0.,0.,2.,0.,2.,0.", status=DEP)
    top = f.add(100, "3.,0.,0.,2.,0.,2.,0.", status=DEP)
    s = Shell(f, [(2, 0, 0), (2, 0, 3)], [(bottom, 1, 1), (top, 2, 2), (f.line("2.,0.,0.,2.,0.,3."), 1, 2)])
    side = s.face(f.add(192, f"{low},{up},2.,{x}", form=1, status=DEP), [1, 3, -2, -3])
    lid = s.face(f.add(190, f"{high},{up},{x}", form=1, status=DEP), [2])
    floor = s.face(f.add(190, f"{low},{down},{x}", form=1, status=DEP), [-1])
    f.add(186, f"{s.shell([side, lid, floor])},1,0")


@case("e186_torus_of_one_face", ("volume", "40*pi**2"), ("area", "40*pi**2"), ("faces", "1"), ("edges", "2"))
def _(f):
    centre, up, x = f.point(), f.direction("0.,0.,1."), f.direction("1.,0.,0.")
    upright = f.add(124, "1.,0.,0.,0.,0.,0.,-1.,0.,0.,1.,0.,0.")
    around = f.add(100, "0.,0.,0.,7.,0.,7.,0.", status=DEP)
    tube = f.add(100, "0.,5.,0.,7.,0.,7.,0.", status=DEP, matrix=upright)
    s = Shell(f, [(7, 0, 0)], [(around, 1, 1), (tube, 1, 1)])
    f.add(186, f"{s.shell([s.face(f.add(198, f'{centre},{up},5.,2.,{x}', form=1, status=DEP), [1, 2, -1, -2])])},1,0")


@case("e508_1_ball_by_pole_vertices", ("volume", "36*pi"), ("area", "36*pi"), ("faces", "1"))
def _(f):
    centre, up, x = f.point(), f.direction("0.,0.,1."), f.direction("1.,0.,0.")
    upright = f.add(124, "1.,0.,0.,0.,0.,0.,-1.,0.,0.,1.,0.,0.")
    half = f.add(100, "0.,0.,0.,0.,-3.,0.,3.", status=DEP, matrix=upright)
    s = Shell(f, [(0, 0, -3), (0, 0, 3)], [(half, 1, 2)])
    ball = f.add(196, f"{centre},3.,{up},{x}", form=1, status=DEP)
    f.add(186, f"{s.shell([s.face(ball, [1, ('v', 2), -1, ('v', 1)])])},1,0")


@case("e508_0_loop_of_one_vertex", ("volume", "36*pi"), ("area", "36*pi"), ("faces", "1"))
def _(f):
    centre, up, x = f.point(), f.direction("0.,0.,1."), f.direction("1.,0.,0.")
    vertices = f.add(502, "1,0.,0.,3.", form=1, status=DEP)
    loop = f.add(508, f"1,1,{vertices},1,1,0", form=0, status=DEP)
    face = f.add(510, f"{f.add(196, f'{centre},3.,{up},{x}', form=1, status=DEP)},1,1,{loop}", form=1, status=DEP)
    f.add(186, f"{f.add(514, f'1,{face},1', form=1, status=DEP)},1,0")


@case("e184_1_430_1_of_a_brep", ("solids", "2"), ("volume", "54"), ("low", "(0, 0, 0)"), ("high", "(23, 3, 3)"))
def _(f):
    s, faces = cube(f, 3)
    solid = f.add(186, f"{s.shell(faces)},1,0", status=DEP)
    there = f.add(124, "1.,0.,0.,20.,0.,1.,0.,0.,0.,0.,1.,0.")
    f.add(184, f"1,{solid},0", form=1)
    f.add(430, f"{solid}", form=1, matrix=there)


# Structure ------------------------------------------------------------------------------------------------------------
@case("e308_408_nested_subfigures", ("points", "3"), ("point 0", "(2, 0, 0)"), ("point 1", "(0, 12, 0)"), ("point 2", "(9, 5, 0)"))
def _(f):
    inner = f.add(308, f"0,5Hinner,1,{f.point('1.,0.,0.')}", status=DEF)
    outer = f.add(308, f"1,5Houter,1,{f.add(408, f'{inner},4.,0.,0.,1.', status=DEP)}", status=DEF)
    turn = f.add(124, "0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.")
    f.add(408, f"{inner},0.,0.,0.,2.")
    f.add(408, f"{inner},10.,0.,0.,2.", matrix=turn)
    f.add(408, f"{outer},4.,5.,0.,1.")


@case("e320_420_network", ("points", "3"), ("point 0", "(1, 1, 1)"), ("point 1", "(12, 3, 2)"), ("point 2", "(2, 3, 2)"))
def _(f):
    pin = f.add(132, "1.,1.,1.,0,0,0,1H1,0,3Hpin,0,0,0,0,0", status=DEP)
    net = f.add(320, f"0,3Hnet,1,{f.point('1.,1.,1.')},0,2HU1,0,0", status=DEF)
    f.add(420, f"{net},10.,0.,0.,2.,3.,,0,2HU1,0,0")
    f.add(420, f"{net},0.,0.,0.,2.,3.,,0,2HU2,0,1,{pin}")


@case("e412_414_arrays", ("points", "11"), ("point 1", "(1, 7, 3)"), ("point 2", "(11, 2, 3)"), ("point 5", "(21, 7, 3)"),
      ("point 6", "(1, 2, 3)"), ("point 7", "(-4, 12, 3)"), ("point 10", "(0, 2, 7)"))
def _(f):
    p = f.point()
    f.add(412, f"{p},1.,1.,2.,3.,3,2,10.,5.,0.,0,0")
    f.add(412, f"{p},1.,1.,2.,3.,3,2,10.,5.,{pi / 2!r},2,1,2,3")
    f.add(414, f"{p},4,0.,0.,7.,2.,0.,{pi / 2!r},1,0,2")


for form, name in ((1, "group"), (7, "group_without_back_pointers"), (14, "ordered_group"), (15, "ordered_group_without_back_pointers")):
    @case(f"e402_{form}_{name}", ("points", "2"))
    def _(f):
        back = f",1,5" if form in (1, 14) else ""
        a, b = f.add(116, "0.,0.,0.,0" + back), f.add(116, "1.,0.,0.,0" + back)
        f.add(402, f"2,{a},{b}", form=form)


@case("e404_410_drawings_and_views", ("views", "2"), ("drawings", "2"), ("points", "1"))
def _(f):
    p = f.add(116, "1.,2.,3.,0")
    across = f.add(124, "0.,1.,0.,0.,-1.,0.,0.,0.,0.,0.,1.,0.")
    view = f.add(410, "3,.5,0,0,0,0,0,0", matrix=across)
    perspective = f.add(410, "4,1.,0.,0.,1.,0.,0.,0.,0.,0.,100.,0.,1.,0.,50.,-10.,10.,-10.,10.,0,0.,0.", form=1)
    note = f.add(212, "1,2,4.,2.,1,1.5707963267948966,0.,0,0,4.,1.,0.,2Hab", status=DEPNOTE)
    size, unit = f.add(406, "2,420.,297.", form=16), f.add(406, "2,2,2HMM", form=17)
    f.add(404, f"1,{view},100.,50.,1,{note},0,2,{size},{unit}")
    f.add(404, f"1,{perspective},100.,50.,.5,0,0,2,{size},{unit}", form=1)
    f.add(402, f"1,1,{view},{p}", form=3)
    f.add(402, f"1,1,{view},1,0,2,1,{p}", form=4)
    f.add(402, f"1,{view},0.,0.,0.,0,1,{p}", form=5)
    f.add(402, f"1,1,{view},{p}", form=6)


@case("e402_links_without_geometry", ("points", "1"), ("curves", "1"))
def _(f):
    p = f.add(116, "1.,2.,3.,0")
    line = f.add(110, "0.,0.,0.,1.,0.,0.")
    note = f.add(212, "1,2,4.,2.,1,1.5707963267948966,0.,0,0,4.,1.,0.,2Hab", status=DEPNOTE)
    leader = f.add(214, "1,1.,.5,0.,5.,0.,0.,5.", form=1, status=DEPNOTE)
    label = f.add(210, f"{note},1,{leader}", status=NOTE)
    view = f.add(410, "1,1.,0,0,0,0,0,0")
    f.add(402, f"1,1,{label},{p}", form=13)
    f.add(402, f"1,1,{f.add(124, '1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.')},{line}", form=16)
    f.add(402, f"2,1,1,1,1,0,0,1,0,{line},{p},{line},3Hnet", form=18)
    f.add(402, f"1,{view},.5,0,1,1,0", form=19)
    f.add(402, f"1,1,1,1,1,0,0,1,{line},{p},{line},4Hpipe", form=20)
    f.add(402, f"1,1,{label},0,0.,{line},0,0.,0.,0.", form=21)


# Annotation: strokes and runs of text ---------------------------------------------------------------------------------
one("e106_20_centreline", 106, "1,4,0.,0.,0.,1.,0.,2.,0.,3.,0.", ("annotations", "1"), ("strokes", "2"), form=20, status=NOTE)
one("e106_21_centreline_of_circles", 106, "1,2,0.,0.,0.,1.,0.", ("strokes", "1"), form=21, status=NOTE)
for form in range(31, 39):
    one(f"e106_{form}_section", 106, "1,4,0.,0.,0.,1.,0.,0.,1.,1.,1.", ("strokes", "2"), form=form, status=NOTE)
one("e106_40_witness_line", 106, "1,3,0.,0.,0.,1.,0.,2.,0.", ("strokes", "1"), form=40, status=NOTE)
for form in list(range(0, 9)) + [100, 101, 102, 105]:
    text = "2,5,10.,2.,1,1.5707963267948966,0.,0,0,1.,2.,3.,5Hhello,2,4.,2.,1,1.5707963267948966,0.,0,0,1.,6.,3.,2Hab"
    one(f"e212_{form}_note", 212, text, ("annotations", "1"), ("texts", "2"), ("text 0", "(1, 2, 3)"), ("text 1", "(1, 6, 3)"), form=form, status=NOTE)
one("e213_new_note", 213, "20.,10.,0,0.,0.,0.,0.,1.,2.,3.,0.,1,0,2.,3.,0.,4.,1,0.,0H,5,10.,3.,1,1.5707963267948966,0.,0,0,1.,2.,3.,5Hhello",
    ("texts", "1"), ("text 0", "(1, 2, 3)"), status=NOTE)
for form in range(1, 13):
    @case(f"e214_{form}_leader", ("annotations", "1"))
    def _(f):
        f.add(214, "2,1.,.5,0.,0.,0.,5.,0.,5.,5.", form=form, status=NOTE)


def drafting(name, type, parameters, strokes, form=0, texts=1):
    """N: a note; A: a leader; G: a segment; W: a witness line; B: a closed border."""
    @case(name, ("annotations", "1"), *([("strokes", str(strokes))] if strokes else []), ("texts", str(texts)))
    def _(f):
        at = {}
        if "N" in parameters:
            at["N"] = f.add(212, "1,2,4.,2.,1,1.5707963267948966,0.,0,0,4.,1.,0.,2H90", status=DEPNOTE)
        if "A" in parameters:
            at["A"] = f.add(214, "1,1.,.5,0.,5.,0.,0.,5.", form=1, status=DEPNOTE)
        if "G" in parameters:
            at["G"] = f.add(110, "0.,0.,0.,1.,0.,0.", status=DEPNOTE)
        if "W" in parameters:
            at["W"] = f.add(106, "1,3,0.,0.,-5.,0.,-4.,0.,1.", form=40, status=DEPNOTE)
        if "B" in parameters:
            at["B"] = f.add(106, "1,5,0.,0.,0.,10.,0.,10.,10.,0.,10.,0.,0.", form=63, status=DEPNOTE)
        f.add(type, "".join(str(at.get(c, c)) for c in parameters), form=form, status=NOTE)


drafting("e202_angular", 202, "N,W,0,0.,0.,5.,A,0", 3)
drafting("e204_curve_dimension", 204, "N,G,0,A,0,0,0", 3)
drafting("e206_diameter", 206, "N,A,0,0.,0.", 2)
drafting("e208_flag", 208, "0.,0.,0.,0.,N,1,A", 3)
drafting("e210_label", 210, "N,1,A", 2)
for form in (0, 1, 2):
    drafting(f"e216_{form}_linear", 216, "N,A,0,W,0", 3, form)
drafting("e218_0_ordinate", 218, "N,A", 2)
drafting("e218_1_ordinate", 218, "N,W,A", 3, 1)
drafting("e220_point_dimension", 220, "N,A,G", 3)
drafting("e222_0_radius", 222, "N,A,0.,0.", 2)
drafting("e222_1_radius", 222, "N,A,0.,0.,A", 4, 1)
for form in (0, 1, 2, 3, 5001):
    drafting(f"e228_{form}_symbol", 228, "N,1,G,1,A", 3, form)
drafting("e230_0_sectioned_area", 230, "B,1,0.,.5,0.,1.,0.,0", 11, 0, texts=0)
drafting("e230_1_sectioned_area_inverted", 230, "B,1,0.,.5,0.,1.,0.,0", None, 1, texts=0)

# Records without geometry: read with their meaning, written with the same tokens, no finding --------------------------
one("none_e0_null", 0, "", ("records", "1"))


@case("none_finite_elements", ("records", "77"))
def _(f):
    nodes = [f.add(134, f"{x}.,0.,0.,0") for x in range(4)]
    element = f.add(136, f"2,3,{nodes[0]},{nodes[1]},{nodes[2]},5HTRIA3")
    case_note = f.add(212, "1,4,4.,2.,1,1.5707963267948966,0.,0,0,4.,1.,0.,4Hcase", status=DEPNOTE)
    f.add(138, f"1,{case_note},1,1,{nodes[0]},0.,0.,.5,0.,0.,0.")
    for form in range(35):
        values = {0: 0, 3: 3, 4: 6, 5: 1}.get(form, 1) or 1
        f.add(146, f"{case_note},1,0.,{values},1,1,{nodes[0]}," + ",".join(["1."] * values), form=form)
    for form in range(35):
        f.add(148, f"{case_note},1,0.,1,0,1,1,{element},2,1,0,0,1,1.", form=form)


@case("none_e418_load", ("records", "4"))
def _(f):
    node = f.add(134, "0.,0.,0.,0")
    note = f.add(212, "1,4,4.,2.,1,1.5707963267948966,0.,0,0,4.,1.,0.,4Hcase", status=DEPNOTE)
    table = f.add(406, "8,1,1,1,6,1,0.,2.5,0.", form=11)
    f.add(418, f"1,1,{node},{table}")


@case("none_definitions", ("records", "21"), ("curves", "1"))
def _(f):
    f.add(302, "1,1,2,1,1", form=5001, status=DEF)
    mark = f.add(308, f"0,4Hmark,1,{f.line('0.,0.,0.,1.,0.,0.')}", status=DEF)
    f.add(304, f"1,{mark},5.,1.", form=1, status=DEF)
    dashes = f.add(304, "2,1.,2.,2H01", form=2, status=DEF)
    f.add(306, "MACRO,621,A,B", status=DEF)
    font = f.add(310, "1,4Hfont,0,10,1,65,10,0,3,0,0,0,0,5,10,0,10,0", status=DEF)
    f.add(312, f"10.,2.,-{font},1.5707963267948966,0.,0,0,1.,2.,3.", status=DEF)
    f.add(312, "10.,2.,1,1.5707963267948966,0.,0,0,1.,2.,3.", form=1, status=DEF)
    red = f.add(314, "100.,0.,0.,3Hred", status=DEF)
    f.add(316, "1,6HLENGTH,2HMM,.001", status=DEF)
    f.add(322, "5Htable,1,2,1,1,1,2,2,1", status=DEF)
    table = f.add(322, "5Htable,1,2,1,1,1,5,2,2,1,2.5", form=1, status=DEF)
    f.add(322, f"5Htable,1,1,1,1,1,5,0", form=2, status=DEF)
    plain = f.add(322, "5Htable,1,2,1,1,1,2,2,1", status=DEF)
    f.add(422, "7,2.5", structure=-plain)
    f.add(422, "2,7,2.5,8,3.5", form=1, structure=-plain)
    f.add(132, "1.,2.,3.,0,0,0,1H1,0,3Hpin,0,0,0,0,0")
    f.add(110, "0.,0.,0.,9.,0.,0.", colour=-red, font=-dashes)
    f.add(402, "1,1", form=7)
    f.add(302, "1,2,1,1,1", form=6000, status=DEF)


@case("none_e416_external_references", ("records", "6"), ("points", "1"))
def _(f):
    f.add(116, "0.,0.,0.,0")
    for form, text in enumerate(("8Hpart.igs,4Hbolt", "8Hpart.igs", "8Hpart.igs,4Hbolt", "4Hbolt", "4Hbolt,3Hlib")):
        f.add(416, text, form=form)


properties = {1: "2,1,3", 2: "3,1,1,0", 3: "2,5,5Hlayer", 4: "0", 5: "5,2.,0,0,1,.5", 6: "5,3.,3.1,1,1,2", 7: "1,2HU1", 8: "1,1H1",
              9: "4,1Ha,1Hb,1Hc,1Hd", 10: "6,0,0,0,0,0,0", 11: "8,1,1,1,6,1,0.,2.5,0.", 12: "1,5Ha.igs", 13: "3,4.,4HPIPE,2HA1", 14: "1,3Hhot",
              15: "1,4Hname", 16: "2,420.,297.", 17: "2,2,2HMM", 18: "1,.2", 19: "1,3", 20: "1,1", 21: "1,1", 22: "9,1,0,1,0.,0.,5.,5.,10,10",
              23: "2,1,3Hset", 24: "5,1,2,3Htop,1,3Hcut", 25: "4,3Hpcb,2,1,2", 26: "3,3.,3.1,1", 27: "5,3Hkey,1,3,5Hvalue,0", 28: "6,0,2,0,2HMM,0,2",
              29: "8,1,1,1,.1,-.1,0,0,2", 30: "15,1,0,0,1H-,0,1.5707963267948966,0,0,0,0,10.,1,1,1,2", 31: "8,0.,0.,1.,0.,1.,1.,0.,1.",
              32: "2,2Hok,8H20260101", 33: "2,1H1,1HA", 34: "3,1,1,2", 35: "3,1,1,2", 36: "1,1", 5001: "2,1,3Hany"}
properties[27] = "4,3Hkey,1,3,5Hvalue"


@case("none_e406_properties", ("records", str(1 + len(properties))), ("points", "1"))
def _(f):
    first = 3
    owned = ",".join(str(first + 2 * i) for i in range(len(properties)))
    f.add(116, f"0.,0.,0.,0,0,{len(properties)},{owned}")
    for form, text in properties.items():
        f.add(406, text, form=form, status=DEP)


@case("none_e402_12_index_and_5001_implementor", ("records", "3"), ("points", "1"))
def _(f):
    p = f.add(116, "0.,0.,0.,0")
    f.add(402, f"1,4Hbolt,{p}", form=12)
    f.add(402, "3,1,2,3", form=5001)


# Rows: what OpenCASCADE 7.6.3 reads wrongly ---------------------------------------------------------------------------
one("row01_range_order", 128, flat + "0.,.5,.25,.75", *over("(4*U, 1+2*V, 0)"), ("area", "8"), ("low", "(0, 1, 0)"), ("high", "(4, 3, 0)"))
one("row02_part_of_the_knots", 128, flat + ".25,.75,.25,.75", *over("(2+4*U, 1+2*V, 0)"), ("area", "8"), ("low", "(2, 1, 0)"), ("high", "(6, 3, 0)"))
one("row03_tiny_weight", 128, "1,1,1,1,0,0,0,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.E-10,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,0.,1.,0.,1.",
    ("surface 0 at 0.5 0.5", "(8*(1+1e-10)/(3+1e-10), 4*(1+1e-10)/(3+1e-10), 0)"), ("finding IG-E128-06", "1"))


def mirrored(name, matrix, type, parameters, *answers, form=0):
    @case(name, *answers)
    def _(f):
        f.add(type, parameters, form=form, matrix=f.add(124, matrix, form=1))


x_mirror, z_mirror = "-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,-1.,0."
mirrored("row04a_arc_mirrored_in_x", x_mirror, 100, "0.,0.,0.,5.,0.,0.,5.", *along("(-5*cos(pi/2*T), 5*sin(pi/2*T), 0)"), ("length", quarter))
mirrored("row04b_arc_mirrored_in_z", z_mirror, 100, "2.,0.,0.,5.,0.,0.,5.", *along("(5*cos(pi/2*T), 5*sin(pi/2*T), -2)"), ("length", quarter))


def ellipse_quarter(a, b):
    """The length of a quarter: the trapezoidal rule over a period converges geometrically."""
    n = 256
    return sum(hypot(a * sin(2 * pi * i / n), b * cos(2 * pi * i / n)) for i in range(n)) * pi / 2 / n


mirrored("row05_ellipse_mirrored_in_x", x_mirror, 104, ".04,0.,.25,0.,0.,-1.,0.,5.,0.,0.,2.", *along("(-5*cos(pi/2*T), 2*sin(pi/2*T), 0)"),
         ("length", "ellipse_quarter(5, 2)"), form=1)


@case("row06_offset_of_a_whole_line", *along("(10*T, 2, 0)"), ("length", "10"))
def _(f):
    f.add(130, f"{f.line('0.,0.,0.,10.,0.,0.')},1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.")


@case("row07a_tapered_offset", *along("(10*T, 2+T, 0)"), ("length", "sqrt(101)"))
def _(f):
    f.add(130, f"{f.line('0.,0.,0.,10.,0.,0.')},2,0,0,2,2.,0.,3.,1.,0.,0.,1.,0.,1.")


@case("row07b_functional_offset", *along("(10*T, 1+4*T, 0)"), ("length", "sqrt(116)"))
def _(f):
    f.add(130, f"{f.line('0.,0.,0.,10.,0.,0.')},3,{f.line('0.,1.,0.,1.,5.,0.')},2,2,0.,0.,0.,0.,0.,0.,1.,0.,1.")


@case("row08_indicator_against_the_normal", *over("(8*U, 4*V, -2)"), ("area", "32"), ("low", "(0, 0, -2)"), ("high", "(8, 4, -2)"))
def _(f):
    f.add(140, f"0.,0.,-1.,2.,{f.add(128, flat + '0.,1.,0.,1.', status=DEP)}")


@case("row09_offset_of_an_offset", *over("(8*U, 4*V, 5)"), ("area", "32"), ("low", "(0, 0, 5)"), ("high", "(8, 4, 5)"))
def _(f):
    once = f.add(140, f"0.,0.,1.,2.,{f.add(128, flat + '0.,1.,0.,1.', status=DEP)}", status=DEP)
    f.add(140, f"0.,0.,1.,3.,{once}")


@case("row10_border_without_curves", ("area", "32"), ("faces", "1"), ("finding IG-E141-03", "1"))
def _(f):
    base = f.add(128, flat + "0.,1.,0.,1.", status=DEP)
    f.add(143, f"1,{base},1,{f.add(141, f'1,2,{base},0', status=DEP)}")


@case("row11_scale_without_matrix", ("curve 0 at 1", "(1, 0, 0)"), ("high", "(2, 0, 0)"), ("low", "(0, 0, 0)"))
def _(f):
    f.add(408, f"{f.add(308, f'0,1Hp,1,' + str(f.line('0.,0.,0.,1.,0.,0.')), status=DEF)},0.,0.,0.,2.")


@case("row12_translation_then_matrix", ("low", "(0, 10, 0)"), ("high", "(0, 12, 0)"))
def _(f):
    turn = f.add(124, "0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.")
    f.add(408, f"{f.add(308, f'0,1Hp,1,' + str(f.line('0.,0.,0.,1.,0.,0.')), status=DEF)},10.,0.,0.,2.", matrix=turn)


@case("row13_rulings_by_arc_length", *over("(10*U, 2*V, 0)"), ("area", "20"))
def _(f):
    a = f.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,3.,0.,0.,10.,0.,0.,0.,1.,0.,0.,1.", status=DEP)
    f.add(118, f"{a},{f.line('0.,2.,0.,10.,2.,0.')},0,0")


one("row14a_ray", 110, "1.,0.,0.,2.,0.,0.", ("curve 0 low", "0"), ("curve 0 high", "inf"), ("curve 0 value -3", "(-2, 0, 0)"), form=1)
one("row14b_unbounded_line", 110, "1.,0.,0.,2.,0.,0.", ("curve 0 low", "-inf"), ("curve 0 high", "inf"), ("curve 0 value -3", "(-2, 0, 0)"), form=2)


@case("row15a_sphere_without_direction", ("area", "64*pi"), ("faces", "1"))
def _(f):
    f.add(196, f"{f.point('1.,2.,3.')},4.")


@case("row15b_cone_of_no_angle", ("area", "16*pi"), ("faces", "1"), ("finding IG-E190-02", "1"))
def _(f):
    base = f.add(194, f"{f.point()},{f.direction('0.,0.,1.')},2.,0.,{f.direction('1.,0.,0.')}", form=1, status=DEP)
    rims = [f.add(100, f"{z}.,0.,0.,2.,0.,2.,0.", status=DEP) for z in (0, 4)]
    on = [f.add(142, f"1,{base},0,{c},2", status=DEP) for c in rims]
    f.add(144, f"{base},1,1,{on[0]},{on[1]}")


@case("row15c_constructive_solids", ("solids", "1"), ("volume", "8-pi/6"), ("area", "24-3*pi/4+pi/2"))
def _(f):
    f.add(180, f"3,-{f.add(150, '2.,2.,2.', status=DEP)},-{f.add(158, '1.', status=DEP)},3")


@case("row15d_rectangular_array", ("curves", "6"), ("length", "6"), ("low", "(0, 0, 0)"), ("high", "(21, 5, 0)"))
def _(f):
    f.add(412, f"{f.line('0.,0.,0.,1.,0.,0.')},1.,0.,0.,0.,3,2,10.,5.,0.,0,0")


@case("row15e_circular_array", ("curves", "4"), ("length", "4"), ("low", "(-2, -2, 0)"), ("high", "(3, 2, 0)"))
def _(f):
    f.add(414, f"{f.line('0.,0.,0.,1.,0.,0.')},4,0.,0.,0.,2.,0.,{pi / 2!r},0,0")


@case("row16a_piping_flow", ("curves", "1"))
def _(f):
    f.add(402, "1,0,0,0,0,0,0,0", form=20)
    f.add(110, "0.,0.,0.,1.,0.,0.")


@case("row16b_network", ("curves", "2"))
def _(f):
    pin = f.add(132, "1.,1.,1.,0,0,0,1H1,0,3Hpin,0,0,0,0,0", status=DEP)
    net = f.add(320, f"0,3Hnet,1,{f.line('0.,0.,0.,1.,0.,0.')},0,2HU1,0,1,{pin}", status=DEF)
    f.add(420, f"{net},10.,0.,0.,1.,1.,1.,0,2HU1,0,1,{pin}")
    f.add(110, "0.,0.,0.,1.,0.,0.")


@case("row16c_surface_cut_short", ("curves", "1"), ("finding IG-E128-02", "1"))
def _(f):
    f.add(128, "1,1,1,1,0,0,1,0,0,0.,0.,1.")
    f.add(110, "0.,0.,0.,1.,0.,0.")


one("row19_a_third", 116, f"{1 / 3!r},0.,0.,0", ("point 0", "(1/3, 0, 0)"))


def number(x):
    return "inf" if x == inf else "-inf" if x == -inf else repr(float(x)) if isinstance(x, float) else str(x)


def main():
    rows = []
    for name, file, answers in cases:
        with open(os.path.join(HERE, name + ".igs"), "w", newline="\n") as out:
            out.write(file.text())
        for quantity, closed in answers:
            value = eval(closed)
            rows.append((name + ".igs", quantity, closed, " ".join(map(number, value)) if isinstance(value, tuple) else number(value)))
    with open(os.path.join(HERE, "answers.tsv"), "w", newline="\n") as out:
        out.write("file\tquantity\tclosed form\tvalue\n")
        out.writelines("\t".join(r) + "\n" for r in rows)
    print(f"{len(cases)} files, {len(rows)} answers")


if __name__ == "__main__":
    main()
