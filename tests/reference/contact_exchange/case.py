"""Reads the part of the case file that this program knows; anything else is an error."""
import math
import pathlib
import tomllib

import numpy as np

EPS0 = 8.8541878128e-12

# Crystal axes, class 6mm; `tourmaline materials BaTiO3-Liu2014` prints them with their source.
LIBRARY = {
    "BaTiO3-Liu2014": dict(
        c11=1.66e11, c12=7.7e10, c13=7.8e10, c33=1.62e11, c44=4.3e10, e15=11.6, e31=-4.4, e33=18.6, beta11=1.12e-8,
        beta33=1.26e-8, m11=2.24e6, m33=1.89e6, p3=-1e-4, k11=50.0, k33=75.0, density=5500.0,
        specific_heat=420.0, reference_temperature=293.0),
}
CONSTANTS = set(LIBRARY["BaTiO3-Liu2014"]) | {"young", "poisson", "eps11", "thermal_stress", "pyroelectric", "poling"}

FUNCTIONS = {name: getattr(np, name) for name in ("sin", "cos", "tan", "exp", "sqrt", "abs", "tanh")}
FUNCTIONS |= {"pi": math.pi, "_pi": math.pi, "min": np.minimum, "max": np.maximum, "if_": lambda c, a, b: np.where(c, a, b)}


class Formula:
    """A number or a text in x, y, z, t; places is an array (n, dim)."""

    def __init__(self, text):
        self.text = text
        self.code = compile(str(text).replace("^", "**").replace("if(", "if_("), str(text), "eval")

    def __call__(self, places, t):
        names = dict(zip("xyz", np.asarray(places, float).T)) | {"t": t}
        value = eval(self.code, {"__builtins__": {}}, FUNCTIONS | names)
        return np.broadcast_to(np.asarray(value, float), len(places)).copy()


def only(table, *names):
    unknown = set(table) - set(names)
    if unknown:
        raise SystemExit(f"keys that this program does not know: {sorted(unknown)}")


class Material:
    """Tensors in body axes: F (6x6), E (3x6), beta, K (3x3), M (6), P (3); Voigt order 11 22 33 23 13 12."""

    def __init__(self, table, dim):
        only(table, "library", "symmetry", *CONSTANTS)
        m = dict(LIBRARY[table["library"]]) if "library" in table else {}
        m |= {k: v for k, v in table.items() if k not in ("library", "symmetry")}
        if table.get("symmetry") == "isotropic":
            E, nu = m.pop("young"), m.pop("poisson")
            m["c11"] = m["c33"] = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
            m["c12"] = m["c13"] = E * nu / ((1 + nu) * (1 - 2 * nu))
            m["c44"] = E / (2 * (1 + nu))
            m["beta11"] = m["beta33"] = m.pop("eps11") * EPS0
            m["k33"] = m["k11"]
            for name in ("e15", "e31", "e33", "m11", "m33", "p3"):
                m.setdefault(name, 0.0)
        self.capacity = m["density"] * m["specific_heat"] / m["reference_temperature"]  # alpha
        self.reference_temperature = m["reference_temperature"]
        F, E = np.zeros((6, 6)), np.zeros((3, 6))
        F[:3, :3] = [[m["c11"], m["c12"], m["c13"]], [m["c12"], m["c11"], m["c13"]], [m["c13"], m["c13"], m["c33"]]]
        F[3, 3] = F[4, 4] = m["c44"]
        F[5, 5] = (m["c11"] - m["c12"]) / 2
        E[0, 4] = E[1, 3] = m["e15"]
        E[2, :3] = m["e31"], m["e31"], m["e33"]
        M = np.array(m["thermal_stress"] if "thermal_stress" in m else [m["m11"], m["m11"], m["m33"], 0, 0, 0], float)
        P = list(m.get("pyroelectric", [0, 0, m["p3"]]))
        P = np.array(P if len(P) == 3 else [P[0], 0, P[1]], float)
        beta, K = np.diag([m["beta11"], m["beta11"], m["beta33"]]), np.diag([m["k11"], m["k11"], m["k33"]])
        self.rotate(axes(m.get("poling"), dim), F, E, M, P, beta, K)

    def rotate(self, Q, F, E, M, P, beta, K):
        """Columns of Q: the crystal's axes in body axes."""
        pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
        index = np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])
        voigt = lambda full: np.array([full[..., i, j] for i, j in pairs])
        F4 = np.einsum("ia,jb,kc,ld,abcd->ijkl", Q, Q, Q, Q, F[index][..., index])
        E3 = np.einsum("ia,jb,kc,abc->ijk", Q, Q, Q, E[:, index])
        self.F = np.array([[F4[i, j, k, l] for k, l in pairs] for i, j in pairs])
        self.E = voigt(E3).T
        self.M = voigt(Q @ M[index] @ Q.T)
        self.P, self.beta, self.K = Q @ P, Q @ beta @ Q.T, Q @ K @ Q.T


