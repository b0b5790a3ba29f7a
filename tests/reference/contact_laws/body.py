"""The body: bilinear quadrilaterals, fields u_x, u_y, phi, theta at every node, one step of backward Euler.

The matrix of the step is symmetric: electric rows times -1, heat rows times -k/theta_ref (docs/theory.md, 2).
All sums are made in extended precision; systems are solved by a sparse LU and refined with residuals in
extended precision.
"""
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from case import Formula

LONG = np.longdouble
GAUSS = np.array([-1, 1]) / np.sqrt(LONG(3))
UX, UY, PHI, THETA = range(4)


def element(m, hx, hy):
    """Blocks of one cell, nodes counter-clockwise from the lower left: storage operator and conduction."""
    F = np.array([[m["c11"], m["c13"], 0], [m["c13"], m["c33"], 0], [0, 0, m["c44"]]], LONG)
    e = np.array([[0, 0, m["e15"]], [m["e31"], m["e33"], 0]], LONG)
    beta, K = np.diag(np.array([m["beta11"], m["beta33"]], LONG)), np.diag(np.array([m["k11"], m["k33"]], LONG))
    M, P = np.array([m["m11"], m["m33"], 0], LONG), np.array(m["p"], LONG)
    alpha = LONG(m["density"]) * LONG(m["specific_heat"]) / LONG(m["reference_temperature"])
    storage, conduction = np.zeros((16, 16), LONG), np.zeros((16, 16), LONG)
    xi, eta = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    u, f, th = [i for n in range(4) for i in (4 * n, 4 * n + 1)], [4 * n + 2 for n in range(4)], [4 * n + 3 for n in range(4)]
    for a in GAUSS:
        for b in GAUSS:
            N = (1 + xi * a) * (1 + eta * b) / 4
            G = np.array([xi * (1 + eta * b) / 4 * 2 / LONG(hx), eta * (1 + xi * a) / 4 * 2 / LONG(hy)])
            B = np.zeros((3, 8), LONG)
            B[0, 0::2], B[1, 1::2], B[2, 0::2], B[2, 1::2] = G[0], G[1], G[1], G[0]
            w = LONG(hx) * LONG(hy) / 4
            storage[np.ix_(u, u)] += w * B.T @ F @ B
            storage[np.ix_(u, f)] += w * B.T @ e.T @ G
            storage[np.ix_(f, u)] += w * (B.T @ e.T @ G).T
            storage[np.ix_(u, th)] -= w * np.outer(B.T @ M, N)
            storage[np.ix_(th, u)] -= w * np.outer(N, B.T @ M)
            storage[np.ix_(f, f)] -= w * G.T @ beta @ G
            storage[np.ix_(f, th)] += w * np.outer(G.T @ P, N)
            storage[np.ix_(th, f)] += w * np.outer(N, G.T @ P)
            storage[np.ix_(th, th)] -= w * alpha * np.outer(N, N)
            conduction[np.ix_(th, th)] += w * G.T @ K @ G
    return storage, conduction


class Sparse:
    """A sparse matrix in extended precision."""

    def __init__(self, row, col, value, n):
        key, inverse = np.unique(row.astype(np.int64) * n + col, return_inverse=True)
        self.value = np.zeros(len(key), LONG)
        np.add.at(self.value, inverse, value)
        self.row, self.col, self.n = key // n, key % n, n
        self.start = np.searchsorted(self.row, np.arange(n))

    def __matmul__(self, x):
        return np.add.reduceat(self.value * x[self.col], self.start)  # every row has entries

    def block(self, rows, cols):
        """The block as a sparse matrix in double precision."""
        a = sp.csr_matrix((self.value.astype(float), (self.row, self.col)), shape=(self.n, self.n))
        return a[rows][:, cols]


