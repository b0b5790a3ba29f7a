"""Convergence of the paper's example (cases/ouafik-2020) in mesh and time step."""
import math

import corner
import extrapolation
import page
from tolerance import Absolute, Bar, Relative, Same, Tolerance

FAMILIES = {"uniform": 1, "graded 16": 16, "graded 64": 64}
FOUNDATIONS = ["insulated", "conductive"]


def potential_at(run, *place):
    nodes = run.table("nodes")
    distances = [abs(x - place[0]) + abs(y - place[1])
                 for x, y in zip(nodes.numbers("x"), nodes.numbers("y"))]
    nearest = min(range(len(distances)), key=distances.__getitem__)
    assert distances[nearest] < 1e-9, f"no node at {place}"
    return float(nodes.texts("potential")[nearest])


def last_contact(run):
    contact = run.table("contact")
    return contact.only("step", contact.numbers("step")[-1])


def last(run, column):
    return run.table("history").numbers(column)[-1]


QUANTITIES = {
    "potential at (0, 0) [V]": lambda run: potential_at(run, 0, 0),
    "potential at (0, 0.1) [V]": lambda run: potential_at(run, 0, 0.1),
    "potential at (0.05, 0.1) [V]": lambda run: potential_at(run, 0.05, 0.1),
    "largest slip [m]": lambda run: max(map(abs, last_contact(run).numbers("slip_y"))),
    "lowest temperature [K]": lambda run: last(run, "min_temperature"),
    "elastic energy [J/m]": lambda run: last(run, "elastic_energy"),
}
TRACTIONS = {
    "normal, (0, 0)": lambda run: last_contact(run).numbers("normal_traction")[0],
    "tangential, (0, 0)": lambda run: last_contact(run).numbers("tangential_traction_y")[0],
    "normal, (0, 0.1)": lambda run: last_contact(run).numbers("normal_traction")[-1],
    "tangential, (0, 0.1)": lambda run: last_contact(run).numbers("tangential_traction_y")[-1],
}


# Tables are printed with seven digits, tractions with five.
FROM_THE_FINEST = ["converged", "order", "s from values", "s from differences", "error bar of the mesh"]
SEVEN_DIGITS = Tolerance(Relative(2e-6), rows={"converged": Bar(), "order": Absolute(0.05)}, finest=FROM_THE_FINEST)
FIVE_DIGITS = Tolerance(Relative(2e-4), rows={"s from values": Absolute(0.005), "s from differences": Absolute(0.005)},
                        finest=FROM_THE_FINEST)


class Values:
    """All quantities on all meshes: values[foundation, family][name] is a list over the cells."""

    def __init__(self, program, finest):
        self.program = program
        self.cells = [n for n in (16, 32, 64, 128, 256, 512) if n <= finest]
        self._kept = {}

    def __getitem__(self, key):
        if key not in self._kept:
            self._kept[key] = self._computed(*key)
        return self._kept[key]

    def _computed(self, foundation, family):
        ratio, kept = FAMILIES[family], {name: [] for name in QUANTITIES | TRACTIONS}
        for n in self.cells:
            run = self.run(foundation, n, ratio)
            for name, quantity in (QUANTITIES | TRACTIONS).items():
                kept[name].append(quantity(run))
        return kept

    def run(self, foundation, n, ratio, **settings):
        if ratio > 1:
            settings["mesh__box__grading"] = \
                f"{{left={ratio},right={ratio},bottom={ratio},top={ratio}}}"
        return self.program.run(f"cases/ouafik-2020/{foundation}.toml", mesh__box__cells=f"[{n},{n}]",
                                **settings)


def best_limit(values, foundation, name):
    """The family's limit with the smallest error bar, and the families that contradict it."""
    limits = {family: extrapolation.limit(values[foundation, family][name]) for family in FAMILIES}
    best = min(limits, key=lambda family: limits[family].bar)
    against = [family for family, limit in limits.items() if not limit.agrees_with(limits[best])]
    return best, limits[best], against


def is_trivial(values, foundation, name):
    return all(value == 0 for value in values[foundation, "uniform"][name])


def summary(values):
    rows = []
    for name in QUANTITIES:
        row = [name]
        for foundation in FOUNDATIONS:
            if is_trivial(values, foundation, name):
                row += ["0", "every node sticks"]
                continue
            best, limit, against = best_limit(values, foundation, name)
            row += [page.with_error_bar(limit.value, limit.bar),
                    best + (f"; not within the bars: {', '.join(against)}" if against else "")]
        rows.append(row)
    return ["quantity at t = 0.2 s", "insulated", "insulated, from", "conductive", "conductive, from"], rows, Tolerance(
        Bar(), {"insulated, from": Same(), "conductive, from": Same()}, finest=["all"])


