"""One step on the contact boundary: S z = s + q for z = (delta, d) at every node, with the laws between z and q.

1. Node by node (nonlinear Gauss-Seidel), each node's normal and tangential problem solved exactly, bounds taken
   from the node's present state; or, for another route, bounds frozen during a convex programme and then renewed.
2. The statuses that come out (open or closed; stick or slip to one side) make the problem a smooth system, which
   is solved exactly, and all inequalities are checked. Where one fails, the node changes its status, and if that
   does not settle, 1 goes on.
"""
import numpy as np

LONG = np.longdouble
OPEN, STICK, SLIP = "open", "stick", "slip"


class Unsettled(Exception):
    pass


class Step:
    def __init__(self, S, s, w, normal, friction, before, slip0, held, size):
        """S, s: rows of the normal components, then of the tangential ones; held: {row: prescribed z}; size: a force to measure by."""
        self.n = len(w)
        self.SL, self.sL, self.wL = S, s, w
        self.S, self.s, self.w = S.astype(float), s.astype(float), w.astype(float)
        self.normal, self.friction, self.before, self.slip0, self.held = normal, friction, before, slip0, held
        self.size = size  # largest nodal force so far [N/m]
        self.diagonal = np.diag(self.S).copy()

    # -- 1: node by node ----------------------------------------------------------------------------------------

    def normal_update(self, i, g):
        """delta and p of a node whose normal force is diagonal * delta + g."""
        S, w, law = self.diagonal[i], self.w[i], self.normal
        if i in self.held:
            return self.held[i], -(S * self.held[i] + g) / w
        if law.law == "bilateral":
            return 0.0, -g / w
        delta = -g / S
        if law.law == "unilateral":
            return (delta, 0.0) if delta < 0 else (0.0, -g / w)
        kink = 0.0 if law.law == "compliance" else max(self.before[i], 0.0)
        if delta <= kink:
            return delta, 0.0
        low, high = kink, delta  # S delta + g + w p grows: bisection, then Newton
        for _ in range(60):
            p, slope = law.pressure(delta, self.before[i])
            r = S * delta + g + w * p
            low, high = (low, delta) if r > 0 else (delta, high)
            new = delta - r / (S + w * slope)
            new = new if low < new < high else (low + high) / 2
            if abs(new - delta) <= 1e-16 * abs(delta):
                break
            delta = new
        return delta, law.pressure(delta, self.before[i])[0]

    def carries(self, i, delta, p):
        """Whether the node is closed, so that it can carry friction."""
        return self.normal.law == "bilateral" or p > 0 or delta >= 0

    def sweep(self, z, bounds=None):
        """One pass over all nodes; returns the largest change of a force."""
        n, change, p = self.n, 0.0, np.zeros(self.n)
        for i in range(n):
            g = self.S[i] @ z - self.diagonal[i] * z[i] - self.s[i]
            new, p[i] = self.normal_update(i, g)
            change = max(change, abs(new - z[i]) * self.diagonal[i])
            z[i] = new
            j = n + i
            if j in self.held:
                z[j] = self.held[j]
                continue
            g = self.S[j] @ z - self.diagonal[j] * z[j] - self.s[j]
            if bounds is None:
                b = self.friction.bound(max(p[i], 0), abs(z[j]), self.slip0[i])[0] if self.carries(i, z[i], p[i]) else 0.0
            else:
                b = bounds[i]
            new = -np.sign(g) * max(abs(g) - self.w[i] * b, 0) / self.diagonal[j]
            change = max(change, abs(new - z[j]) * self.diagonal[j])
            z[j] = new
        return change, p

    def relax(self, z, sweeps, tolerance, frozen=False):
        """Sweeps until forces change by less than tolerance times the largest; frozen: a convex programme each time."""
        n = self.n
        bounds, p = None, np.zeros(n)
        if frozen:
            bounds = np.zeros(n)
        for k in range(sweeps):
            change, p = self.sweep(z, bounds)
            size = max(np.max(self.w * np.abs(p)), self.size, np.max(np.abs(self.s)) * 1e-6, 1e-300)
            if frozen and (change < 1e-3 * size and k % 5 == 4 or k % 200 == 199):
                new = np.array([self.friction.bound(max(p[i], 0), abs(z[n + i]), self.slip0[i])[0]
                                if self.carries(i, z[i], p[i]) else 0.0 for i in range(n)])
                change = max(change, np.max(self.w * np.abs(new - bounds)))
                bounds = bounds + 0.5 * (new - bounds)
                if change < tolerance * size:
                    break
            elif not frozen and change < tolerance * size:
                break
        return z, p

    # -- 2: exactly ---------------------------------------------------------------------------------------------

    def guess(self, z, p):
        """Statuses of a state: closed nodes; 0 for stick, +1 or -1 for the direction of slip, None without friction."""
        closed, side = [], []
        for i in range(self.n):
            if self.normal.law == "bilateral":
                closed.append(True)
            elif self.normal.law == "damped":
                closed.append(p[i] > 0)
            else:
                closed.append(p[i] > 0)
            free = self.friction.law == "none" or not self.carries(i, z[i], p[i])
            d = z[self.n + i]
            side.append(None if free else int(np.sign(d)))
        return closed, side

    def exact(self, z, closed, side):
        """The state of given statuses: Newton on smooth equations, one step where the laws are linear."""
        n, S, s, w = self.n, self.SL, self.sL, self.wL
        z = z.astype(LONG).copy()
        best = None
        for it in range(30):
            q = S @ z - s
            F, J = q.copy(), self.S.copy()
            row_scale = self.diagonal.copy()
            for i in range(n):
                j = n + i
                unit = lambda r: J.__setitem__(r, np.eye(2 * n)[r] * self.diagonal[r])
                p, slope = -q[i] / w[i], None
                if i in self.held:
                    F[i] = self.diagonal[i] * (z[i] - self.held[i])
                    unit(i)
                elif self.normal.rigid:
                    if closed[i]:
                        F[i] = self.diagonal[i] * z[i]
                        unit(i)
                elif closed[i]:
                    p, slope = self.normal.pressure(z[i], self.before[i])
                    F[i] += w[i] * p
                    J[i, i] += float(w[i] * slope)
                if j in self.held:
                    F[j] = self.diagonal[j] * (z[j] - self.held[j])
                    unit(j)
                elif side[i] == 0:
                    F[j] = self.diagonal[j] * z[j]
                    unit(j)
                elif side[i] is not None:
                    if not closed[i]:
                        p = LONG(0)
                    b, by_p, by_d = self.friction.bound(p, side[i] * z[j], self.slip0[i])
                    F[j] += w[i] * b * side[i]
                    if closed[i]:
                        if slope is None:
                            J[j] -= side[i] * float(by_p) * self.S[i]
                        else:
                            J[j, i] += side[i] * float(w[i] * by_p * slope)
                    J[j, j] += float(w[i] * by_d)
            size = max(np.max(np.abs(q)), self.size, 1e-300)
            r = np.max(np.abs(F)) / size
            if best is None or r < best[0] / 2:
                best = (r, z.copy())
            elif it > 3 and best[0] < 1e-14:
                break
            scale = 1 / np.sqrt(self.diagonal)
            dz = np.linalg.solve(J * scale[:, None] * scale, -(F * scale).astype(float)) * scale
            z = z + dz
        return best[1], best[0]

    def closed_pressure(self, z, q, closed):
        if self.normal.rigid:
            return -q[:self.n] / self.wL
        return np.array([self.normal.pressure(z[i], self.before[i])[0] if i not in self.held
                         else -q[i] / self.wL[i] for i in range(self.n)], LONG)

    def check(self, z, closed, side):
        """Largest violation of the laws over the largest force, the statuses that the state asks for, the margin."""
        n = self.n
        q = self.SL @ z - self.sL
        p = self.closed_pressure(z, q, closed)
        size = max(float(np.max(np.abs(q))), self.size)
        worst, margin = 0.0, np.inf
        new_closed, new_side = list(closed), list(side)
        D, w = self.diagonal, self.wL
        for i in range(n):
            j = n + i
            if i not in self.held:
                if self.normal.law == "unilateral":
                    worst = max(worst, abs(min(w[i] * p[i], -D[i] * z[i])))
                    new_closed[i] = w[i] * p[i] + D[i] * z[i] > 0
                    margin = min(margin, abs(w[i] * p[i] + D[i] * z[i]))
                elif not self.normal.rigid:
                    worst = max(worst, abs(q[i] + w[i] * p[i]))
                    kink = 0 if self.normal.law == "compliance" else max(self.before[i], 0)
                    new_closed[i] = z[i] > kink
                    margin = min(margin, abs(D[i] * (z[i] - kink)))
            if j in self.held:
                continue
            carries = self.friction.law != "none" and self.carries(i, z[i] if not (closed[i] and self.normal.rigid) else 0.0, p[i] if closed[i] else 0.0)
            if not carries:
                worst = max(worst, abs(q[j]))
                new_side[i] = None
                continue
            b = self.friction.bound(p[i] if closed[i] else LONG(0), abs(z[j]), self.slip0[i])[0]
            trial = q[j] - D[j] * z[j]
            worst = max(worst, abs(q[j] - min(max(trial, -w[i] * b), w[i] * b)))
            new_side[i] = 0 if abs(trial) <= w[i] * b else -int(np.sign(trial))
            margin = min(margin, abs(abs(trial) - w[i] * b))
        return float(worst) / size, new_closed, new_side, float(margin) / size

    def distance(self, a, b):
        """Largest difference of two states, as a force, over the largest force."""
        d = a - b
        size = max(np.max(np.abs(self.SL @ b - self.sL)), self.size)
        return float(max(np.max(np.abs(self.SL @ d)), np.max(np.abs(self.diagonal * d))) / size)

    def solve(self, z, frozen=False, tolerance=1e-12, rounds=40):
        """The state, pressures and statuses; raises Unsettled."""
        z = z.copy()
        for i, value in self.held.items():
            z[i] = value
        seen = 1e-4
        for _ in range(rounds):
            z, p = self.relax(z, 3000, seen, frozen)
            closed, side = self.guess(z, p)
            for _ in range(2 * self.n):
                try:
                    x, r = self.exact(z, closed, side)
                except np.linalg.LinAlgError:
                    break
                worst, new_closed, new_side, margin = self.check(x, closed, side)
                if worst < tolerance and r < tolerance:
                    return x, closed, side, worst, margin
                if (new_closed, new_side) == (closed, side) or not np.isfinite(worst):
                    break
                closed, side = new_closed, new_side
            seen /= 4
        raise Unsettled(f"violation {worst:.1e}")
