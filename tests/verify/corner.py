"""Singular exponents of a right-angled corner of a piezoelectric body, from its equations alone.

Near a corner displacement and potential behave like r^s. Fields f(x + p y) solve (4), (5) for three pairs of
complex p (A. N. Stroh's formalism); the exponents s are those at which powers of them satisfy the
homogeneous conditions of both sides. Stresses behave like r^(s - 1).
"""
import cmath
import math

CONSTANTS = {"c11": 166e9, "c13": 78e9, "c33": 162e9, "c44": 43e9, "e31": -4.4, "e33": 18.6, "e15": 11.6,
             "beta11": 11.2e-9, "beta33": 12.6e-9}


def scaled(constants):
    """The constants in units that make all of them of order one; exponents have no unit."""
    units = {"c": 1e11, "e": math.sqrt(1e11 * 1e-8), "b": 1e-8}
    return {name: value / units[name[0]] for name, value in constants.items()}


def blocks(c):
    """Q, R, T of the operator Q f,xx + (R + R^T) f,xy + T f,yy on (u_x, u_y, phi)."""
    q = [[c["c11"], 0, 0], [0, c["c44"], c["e15"]], [0, c["e15"], -c["beta11"]]]
    r = [[0, c["c13"], c["e31"]], [c["c44"], 0, 0], [c["e15"], 0, 0]]
    t = [[c["c44"], 0, 0], [0, c["c33"], c["e33"]], [0, c["e33"], -c["beta33"]]]
    return q, r, t


def pencil(q, r, t, p):
    return [[q[i][j] + p * (r[i][j] + r[j][i]) + p * p * t[i][j] for j in range(3)] for i in range(3)]


def determinant(matrix):
    rows, result = [list(row) for row in matrix], 1
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        if rows[pivot][k] == 0:
            return 0
        if pivot != k:
            rows[k], rows[pivot], result = rows[pivot], rows[k], -result
        result *= rows[k][k]
        for i in range(k + 1, len(rows)):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k])]
    return result


def characteristic_roots(q, r, t):
    """The three p with positive imaginary part, by Weierstrass' simultaneous iteration."""
    leading = determinant(t)
    roots = [(0.4 + 0.9j) ** k for k in range(6)]
    for _ in range(500):
        for i, p in enumerate(roots):
            others = math.prod((p - other for j, other in enumerate(roots) if j != i), start=1)
            roots[i] = p - determinant(pencil(q, r, t, p)) / leading / others
    return [p for p in roots if p.imag > 0]


def null_vector(matrix):
    """Of a singular 3 x 3 matrix: the largest cross product of two rows."""
    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    products = [cross(matrix[i], matrix[j]) for i, j in ((0, 1), (1, 2), (0, 2))]
    best = max(products, key=lambda v: sum(abs(x) ** 2 for x in v))
    size = math.sqrt(sum(abs(x) ** 2 for x in best))
    return [x / size for x in best]


def modes(constants):
    """(p, a, b) with the field a f(x + p y) and the stress function b f(x + p y), conjugates included."""
    q, r, t = blocks(scaled(constants))
    found = []
    for p in characteristic_roots(q, r, t):
        a = null_vector(pencil(q, r, t, p))
        b = [sum((r[j][i] + p * t[i][j]) * a[j] for j in range(3)) for i in range(3)]
        found += [(p, a, b), (p.conjugate(), [x.conjugate() for x in a], [x.conjugate() for x in b])]
    return found


def conditions_matrix(found, s, sides):
    """A row for each condition: "u" the field's component vanishes on the side, "s" its traction does."""
    rows = []
    for angle, kinds in sides:
        powers = [cmath.exp(s * cmath.log(math.cos(angle) + p * math.sin(angle))) for p, _, _ in found]
        for component, kind in enumerate(kinds):
            rows.append([power * (a if kind == "u" else b)[component]
                         for power, (_, a, b) in zip(powers, found)])
    return rows


def exponents(sides, low=0.05, high=0.98, constants=CONSTANTS):
    """All real s between low and high at which the corner has a solution r^s, to 1e-12."""
    found = modes(constants)
    # Columns come in conjugate pairs: the determinant is purely imaginary.
    value = lambda s: determinant(conditions_matrix(found, s, sides)).imag
    grid = [low + (high - low) * i / 400 for i in range(401)]
    return [bisected(value, a, b) for a, b in zip(grid, grid[1:]) if value(a) * value(b) < 0]


def bisected(value, a, b):
    while b - a > 1e-12:
        middle = (a + b) / 2
        a, b = (a, middle) if value(a) * value(middle) <= 0 else (middle, b)
    return (a + b) / 2


FREE, CLAMPED, ROLLER, CLAMPED_GROUNDED = "sss", "uus", "uss", "uuu"
BOTTOM, CONTACT = 0, math.pi / 2  # directions of the two sides of the corner (0, 0)


def solve_consistent(rows, right):
    """A solution of a consistent linear system that may be singular: free unknowns are zero."""
    n, system = len(rows[0]), [list(row) + [value] for row, value in zip(rows, right)]
    pivots = []
    for column in range(n):
        rest = range(len(pivots), len(system))
        pivot = max(rest, key=lambda i: abs(system[i][column]), default=None)
        if pivot is None or abs(system[pivot][column]) < 1e-9:
            continue
        k = len(pivots)
        system[k], system[pivot] = system[pivot], system[k]
        system[k] = [x / system[k][column] for x in system[k]]
        for i, row in enumerate(system):
            if i != k:
                system[i] = [x - row[column] * y for x, y in zip(row, system[k])]
        pivots.append(column)
    solution = [0.0] * n
    for k, column in enumerate(pivots):
        solution[column] = system[k][n]
    return solution


def parts(coefficients):
    """2 Re(sum c_k q_k) as a row over the real and imaginary parts of the q_k."""
    return [2 * c.real for c in coefficients] + [-2 * c.imag for c in coefficients]


def logarithm(constants=CONSTANTS):
    """Where the contact slips: normal traction = k * tangential traction * ln r + ... next to the corner
    (0, 0), with the tangential traction uniform along the contact and zero on the free side. Returns k.

    Fields sum a q z ln z + a h z with z = x + p y. On the free side the stress function vanishes; on the
    contact u_x = 0, no charge flows, and the derivative of the stress function is the traction (nu = -x).
    """
    found = modes(constants)[::2]
    p, none = [m[0] for m in found], [0.0] * 6
    rows, right = [], []
    for j in range(3):
        free = parts([b[j] for _, _, b in found])
        rows += [free + none, none + free]
        right += [0, 0]
    for j, which, value in ((0, 1, 0), (1, 2, 1), (2, 2, 0)):
        along = [m[which][j] * m[0] for m in found]
        rows.append(parts(along) + none)
        rows.append(parts([c * cmath.log(x) for c, x in zip(along, p)]) + parts(along))
        right += [0, value]
    solution = solve_consistent(rows, right)
    normal = parts([b[0] * x for x, _, b in found])
    return -sum(c * q for c, q in zip(normal, solution))
