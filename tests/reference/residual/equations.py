"""The equations of docs/theory.md, 1 and 2, with given nodal values: what each node lacks without its boundary.

Linear cells of any plane. Constants in the stress-charge form or in that of data sheets, class 6mm or isotropic. All is
summed in extended precision.
"""
import math

import numpy as np

EPS0 = 8.8541878128e-12
VOIGT = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
LONG = np.longdouble
G = 1 / np.sqrt(LONG(3))


def value(text, places, t):
    """A number or a formula of the case file, or points over t, at places (n, dim)."""
    if isinstance(text, dict):
        at = np.array(text["points"], float)
        return np.full(len(places), np.interp(t, at[:, 0], at[:, 1]))
    code = " & ".join(f"({part})" for part in str(text).replace("^", "**").replace("if(", "if_(").split("&&"))
    names = {name: getattr(np, name) for name in ("sin", "cos", "exp", "sqrt", "abs")}
    names |= {"pi": math.pi, "min": np.minimum, "max": np.maximum, "if_": np.where, "t": t}
    names |= dict(zip("xyz", np.asarray(places, float).T))
    return np.broadcast_to(np.asarray(eval(code, {"__builtins__": {}}, names), LONG), len(places))


class Material:
    """The symmetric matrix of (strain, field, temperature) -> (stress, -D, -entropy) in crystal axes, and K."""

    def __init__(self, m, thermal, electric):
        m = dict(m)
        if m.get("symmetry") == "isotropic":
            E, nu = m.pop("young"), m.pop("poisson")
            m |= {"s11": 1 / E, "s33": 1 / E, "s12": -nu / E, "s13": -nu / E, "s44": 2 * (1 + nu) / E}
        S = lambda a: np.array([[m[a + "11"], m[a + "12"], m[a + "13"]], [m[a + "12"], m[a + "11"], m[a + "13"]],
                                [m[a + "13"], m[a + "13"], m[a + "33"]]], float)
        c = np.zeros((6, 6))
        if "c11" in m:
            c[:3, :3], c[3, 3], c[5, 5] = S("c"), m["c44"], (m["c11"] - m["c12"]) / 2
        else:
            c[:3, :3], c[3, 3], c[5, 5] = np.linalg.inv(S("s")), 1 / m["s44"], 1 / (2 * (m["s11"] - m["s12"]))
        c[4, 4] = c[3, 3]
        coupling = np.zeros((3, 6))
        for form in "ed":
            if form + "31" in m:
                coupling[2, :3] = m[form + "31"], m[form + "31"], m[form + "33"]
                coupling[0, 4] = coupling[1, 3] = m[form + "15"]
                e = coupling if form == "e" else coupling @ c
        if "e31" not in m and "d31" not in m:
            e = coupling
        d = e @ np.linalg.inv(c)
        beta = np.zeros((3, 3))
        if "beta11" in m:
            beta = np.diag([m["beta11"], m["beta11"], m["beta33"]])
        elif "eps11" in m:
            beta = EPS0 * np.diag([m["eps11"], m["eps11"], m.get("eps33", m["eps11"])])
        elif "eps11_T" in m:
            beta = EPS0 * np.diag([m["eps11_T"], m["eps11_T"], m.get("eps33_T", m["eps11_T"])]) - d @ e.T
        M, P = np.zeros(6), np.zeros(3)
        if "m11" in m:
            M[:3] = m["m11"], m["m11"], m["m33"]
        elif "a11" in m:
            M = c @ np.array([m["a11"], m["a11"], m.get("a33", m["a11"]), 0, 0, 0])
        if "p3" in m:
            P[2] = m["p3"]
        self.reference = m.get("reference_temperature", 1.0)
        alpha = m["density"] * m["specific_heat"] / self.reference if thermal else 0.0
        self.K = np.diag([m["k11"], m["k11"], m.get("k33", m["k11"])]) if thermal else np.zeros((3, 3))
        M, P = M * thermal, P * (thermal and electric)
        e, beta = e * electric, beta * electric
        self.c, self.e, self.beta, self.M, self.P, self.alpha = c, e, beta, M, P, alpha

    def turned(self, poling):
        """(c, e, beta, M, P, alpha, K) with the crystal's axis 3 along `poling`, in body axes."""
        p = np.zeros(3)
        p[:len(poling)] = poling
        p /= np.linalg.norm(p)
        one = np.cross(p, np.eye(3)[np.argmin(np.abs(p))])
        one /= np.linalg.norm(one)
        R = np.stack([one, np.cross(p, one), p], 1)
        c4 = np.zeros((3, 3, 3, 3))
        e3 = np.zeros((3, 3, 3))
        M2 = np.zeros((3, 3))
        for I, (i, j) in enumerate(VOIGT):
            M2[i, j] = M2[j, i] = self.M[I]
            for a, b in {(i, j), (j, i)}:
                e3[:, a, b] = self.e[:, I]
                for J, (k, l) in enumerate(VOIGT):
                    c4[a, b, k, l] = c4[a, b, l, k] = self.c[I, J]
        c4 = np.einsum("ia,jb,kc,ld,abcd->ijkl", R, R, R, R, c4)
        e3 = np.einsum("ia,jb,kc,abc->ijk", R, R, R, e3)
        M2 = R @ M2 @ R.T
        c = np.array([[c4[i, j, k, l] for k, l in VOIGT] for i, j in VOIGT])
        e = np.array([[e3[a, i, j] for i, j in VOIGT] for a in range(3)])
        M = np.array([M2[i, j] for i, j in VOIGT])
        return c, e, R @ self.beta @ R.T, M, R @ self.P, self.alpha, R @ self.K @ R.T


