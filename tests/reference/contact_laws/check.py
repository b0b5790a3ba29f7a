#!/usr/bin/python3
"""check.py: what results/*.json says is checked against the laws themselves, from the numbers and the case alone,
and against closed forms and published numbers. Shares nothing with the solution but the reading of cases."""
import json
import math
import pathlib

import numpy as np

from case import Case

HERE = pathlib.Path(__file__).resolve().parent
TOLERANCE = 1e-12


def bound(friction, p, d, s, k, is_open):
    if friction["law"] == "none" or is_open:
        return 0.0
    if friction["law"] == "tresca":
        return friction["bound"]
    mu = friction["coefficient"]
    if isinstance(mu, dict):
        fade = -(d / k) / mu["speed"] if "speed" in mu else -s / mu["distance"]
        mu = mu["kinetic"] + (mu["static"] - mu["kinetic"]) * math.exp(fade)
    return min(friction.get("cohesion", 0.0) + mu * p, friction.get("limit", math.inf))


def pressure(normal, delta, before, k):
    if normal["law"] == "compliance":
        return normal["coefficient"] * max(delta, 0.0) ** normal.get("exponent", 1)
    return normal["coefficient"] / k * max(delta - max(before, 0.0), 0.0)


def check_laws(case, result):
    """Largest violation: tractions over the largest traction, lengths over the largest length."""
    k, normal = case.k, case.normal
    along, across = ("y", "x") if case.side in ("left", "right") else ("x", "y")
    sign = -1 if case.side in ("left", "bottom") else 1
    contacts = [s["contact"] for s in result["steps"]]
    force = max(abs(v) for c in contacts for v in c["normal_traction"])
    length = max(abs(v) for c in contacts for name in ("u_x", "u_y", "gap") for v in c[name])
    x, y = np.array(contacts[0]["x"]), np.array(contacts[0]["y"])
    foundation = lambda t: [f(x, y, t) for f in case.foundation]
    axis = 0 if across == "x" else 1
    f0, g = foundation(0.0), case.gap(x, y, 0.0)
    slid, before, s = -f0[1 - axis], -sign * f0[axis] - g, np.zeros(len(x))
    worst = {"law": 0.0, "geometry": 0.0}

    def wrong(name, value, size):
        worst[name] = max(worst[name], abs(float(value)) / size)

    for step, c in zip(result["steps"], contacts):
        f = foundation(step["time"])
        c = {name: np.array(v) for name, v in c.items()}
        slip, tau, p = c["slip_" + along], c["tangential_traction_" + along], -c["normal_traction"]
        delta, d = -c["gap"], c["slip_" + along] - slid
        u = [c["u_x"], c["u_y"]]
        wrong("geometry", np.max(np.abs(sign * (u[axis] - f[axis]) - g - delta)), length)
        wrong("geometry", np.max(np.abs(u[1 - axis] - f[1 - axis] - slip)), length)
        wrong("geometry", np.max(np.abs(c["slip_rate"] * k - np.abs(d))), length)
        s = s + np.abs(d)
        wrong("geometry", np.max(np.abs(c["accumulated_slip"] - s)), length)
        for i, status in enumerate(c["status"]):
            is_open = status == "open"
            if normal["law"] == "bilateral":
                wrong("geometry", delta[i], length)
            elif normal["law"] == "unilateral":
                wrong("law", max(-p[i], 0), force)
                wrong("geometry", max(delta[i], 0), length)
                wrong("law" if is_open else "geometry", p[i] if is_open else delta[i], force if is_open else length)
            else:
                stiffness = normal["coefficient"] / (k if normal["law"] == "damped" else 1)
                slack = stiffness * length * 1e-3 if normal.get("exponent", 1) == 1 else force
                wrong("law", p[i] - pressure(normal, delta[i], before[i], k), max(force, slack))
            b = bound(case.friction, p[i], abs(d[i]), s[i], k, is_open)
            wrong("law", max(abs(tau[i]) - b, 0), force)
            if status == "slip" and case.friction["law"] != "none":
                wrong("law", tau[i] + b * np.sign(d[i]), force)
            if status == "stick":
                wrong("geometry", d[i], length)
        slid, before = slip, delta
    return worst


def column(result, name):
    return [np.array(s["contact"][name]) for s in result["steps"]]


def closed_forms(results):
    """(what, largest relative error)"""
    def compliance(r):
        f, c, g = 162e9 * 0.75 / (1.25 * 0.5), 1e12, 2e-7
        return [u - (f * 1e-6 * n / 3 / 0.1 + c * g) / (f / 0.1 + c) for n, u in enumerate(column(r, "normal_displacement"), 1)], 1e-6

    def damped(r):
        return [u - 1e-6 * n / 4 for n, u in enumerate(column(r, "normal_displacement"), 1)], 1e-6

    def damped_driven(r):
        f, c, k, exact, u = 162e9 * 0.75 / (1.25 * 0.5), 1e12, 0.25, [], 0.0
        for n in range(1, 5):
            u = (f * 1e-6 * n * k / 0.1 + c / k * u) / (f / 0.1 + c / k)
            exact.append(u)
        return [u - e for u, e in zip(column(r, "normal_displacement"), exact)], 1e-6

    def capped(r):
        d = [5e-7 * n for n in range(1, 5)]
        return [s - (a - min(43e10 * a, 3e5) / 43e10) for a, s in zip(d, column(r, "slip_x"))], 2e-6

    def weakening(r):
        s = 1.155922279133010628e-6
        return [column(r, "slip_x")[0] - s, (column(r, "tangential_traction_x")[0] + 43e10 * (2e-6 - s)) / 43e10], s

    for name, formula in (("column-compliance", compliance), ("column-damped", damped),
                          ("column-damped-driven", damped_driven), ("layer-capped", capped),
                          ("layer-slip-weakening", weakening)):
        error, size = formula(results[name])
        yield name + ": closed form", max(float(np.max(np.abs(e))) for e in error) / size
    last = results["ssnv128"]["steps"][-1]["contact"]
    at = lambda place: min(range(33), key=lambda i: abs(last["x"][i] - place))
    expected = {0: 2.845943843, 1.25e-3: 2.707923641, 5e-3: 2.274025555, 7.5e-3: 1.972706693, 11.25e-3: 1.536415944}
    yield "ssnv128: u_x at five points, to the 10 digits given", max(abs(last["u_x"][at(x)] * 1e5 / v - 1) for x, v in expected.items())
    yield "ssnv128: normal force at 38.75 mm", abs(last["normal_traction"][at(0.03875)] * -0.00125 / 1.0486376788e5 - 1)
    # 32 contact nodes: the corner beside the support is not counted
    counts = [last["status"][:32].count(s) for s in ("open", "slip", "stick")]
    yield f"ssnv128: open, slip, stick {counts}", 0.0 if counts == [3, 22, 7] else math.inf


def main():
    results = {p.stem: json.loads(p.read_text()) for p in sorted((HERE / "results").glob("*.json"))}
    bad = False
    for name, result in results.items():
        worst = check_laws(Case(HERE / "cases" / f"{name}.toml"), result)
        bad |= max(worst.values()) > TOLERANCE
        print(f"{name:24} tractions {worst['law']:.1e}  lengths {worst['geometry']:.1e}")
    for what, error in closed_forms(results):
        bad |= error > 1e-9
        print(f"{what:60} {error:.1e}")
    raise SystemExit(1 if bad else 0)


if __name__ == "__main__":
    main()