def axes(poling, dim):
    """2D, nothing said: x is crystal axis 1, y is 3, z is against 2. The class is isotropic about axis 3."""
    if poling is None:
        return np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], float) if dim == 2 else np.eye(3)
    third = np.array(list(map(float, poling)) + [0] * (3 - len(poling)))
    third /= np.linalg.norm(third)
    if abs(third[0]) == 1 and dim == 3:
        first = np.array([0.0, 1, 0])
    else:
        first = np.cross(third, [0, 0, 1]) if dim == 2 else np.array([1.0, 0, 0]) - third[0] * third
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(third, first), third]).T


def listed(value):
    return value if isinstance(value, list) else [value]


class Case:
    def __init__(self, path, lumped=False):
        path = pathlib.Path(path)
        with open(path, "rb") as file:
            c = tomllib.load(file)
        only(c, "title", "mesh", "material", "time", "boundary", "contact", "initial", "load", "output", "solver")
        only(c["mesh"], "box", "file")
        self.title, self.box = c["title"], c["mesh"].get("box")
        self.file = path.parent / c["mesh"]["file"] if "file" in c["mesh"] else None
        if self.box:
            only(self.box, "min", "max", "cells", "cell")
        self.material_table = c["material"]
        self.end, self.steps = float(c["time"]["end"]), c["time"]["steps"]
        self.k = self.end / self.steps
        self.boundaries = c.get("boundary", [])
        for b in self.boundaries:
            only(b, "on", "displacement", "potential", "temperature", "traction", "surface_charge", "heat_flux")
            b["on"] = listed(b["on"])
        only(c.get("initial", {}), "temperature")
        self.initial_temperature = Formula(c.get("initial", {}).get("temperature", 0))
        only(c.get("load", {}), "heat")
        self.heat = Formula(c.get("load", {}).get("heat", 0))
        self.read_contact(c["contact"], lumped)

    def read_contact(self, k, lumped):
        only(k, "on", "gap", "foundation_displacement", "normal", "friction", "heat", "electric")
        self.on = listed(k["on"])
        self.gap = Formula(k.get("gap", 0))
        self.foundation = [Formula(f) for f in k["foundation_displacement"]] if "foundation_displacement" in k else None
        table = lambda name, default: k.get(name, default) if isinstance(k.get(name, default), dict) else {"law": k.get(name, default)}
        self.normal, self.friction = table("normal", "bilateral"), table("friction", "none")
        self.heat_law, self.electric = table("heat", "insulated"), table("electric", "insulated")
        only(self.heat_law, "law", "coefficient", "foundation_temperature", "pressure", "ramp", "friction_share")
        only(self.electric, "law", "coefficient", "foundation_potential", "ramp")
        only(self.heat_law.get("pressure", {}), "coefficient", "reference", "exponent")
        exchanges, conducts = self.heat_law["law"] == "exchange", self.electric["law"] in ("exchange", "leak")
        number = lambda t, key, present: Formula(t.get(key, 0) if present else 0)
        self.k_c = number(self.heat_law, "coefficient", exchanges)
        self.theta_f = number(self.heat_law, "foundation_temperature", exchanges)
        self.heat_ramp = self.heat_law.get("ramp")
        self.pressure = self.heat_law.get("pressure")
        self.share = float(self.heat_law.get("friction_share", 0))
        self.c_e = number(self.electric, "coefficient", conducts)
        self.phi_f = number(self.electric, "foundation_potential", conducts)
        self.charge_ramp = self.electric.get("ramp")
        self.leaks = self.electric["law"] == "leak"
        # What depends on the contact's state is lumped; what is linear with a constant coefficient is integrated exactly.
        # `lumped`: the other reading, in which a pressure term, or charge, lumps the constant part too.
        self.lump_heat = exchanges and (self.heat_ramp is not None or lumped and self.pressure is not None)
        self.lump_charge = conducts and (self.charge_ramp is not None or lumped)
        self.exact_heat = exchanges and not self.lump_heat
        self.exact_charge = conducts and not self.lump_charge
