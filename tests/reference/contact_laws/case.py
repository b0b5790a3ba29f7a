"""Reads the part of the case file that this program knows; anything else is an error."""
import math
import tomllib

import numpy as np

EPS0 = 8.8541878128e-12

LIBRARY = {
    "BaTiO3-Liu2014": dict(
        c11=1.66e11, c13=7.8e10, c33=1.62e11, c44=4.3e10, e15=11.6, e31=-4.4, e33=18.6, beta11=1.12e-8,
        beta33=1.26e-8, m11=2.24e6, m33=1.89e6, p3=-1e-4, k11=50.0, k33=75.0, density=5500.0,
        specific_heat=420.0, reference_temperature=293.0),
}

FUNCTIONS = {name: getattr(np, name) for name in ("sin", "cos", "tan", "exp", "sqrt", "abs", "tanh")}
FUNCTIONS |= {"pi": math.pi, "_pi": math.pi, "min": np.minimum, "max": np.maximum, "mod": np.mod,
              "if_": lambda c, a, b: np.where(c, a, b)}


class Formula:
    """A number or a text in x, y, t."""

    def __init__(self, text):
        self.text = text
        self.code = None if not isinstance(text, str) else compile(
            text.replace("^", "**").replace("if(", "if_("), text, "eval")

    def __call__(self, x, y, t):
        if self.code is None:
            return np.full_like(np.asarray(x, float), float(self.text))
        value = eval(self.code, {"__builtins__": {}}, FUNCTIONS | {"x": x, "y": y, "t": t})
        return np.broadcast_to(np.asarray(value, float), np.shape(x)).copy()


def only(table, *names):
    unknown = set(table) - set(names)
    if unknown:
        raise SystemExit(f"keys that this program does not know: {sorted(unknown)}")


def material(table):
    m = dict(LIBRARY[table["library"]]) if "library" in table else {}
    m |= {k: v for k, v in table.items() if k not in ("library", "symmetry")}
    if table.get("symmetry") == "isotropic":
        E, nu = m.pop("young"), m.pop("poisson")
        m["c11"] = m["c33"] = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        m["c13"] = E * nu / ((1 + nu) * (1 - 2 * nu))
        m["c44"] = E / (2 * (1 + nu))
        m["beta11"] = m["beta33"] = m.pop("eps11") * EPS0
        m["k33"] = m["k11"]
        for name in ("e15", "e31", "e33", "m11", "m33", "p3"):
            m[name] = 0.0
    m["p"] = m.pop("pyroelectric", None) or [0.0, m["p3"]]
    return m


class Case:
    def __init__(self, path):
        with open(path, "rb") as file:
            c = tomllib.load(file)
        only(c, "title", "mesh", "material", "time", "boundary", "contact", "output")
        only(c["mesh"], "box")
        box = c["mesh"]["box"]
        only(box, "min", "max", "cells", "cell")
        assert box["cell"] == "quadrilateral"
        self.title, self.lo, self.hi, self.cells = c["title"], box["min"], box["max"], box["cells"]
        self.material = material(c["material"])
        self.end, self.steps = c["time"]["end"], c["time"]["steps"]
        self.k = self.end / self.steps
        self.boundaries = c.get("boundary", [])
        for b in self.boundaries:
            only(b, "on", "displacement", "potential", "temperature", "traction", "surface_charge", "heat_flux")
            b["on"] = b["on"] if isinstance(b["on"], list) else [b["on"]]
        k = self.contact = c["contact"]
        only(k, "on", "gap", "foundation_displacement", "normal", "friction", "heat")
        self.side = k["on"]
        self.gap = Formula(k.get("gap", 0))
        self.foundation = [Formula(f) for f in k.get("foundation_displacement", [0, 0])]
        normal = k.get("normal", "bilateral")
        self.normal = normal if isinstance(normal, dict) else {"law": normal}
        self.friction = k.get("friction", {"law": "none"})
        heat = k.get("heat", {"law": "insulated"})
        self.exchange = None
        if heat["law"] == "exchange":
            only(heat, "law", "coefficient", "foundation_temperature")
            self.exchange = float(heat["coefficient"]), Formula(heat["foundation_temperature"])