def sheet(c, e, beta, M, P, alpha):
    """The constants that are left in plane stress: no stress zz, yz, xz, whose strains are eliminated; no field across."""
    A = np.zeros((10, 10))
    A[:6, :6], A[:6, 6:9], A[:6, 9] = c, -e.T, -M
    A[6:9, :6], A[6:9, 6:9], A[6:9, 9] = -e, -beta, -P
    A[9, :6], A[9, 6:9], A[9, 9] = -M, -P, -alpha
    out, rest = [2, 3, 4], [0, 1, 5, 6, 7, 8, 9]
    B = np.zeros((10, 10))
    B[np.ix_(rest, rest)] = A[np.ix_(rest, rest)] - A[np.ix_(rest, out)] @ np.linalg.solve(A[np.ix_(out, out)], A[np.ix_(out, rest)])
    return B[:6, :6], -B[6:9, :6], -B[6:9, 6:9], -B[:6, 9], -B[6:9, 9], -B[9, 9]


def tensor(corners):
    """[(shape functions, their derivatives, weight)] of a line, quadrilateral or hexahedron, corners in [-1, 1]^d."""
    corners = np.array(corners, LONG)
    d = corners.shape[1]

    def shape(p):
        f = (1 + corners * p) / 2
        return np.prod(f, 1), np.array([np.prod(np.delete(f, m, 1), 1) * corners[:, m] / 2 for m in range(d)])

    points = np.array(np.meshgrid(*[[-G, G]] * d, indexing="ij")).reshape(d, -1).T
    return [(*shape(p), LONG(1)) for p in points], shape


def simplex(dim, rule):
    """The same of a simplex: rule [(barycentric coordinates, weight)], weights add up to 1."""
    gradient = np.concatenate([-np.ones((dim, 1), LONG), np.eye(dim, dtype=LONG)], 1)
    size = LONG(1) / math.factorial(dim)
    return [(np.array(b, LONG), gradient, LONG(w) * size) for b, w in rule], lambda p: (np.array([1 - sum(p), *p], LONG), gradient)


def orbit(dim, a, w):
    """All permutations of (a, ..., a, 1 - dim a)."""
    return [([1 - dim * a if i == k else a for i in range(dim + 1)], w) for k in range(dim + 1)]


SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
# Degree 4 on triangles (Dunavant), degree 3 on tetrahedra (Keast): only a body of revolution can tell rules apart.
TRIANGLE = orbit(2, LONG("0.091576213509770743459571463402202"), LONG("0.10995174365532186763832632490021")) + \
    orbit(2, LONG("0.44594849091596488631832925388305"), LONG("0.22338158967801146569500700843312"))
TETRAHEDRON = orbit(3, LONG("0.32805469671142664733580581998119"), LONG("0.13852796651186214232361769837564")) + \
    orbit(3, LONG("0.10695227393293068277170204157061"), LONG("0.11147203348813785767638230162436"))
RULES = {
    "line": tensor([(-1,), (1,)]), "triangle": simplex(2, TRIANGLE), "quadrilateral": tensor(SQUARE),
    "tetrahedron": simplex(3, TETRAHEDRON),
    "hexahedron": tensor([c + (-1,) for c in SQUARE] + [c + (1,) for c in SQUARE]),
}
FACET = {"triangle": "line", "quadrilateral": "line", "tetrahedron": "triangle", "hexahedron": "quadrilateral"}


