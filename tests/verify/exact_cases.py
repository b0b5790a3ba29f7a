"""The cases with exact solutions (docs/exact-solutions.md): closed forms and the program's errors."""
import math

import page
from tolerance import Absolute, Error, Relative, Same, Tolerance

C11, C13, C33, C44 = 166e9, 78e9, 162e9, 43e9
E33, E15 = 18.6, 11.6
BETA11, BETA33 = 11.2e-9, 12.6e-9
M33, P3 = 1.89e6, -1e-4
K11, RHO_C, THETA_REF = 50, 5500 * 420, 293
FOLDER = "cases/verification"


def case(program, name, **settings):
    return program.run(f"{FOLDER}/{name}.toml", **settings)


def line(case_name, quantity, exact, computed):
    """A row: the exact number, or what the fields are compared with, and the relative error."""
    return [f"`{case_name}`", quantity, page.number(exact, 12), page.error(worst([exact], [computed]))]


def worst(exact, computed, size=None):
    size = size or max(abs(e) for e in exact)
    return max(abs(e - c) for e, c in zip(exact, computed, strict=True)) / size


def column_rows(program):
    strain, height, warming = -1e-6, 0.01, 0.1
    short, opened, adiabatic = (case(program, f"column-{kind}")
                                for kind in ("short-circuit", "open-circuit", "adiabatic"))
    stress = lambda run, step: run.table("contact").only("step", step).numbers("normal_traction")[0]
    top = lambda run, step: run.table("history").only("step", step).numbers("min_potential")[0]
    field = lambda theta: -(E33 * strain + P3 * theta) / BETA33
    pressed = lambda theta: C33 * strain - E33 * field(theta) - M33 * theta
    theta = -(M33 - P3 * E33 / BETA33) * strain / (RHO_C / THETA_REF - P3 ** 2 / BETA33)
    charge = short.table("history").only("step", 1).numbers("charge_top")[0]
    return [
        line("column-short-circuit", "stress/strain, c33 [Pa]", C33, stress(short, 1) / strain),
        line("column-short-circuit", "charge of the top electrode [C/m]", E33 * strain * 0.001, charge),
        line("column-short-circuit", "stress, warmed [Pa]", C33 * strain - M33 * warming, stress(short, 2)),
        line("column-open-circuit", "stress/strain, c33 + e33²/β33 [Pa]", C33 + E33 ** 2 / BETA33,
             stress(opened, 1) / strain),
        line("column-open-circuit", "potential on top [V]", -field(0) * height, top(opened, 1)),
        line("column-open-circuit", "stress, warmed [Pa]", pressed(warming), stress(opened, 2)),
        line("column-open-circuit", "potential on top, warmed [V]", -field(warming) * height, top(opened, 2)),
        line("column-adiabatic", "temperature [K]", theta,
             adiabatic.table("nodes").numbers("temperature")[0]),
        line("column-adiabatic", "stress [Pa]", pressed(theta), stress(adiabatic, 4)),
    ]


def plate(t):
    return 3e-11 * (abs((t - 1) % 4 - 2) - 1)


def hysteresis(steps=90, end=9):
    """(slip, traction on the body) after each step."""
    first_slip, shear_stiffness, states = 1e-11, C44 + E15 ** 2 / BETA11, [(0, 0)]
    for n in range(1, steps + 1):
        at = plate(end * n / steps)
        slip = min(max(states[-1][0], at - first_slip), at + first_slip)
        states.append((slip, -shear_stiffness * (at - slip) / 0.01))
    return states


def shear_rows(program):
    run, states = case(program, "shear-hysteresis"), hysteresis()
    contact, history = run.table("contact"), run.table("history")
    steps = [int(step) for step in contact.texts("step")]
    name = "`shear-hysteresis`"
    slip = worst([states[n][0] for n in steps], contact.numbers("slip_x"))
    traction = worst([states[n][1] for n in steps], contact.numbers("tangential_traction_x"))
    dissipated = sum(history.numbers("friction_dissipation")[50:]) * 0.1
    bound = (C44 + E15 ** 2 / BETA11) * 1e-9
    return [[name, "slip, all nodes and steps [m]", "stick, slip, reversal", page.error(slip)],
            [name, "tangential traction, all nodes and steps [N/m²]", "stick, slip, reversal",
             page.error(traction)],
            line("shear-hysteresis", "dissipated in the last cycle [J/m]", bound * 0.02 * 8e-11, dissipated)]


def field_rows(program, name, fields, **settings):
    """The largest error of each nodal field against its formula in x, y, z."""
    nodes = case(program, name, **settings).table("nodes")
    places = [nodes.numbers(axis) for axis in ("x", "y", "z") if axis in nodes.names]
    errors = []
    for column, formula in fields.items():
        exact = [formula(*place) for place in zip(*places)]
        errors.append(worst(exact, nodes.numbers(column)))
    return [f"`{name}`", "fields at all nodes: " + ", ".join(fields), "linear", page.error(max(errors))]


