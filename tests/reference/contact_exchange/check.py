#!/usr/bin/python3
"""check.py: what results/*.json says is checked against the laws themselves, from the columns and the case alone, and
against closed forms. Shares nothing with the solution but the reading of cases."""
import json
import math
import pathlib

import numpy as np

import closed_forms as exact
from case import Case

HERE = pathlib.Path(__file__).resolve().parent
TOLERANCE = 1e-12


def size(*arrays):
    return max(1e-300, *(float(np.max(np.abs(a), initial=0)) for a in arrays))


def vectors(c, name):
    return np.array([c[f"{name}_{a}"] for a in "xyz" if f"{name}_{a}" in c]).T


def bound(friction, p, d, s, k, closed):
    if friction["law"] == "none":
        return 0 * p
    if friction["law"] == "tresca":
        return np.where(closed, friction["bound"], 0)
    mu = friction["coefficient"]
    if isinstance(mu, dict):
        fade = -(d / k) / mu["speed"] if "speed" in mu else -s / mu["distance"]
        mu = mu["kinetic"] + (mu["static"] - mu["kinetic"]) * np.exp(fade)
    return np.where(closed, np.clip(friction.get("cohesion", 0) + mu * p, 0, friction.get("limit", np.inf)), 0)


def check_laws(case, result):
    """Largest violation of each kind, over the largest value of the kind in the step."""
    k, worst = case.k, {}
    leaked, stepped = 0.0, 0

    def wrong(name, value, scale):
        worst[name] = max(worst.get(name, 0.0), float(np.max(np.abs(value), initial=0)) / scale)

    for step in result["steps"]:
        c, t = {name: np.array(v) for name, v in step["contact"].items()}, step["time"]
        places = np.array([c[a] for a in "xyz" if a in c]).T
        p, delta, d = -c["normal_traction"], -c["gap"], c["slip_rate"] * k
        tau, slip = vectors(c, "tangential_traction"), vectors(c, "slip")
        carried, closed = np.sqrt((tau ** 2).sum(1)), c["status"] != "open"
        if case.normal["law"] == "unilateral":
            wrong("contact", np.minimum(p, 0), size(p))
            wrong("contact", p * ~closed, size(p))
            wrong("gap", np.maximum(delta, 0), size(slip, c["normal_displacement"]))
            wrong("gap", delta * closed, size(slip, c["normal_displacement"]))
        elif case.normal["law"] == "bilateral":
            wrong("gap", delta, size(slip, c["normal_displacement"], np.array(1e-9)))
        else:
            wrong("contact", p - case.normal["coefficient"] * np.maximum(delta, 0) ** case.normal.get("exponent", 1), size(p))
        limit = bound(case.friction, p, d, c["accumulated_slip"], k, closed)
        wrong("friction", np.maximum(carried - limit, 0), size(p))
        wrong("friction", (carried - limit) * (c["status"] == "slip"), size(p))
        wrong("friction", d * (c["status"] == "stick"), size(d))
        warmth = c["temperature"] - case.theta_f(places, t)
        psi = np.clip(1 + delta / case.heat_ramp, 0, 1) if case.heat_ramp else 1
        pressed = 0 * p
        if case.pressure:
            pressed = case.pressure["coefficient"] * (np.maximum(p, 0) / case.pressure["reference"]) ** case.pressure["exponent"]
        terms = (case.k_c(places, 0) * psi * warmth, pressed * warmth, -case.share * carried * d / k)
        wrong("heat flux", c["heat_flux"] - sum(terms), size(*terms))
        psi = np.clip(1 + delta / case.charge_ramp, 0, 1) if case.charge_ramp else 1
        through = case.c_e(places, 0) * psi * (c["potential"] - case.phi_f(places, t))
        if case.leaks:
            assert step["step"] == stepped + 1
            leaked, stepped = leaked + k * through, step["step"]
            through = leaked
        wrong("charge flux", c["charge_flux"] - through, size(through))
        h, check = step["history"], step["check"]
        wrong("split of heat", h["friction_dissipation"] - h["friction_heat_body"] - h["friction_heat_foundation"], max(h["friction_dissipation"], 1e-300))
        wrong("rows", np.array([check["residual"], check["heat_imbalance"], check["charge_imbalance"] * (h["charge"] != 0)]), 1)
    return worst


