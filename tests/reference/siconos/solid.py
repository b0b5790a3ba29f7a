"""An elastic box of trilinear hexahedra on its bottom, condensed to the contact nodes: what contact_laws does in 2D."""
import itertools

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from case import Formula

CORNERS = np.array(list(itertools.product((-1, 1), repeat=3)))  # z fastest, as the nodes


def element(young, poisson, h):
    """Stiffness of one cell of edges h, 24 x 24, 2 x 2 x 2 Gauss points."""
    shear = young / (2 * (1 + poisson))
    C = np.zeros((6, 6))
    C[:3, :3] = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    C[range(6), range(6)] += [2 * shear] * 3 + [shear] * 3
    K = np.zeros((24, 24))
    for point in itertools.product((-3**-0.5, 3**-0.5), repeat=3):
        factor = 1 + CORNERS * point
        B = np.zeros((6, 24))
        for a in range(3):
            b, c = (a + 1) % 3, (a + 2) % 3
            G = CORNERS[:, a] * factor[:, b] * factor[:, c] / 8 * 2 / h[a]  # derivative along a
            B[a, a::3] = G
            B[3 + b, c::3] += G  # row 3 + b: the shear strain of the plane normal to b
            B[3 + c, b::3] += G
        K += np.prod(h) / 8 * B.T @ C @ B
    return K


def condense(case):
    """(places, weights, M, q) per contact node (normal, x, y): u = M r + q, u_N the opening, r on the body [m, N]."""
    box, lo = case["mesh"]["box"], np.array(case["mesh"]["box"]["min"], float)
    cells = np.array(box["cells"])
    h = (np.array(box["max"]) - lo) / cells
    node = np.arange(np.prod(cells + 1)).reshape(cells + 1)
    place = lo + h * np.stack(np.unravel_index(node.ravel(), node.shape), 1)
    ends = [node[tuple(slice(o, o + n) for o, n in zip(offset, cells))].ravel() for offset in (CORNERS + 1) // 2]
    dofs = (3 * np.stack(ends, 1)[:, :, None] + np.arange(3)).reshape(-1, 24)
    K = sp.coo_matrix((np.tile(element(case["material"]["young"], case["material"]["poisson"], h).ravel(), len(dofs)),
                       (np.repeat(dofs, 24, 1).ravel(), np.tile(dofs, (1, 24)).ravel()))).tocsc()
    sides = {"left": (0, 0), "right": (0, -1), "front": (1, 0), "back": (1, -1), "bottom": (2, 0), "top": (2, -1)}
    u, load, held = np.zeros(3 * node.size), np.zeros(3 * node.size), np.zeros(3 * node.size, bool)

    def faces(axis, end):
        """Nodes of a side and the integrals of their shape functions."""
        counts = [np.r_[1, np.full(n - 1, 2), 1] * w / 2 for n, w in zip(np.delete(cells, axis), np.delete(h, axis))]
        return np.take(node, end, axis).ravel(), np.outer(*counts).ravel()

    for boundary in case["boundary"]:
        nodes, area = faces(*sides[boundary["on"]])
        for a, value in enumerate(boundary.get("displacement", [])):
            u[3 * nodes + a], held[3 * nodes + a] = Formula(value)(*place[nodes, :2].T, 1.0), True
        for a, value in enumerate(boundary.get("traction", [])):
            load[3 * nodes + a] += value * area  # constant
    nodes, weight = faces(*sides["bottom"])
    x, y = place[nodes, :2].T
    contact = case["contact"]
    rest = [Formula(f)(x, y, 1.0) - Formula(f)(x, y, 0.0) for f in contact["foundation_displacement"]]
    rows = (3 * nodes[:, None] + [2, 0, 1]).ravel()  # u_N = u_z - u_f,z + g; slip in this step along x, y
    rest = np.stack([Formula(contact["foundation_displacement"][2])(x, y, 1.0) - Formula(contact["gap"])(x, y, 0.0), *rest[:2]], 1)
    free = np.flatnonzero(~held)
    unit = np.zeros((3 * node.size, len(rows)))
    unit[rows, range(len(rows))] = 1
    solve = sla.splu(K[free][:, free]).solve
    u[free] = solve((load - K @ u)[free])
    compliance = np.zeros_like(unit)
    compliance[free] = solve(unit[free])
    return place[nodes], weight, compliance[rows], u[rows] - rest.ravel()
