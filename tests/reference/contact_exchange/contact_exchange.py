#!/usr/bin/python3
"""contact_exchange.py CASE.toml [RESULT.json]: solves the case and writes what is expected of every contact node.

Options: --starts N    solves every step again by held coefficients and from N random states, counts those that end elsewhere
         --every N     writes every Nth step and the last one only
         --lumped      the other reading of what is lumped (README)
"""
import argparse
import json

import numpy as np

import laws
from body import LONG, Body
from case import Case
from step import Data, Step


class Run:
    def __init__(self, case):
        self.case, self.body = case, Body(case)
        b = self.body
        self.dim = b.dim
        self.nodes, self.w, self.nu = b.contact_points()
        self.places = b.points[self.nodes]
        self.m = len(self.nodes)
        self.T = np.array([tangents(n) for n in self.nu])  # m x dim x (dim - 1)
        self.K = b.K.double()
        for i in self.nodes:
            held = any(b.stride * i + a in b.held for a in range(self.dim))
            assert not held or case.friction["law"] == "none", "friction at a node that a support holds"

    def foundation(self, t):
        if self.case.foundation is None:
            return np.zeros((self.m, self.dim), LONG)
        return np.array([f(self.places, t) for f in self.case.foundation], LONG).T

    def data(self, x, t, memory, slip, slid):
        """x: the state before; memory: charge that has leaked through each node's patch; slip: u_tau - u_f,tau before."""
        b, case, d = self.body, self.case, Data()
        f = self.foundation(t)
        d.body, d.case, d.dim, d.nodes, d.w, d.nu, d.T, d.K = b, case, self.dim, self.nodes, self.w, self.nu, self.T, self.K
        d.gap = case.gap(self.places, 0.0) + (f * self.nu).sum(1)
        d.u_stuck = f + np.einsum("mad,md->ma", self.T, slip)  # its tangential part: no slip in this step
        d.slid = slid.astype(float)
        d.k_c, d.theta_f = case.k_c(self.places, 0.0), case.theta_f(self.places, t)
        d.c_e, d.phi_f = case.c_e(self.places, 0.0), case.phi_f(self.places, t)
        d.rate = case.k if case.leaks else 1.0
        d.b = b.loads(t, x)
        d.memory = memory
        d.b[b.stride * self.nodes + b.PHI] += memory
        d.prescribed = np.zeros(b.n, LONG)
        for i, value in b.held_values(t).items():
            d.prescribed[i] = value
        return d

    def march(self, starts=0, random=np.random.default_rng(1)):
        b, case, m, dim = self.body, self.case, self.m, self.dim
        x = np.zeros(b.n, LONG)
        x[b.THETA::b.stride] = case.initial_temperature(b.points, 0.0)
        slip = -np.einsum("mad,ma->md", self.T, self.foundation(0.0))
        slid, memory, leaked = np.zeros(m, LONG), np.zeros(m, LONG), np.zeros(m, LONG)
        # The first guess: what touches is closed, as otherwise nothing may hold the body.
        X, steps = np.concatenate([x, np.ones(m, LONG), np.zeros(m * (dim - 1), LONG)]), []
        self.largest = np.zeros(b.stride)
        for number in range(1, case.steps + 1):
            t = number * case.end / case.steps
            step = Step(self.data(x, t, memory, slip, slid))
            X, check = step.solve(X, x, random, starts)
            before, x = x, X[:b.n]
            delta, d, _, _, p, lt = step.local(X)
            bound = step.coefficients(X)["bound"][0]
            stuck = (np.sqrt(((lt + step.r[:, None] * d) ** 2).sum(1)) <= bound) & (bound > 0)
            d = np.where((stuck & (case.friction["law"] != "none"))[:, None], 0, d)
            slip = slip + d
            is_open = (case.normal["law"] != "bilateral") & ~step.coefficients(X)["closed"] & (delta < 0)
            slid = slid + np.where(is_open, 0, np.sqrt((d ** 2).sum(1)))  # an open node remembers no slip
            heat, charge = self.patch_flows(step, X, t)
            if case.leaks:
                leaked = leaked + case.k * step.c_e * laws.ramp(delta.astype(float), case.charge_ramp)[0] * (X[step.phi] - step.phi_f)
                charge = charge + memory
                memory = charge
            for field in range(b.stride):
                self.largest[field] = max(self.largest[field], float(np.max(np.abs(x[field::b.stride]))))
            steps.append(self.record(number, t, step, X, before, d, slip, slid, leaked, heat, charge, stuck))
            steps[-1]["check"] = check | self.balances(step, X, heat, charge)
        self.final = x
        return steps

    def patch_flows(self, step, X, t):
        """Heat [W] and charge [C] out of the body through each contact node's patch; of a leak the charge of this step."""
        b, case = self.body, self.case
        heat, charge = step.flows(X, step.coefficients(X))
        heat, charge = self.w * (heat - step.friction_heat(X)[0]), self.w * charge
        for exact, field, coefficient, name in ((case.exact_heat, b.THETA, case.k_c, "heat"),
                                                (case.exact_charge, b.PHI, case.c_e, "charge")):
            if exact:
                i, j, value = b.facet_mass(case.on, coefficient)
                flow = np.zeros(len(b.points), LONG)
                np.add.at(flow, i, value * X[b.stride * j + field])
                if name == "heat":
                    heat = heat + (flow - b.exact_foundation["heat"])[self.nodes]
                else:
                    charge = charge + (step.rate * flow - b.exact_foundation["charge"])[self.nodes]
        return heat, charge

    def record(self, number, t, step, X, before, d, slip, slid, leaked, heat, charge, stuck):
        b, case, dim = self.body, self.case, self.dim
        delta, _, phi, theta, p, lt = step.local(X)
        c = step.coefficients(X)
        bilateral, none = case.normal["law"] == "bilateral", case.friction["law"] == "none"
        status = ["open" if not bilateral and not closed and gap < 0 else "stick" if s and not none else "slip"
                  for closed, gap, s in zip(c["closed"], delta, stuck)]
        opened = ~c["closed"] & (not bilateral)
        p, lt = np.where(opened, 0, p), np.where(opened[:, None], 0, lt)
        tau, slips = -np.einsum("mad,md->ma", self.T, lt), np.einsum("mad,md->ma", self.T, slip)
        made = (lt * d).sum(1) / case.k  # friction power per area
        warmth, through = theta - step.theta_f, phi - step.phi_f
        heat_flux = (step.k_c * c["heat_psi"][0] + c["pressed"][0]) * warmth - case.share * made
        charge_flux = leaked if case.leaks else step.c_e * c["charge_psi"][0] * through
        xyz = "xyz"[:dim]
        columns = {a: self.places[:, i] for i, a in enumerate(xyz)}
        columns |= {"normal_traction": -p} | {f"tangential_traction_{a}": tau[:, i] for i, a in enumerate(xyz)}
        columns |= {"normal_displacement": (X[step.u] * self.nu).sum(1)} | {f"slip_{a}": slips[:, i] for i, a in enumerate(xyz)}
        columns |= {"slip_rate": np.sqrt((d ** 2).sum(1)) / case.k, "temperature": theta, "potential": phi,
                    "heat_flux": heat_flux, "gap": -delta, "charge_flux": charge_flux}
        bound = {} if none else {"friction_bound": c["bound"][0]}
        held = lambda field: [int(b.stride * i + field) in b.held for i in self.nodes]
        history = {"friction_dissipation": (self.w * made).sum(), "friction_heat_body": case.share * (self.w * made).sum(),
                   "friction_heat_foundation": (1 - case.share) * (self.w * made).sum(),
                   "heat": heat.sum(), "charge": charge.sum()}
        force = -(self.w[:, None] * (p[:, None] * self.nu - tau)).sum(0)
        history |= {f"contact_force_{a}": force[i] for i, a in enumerate(xyz)}
        plain = lambda a: [float(v) + 0.0 for v in a]
        return {"step": number, "time": t, "contact": {"status": status} | {n: plain(v) for n, v in (columns | bound).items()}
                | {"accumulated_slip": plain(slid), "temperature_held": held(b.THETA), "potential_held": held(b.PHI)},
                "history": {n: float(v) for n, v in history.items()}}

    def balances(self, step, X, heat, charge):
        """Rows of heat and charge at the free nodes with the flows as they are written: what they lack, over the terms' size."""
        b, x, values = self.body, X[:self.body.n], {}
        whole = b.storage @ x - b.tau * (b.conduction @ x)
        for name, field, out in (("heat", b.THETA, b.tau * heat), ("charge", b.PHI, charge - step.memory)):
            rows = np.arange(field, b.n, b.stride)
            free = np.array([i not in b.held for i in rows])
            given = step.b[rows] + (b.tau if name == "heat" else 1) * b.exact_foundation.get(name, 0)
            given[self.nodes] += out
            size = float(np.sum(np.abs(whole[rows])) + np.sum(np.abs(given)))
            values[name + "_imbalance"] = float(np.max(np.abs(whole[rows] - given)[free], initial=0)) / size if size else 0.0
        return values

    def interior_values(self):
        """Every field at some twenty nodes of the last step."""
        b = self.body
        picked = np.unique(np.linspace(0, len(b.points) - 1, 24).astype(int))
        names = [f"u_{a}" for a in "xyz"[:self.dim]] + ["potential", "temperature"]
        nodes = {a: b.points[picked, i].tolist() for i, a in enumerate("xyz"[:self.dim])}
        nodes |= {name: [float(v) for v in self.final[b.stride * picked + f]] for f, name in enumerate(names)}
        return nodes, dict(zip(names, self.largest.tolist()))


