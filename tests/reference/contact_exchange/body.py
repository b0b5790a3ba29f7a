"""The body: fields u, phi, theta at every node, linear cells, one step of backward Euler (docs/theory.md, 1 and 2).

The matrix of a step is symmetric: electric rows times -1, heat rows times -k/theta_ref. All sums are made in
extended precision.
"""
import numpy as np
import scipy.sparse as sp

from case import Formula, Material

LONG = np.longdouble
G = 1 / np.sqrt(LONG(3))
PAIRS = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]


def tensor(corners):
    """Shape functions of a line, quadrilateral or hexahedron with these corners in [-1, 1]^d, and its Gauss rule."""
    corners = np.array(corners, LONG)
    d = corners.shape[1]
    points = np.array(np.meshgrid(*[[-G, G]] * d, indexing="ij")).reshape(d, -1).T

    def shape(p):
        f = (1 + corners * p) / 2
        gradient = np.array([np.prod(np.delete(f, m, 1), 1) * corners[:, m] / 2 for m in range(d)])
        return np.prod(f, 1), gradient

    return [(shape(p), LONG(1)) for p in points]


SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
TRIANGLE = [((np.array([1 - a - b, a, b], LONG), np.array([[-1, 1, 0], [-1, 0, 1]], LONG)), LONG(1) / 6)
            for a, b in np.array([[1, 1], [4, 1], [1, 4]], LONG) / 6]
RULES = {
    "line": tensor([(-1,), (1,)]), "triangle": TRIANGLE, "quadrilateral": tensor(SQUARE),
    "hexahedron": tensor([c + (-1,) for c in SQUARE] + [c + (1,) for c in SQUARE]),
}


def box_mesh(box):
    """Points, kind, cells, and the facets of each side."""
    lo, hi, count, kind = box["min"], box["max"], box["cells"], box["cell"]
    dim = len(lo)
    axes = [lo[a] + (hi[a] - lo[a]) * np.arange(count[a] + 1) / count[a] for a in range(dim)]
    points = np.array(np.meshgrid(*axes, indexing="ij")).reshape(dim, -1).T
    node = np.arange(len(points)).reshape([c + 1 for c in count])
    if dim == 2:
        cells = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], -1).reshape(-1, 4)
        if kind == "triangle":  # diagonal from lower right to upper left
            cells = np.concatenate([cells[:, [0, 1, 3]], cells[:, [1, 2, 3]]])
        edge = lambda a: np.stack([a[:-1], a[1:]], -1)
        sides = {"left": edge(node[0]), "right": edge(node[-1]), "bottom": edge(node[:, 0]), "top": edge(node[:, -1])}
    else:
        quad = lambda a: np.stack([a[:-1, :-1], a[1:, :-1], a[1:, 1:], a[:-1, 1:]], -1).reshape(-1, 4)
        low, high = node[:, :, :-1], node[:, :, 1:]
        stack = lambda n: np.stack([n[:-1, :-1], n[1:, :-1], n[1:, 1:], n[:-1, 1:]], -1)
        cells = np.concatenate([stack(low), stack(high)], -1).reshape(-1, 8)
        sides = {"left": quad(node[0]), "right": quad(node[-1]), "front": quad(node[:, 0]), "back": quad(node[:, -1]),
                 "bottom": quad(node[:, :, 0]), "top": quad(node[:, :, -1])}
    return points, kind, cells, sides


def file_mesh(path):
    """Gmsh's text format 2.2 with the cells and facets of one kind."""
    text = path.read_text().split("\n")
    section = lambda name: text[text.index("$" + name) + 2:text.index("$End" + name)]
    names = {int(n): name.strip('"') for _, n, name in (line.split() for line in section("PhysicalNames"))}
    points = np.array([list(map(float, line.split()[1:])) for line in section("Nodes")])
    elements = [list(map(int, line.split())) for line in section("Elements")]
    kinds = {1: "line", 2: "triangle", 3: "quadrilateral", 5: "hexahedron"}
    solid = any(e[1] == 5 for e in elements)
    cells, sides = [], {}
    for e in elements:
        nodes = [n - 1 for n in e[3 + e[2]:]]
        if (kinds[e[1]] == "hexahedron") if solid else (e[1] in (2, 3)):
            cells.append(nodes)
            kind = kinds[e[1]]
        else:
            sides.setdefault(names[e[3]], []).append(nodes)
    return points[:, :3 if solid else 2], kind, np.array(cells), {n: np.array(s) for n, s in sides.items()}


class Sparse:
    """A sparse matrix in extended precision."""

    def __init__(self, row, col, value, n):
        key, inverse = np.unique(row.astype(np.int64) * n + col, return_inverse=True)
        self.value = np.zeros(len(key), LONG)
        np.add.at(self.value, inverse, value)
        self.row, self.col, self.n = key // n, key % n, n

    def __matmul__(self, x):
        y = np.zeros(self.n, LONG)
        np.add.at(y, self.row, self.value * x[self.col])
        return y

    def double(self):
        return sp.csr_matrix((self.value.astype(float), (self.row, self.col)), shape=(self.n, self.n))


