"""The same step as a linear complementarity problem, solved by Lemke's pivots: another way to the same solution.

For laws that are piecewise linear: bilateral, unilateral, compliance with exponent 1, damped; without friction,
Tresca, Coulomb with a constant coefficient, no limit. Bounds that vanish with the contact (Tresca, cohesion) are
taken from the statuses found before, so there this checks the rest.

    x = (P, T+, T-, sigma), y = (opening, d + sigma, -d + sigma, w bound - T+ - T-):  x >= 0, y >= 0, x y = 0

with q_n = -P, q_t = T+ - T- (the form of Stewart and Trinkle, whose matrix is copositive).
"""
import numpy as np

# Added to every friction bound, as a share of the largest force: with bounds that are positive where the contact is
# open, Lemke's path cannot end in a ray (the matrix is copositive). The solution moves by about as much.
CLEARANCE = 1e-10


def leaving(T, c, able, basis):
    """The row of the least ratio; ties are broken lexicographically, so that degenerate pivots cannot cycle."""
    m = len(basis)
    ratio = np.maximum(T[able, -1], 0) / c[able]
    ties = able[ratio <= ratio.min() + 1e-13]
    for i in ties:
        if basis[i] == 2 * m:
            return i
    for column in range(m):
        if len(ties) == 1:
            break
        value = T[ties, column] / c[ties]
        ties = ties[value <= value.min() + 1e-13]
    return ties[0]


def lemke(M, r, cover, limit=2000):
    """x >= 0 with M x + r >= 0 and x (M x + r) = 0, or None where the path ends in a ray."""
    m = len(r)
    if np.all(r >= 0):
        return np.zeros(m), 0
    T = np.hstack([np.eye(m), -M, -cover[:, None], r[:, None]])
    basis = np.arange(m)  # y
    row = np.argmin(r / cover)
    entering = 2 * m
    for pivot in range(1, limit):
        T[row] /= T[row, entering]
        column = T[:, entering].copy()
        column[row] = 0
        T -= np.outer(column, T[row])
        left, basis[row] = basis[row], entering
        if left == 2 * m:
            x = np.zeros(2 * m)
            x[basis] = T[:, -1]
            return x[m:], pivot
        entering = left + m if left < m else left - m
        c = T[:, entering]
        able = c > 1e-11
        if not able.any():
            return None, pivot
        row = leaving(T, c, np.flatnonzero(able), basis)
    return None, limit


def free_rows(step, closed):
    """Rows that are solved for. Where contact alone holds the body, a closed node at a support is held as well."""
    n = step.n
    free = [i for i in range(2 * n) if i not in step.held]
    scale = 1 / np.sqrt(step.diagonal[free])
    if np.linalg.eigvalsh(step.S[np.ix_(free, free)] * scale[:, None] * scale)[0] < 1e-12:
        free.remove(next(i for i in range(n) if closed[i] and n + i in step.held))
    return np.array(free)


