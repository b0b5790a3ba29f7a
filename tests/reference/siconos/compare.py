#!/usr/bin/python3
"""compare.py PROGRAM [SEED [COUNT]] [-- OPTION...]: is the program's contact a solution of siconos's problem?

    compare.py build/release/apps/tourmaline/tourmaline
    compare.py build/release/apps/tourmaline/tourmaline 7 20 -- --set solver.method=monolithic

COUNT random cases in 2D and as many in 3D: one step, unilateral contact, Coulomb's friction; README.md says what is compared.
Exit status 1 where siconos has an answer and the program has none or one that is not a solution.
"""
import collections
import csv
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import numpy as np
import siconos.numerics as sn

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "contact_laws"))
import solid
from case import Case, Formula
from contact_laws import LONG, Run
from random_cases import random_case

TOLERANCE = 1e-8  # of siconos's error, and of displacements over the largest entry of q
SAME = 1e-6  # of the largest nodal force
SOLVERS = {2: {sn.SICONOS_FRICTION_2D_NSGS: 100000, sn.SICONOS_FRICTION_2D_LEMKE: 10000},  # with iterations
           3: {sn.SICONOS_FRICTION_3D_NSGS: 100000, sn.SICONOS_FRICTION_3D_NSN_AC: 1000}}


def problem(path, dim):
    """(places, weights, M, q): u = M r + q, node by node (normal, tangential...); u_N opens, u_T slips, r acts on the body."""
    if dim == 3:
        return solid.condense(tomllib.loads(path.read_text()))
    run = Run(Case(path))
    s = run.condensed(run.case.end, np.zeros(run.body.n, LONG), -run.foundation(0.0)[1].astype(LONG))[-1].astype(float)
    turn = np.repeat([-1, 1], run.n)  # delta and the force along it are -u_N and -r_N
    M = turn[:, None] * np.linalg.inv(run.S.astype(float)) * turn
    order = np.arange(2 * run.n).reshape(2, -1).T.ravel()
    return np.stack([run.x, run.y], 1), run.w.astype(float), M[np.ix_(order, order)], (M @ (turn * s))[order]


def answer(program, path, options, places, weights):
    """(r, u, statuses) as contact.csv has them, or what the program says where it has none."""
    dim = places.shape[1]
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run([program, "run", str(path), "-o", folder, *options], capture_output=True, text=True)
        if run.returncode:
            return f"exit status {run.returncode}: " + run.stderr.strip()
        with open(pathlib.Path(folder) / "contact.csv", newline="") as file:
            table = {tuple(round(float(r[c]), 9) for c in "xyz"[:dim]): r for r in csv.DictReader(file)}
    rows = [table[tuple(p)] for p in np.round(places, 9)]
    column = lambda name: np.array([float(r[name]) for r in rows])
    along = [(c, Formula(tomllib.loads(path.read_text())["contact"]["foundation_displacement"][a])(0.0, 0.0, 0.0))
             for a, c in enumerate("xyz"[:dim]) if np.ptp(places[:, a])]
    r = [-column("normal_traction")] + [column(f"tangential_traction_{c}") for c, _ in along]
    u = [column("gap")] + [column(f"slip_{c}") + start for c, start in along]  # slip before the step: -start
    return (np.stack(r, 1) * weights[:, None]).ravel(), np.stack(u, 1).ravel(), [r["status"] for r in rows]


class Siconos:
    """Its problem, in units in which the entries of q are at most 1 and the diagonal of M is 1 in the mean."""

    def __init__(self, dim, M, q, mu):
        self.dim, self.n, self.mu = dim, len(q) // dim, mu
        self.length, self.force = np.max(np.abs(q)), np.max(np.abs(q)) / np.mean(np.diag(M))
        self.M, self.q = M * self.force / self.length, q / self.length

    def error(self, r):
        """fc3d_compute_error, relative to |q|, and u = M r + q as it has it; a plane problem gets a direction without force."""
        M, q, reaction, u = np.eye(3 * self.n), np.zeros(3 * self.n), np.zeros(3 * self.n), np.zeros(3 * self.n)
        mine = (3 * np.arange(self.n)[:, None] + np.arange(self.dim)).ravel()
        M[np.ix_(mine, mine)], q[mine], reaction[mine] = self.M, self.q, r
        siconos = sn.FrictionContactProblem(3, self.n, M, q, np.full(self.n, self.mu))
        options = sn.SolverOptions(sn.SICONOS_FRICTION_3D_NSGS)
        return sn.fc3d_compute_error(siconos, reaction, u, TOLERANCE, options, np.linalg.norm(q))[1], u[mine]

    def solutions(self):
        drive = sn.fc2d_driver if self.dim == 2 else sn.fc3d_driver
        for solver, iterations in SOLVERS[self.dim].items():
            for tolerance in (1e-10, 1e-12):  # what a solver calls small need not be so by the error above
                options, r, u = sn.SolverOptions(solver), np.zeros(len(self.q)), np.zeros(len(self.q))
                options.iparam[0], options.dparam[0] = iterations, tolerance
                siconos = sn.FrictionContactProblem(self.dim, self.n, self.M.copy(), self.q.copy(), np.full(self.n, self.mu))
                if drive(siconos, r, u, options) == 0 and self.error(r)[0] < TOLERANCE:
                    yield r
                    break


def compare(program, path, options, dim, mu, count):
    """Adds the case to the counts; returns what is said of it, and whether that is a failure."""
    places, weights, M, q = problem(path, dim)
    siconos = Siconos(dim, M, q, mu)
    found, mine = list(siconos.solutions()), answer(program, path, options, places, weights)
    count.update({"cases": 1, "solved by siconos": bool(found), "of mu > 1": mu > 1})
    if isinstance(mine, str):
        count["not solved by the program"] += 1
        return f"{len(found)} by siconos; {mine}", bool(found)
    r, u = mine[0] / siconos.force, mine[1] / siconos.length
    error, theirs = siconos.error(r)
    apart = np.max(np.abs(u - theirs))
    solution, same = max(error, apart) <= TOLERANCE, [bool(np.max(np.abs(f - r)) <= SAME * max(1, np.max(np.abs(f)))) for f in found]
    count.update({"solutions": solution, "equal to one of siconos's": any(same), **{f"nodes {s}": n for s, n in collections.Counter(mine[2]).items()}})
    count["largest error"], count["largest difference of u"] = max(count["largest error"], error), max(count["largest difference of u"], apart)
    return f"mu {mu}, {len(r) // dim} nodes, error {error:.1e}, u {apart:.1e}, equal to siconos's: {same}", bool(found) and not solution


def main():
    own, options = sys.argv[1:], []
    if "--" in own:
        own, options = own[:own.index("--")], own[own.index("--") + 1:]
    if not own:
        raise SystemExit(__doc__)
    seed, cases = [int(a) for a in own[1:]] + [15, 60][len(own) - 1:]
    failed = False
    for dim in (2, 3):
        random, count = np.random.default_rng([seed, dim]), collections.Counter()
        for i in range(cases):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "case.toml"
                text, mu = random_case(random, dim)
                path.write_text(text)
                line, wrong = compare(own[0], path, options, dim, mu, count)
            print(f"{dim}D {i}: {line}" + (f"\nFAILS; its case:\n{text}" if wrong else ""), flush=True)
            failed = failed or wrong
        print(f"{dim}D: " + ", ".join(f"{name} {n:.2g}" if "largest" in name else f"{name} {n}" for name, n in count.items()))
    raise SystemExit(1 if failed else 0)


if __name__ == "__main__":
    main()