class Body:
    def __init__(self, case):
        self.case = case
        nx, ny = case.cells
        (x0, y0), (x1, y1) = case.lo, case.hi
        self.x = np.repeat(x0 + (x1 - x0) * np.arange(nx + 1) / nx, ny + 1)
        self.y = np.tile(y0 + (y1 - y0) * np.arange(ny + 1) / ny, nx + 1)
        node = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
        self.sides = {"left": node[0], "right": node[-1], "bottom": node[:, 0], "top": node[:, -1]}
        self.n = 4 * node.size
        h = LONG(x1 - x0) / nx, LONG(y1 - y0) / ny
        cells = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], -1).reshape(-1, 4)
        dofs = (4 * cells[:, :, None] + np.arange(4)).reshape(-1, 16)
        row, col = np.repeat(dofs, 16, 1).ravel(), np.tile(dofs, (1, 16)).ravel()
        storage, conduction = element(case.material, *h)
        self.tau = LONG(case.k) / LONG(case.material["reference_temperature"])
        each = lambda block: np.tile(block.ravel(), len(cells))
        self.storage = Sparse(row, col, each(storage), self.n)
        rows, cols, values = [row], [col], [each(storage) - self.tau * each(conduction)]
        if case.exchange:
            i, j, value = self.edge_mass(case.side)
            rows.append(4 * i + THETA), cols.append(4 * j + THETA)
            values.append(-self.tau * LONG(case.exchange[0]) * value)
        self.K = Sparse(np.concatenate(rows), np.concatenate(cols), np.concatenate(values), self.n)
        self.find_held()

    def edges(self, side):
        nodes = self.sides[side]
        length = np.hypot(np.diff(self.x[nodes]), np.diff(self.y[nodes])).astype(LONG)
        return nodes[:-1], nodes[1:], length

    def edge_mass(self, side):
        a, b, h = self.edges(side)
        return (np.concatenate([a, a, b, b]), np.concatenate([a, b, a, b]),
                np.concatenate([h / 3, h / 6, h / 6, h / 3]))

    def edge_load(self, side, formula, t):
        """Integrals of formula times the shape functions along a side, two Gauss points on each edge."""
        a, b, h = self.edges(side)
        load = np.zeros(self.n // 4, LONG)
        for g in GAUSS:
            s = float((1 + g) / 2)
            x, y = self.x[a] + s * (self.x[b] - self.x[a]), self.y[a] + s * (self.y[b] - self.y[a])
            value = formula(x, y, t) * h / 2
            np.add.at(load, a, value * (1 - g) / 2)
            np.add.at(load, b, value * (1 + g) / 2)
        return load

    def weights(self, side):
        a, b, h = self.edges(side)
        w = np.zeros(self.n // 4, LONG)
        np.add.at(w, a, h / 2)
        np.add.at(w, b, h / 2)
        return w[self.sides[side]]

    def find_held(self):
        """Prescribed unknowns; the entry that stands first holds."""
        self.held = {}
        for b in self.case.boundaries:
            for side in b["on"]:
                for i in self.sides[side]:
                    for field, value in enumerate(list(b.get("displacement", ["free", "free"]))
                                                  + [b.get("potential", "free"), b.get("temperature", "free")]):
                        if value != "free":
                            self.held.setdefault(4 * i + field, Formula(value))

    def held_values(self, t):
        return {i: f(self.x[i // 4], self.y[i // 4], t) for i, f in self.held.items()}

    def loads(self, t, old):
        """Right side of the step that ends at t, from the state old."""
        c, b = self.case, np.zeros(self.n, LONG)
        history = self.storage @ old
        b[THETA::4] += history[THETA::4]
        for entry in c.boundaries:
            for side in entry["on"]:
                for axis, value in enumerate(entry.get("traction", [])):
                    b[axis::4] += self.edge_load(side, Formula(value), t)
                if "surface_charge" in entry:
                    b[PHI::4] += self.edge_load(side, Formula(entry["surface_charge"]), t)
                if "heat_flux" in entry:
                    b[THETA::4] += self.tau * self.edge_load(side, Formula(entry["heat_flux"]), t)
        if c.exchange:
            coefficient, temperature = c.exchange
            b[THETA::4] -= self.tau * coefficient * self.edge_load(c.side, temperature, t)
        return b


class Solver:
    """Unknowns `free` of the body's matrix, all others given."""

    def __init__(self, K, free):
        self.K, self.free = K, free
        block = K.block(free, free).tocsc()
        scale = 1 / np.sqrt(np.abs(block.diagonal()))
        self.scale = scale
        self.lu = sla.splu((sp.diags(scale) @ block @ sp.diags(scale)).tocsc())

    def solve(self, x, b):
        """Changes the free entries of x so that their rows of K x = b hold."""
        for _ in range(6):
            r = (b - self.K @ x)[self.free]
            x[self.free] += self.scale * self.lu.solve((self.scale * r).astype(float))
        return x
