"""The paper's own iteration beside the condensed route: what docs/monolithic.md says is measured."""
import tomllib

import other_codes
import page
import runs
from tolerance import Count, Error, Relative, Same, Tolerance

HEADING = "## Measured"
DISPLACEMENTS = {"u_x", "u_y", "normal_displacement", "slip_x", "slip_y"}
R = ["1e9", "1e10", "1e11", "1e12", None, "1e13", "1e14", "1e15"]


def paper(foundation, n):
    return f"cases/ouafik-2020/{foundation}.toml", {"mesh__box__cells": f"[{n},{n}]"}


def third():
    return [(folder.relative_to(runs.ROOT) / "case.toml", {}) for folder in
            sorted((other_codes.REFERENCE / "third").iterdir())]


def difference(ours, theirs, name):
    """The largest difference over all columns, each over its largest value, displacements over the largest of these."""
    ours, theirs = ours.table(name), theirs.table(name)
    largest = max(max(map(abs, theirs.numbers(c))) for c in theirs.names if c in DISPLACEMENTS)
    sizes = {column: largest for column in DISPLACEMENTS}
    if "time" in theirs.names:
        assert ours.texts("status") == theirs.texts("status")
        sizes["slip_rate"] = largest / theirs.numbers("time")[0]
        tractions = [c for c in theirs.names if "traction" in c]
        largest = max(max(map(abs, theirs.numbers(c))) for c in tractions)
        sizes |= {column: largest for column in tractions}
    return max(other_codes.differences(ours, theirs, sizes).values())


def totals(all_runs, key="newton_total"):
    return [run.summary()["iterations"][key] for run in all_runs]


def spread(counts):
    low, high = min(counts), max(counts)
    return str(low) if low == high else f"{low} to {high}"


class Routes:
    """Runs of both routes, with each of the kernels; differences are those of the processor's own one."""

    def __init__(self, program, kernels):
        self.program, self.kernels = program, kernels

    def monolithic(self, case, settings):
        return self.all(case, settings | {"solver__method": "monolithic"})

    def all(self, case, settings):
        return [self.program.run(case, kernel=kernel, **settings) for kernel in self.kernels]


def agreement_row(name, routes, cases):
    pairs = [(routes.monolithic(*case), routes.all(*case)) for case in cases]
    worst = [page.error(max(difference(ours[0], theirs[0], table) for ours, theirs in pairs))
             for table in ("nodes", "contact")]
    counts = [spread([n for pair in pairs for n in totals(pair[side])]) for side in (0, 1)]
    return [name, *worst, *counts]


def agreement(routes, cells):
    rows = [agreement_row(f"{foundation}, n = {n}", routes, [paper(foundation, n)])
            for foundation in ("conductive", "insulated") for n in cells]
    rows.append(agreement_row(f"{len(third())} programmes of `tests/reference/third`", routes, third()))
    return (["case", "nodes", "contact", "Newton iterations", "condensed"], rows,
            Tolerance(Count(0.1), {"nodes": Error(1e-9), "contact": Error(1e-9)}))


def with_r(settings, case, r):
    if r is None:
        return settings
    time = tomllib.loads((runs.ROOT / case).read_text())["time"]
    step = time["end"] / int(settings.get("time__steps", time["steps"]))
    return settings | {"solver__r_normal": r, "solver__r_tangential": float(r) * step}


def r_row(name, routes, case, settings):
    condensed = routes.program.run(case, **settings)
    cells, largest = [], 0
    for r in R:
        try:
            found = routes.monolithic(case, with_r(settings, case, r))
        except runs.NotSolved:
            cells.append("—")
            continue
        cells.append(f"{spread(totals(found))} ({spread(totals(found, 'newton_max'))})")
        largest = max(largest, *(difference(found[0], condensed, table) for table in ("nodes", "contact")))
    return [name, *cells, page.error(largest)]