def problem(step, state, closed, side):
    """M, r, and the map from x to all nodal forces, forces in units of `size`, lengths in size/stiffness."""
    n, S, s, w = step.n, step.S, step.s, step.w
    free = free_rows(step, closed)
    rhs = s.copy()
    for i, value in step.held.items():
        rhs -= S[:, i] * value
    for i in set(range(2 * n)) - set(free) - set(step.held):
        rhs -= S[:, i] * float(state[i])
    A, F = step.diagonal.mean(), max(np.max(np.abs(rhs[free])), step.size)
    W = np.zeros((2 * n, 2 * n))
    W[np.ix_(free, free)] = np.linalg.inv(S[np.ix_(free, free)] / A)
    z0 = W @ (rhs / F)
    t = [i for i in range(n) if n + i in free and step.friction.law != "none"]
    mu = 0.0
    fixed = np.zeros(n)
    table = step.friction.table
    if step.friction.law == "coulomb":
        mu, fixed = table["coefficient"], np.array([table.get("cohesion", 0.0) * c for c in closed])
    if step.friction.law == "tresca":
        fixed = np.array([table["bound"] if k is not None else 0.0 for k in side])
    fixed = w * fixed / F
    k = len(t)
    m = n + 3 * k
    plus, minus, sigma = n + np.arange(k), n + k + np.arange(k), n + 2 * k + np.arange(k)
    Q = np.zeros((2 * n, m))  # q = Q x
    Q[np.arange(n), np.arange(n)] = -1
    M, r = np.zeros((m, m)), np.zeros(m)
    for j, i in enumerate(t):
        Q[n + i, plus[j]], Q[n + i, minus[j]] = 1, -1
        M[sigma[j], i], M[sigma[j], plus[j]], M[sigma[j], minus[j]], r[sigma[j]] = mu, -1, -1, fixed[i] + CLEARANCE
    Z = W @ Q
    M[:n], r[:n] = -Z[:n], -z0[:n]
    if step.normal.law == "compliance":
        M[np.arange(n), np.arange(n)] += A / (w * step.normal.c)
    if step.normal.law == "damped":
        M[np.arange(n), np.arange(n)] += A * step.normal.k / (w * step.normal.c)
        r[:n] += np.maximum(step.before, 0) * A / F
    for j, i in enumerate(t):
        M[plus[j]], r[plus[j]] = Z[n + i], z0[n + i]
        M[minus[j]], r[minus[j]] = -Z[n + i], -z0[n + i]
        M[plus[j], sigma[j]] = M[minus[j], sigma[j]] = 1
    q0 = np.zeros(2 * n)
    if step.normal.law == "bilateral":  # the opening is zero: the pressures follow from the rest
        inner = np.linalg.inv(M[:n, :n])
        E, e = -inner @ M[:n, n:], -inner @ r[:n]
        full = np.vstack([E, np.eye(m - n)])
        M, r, q0, Q = M[n:] @ full, r[n:] + M[n:, :n] @ e, Q[:, :n] @ e, Q @ full
    return M, r, Q, q0, F


def compare(step, state, closed, side, random, covers=8):
    """Solutions from several covering vectors: how far their forces are from those of `state`."""
    table = step.friction.table
    if step.normal.law == "compliance" and step.normal.m != 1 or isinstance(table.get("coefficient"), dict) or "limit" in table:
        return {}
    M, r, Q, q0, F = problem(step, state, closed, side)
    free = free_rows(step, closed)
    counts = {"same": 0, "same_after_changes": 0, "other": 0, "ray": 0, "lost_digits": 0}
    for c in range(covers):
        x, _ = lemke(M, r, np.ones(len(r)) if c == 0 else 10 ** random.uniform(-1, 1, len(r)))
        if x is None:
            counts["ray"] += 1
            continue
        q = (Q @ x + q0) * F
        z = np.where(np.isin(np.arange(2 * step.n), free), 0, state.astype(float))
        rhs = step.s + q - step.S @ z
        z[free] = np.linalg.solve(step.S[np.ix_(free, free)], rhs[free])
        counts[judge(step, z, -q[:step.n], state, closed, side)] += 1
    return {"lemke": counts}


def judge(step, z, P, state, closed, side):
    """Whether the state that pivots ended at is this solution, another one, or none.

    Digits are lost on long paths: where the statuses they end at fail, nodes change theirs up to four times, which is
    counted apart.
    """
    guess_closed, guess_side = step.guess(np.where(np.abs(z) * step.diagonal < 1e-8 * P.max(), 0, z), np.where(P > 1e-8 * P.max(), P, 0))
    for i in step.held:
        if i >= step.n:
            guess_side[i - step.n] = side[i - step.n]
    if step.normal.law == "unilateral" and len(free_rows(step, closed)) < 2 * step.n - len(step.held):
        for i in range(step.n):
            guess_closed[i] = guess_closed[i] or (closed[i] and step.n + i in step.held)
    found, a, b = None, guess_closed, guess_side
    for changes in range(5):
        try:
            found, r = step.exact(z, a, b)
        except np.linalg.LinAlgError:
            return "lost_digits"
        worst, a, b, _ = step.check(found, a, b)
        if worst < 1e-12:
            break
    else:
        return "lost_digits"
    if step.distance(found, state) > 1e-9:
        return "other"
    return "same_after_changes" if changes else "same"
