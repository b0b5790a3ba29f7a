#!/usr/bin/python3
"""contact_laws.py CASE.toml [RESULT.json]: solves the case and writes what is expected of every contact node.

Options: --frozen      the other route of step 1 (bounds frozen during a convex programme)
         --starts N    solves every step from N random states as well and counts those that end elsewhere
"""
import argparse
import json
import sys

import numpy as np

import lcp
from body import LONG, PHI, THETA, Body, Solver
from case import Case
from laws import Friction, Normal
from step import OPEN, SLIP, STICK, Step, Unsettled


class Run:
    def __init__(self, case):
        self.case, self.body = case, Body(case)
        b = self.body
        self.nodes = b.sides[case.side]
        self.order = np.lexsort((b.y[self.nodes], b.x[self.nodes]))
        self.nodes = self.nodes[self.order]
        self.n, self.w = len(self.nodes), b.weights(case.side)[self.order]
        self.x, self.y = b.x[self.nodes], b.y[self.nodes]
        self.axis = 0 if case.side in ("left", "right") else 1
        self.sign = -1 if case.side in ("left", "bottom") else 1
        normal_rows, tangential_rows = 4 * self.nodes + self.axis, 4 * self.nodes + 1 - self.axis
        self.rows = np.concatenate([normal_rows, tangential_rows])
        self.turn = np.concatenate([np.full(self.n, self.sign), np.ones(self.n, int)])
        mine = set(self.rows.tolist())
        self.interior = np.array([i for i in range(b.n) if i not in b.held and i not in mine])
        self.solver = Solver(b.K, self.interior)
        self.normal, self.friction = Normal(case.normal, case.k), Friction(case.friction, case.k)
        self.condense()

    def condense(self):
        m = 2 * self.n
        self.S = np.zeros((m, m), LONG)
        for j, row in enumerate(self.rows):
            x = np.zeros(self.body.n, LONG)
            x[row] = self.turn[j]
            self.solver.solve(x, np.zeros(self.body.n, LONG))
            self.S[:, j] = self.turn * (self.body.K @ x)[self.rows]
        self.asymmetry = float(np.max(np.abs(self.S - self.S.T)) / np.max(np.abs(self.S)))
        self.S = (self.S + self.S.T) / 2

    def foundation(self, t):
        """Displacement of the foundation: along the outward normal, along the side."""
        f = [formula(self.x, self.y, t) for formula in self.case.foundation]
        return self.sign * f[self.axis], f[1 - self.axis]

    def coulomb_constant(self):
        """Below 1/this a constant coefficient of friction has one solution (README)."""
        n, S = self.n, self.S.astype(float)
        free_n = [i for i in range(n) if self.rows[i] not in self.body.held]
        free_t = [i for i in range(n, 2 * n) if self.rows[i] not in self.body.held]
        nn, tt, nt = S[np.ix_(free_n, free_n)], S[np.ix_(free_t, free_t)], S[np.ix_(free_n, free_t)]
        schur = tt - nt.T @ np.linalg.solve(nn, nt)
        values = []
        for T in (np.ones(n), 1 / np.sqrt(self.w.astype(float)), 1 / np.sqrt(np.diag(S)[:n])):
            a, c = T[free_n], T[[i - n for i in free_t]]
            values.append(np.sqrt(np.linalg.eigvalsh(nn * a[:, None] * a)[-1]
                                  / np.linalg.eigvalsh(schur * c[:, None] * c)[0]))
        return float(min(values))

    def condensed(self, t, x, slid):
        """S z = s + q of the step that ends at t, from the state x: base (normal displacement without gap, tangential one
        without slip in this step), body at z = 0, load, prescribed z by row, s."""
        b = self.body
        load = b.loads(t, x)
        fn, ft = self.foundation(t)
        base = np.concatenate([(self.case.gap(self.x, self.y, 0.0) + fn).astype(LONG), slid + ft])
        trial = x.copy()
        for i, value in b.held_values(t).items():
            trial[i] = value
        held = {j: float(self.turn[j] * trial[row] - base[j]) for j, row in enumerate(self.rows) if row in b.held}
        trial[self.rows] = self.turn * base
        self.solver.solve(trial, load)
        return base, trial, load, held, self.turn * (load - b.K @ trial)[self.rows]

    def march(self, frozen=False, starts=0, random=np.random.default_rng(1)):
        b, n, case = self.body, self.n, self.case
        x = np.zeros(b.n, LONG)
        fn, ft = self.foundation(0.0)
        g = case.gap(self.x, self.y, 0.0)
        before, slid = -fn - g, -ft.astype(LONG)  # delta; u_tau - u_f,tau
        accumulated, size = np.zeros(n, LONG), 0.0
        steps, z = [], np.zeros(2 * n)
        self.largest = np.zeros(4)  # of each field, over all steps
        for k in range(1, case.steps + 1):
            t = k * case.end / case.steps
            base, trial, load, held, s = self.condensed(t, x, slid)
            step = Step(self.S, s, self.w, self.normal, self.friction, before.astype(float), accumulated.astype(float), held, size)
            z[n:] = 0
            state, closed, side, worst, margin = step.solve(z, frozen)
            others = self.other_solutions(step, state, starts, random)
            pivoting = lcp.compare(step, state, closed, side, random)
            for i in range(n):  # what a status says is zero is zero
                if closed[i] and self.normal.rigid and i not in held:
                    state[i] = 0
                if side[i] == 0 and n + i not in held:
                    state[n + i] = 0
            q = step.SL @ state - s
            size = max(size, float(np.max(np.abs(q))))
            x = trial
            x[self.rows] = self.turn * (base + state)
            self.solver.solve(x, load)
            self.largest = np.maximum(self.largest, [float(np.max(np.abs(x[f::4]))) for f in range(4)])
            full = self.body.K @ x - load
            balance = max(np.max(np.abs(self.turn * full[self.rows] - q)),
                          np.max(np.abs(full[self.interior][self.interior % 4 < 2]), initial=0)) / size
            p = step.closed_pressure(state, q, closed)
            d = state[n:]
            slid = slid + d
            accumulated = accumulated + np.abs(d)
            steps.append(self.record(k, t, x, q, p, d, slid, accumulated, state, closed, side, step))
            steps[-1]["check"] = {"law_violation": worst, "margin": margin, "imbalance": float(balance)} | others | pivoting
            before, z = state[:n].copy(), state.astype(float)
        self.final = x
        return steps

    def other_solutions(self, step, state, starts, random):
        """Solves again from random states; how many ended at another solution, or at none."""
        if not starts:
            return {}
        other, failed, n = 0, 0, self.n
        size = max(np.max(np.abs(state)), 1e-12)
        for _ in range(starts):
            try:
                z = random.standard_normal(2 * n) * float(size) * 10 ** random.uniform(-2, 1)
                found = step.solve(z, frozen=bool(random.integers(2)))[0]
                other += step.distance(found, state) > 1e-9
            except Unsettled:
                failed += 1
        return {"random_starts": starts, "other_solution": other, "unsettled": failed}

    def record(self, k, t, x, q, p, d, slid, accumulated, state, closed, side, step):
        n = self.n
        tau = np.where([k is None for k in side], 0, q[n:] / self.w)
        supported = [n + i in step.held for i in range(n)]
        tau[supported] = (q[n:] / self.w)[supported]
        status = []
        for i in range(n):
            is_open = not closed[i] and step.normal.law != "bilateral" and state[i] < 0
            moved = d[i] != 0 if step.friction.law != "none" else True
            if n + i in step.held:  # a support bears a part: the foundation's is what the law allows
                bound = 0 if is_open else step.friction.bound(p[i], abs(d[i]), step.slip0[i])[0]
                tau[i] = -bound * np.sign(d[i]) if d[i] != 0 else min(max(tau[i], -bound), bound)
                moved = d[i] != 0
            status.append(OPEN if is_open else SLIP if moved else STICK)
        along, across = ("tangential_traction_y", "tangential_traction_x") if self.axis == 0 else ("tangential_traction_x", "tangential_traction_y")
        slip, no_slip = ("slip_y", "slip_x") if self.axis == 0 else ("slip_x", "slip_y")
        zero = np.zeros(n)
        flux = zero
        if self.case.exchange:
            kc, th = self.case.exchange
            flux = kc * (x[4 * self.nodes + THETA] - th(self.x, self.y, t))
        columns = {
            "x": self.x, "y": self.y, "normal_traction": np.where(closed, -p, 0) + 0, along: tau, across: zero,
            "normal_displacement": self.sign * x[4 * self.nodes + self.axis], slip: slid, no_slip: zero,
            "slip_rate": np.abs(d) / self.case.k, "temperature": x[4 * self.nodes + THETA],
            "potential": x[4 * self.nodes + PHI], "heat_flux": flux, "gap": -state[:n],
            "u_x": x[4 * self.nodes], "u_y": x[4 * self.nodes + 1], "accumulated_slip": accumulated}
        return {"step": k, "time": t, "contact": {"status": status, "supported": supported} | {c: [float(v) + 0.0 for v in a] for c, a in columns.items()}}

    def interior_values(self):
        """Every field at a few nodes of the last step."""
        nx, ny = self.case.cells
        b, picked = self.body, []
        for i in sorted({nx // 5, nx // 2, nx - nx // 4}):
            for j in sorted({ny // 4, ny // 2, ny - ny // 5}):
                picked.append(i * (ny + 1) + j)
        picked = np.array(picked)
        take = lambda f: [float(v) for v in self.final[4 * picked + f]]
        largest = dict(zip(("u_x", "u_y", "potential", "temperature"), self.largest.tolist()))
        return {"x": b.x[picked].tolist(), "y": b.y[picked].tolist(), "u_x": take(0), "u_y": take(1),
                "potential": take(PHI), "temperature": take(THETA)}, largest


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("case")
    arguments.add_argument("result", nargs="?")
    arguments.add_argument("--frozen", action="store_true")
    arguments.add_argument("--starts", type=int, default=0)
    a = arguments.parse_args()
    case = Case(a.case)
    run = Run(case)
    steps = run.march(a.frozen, a.starts)
    nodes, largest = run.interior_values()
    for s in steps:
        st = s["contact"]["status"]
        p, tau = s["contact"]["normal_traction"], s["contact"]["tangential_traction_x" if run.axis else "tangential_traction_y"]
        print(f"step {s['step']}: open {st.count(OPEN)} stick {st.count(STICK)} slip {st.count(SLIP)}"
              f"  p {-max(p):.3g} .. {-min(p):.3g}  tau {min(tau):.3g} .. {max(tau):.3g}"
              f"  slip <= {max(map(abs, s['contact']['slip_x'] + s['contact']['slip_y'])):.3g}  " + str(s["check"]))
    constant = run.coulomb_constant() if case.friction["law"] == "coulomb" else None
    print("asymmetry of S", run.asymmetry, " 1/L", 1 / constant if constant else None)
    if a.result:
        write(a.result, {"title": case.title, "friction_law": case.friction["law"],
                         "unique_below": 1 / constant if constant else None, "steps": steps, "nodes": nodes, "largest": largest})


def write(path, result):
    """JSON, a line for each list of numbers; numbers as short as they can be without losing a bit (up to 17 digits)."""
    def text(value, indent):
        if not isinstance(value, (dict, list)) or isinstance(value, list) and not isinstance(value[0], dict):
            return json.dumps(value)
        pad = "\n" + " " * (indent + 1)
        if isinstance(value, list):
            return "[" + pad + ("," + pad).join(text(v, indent + 1) for v in value) + "]"
        return "{" + pad + ("," + pad).join(f"{json.dumps(k)}: {text(v, indent + 1)}" for k, v in value.items()) + "}"

    with open(path, "w") as file:
        file.write(text(result, 0) + "\n")


if __name__ == "__main__":
    main()