def r_table(routes):
    insulated, settings = paper("insulated", 40)
    rows = [r_row("conductive, n = 32", routes, *paper("conductive", 32)),
            r_row("insulated, n = 40, S = 0.02, 10 steps", routes, insulated,
                  settings | {"contact__friction__bound": 0.02, "time__steps": 10})]
    rows += [r_row(f"`third/{name}`", routes, f"tests/reference/third/{name}/case.toml", {})
             for name in ("n24-sin-7", "box-offset-13x24-xload")]
    return (["r_ν = r_τ/k [N/m³]", *(r or "default" for r in R), "difference"], rows,
            Tolerance(Count(0.1), {"difference": Error(1e-9)}))


def last(table, column):
    return [abs(x) for x in table.only("step", table.numbers("step")[-1]).numbers(column)]


def multiplier_row(routes, n):
    case, settings = paper("conductive", n)
    nodal = routes.monolithic(case, settings)
    constant = routes.monolithic(case, settings | {"solver__multiplier": "piecewise-constant"})
    size = [run.summary()["extremes"][0]["maximum"] for run in (nodal[0], constant[0])]
    gap = [max(last(run.table("contact"), "normal_displacement")) / s for run, s in zip((nodal[0], constant[0]), size)]
    a, b = (run.table("contact").numbers("normal_traction") for run in (nodal[0], constant[0]))
    traction = max(abs(p - q) for p, q in zip(a, b)) / max(map(abs, a))
    return [n, spread(totals(nodal)), spread(totals(constant)), page.error(gap[0]), page.error(gap[1]),
            f"{100 * abs(size[1] / size[0] - 1):.2g} %", f"{100 * traction:.2g} %"]


def multiplier_table(routes, cells):
    return (["n", "iterations, nodal", "iterations, piecewise-constant", "u_ν, nodal", "u_ν, piecewise-constant",
             "largest displacement differs by", "normal tractions differ by"],
            [multiplier_row(routes, n) for n in cells],
            Tolerance(Relative(0.1), {"n": Same(), "iterations, nodal": Count(0.1),
                                      "iterations, piecewise-constant": Count(0.2), "u_ν, nodal": Error(1e-10)}))


def add_to(document, program, kernels, command):
    routes = Routes(program, kernels)
    more = ", ".join(kernel for kernel in kernels if kernel)
    document.add(f"""{HEADING}

Written by `{command}`; do not edit what follows. Iterations are those of a whole
run. Some differ with the kernels of the BLAS, where round-off decides on the way that Newton's method takes: ranges are over
OpenBLAS's own choice for this processor{f" and {more}" if more else ""}.

**Agreement with the condensed route**, as the largest difference over all columns of `nodes.csv` and
`contact.csv`, each over its largest value, displacements and tractions over the largest of their kind; the statuses
are equal at every node and step.""", agreement(routes, [16, 32, 64]), """
    tourmaline run cases/ouafik-2020/conductive.toml -o m --set mesh.box.cells=[32,32] --set solver.method=monolithic
    tourmaline run cases/ouafik-2020/conductive.toml -o c --set mesh.box.cells=[32,32]

**r over six decades.** In brackets the most iterations in one step; largest difference from the condensed route over
all columns and all r. The paper's r_ν = r_τ = 1e9 is 1e11 for r_τ/k in the first case. A dash: of the law more
than `solver.tolerance` of the forces at some point was left (exit status 3).""", r_table(routes), """
    tourmaline run cases/ouafik-2020/conductive.toml -o r --set mesh.box.cells=[32,32] --set solver.method=monolithic \\
       --set solver.r_normal=1e9 --set solver.r_tangential=1e7

**Piecewise constants** on the conductive case. P1 displacements with P0 multipliers are not uniformly stable in the
sense of inf-sup: u_ν vanishes in the mean of each facet only, and its remainder alternates from node to node. Given are
the largest nodal |u_ν| in the last step over the largest displacement, and how far the largest displacement and the normal
tractions of all nodes and steps are from those of nodal multipliers.""", multiplier_table(routes, [8, 16, 32]), """
    tourmaline run cases/ouafik-2020/conductive.toml -o p --set mesh.box.cells=[32,32] --set solver.method=monolithic \\
       --set solver.multiplier=piecewise-constant
""")