class Body:
    """Cells of one kind; region and material by cell. Of a state it knows what each node lacks (`lack`) and energies."""

    def __init__(self, points, kind, cells, plane, constants, index):
        """constants: [(c, e, beta, M, P, alpha, K, reference temperature)], index: which of them, by cell."""
        self.points, self.kind, self.cells, self.plane, self.index = points, kind, cells, plane, index
        self.dim, self.n = points.shape[1], len(points)
        self.constants = []
        for *c, K, reference in constants:
            self.constants.append([np.array(v, LONG) for v in (sheet(*c) if plane == "stress" else c)] + [np.array(K, LONG), LONG(reference)])
        self.gauss = []
        X = points[cells].astype(LONG)
        for N, dN, w in RULES[kind][0]:
            J = np.einsum("ma,cad->cmd", dN, X)  # dx_d/dxi_m
            det, inverse = self.determinant(J)
            grad = np.einsum("cdm,ma->cad", inverse, dN)
            weight = w * np.abs(det)
            r = np.einsum("a,ca->c", N, X[:, :, 0])
            if plane == "axisymmetric":
                weight = weight * 2 * LONG(np.pi) * r
            self.gauss.append((N, grad, weight, r))

    @staticmethod
    def determinant(J):
        if J.shape[1] == 2:
            det = J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
            adj = np.stack([np.stack([J[:, 1, 1], -J[:, 0, 1]], -1), np.stack([-J[:, 1, 0], J[:, 0, 0]], -1)], 1)
        else:
            a, b, c = J[:, 0], J[:, 1], J[:, 2]
            adj = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], -1)
            det = (a * np.cross(b, c)).sum(1)
        return det, adj / det[:, None, None]

    def strain(self, u, N, grad, r):
        g = np.einsum("cad,cak->ckd", grad, u[self.cells])
        eps = np.zeros((len(self.cells), 6), LONG)
        for I, (i, j) in enumerate(VOIGT):
            if max(i, j) < self.dim:
                eps[:, I] = g[:, i, j] + (g[:, j, i] if i != j else 0)
        if self.plane == "axisymmetric":
            eps[:, 2] = np.einsum("a,ca->c", N, u[self.cells][:, :, 0]) / r
        return eps

    def field(self, phi, grad):
        E = np.zeros((len(self.cells), 3), LONG)
        E[:, :self.dim] = -np.einsum("cad,ca->cd", grad, phi[self.cells])
        return E

    def states(self, state):
        """At each Gauss point: strain, field, temperature, by cell."""
        u, phi, theta = state
        for N, grad, weight, r in self.gauss:
            yield N, grad, weight, r, self.strain(u, N, grad, r), self.field(phi, grad), np.einsum("a,ca->c", N, theta[self.cells])

    def by_cell(self, which):
        return np.stack([c[which] for c in self.constants])[self.index]

    def lack(self, state, before, k, load, static):
        """Nodal forces, charges D.nu and heats q.nu that must come in through the boundary, and the sizes of their
        terms. load(name, places): force, charge, heat in the volume at the end of the step."""
        c, e, beta, M, P, alpha, K, reference = map(self.by_cell, range(8))
        f, q, h = np.zeros((self.n, self.dim), LONG), np.zeros(self.n, LONG), np.zeros(self.n, LONG)
        sizes = [np.zeros((self.n, self.dim), LONG), np.zeros(self.n, LONG), np.zeros(self.n, LONG)]

        def add(target, number, values):
            np.add.at(target, self.cells, values)
            np.add.at(sizes[number], self.cells, np.abs(values))

        X = self.points[self.cells].astype(LONG)
        for (N, grad, w, r, eps, E, theta), (*_, eps0, E0, theta0) in zip(self.states(state), self.states(before)):
            sigma = np.einsum("cij,cj->ci", c, eps) - np.einsum("cij,ci->cj", e, E) - M * theta[:, None]
            D = np.einsum("cij,cj->ci", e, eps) + np.einsum("cij,cj->ci", beta, E) + P * theta[:, None]
            T = np.zeros((len(w), 3, 3), LONG)
            for I, (i, j) in enumerate(VOIGT):
                T[:, i, j] = T[:, j, i] = sigma[:, I]
            d = self.dim
            places = np.einsum("a,cad->cd", N, X)
            values = np.einsum("cad,ckd->cak", grad, T[:, :d, :d]) * w[:, None, None]
            add(f, 0, values)
            if self.plane == "axisymmetric":
                hoop = np.zeros_like(values)
                hoop[:, :, 0] = np.outer(sigma[:, 2] / r * w, N)
                add(f, 0, hoop)
            for a in range(d):
                f0 = np.zeros_like(values)
                f0[:, :, a] = -np.outer(load("force", places)[a] * w, N)
                add(f, 0, f0)
            add(q, 1, np.einsum("cad,cd->ca", grad, D[:, :d]) * w[:, None])
            add(q, 1, np.outer(load("charge", places) * w, N))
            theta_grad = np.einsum("cad,ca->cd", grad, state[2][self.cells])
            add(h, 2, -np.einsum("cad,cde,ce->ca", grad, K[:, :d, :d], theta_grad) * w[:, None])
            add(h, 2, np.outer(load("heat", places) * w, N))
            if not static:
                change = alpha * (theta - theta0) + np.einsum("ci,ci->c", M, eps - eps0) + np.einsum("ci,ci->c", P, E - E0)
                add(h, 2, -np.outer(reference / k * change * w, N))
        return (f, q, h), sizes

    def region(self, state, chosen):
        """Volume, energies and means of the cells `chosen` (a mask)."""
        c, e, beta, M, P, alpha = (self.by_cell(i) for i in range(6))
        out = dict.fromkeys(("volume", "elastic_energy", "electric_energy", "thermal_energy", "coupling_energy"), LONG(0))
        means = np.zeros(self.dim + 2, LONG)
        u, phi, theta_nodes = state
        for N, grad, w, r, eps, E, theta in self.states(state):
            w = np.where(chosen, w, 0)
            out["volume"] += w.sum()
            out["elastic_energy"] += (w * np.einsum("ci,cij,cj->c", eps, c, eps)).sum() / 2
            out["electric_energy"] += (w * np.einsum("ci,cij,cj->c", E, beta, E)).sum() / 2
            out["thermal_energy"] += (w * alpha * theta ** 2).sum() / 2
            out["coupling_energy"] += (w * np.einsum("ci,ci->c", P, E) * theta).sum()
            for a in range(self.dim):
                means[a] += (w * (N @ u[self.cells][:, :, a].T)).sum()
            means[self.dim] += (w * (N @ phi[self.cells].T)).sum()
            means[self.dim + 1] += (w * theta).sum()
        nodes = np.unique(self.cells[chosen])
        for a, name in enumerate(["u_x", "u_y", "u_z"][:self.dim] + ["potential", "temperature"]):
            all_values = u[:, a] if a < self.dim else (phi if a == self.dim else theta_nodes)
            out["mean_" + name] = means[a] / out["volume"]
            out["min_" + name], out["max_" + name] = all_values[nodes].min(), all_values[nodes].max()
        return out

    def facets(self, facets):
        """At each Gauss point of these facets: shape functions, weights, places, outward normals."""
        facets = np.asarray(facets)
        X = self.points[facets].astype(LONG)
        for N, dN, w in RULES[FACET[self.kind]][0]:
            J = np.einsum("ma,fad->fmd", dN, X)
            normal = np.stack([J[:, 0, 1], -J[:, 0, 0]], -1) if self.dim == 2 else np.cross(J[:, 0], J[:, 1])
            size = np.sqrt((normal ** 2).sum(1))
            places = np.einsum("a,fad->fd", N, X)
            weight = w * size
            if self.plane == "axisymmetric":
                weight = weight * 2 * LONG(np.pi) * places[:, 0]
            yield N, weight, places, normal / size[:, None] * self.sides(facets)[:, None]

    def sides(self, facets):
        """1 where the facet's normal points out of the body, -1 where in."""
        if not hasattr(self, "cells_of"):
            self.cells_of = {}
            for number, cell in enumerate(self.cells):
                for node in cell:
                    self.cells_of.setdefault(int(node), set()).add(number)
        out = np.ones(len(facets))
        for i, facet in enumerate(facets):
            cell = next(iter(set.intersection(*(self.cells_of[int(n)] for n in facet))))
            X = self.points[facet]
            normal = np.array([X[1, 1] - X[0, 1], X[0, 0] - X[1, 0]]) if self.dim == 2 else np.cross(X[1] - X[0], X[2] - X[0])
            inward = self.points[self.cells[cell]].mean(0) - X.mean(0)
            if self.kind in ("hexahedron",):  # the tangents of the rule run along the first and the last corner
                normal = np.cross(X[1] - X[0], X[3] - X[0])
            out[i] = -1 if normal @ inward > 0 else 1
        return out

    def at(self, place, nodal):
        """Nodal values (n, m) interpolated in the cell around the place."""
        X = self.points[self.cells]
        near = np.flatnonzero(((X.min(1) <= place + 1e-12) & (X.max(1) >= place - 1e-12)).all(1))
        best = None
        for cell in near:
            xi = np.zeros(self.dim, LONG)
            if self.kind in ("triangle", "tetrahedron"):
                xi += LONG(1) / (self.dim + 1)
            for _ in range(30):
                N, dN = RULES[self.kind][1](xi)
                miss = place - N @ X[cell]
                xi = xi + np.linalg.solve((dN @ X[cell]).T.astype(float), miss.astype(float))
            N, _ = RULES[self.kind][1](xi)
            if best is None or N.min() > best[0]:
                best = N.min(), N @ nodal[self.cells[cell]]
        return best[1]
