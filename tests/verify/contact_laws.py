"""Contact that opens, yields or rubs by its pressure: closed forms, another code's plate, Hertz's line on finer and finer
meshes."""
import math

import page
from exact_cases import BETA11, BETA33, C33, C44, E15, E33, case, worst
from tolerance import Absolute, Error, Relative, Same, Tolerance


def over_time(run, name, column, exact, words):
    """A row: the error of a column of contact.csv at all nodes in all steps against a function of time."""
    contact = run.table("contact")
    error = worst([exact(t) for t in contact.numbers("time")], contact.numbers(column))
    return [f"`{name}`", words, page.error(error)]


def sunk(t, gap=1e-8, compliance=1e13, stiffness=(C33 + E33 ** 2 / BETA33) / 0.01):
    lowered = 5e-8 * t * (2 - t)
    return lowered if lowered < gap else (stiffness * lowered + compliance * gap) / (stiffness + compliance)


def capped(t):
    return min(1.5e6 * t, 3e5 * (1 + t), 5e5)


def weakened():
    """(slip, accumulated slip, shear) after each step; the slip increments by bisection."""
    stiffness, states = 43e9 / 0.1, [(0, 0, 0)]
    for moved in (0.5e-6, 1e-6, 1.5e-6, 2e-6, 1.5e-6, 0, -0.5e-6):
        slip, accumulated, _ = states[-1]
        bound = lambda x: 1e6 * (0.3 + 0.2 * math.exp(-(accumulated + x) / 1e-6))
        trial, increment = stiffness * (moved - slip), 0
        if abs(trial) > bound(0):
            low, high = 0, abs(trial) / stiffness
            for _ in range(200):
                increment = (low + high) / 2
                low, high = (increment, high) if abs(trial) - stiffness * increment > bound(increment) else \
                    (low, increment)
        sign = math.copysign(1, trial)
        states.append((slip + sign * increment, accumulated + increment, trial - sign * stiffness * increment))
    return states


def column_rows(program):
    compliance, damped, cap, weak = (case(program, f"contact-{name}") for name in
                                     ("compliance", "damped", "capped-friction", "slip-weakening"))
    shear_stiffness, states = (C44 + E15 ** 2 / BETA11) / 0.01, weakened()
    at = lambda k: lambda t: states[round(t)][k]
    return [over_time(compliance, "contact-compliance", "normal_displacement", sunk, "normal displacement"),
            over_time(compliance, "contact-compliance", "normal_traction",
                      lambda t: -1e13 * max(0, sunk(t) - 1e-8), "normal traction"),
            over_time(damped, "contact-damped", "normal_displacement", lambda t: 1e-7 * t, "normal displacement"),
            over_time(cap, "contact-capped-friction", "tangential_traction_x", lambda t: -capped(t),
                      "tangential traction"),
            over_time(cap, "contact-capped-friction", "slip_x", lambda t: (1.5e6 * t - capped(t)) / shear_stiffness,
                      "slip"),
            over_time(weak, "contact-slip-weakening", "slip_x", at(0), "slip"),
            over_time(weak, "contact-slip-weakening", "accumulated_slip", at(1), "accumulated slip"),
            over_time(weak, "contact-slip-weakening", "tangential_traction_x", lambda t: -at(2)(t),
                      "tangential traction")]


FORCE, RADIUS = 1e6, 1


def hertz(program, name, reduced, cells):
    """The half width a, from the second moment of the pressure; errors of a, of the largest pressure and of E*; h/a."""
    contact = program.run(f"cases/hertz/{name}.toml", mesh__box__cells=str(list(cells))).table("contact")
    x, pressure = contact.numbers("x"), [-t for t in contact.numbers("normal_traction")]
    after, before = x[1:] + x[-1:], x[:1] + x[:-1]
    second = sum(p * (right - left) * at * at for p, right, left, at in zip(pressure, after, before, x))
    a, p0 = math.sqrt(4 * FORCE * RADIUS / (math.pi * reduced)), math.sqrt(FORCE * reduced / (math.pi * RADIUS))
    half_width = 2 * math.sqrt(second / FORCE)
    size = min(right - at for at, right in zip(x, x[1:]) if right > a)
    return half_width, half_width / a - 1, pressure[0] / p0 - 1, (a / half_width) ** 2 - 1, size / a


def hertz_rows(program, name, reduced):
    rows, last = [], None
    for cells in ((32, 32), (64, 64), (128, 128), (256, 256), (512, 256)):
        half_width, *errors, size = hertz(program, name, reduced, cells)
        rows.append([f"`{name}`", "{} x {}".format(*cells), page.number(size, 2), *(page.error(e) for e in errors),
                     page.error(half_width / last - 1) if last else ""])
        last = half_width
    return rows


PLATE = {0: 2.84594384, 1.25e-3: 2.70792364, 5e-3: 2.27402555, 7.5e-3: 1.97270669, 11.25e-3: 1.53641594}


def plate_rows(program):
    rows = []
    for name, settings in (("plate", {}), ("plate, ten load steps", {"time__steps": 10}), ("solid", {})):
        run = program.run(f"cases/ssnv128/{name.split(',')[0]}.toml", **settings)
        contact = run.table("contact").only("step", settings.get("time__steps", 1))
        at = lambda place: min(range(len(contact.rows)), key=lambda i: abs(contact.numbers("x")[i] - place))
        found = [contact.numbers("slip_x")[at(place)] * 1e5 for place in PLATE]
        statuses = contact.texts("status")
        rows.append([name, *(page.number(u, 9) for u in found),
                     ", ".join(str(statuses.count(s)) for s in ("open", "slip", "stick"))])
    return rows


def add_to(document, program):
    document.add("""## Contact laws

Label: analytic ([exact-solutions.md](exact-solutions.md), 6). Errors at all nodes in all steps, relative to the largest
exact value.""",
                 (["case", "quantity", "error"], column_rows(program), Tolerance(Same(), {"error": Error(1e-12)})), """
Label: other code. The plate SSNV128 in 32 x 10 squares ([../cases/ssnv128](../cases/ssnv128/README.md)): u_x [1e-5 m] of
the lower side at so many millimetres, and how many nodes are open, slip and stick. Code_Aster has 2.84594384, 2.70792364,
2.27402555, 1.97270669 and 1.53641594.""",
                 (["case", *(page.number(1e3 * place) for place in PLATE), "open, slip, stick"], plate_rows(program),
                  Tolerance(Relative(1e-8), {"open, slip, stick": Same(), "case": Same()})), """
Label: analytic. Hertz's line ([../cases/hertz](../cases/hertz/README.md)): half width a, pressure p0 in the middle and
modulus E* against the closed forms of a half-plane; h is the size of the cells at the edge of the contact, and the last
column by how much a differs from that of the mesh before. The body ends at 100 a.""",
                 (["case", "cells", "h/a", "a", "p0", "E*", "a, change"],
                  hertz_rows(program, "line", 2e11 / 0.91) + hertz_rows(program, "piezoelectric", 1.468047e11),
                  Tolerance(Absolute(2e-5), {"case": Same(), "cells": Same(), "h/a": Relative(0.01)})))