def column(result, name):
    return [s["contact"][name][0] for s in result["steps"]]


def closed(results):
    """(what, computed, exact, tolerance)"""
    m, capacity = exact.BATIO3, 5500 * 420.0
    for name, k_c, theta_f, share in (("friction-heat-layer", 0, 0, 0.5), ("friction-heat-layer-exchange", 5e3, 2, 0.3)):
        flux = exact.layer_flux(share, 0.3, 1e8, 1e-4, 5e10, 0.01, 1000, 5)
        every = exact.layer_steps(flux, 50, capacity, 0.01, 8, 1000, k_c, theta_f)
        yield f"{name}: every step", column(results[name], "temperature"), every, 1e-12
        yield f"{name}: steady", column(results[name], "temperature")[-1:], [exact.layer_steady(share, 0.3, 1e8, 1e-4, 50, 0.01, k_c, theta_f)], 1e-12
    flux = exact.layer_flux(0.5, 0.3, 1e6, 1e-2, 5e10, 0.06, 0.05, 20)
    theta = column(results["friction-heat-half-space"], "temperature")
    yield "friction-heat-half-space: same cells", theta, exact.layer_steps(flux, 50, capacity, 0.06, 600, 0.05)[3::4], 1e-11
    yield "friction-heat-half-space: no cells", theta, exact.half_space_steps(flux, 50, capacity, 0.05)[3::4], 1e-3
    yield "friction-heat-half-space: no steps, at the end", theta[-1:], [exact.half_space(flux[-1], 50, capacity, 1)], 1e-2
    yield "charge-column-capacitor", column(results["charge-column-capacitor"], "potential"), [464.169137244], 1e-11
    times = [0.5, 1, 1.5, 2]
    yield ("charge-column-warmed", column(results["charge-column-warmed"], "potential"),
           [exact.column_potential(m, -1e6 * t, 0.1, 1e-6, 100 * t, 0.05 * t) for t in times], 1e-12)
    yield "charge-column-leak", column(results["charge-column-leak"], "potential"), exact.column_leak(m, -1e6, 0.1, 5e-7, 0.125, 8), 1e-12
    rod = exact.Rod()
    cold, warm, hot = rod.steady()
    yield "barber-cold: steady state", column(results["barber-cold"], "temperature")[-1:], [cold], 1e-12
    yield "barber-hot: steady state", column(results["barber-hot"], "temperature")[-1:], [hot], 1e-12
    yield "barber-leaves-up: steady state", column(results["barber-leaves-up"], "temperature")[-1:], [hot], 1e-9
    yield "barber-leaves-down: steady state", column(results["barber-leaves-down"], "temperature")[-1:], [cold], 1e-9
    away = [T - warm for T in column(results["barber-warm"], "temperature")]
    rate = [(1 - (a / b) ** 0.1) / 1.0 for a, b in zip(away[4:], away[5:])]  # (g - 1)/(g k), g the growth of a step; k = 1 s
    yield "barber-warm: growth over 10 steps, from step 50 on", rate, [rod.growth(warm)] * len(rate), 0.01


def main():
    results = {p.stem: json.loads(p.read_text()) for p in sorted((HERE / "results").glob("*.json"))}
    bad = False
    for name, result in results.items():
        lumped = name.endswith(".lumped")
        worst = check_laws(Case(HERE / "cases" / f"{name.removesuffix('.lumped')}.toml", lumped), result)
        bad |= max(worst.values()) > TOLERANCE
        print(f"{name:34}" + "  ".join(f"{kind} {value:.0e}" for kind, value in worst.items() if value))
    for what, computed, expected, tolerance in closed(results):
        error = max(abs(a - b) for a, b in zip(computed, expected, strict=True)) / max(map(abs, expected))
        bad |= not error <= tolerance
        print(f"{what:60} {error:.1e}  of {expected[-1]:.12g}")
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