def patch_rows(program):
    flat = {"u_x": lambda x, y: 2e-6 * x - 1e-6 * y, "u_y": lambda x, y: 5e-7 * x + 3e-6 * y,
            "potential": lambda x, y: 1000 * x - 500 * y, "temperature": lambda x, y: 0.25}
    solid = {"u_x": lambda x, y, z: 1e-6 * (2 * x - y + z), "u_y": lambda x, y, z: 1e-6 * (x / 2 + 3 * y - 2 * z),
             "u_z": lambda x, y, z: 1e-6 * (-x + y + z / 2),
             "potential": lambda x, y, z: 1000 * x - 500 * y + 200 * z, "temperature": lambda x, y, z: 0.25}
    slipping = flat | {"u_x": lambda x, y: 2e-6 * x + 1e-6 * y, "u_y": lambda x, y: 3e-6 * y}
    contact = case(program, "patch-contact").table("contact").only("step", 3)
    return [field_rows(program, "patch-test", flat), field_rows(program, "patch-test-3d", solid),
            field_rows(program, "patch-contact", slipping),
            line("patch-contact", "normal traction [N/m²]", 160200, contact.numbers("normal_traction")[1]),
            line("patch-contact", "tangential traction [N/m²]", -54600,
                 contact.numbers("tangential_traction_x")[1])]


def limit_rows(program):
    smooth = case(program, "frictionless")
    contact = smooth.table("contact").only("step", 4)
    tangential = max(abs(t) for t in contact.numbers("tangential_traction_x")[1:])
    stuck, clamped = (case(program, name).table("nodes") for name in ("perfect-stick", "perfect-stick-clamped"))
    same = max(worst(clamped.numbers(c), stuck.numbers(c)) for c in ("u_x", "u_y", "potential", "temperature"))
    stress = -(C33 - C13 ** 2 / C11) * 1e-6
    return [line("frictionless", "normal traction [N/m²]", stress, contact.numbers("normal_traction")[1]),
            field_rows(program, "frictionless", {"u_x": lambda x, y: C13 / C11 * 1e-6 * x}),
            ["`frictionless`", "tangential traction over normal", "0", page.error(tangential / abs(stress))],
            ["`perfect-stick`", "all fields", "`perfect-stick-clamped`", page.error(same)]]


EFFUSIVITY, EXCHANGE, FOUNDATION = math.sqrt(K11 * RHO_C), 1e4, -27


def cooled(t):
    b = EXCHANGE * math.sqrt(t) / EFFUSIVITY
    return FOUNDATION * (1 - math.exp(b * b) * math.erfc(b))


def cooled_in_steps(steps):
    """The half-space exact in space, backward Euler in time over one second: its last value."""
    weights, theta = [1.0], []
    for j in range(1, steps + 1):
        weights.append(weights[-1] * (j - 1.5) / j)
    conductance = EFFUSIVITY * math.sqrt(steps)
    for n in range(steps):
        past = sum(weights[n - j] * theta[j] for j in range(n))
        theta.append((EXCHANGE * FOUNDATION - conductance * past) / (conductance + EXCHANGE))
    return theta[-1]


def surface(program, **settings):
    return case(program, "cooled-half-space", **settings).table("contact").numbers("temperature")[-1]


def orders(errors):
    return [None] + [math.log2(abs(a / b)) for a, b in zip(errors, errors[1:])]


def half_space_in_space(program, steps=50):
    cells = [20, 40, 80, 160, 320]
    errors = [surface(program, mesh__box__cells=f"[{n},1]", time__steps=steps) - cooled_in_steps(steps)
              for n in cells]
    return [[n, page.error(e), page.number(o, 4)] for n, e, o in zip(cells, errors, orders(errors))]


def half_space_in_time(program):
    steps = [25, 50, 100, 200, 400]
    values = [surface(program, time__steps=n) for n in steps]
    errors = [value - cooled(1) for value in values]
    return [[n, page.number(v, 7), page.error(e), page.number(o, 4)]
            for n, v, e, o in zip(steps, values, errors, orders(errors))]


def add_to(document, program):
    rows = column_rows(program) + shear_rows(program) + limit_rows(program) + patch_rows(program)
    document.add("""## Exact solutions

Label: analytic. Derivations: [exact-solutions.md](exact-solutions.md). Each of these solutions lies in the
space of the finite elements and of backward Euler, so what is left is round-off. Errors are relative to the
largest exact value.""",
                 (["case", "quantity", "exact", "error"], rows, Tolerance(Same(), {"error": Error(1e-12)})), f"""
`cooled-half-space` is not in that space. Its surface temperature after 1 s, closed form
{page.number(cooled(1), 9)} K, on 160 cells:""",
                 (["steps", "surface temperature [K]", "error [K]", "order"], half_space_in_time(program),
                  Tolerance(Relative(2e-6), {"error [K]": Relative(0.1), "order": Absolute(0.002)})), """
Against the half-space that is exact in space but marches in the same 50 steps of backward Euler:""",
                 (["cells", "error [K]", "order"], half_space_in_space(program),
                  Tolerance(Relative(0.1), {"order": Absolute(0.01)})))