def tangents(normal):
    """Orthonormal columns across the normal."""
    n = normal.astype(LONG)
    if len(n) == 2:
        return np.array([[-n[1]], [n[0]]])
    a = np.zeros(3, LONG)
    a[np.argmin(np.abs(n))] = 1
    first = a - (a @ n) * n
    first /= np.sqrt(first @ first)
    return np.array([first, np.cross(n, first)]).T


def write(path, result):
    """JSON, a line for each list of numbers; numbers as short as they can be without losing a bit."""
    def text(value, indent):
        if not isinstance(value, (dict, list)) or isinstance(value, list) and not isinstance(value[0], dict):
            return json.dumps(value)
        pad = "\n" + " " * (indent + 1)
        if isinstance(value, list):
            return "[" + pad + ("," + pad).join(text(v, indent + 1) for v in value) + "]"
        return "{" + pad + ("," + pad).join(f"{json.dumps(k)}: {text(v, indent + 1)}" for k, v in value.items()) + "}"

    with open(path, "w") as file:
        file.write(text(result, 0) + "\n")


def summary(s):
    c, status = s["contact"], s["contact"]["status"]
    span = lambda name: f"{min(c[name]):.3g}..{max(c[name]):.3g}"
    return (f"step {s['step']}: open {status.count('open')} stick {status.count('stick')} slip {status.count('slip')}"
            f"  sigma_nu {span('normal_traction')} theta {span('temperature')} phi {span('potential')} q {span('heat_flux')}"
            f" D {span('charge_flux')} heat {s['history']['heat']:.4g} charge {s['history']['charge']:.4g}  {s['check']}")


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("case")
    arguments.add_argument("result", nargs="?")
    arguments.add_argument("--starts", type=int, default=0)
    arguments.add_argument("--every", type=int, default=1)
    arguments.add_argument("--lumped", action="store_true")
    a = arguments.parse_args()
    case = Case(a.case, a.lumped)
    run = Run(case)
    steps = run.march(a.starts)
    for s in steps:
        print(summary(s))
    nodes, largest = run.interior_values()
    if a.result:
        kept = [s for s in steps if s["step"] % a.every == 0 or s is steps[-1]]
        write(a.result, {"title": case.title, "friction_law": case.friction["law"], "on": case.on, "steps": kept, "nodes": nodes,
                         "largest": largest})


if __name__ == "__main__":
    main()