class Body:
    def __init__(self, case):
        self.case = case
        self.points, self.kind, self.cells, self.sides = box_mesh(case.box) if case.box else file_mesh(case.file)
        self.dim = self.points.shape[1]
        self.facet = "line" if self.dim == 2 else "quadrilateral"
        self.stride = self.dim + 2
        self.PHI, self.THETA = self.dim, self.dim + 1
        self.n = self.stride * len(self.points)
        self.material = Material(case.material_table, self.dim)
        self.tau = LONG(case.k) / LONG(self.material.reference_temperature)
        self.assemble()
        self.find_held()

    def element(self, corners):
        m, dim, s = self.material, self.dim, self.stride
        strains = [0, 1, 5] if dim == 2 else list(range(6))
        F, E = m.F[np.ix_(strains, strains)].astype(LONG), m.E[:dim, strains].astype(LONG)
        beta, K = m.beta[:dim, :dim].astype(LONG), m.K[:dim, :dim].astype(LONG)
        M, P = m.M[strains].astype(LONG), m.P[:dim].astype(LONG)
        nodes = len(corners)
        storage, conduction = np.zeros((s * nodes, s * nodes), LONG), np.zeros((s * nodes, s * nodes), LONG)
        u = [s * n + a for n in range(nodes) for a in range(dim)]
        f, th = [s * n + self.PHI for n in range(nodes)], [s * n + self.THETA for n in range(nodes)]
        for (N, local), weight in RULES[self.kind]:
            J = local @ corners.astype(LONG)
            gradient = solve_small(J, local)
            w = weight * determinant(J)
            B = np.zeros((len(strains), dim * nodes), LONG)
            for row, voigt in enumerate(strains):
                i, j = PAIRS[voigt]
                B[row, i::dim] += gradient[j]
                if i != j:
                    B[row, j::dim] += gradient[i]
            coupling = w * B.T @ E.T @ gradient
            storage[np.ix_(u, u)] += w * B.T @ F @ B
            storage[np.ix_(u, f)] += coupling
            storage[np.ix_(f, u)] += coupling.T
            storage[np.ix_(u, th)] -= w * np.outer(B.T @ M, N)
            storage[np.ix_(th, u)] -= w * np.outer(N, B.T @ M)
            storage[np.ix_(f, f)] -= w * gradient.T @ beta @ gradient
            storage[np.ix_(f, th)] += w * np.outer(gradient.T @ P, N)
            storage[np.ix_(th, f)] += w * np.outer(N, gradient.T @ P)
            storage[np.ix_(th, th)] -= w * LONG(m.capacity) * np.outer(N, N)
            conduction[np.ix_(th, th)] += w * gradient.T @ K @ gradient
        return storage, conduction

    def assemble(self):
        s = self.stride
        dofs = (s * self.cells[:, :, None] + np.arange(s)).reshape(len(self.cells), -1)
        m = dofs.shape[1]
        row, col = np.repeat(dofs, m, 1).ravel(), np.tile(dofs, (1, m)).ravel()
        known, storage, conduction = {}, [], []
        for cell in self.cells:
            corners = self.points[cell] - self.points[cell[0]]
            key = corners.round(12).tobytes()
            if key not in known:
                known[key] = self.element(corners)
            storage.append(known[key][0]), conduction.append(known[key][1])
        storage, conduction = np.array(storage).ravel(), np.array(conduction).ravel()
        self.storage = Sparse(row, col, storage, self.n)
        self.conduction = Sparse(row, col, conduction, self.n)
        rows, cols, values = [row], [col], [storage - self.tau * conduction]
        case = self.case
        for exact, field, coefficient, factor in ((case.exact_heat, self.THETA, case.k_c, self.tau),
                                                  (case.exact_charge, self.PHI, case.c_e, LONG(case.k if case.leaks else 1))):
            if exact:
                i, j, value = self.facet_mass(case.on, coefficient)
                rows.append(s * i + field), cols.append(s * j + field), values.append(-factor * value)
        self.K = Sparse(np.concatenate(rows), np.concatenate(cols), np.concatenate(values), self.n)

    def on_facets(self, names):
        """Of every point of every facet's rule: nodes, shape functions, weight, normal times weight, place."""
        for facet in (f for name in names for f in self.sides[name]):
            corners = self.points[facet].astype(LONG)
            for (N, local), weight in RULES[self.facet]:
                t = local @ corners
                normal = np.array([t[0][1], -t[0][0]]) if self.dim == 2 else np.array(
                    [t[0][1] * t[1][2] - t[0][2] * t[1][1], t[0][2] * t[1][0] - t[0][0] * t[1][2], t[0][0] * t[1][1] - t[0][1] * t[1][0]])
                yield facet, N, weight * np.sqrt(normal @ normal), weight * normal, N @ corners

    def facet_mass(self, names, coefficient):
        row, col, value = [], [], []
        for facet, N, w, _, place in self.on_facets(names):
            k = len(facet)
            row.append(np.repeat(facet, k)), col.append(np.tile(facet, k))
            value.append(w * coefficient([place.astype(float)], 0.0)[0] * np.outer(N, N).ravel())
        return np.concatenate(row), np.concatenate(col), np.concatenate(value)

    def facet_load(self, names, *formulas, t):
        """Integrals of the product of formulas times the shape functions."""
        load = np.zeros(len(self.points), LONG)
        for facet, N, w, _, place in self.on_facets(names):
            value = np.prod([f([place.astype(float)], t)[0] for f in formulas])
            np.add.at(load, facet, w * value * N)
        return load

    def contact_points(self):
        """Nodes by x, y, z, weights, unit normals (mean of the facets', outward)."""
        weight, normal = np.zeros(len(self.points), LONG), np.zeros((len(self.points), self.dim), LONG)
        centre = {}
        for cell in self.cells:
            for f in cell:
                centre.setdefault(int(f), []).append(cell)
        for facet, N, w, nw, place in self.on_facets(self.case.on):
            inside = next(c for c in centre[int(facet[0])] if set(facet) <= set(c))
            sign = np.sign((place - self.points[inside].mean(0)) @ nw)
            weight[facet] += w * N
            normal[facet] += sign * N[:, None] * nw
        nodes = np.flatnonzero(weight)
        nodes = nodes[np.lexsort(self.points[nodes].T[::-1].round(12))]
        length = np.sqrt((normal[nodes] ** 2).sum(1))
        return nodes, weight[nodes], normal[nodes] / length[:, None]

    def find_held(self):
        """Prescribed unknowns; the entry that stands first holds."""
        self.held = {}
        for b in self.case.boundaries:
            for side in b["on"]:
                values = list(b.get("displacement", ["free"] * self.dim)) + [b.get("potential", "free"), b.get("temperature", "free")]
                for i in np.unique(self.sides[side]):
                    for field, value in enumerate(values):
                        if value != "free":
                            self.held.setdefault(int(self.stride * i + field), Formula(value))

    def held_values(self, t):
        return {i: f(self.points[[i // self.stride]], t)[0] for i, f in self.held.items()}

    def loads(self, t, old):
        """Right side of the step that ends at t, from the state old; what contact adds of memory is not in it."""
        c, b, s = self.case, np.zeros(self.n, LONG), self.stride
        history = self.storage @ old
        b[self.THETA::s] += history[self.THETA::s]
        for entry in c.boundaries:
            for axis, value in enumerate(entry.get("traction", [])):
                b[axis::s] += self.facet_load(entry["on"], Formula(value), t=t)
            if "surface_charge" in entry:
                b[self.PHI::s] += self.facet_load(entry["on"], Formula(entry["surface_charge"]), t=t)
            if "heat_flux" in entry:
                b[self.THETA::s] += self.tau * self.facet_load(entry["on"], Formula(entry["heat_flux"]), t=t)
        self.exact_foundation = {}
        if c.exact_heat:
            self.exact_foundation["heat"] = self.facet_load(c.on, c.k_c, c.theta_f, t=t)
            b[self.THETA::s] -= self.tau * self.exact_foundation["heat"]
        if c.exact_charge:
            self.exact_foundation["charge"] = LONG(c.k if c.leaks else 1) * self.facet_load(c.on, c.c_e, c.phi_f, t=t)
            b[self.PHI::s] -= self.exact_foundation["charge"]
        if c.heat.text != 0:
            b[self.THETA::s] -= self.tau * self.volume_load(c.heat, t)
        return b

    def volume_load(self, formula, t):
        load = np.zeros(len(self.points), LONG)
        for cell in self.cells:
            corners = self.points[cell].astype(LONG)
            for (N, local), weight in RULES[self.kind]:
                np.add.at(load, cell, weight * determinant(local @ corners) * formula([(N @ corners).astype(float)], t)[0] * N)
        return load


def determinant(J):
    if len(J) == 2:
        return J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
    return (J[0, 0] * (J[1, 1] * J[2, 2] - J[1, 2] * J[2, 1]) - J[0, 1] * (J[1, 0] * J[2, 2] - J[1, 2] * J[2, 0])
            + J[0, 2] * (J[1, 0] * J[2, 1] - J[1, 1] * J[2, 0]))


def solve_small(J, right):
    """J^-1 right in extended precision: the double inverse, refined."""
    inverse = np.linalg.inv(J.astype(float)).astype(LONG)
    x = inverse @ right
    for _ in range(3):
        x = x + inverse @ (right - J @ x)
    return x