def family_table(values, foundation, family):
    kept, names = values[foundation, family], list(QUANTITIES)
    names = [name for name in names if not is_trivial(values, foundation, name)]
    rows = [[n, *(page.number(kept[name][i], 7) for name in names)] for i, n in enumerate(values.cells)]
    limits = [extrapolation.limit(kept[name]) for name in names]
    rows.append(["converged", *(page.with_error_bar(limit.value, limit.bar) for limit in limits)])
    rows.append(["order", *(page.number(limit.order, 3) or "none" for limit in limits)])
    return ["n", *names], rows, SEVEN_DIGITS


def add_meshes(document, values):
    document.add(f"""## Mesh convergence of the paper's example

Label: regression. No other source has these numbers; the agreement of three families of meshes is what
supports them. Cases `cases/ouafik-2020/`, n × n squares of two triangles, 20 steps, t = 0.2 s. "graded 16"
and "graded 64" are `mesh.box.grading` with that number on all four sides: cells are smallest at the sides.
At the corners they are {page.number(1 / smallest_share(16), 3)} and {page.number(1 / smallest_share(64), 3)} times smaller than uniform ones.

The *converged value* is Aitken's extrapolation of the three finest meshes. Its *error bar* is its distance
from the value on the finest mesh, or from the extrapolation of the three meshes before, whichever is larger.
Where the last two differences do not shrink with one sign there is no extrapolation: then it is the value on
the finest mesh with the larger of the two differences, and the order reads "none". An order far from those
of the theory (2, and less where corners rule) says that the last differences are not those of one power; the
value then rests on the agreement of the families. The bars are for the error of the mesh only; for that of
the time step see below.""", summary(values), """
The value of the family with the smallest bar is given; "not within the bars" names families whose interval
does not meet its interval.""")
    for foundation in FOUNDATIONS:
        for family in FAMILIES:
            document.add(f"### {foundation}, {family}", family_table(values, foundation, family))


def smallest_share(ratio):
    """Cell at a side over the uniform one, for many cells, both ends graded alike."""
    a = math.sqrt(math.log(ratio))
    return 2 * a / math.sqrt(math.pi) / (ratio * math.erf(a))


def traction_table(values, foundation, family):
    return ["n", *TRACTIONS], traction_rows(values, foundation, family), FIVE_DIGITS


def traction_rows(values, foundation, family):
    kept = values[foundation, family]
    return [[n, *(page.number(kept[name][i], 5) for name in TRACTIONS)] for i, n in enumerate(values.cells)]


def growing_table(values, foundation, family):
    fits = [extrapolation.growth(values[foundation, family][name]) for name in TRACTIONS]
    rows = traction_rows(values, foundation, family)
    rows.append(["s from values", *(page.number(fit[0], 3) for fit in fits)])
    rows.append(["s from differences", *(page.number(fit[1], 3) or "none" for fit in fits)])
    return ["n", *TRACTIONS], rows, FIVE_DIGITS


def range_of_fits(values, foundation):
    fits = [s for family in FAMILIES for name in TRACTIONS
            for s in extrapolation.growth(values[foundation, family][name]) if s is not None]
    return f"{min(fits):.2f} and {max(fits):.2f}"


def corner_exponents():
    kinds = {"sticking contact, at (0, 0) and (0, 0.1)": corner.CLAMPED,
             "clamped and grounded side, at (0.1, 0) and (0.1, 0.1)": corner.CLAMPED_GROUNDED,
             "slipping contact, at (0, 0) and (0, 0.1)": corner.ROLLER}
    rows = []
    for name, kind in kinds.items():
        found = corner.exponents([(corner.BOTTOM, corner.FREE), (corner.CONTACT, kind)])
        rows.append([name, page.number(found[0], 5) if found else "none below 1",
                     f"r^−{1 - found[0]:.4f}" if found else "logarithmic, see below"])
    return ["free side meets", "displacement ~ r^λ, λ", "stress"], rows, Tolerance(Absolute(2e-5))


SLIDING_BOUND = 0.02


def sliding_rows(values):
    """The ends' normal tractions where all of the contact slips and nothing is cold."""
    rows, before = [], None
    for n in values.cells:
        run = values.run("insulated", n, 64, contact__friction__bound=SLIDING_BOUND,
                         **{"boundary[2]__traction": '[0,"-5*t"]'})
        assert set(last_contact(run).texts("status")) == {"slip"}
        now = [TRACTIONS["normal, (0, 0)"](run), TRACTIONS["normal, (0, 0.1)"](run)]
        changes = [a - b for a, b in zip(now, before)] if before else [None, None]
        rows.append([n, *(page.number(x, 5) for x in now), *(page.number(x, 4) for x in changes)])
        before = now
    return rows


def add_corners(document, values):
    sticking, clamped = (corner.exponents([(corner.BOTTOM, corner.FREE), (corner.CONTACT, kind)])[0]
                         for kind in (corner.CLAMPED, corner.CLAMPED_GROUNDED))
    doubling = corner.logarithm() * math.log(2)
    document.add(f"""## What does not converge: stresses at corners

Where a free side meets one that is held, the conditions change at a corner and the stress is infinite there.
`tests/verify/corner.py` computes how it grows with the distance r from the corner, from (1), (2), (4), (5)
alone, with the constants of the case; label: analytic.""", corner_exponents(), f"""
**Sticking contact.** A nodal traction is a mean over half a cell, so at such a corner it grows like h^-s with
s = 1 − λ = {1 - sticking:.4f}, without end. Tractions σν in N/m² at the ends of Γ_C at t = 0.2 s, with s from the last
two values and from the last two differences (a constant beside the power disturbs the first, not the second;
other powers disturb both):

Insulated, every node sticks, uniform meshes:""", growing_table(values, "insulated", "uniform"),
                 "Insulated, graded 64:", growing_table(values, "insulated", "graded 64"), f"""
All estimates on all three families of meshes lie between {range_of_fits(values, "insulated")}. No mesh makes these four
numbers converge; nor do the stresses of the cells at any corner of the body. What converges are fields
away from the corners, the potential, energies and integrals. The exponents also explain how slowly: on
uniform meshes the elastic energy errs like h^2λ = h^{2 * clamped:.2f}, from the clamped corners, and the potential at an
end of Γ_C like h^{sticking:.2f}; compare the orders above.

**Slipping contact.** There is no exponent below 1, but the tangential traction jumps from the bound to 0 at the
corner, and that alone gives a normal traction of {corner.logarithm():.4f} σ_τ ln r at (0, 0), mirrored at (0, 0.1). Each
doubling of n then changes it by {doubling:.4f} times the bound. To see it alone: insulated, the bound {SLIDING_BOUND} N/m² and
ten times the load, so that every node slips; then the change should tend to {doubling * SLIDING_BOUND:.5f} N/m², downwards
at (0, 0) and upwards at (0, 0.1). Graded 64:""",
                 (["n", "normal, (0, 0)", "normal, (0, 0.1)", "change, (0, 0)", "change, (0, 0.1)"], sliding_rows(values),
                  Tolerance(Relative(2e-4), {"change, (0, 0)": Relative(2e-3), "change, (0, 0.1)": Relative(2e-3)})),
                 "Conductive, uniform meshes:", traction_table(values, "conductive", "uniform"),
                 "Conductive, graded 64:", traction_table(values, "conductive", "graded 64"), f"""
The normal traction is mostly that of the cold layer, which ends in the corners; uniform meshes do not resolve
it. With both ends pulled outwards by 15 N/m² the logarithm drives both normal tractions up by
{15 * doubling:.1f} N/m² for each doubling, about one part in a hundred: they look converged, but are not.""")


def add_steps(document, values, n=128, ratio=16):
    steps = [5, 10, 20, 40, 80]
    kept = {name: [] for name in QUANTITIES}
    for count in steps:
        run = values.run("conductive", n, ratio, time__steps=count)
        for name, quantity in QUANTITIES.items():
            kept[name].append(quantity(run))
    rows = [[count, *(page.number(kept[name][i], 7) for name in QUANTITIES)] for i, count in enumerate(steps)]
    limits = [extrapolation.limit(kept[name]) for name in QUANTITIES]
    rows.append(["converged", *(page.with_error_bar(limit.value, limit.bar) for limit in limits)])
    rows.append(["order", *(page.number(limit.order, 3) or "none" for limit in limits)])
    mesh = [best_limit(values, "conductive", name)[1] for name in QUANTITIES]
    time_errors = [abs(kept[name][2] / limit.value - 1) for name, limit in zip(QUANTITIES, limits)]
    mesh_errors = [abs(limit.bar / limit.value) for limit in mesh]
    rows.append(["20 steps off by", *map(percent, time_errors)])
    rows.append(["error bar of the mesh", *map(percent, mesh_errors)])
    document.add(f"""## Convergence in the time step

Label: regression. Conductive, n = {n} graded {ratio}, t = 0.2 s. Converged values and error bars by the same rule
as above. The last two rows compare the error of 20 steps with the error bars of the converged values of the
mesh. The insulated case follows its load, which is linear in time, and has next to no memory; it is left out.""",
                 (["steps", *QUANTITIES], rows, Tolerance(
                     Relative(2e-6), rows={"converged": Bar(), "order": Absolute(0.05), "20 steps off by": Relative(0.5),
                                           "error bar of the mesh": Relative(0.5)}, finest=["error bar of the mesh"])),
                 f"Backward Euler is of first order. {verdict(time_errors, mesh_errors)}")


def verdict(time_errors, mesh_errors):
    worse = [name for name, of_time, of_mesh in zip(QUANTITIES, time_errors, mesh_errors) if of_time > of_mesh]
    if len(worse) == len(QUANTITIES):
        return ("With 20 steps every quantity errs more from the time step than from\nthe best mesh: who wants "
                "more digits needs smaller steps first.")
    return f"With 20 steps the time step errs more than the best mesh for: {', '.join(worse) or 'nothing'}."


def percent(share):
    return f"{100 * share:.1g} %"
