"""One step: the body's equations, every unknown of every node, and the tractions of the contact nodes, by Newton's
method on all of them at once with the exact derivatives of every law. Residuals are in extended precision.

    K x + w (contact forces, -charge out, -k/theta_ref heat out) = b
    l_n = max(0, l_n + r delta)          unilateral; delta = 0, bilateral; l_n = c delta+^m, compliance
    l_t = P_b(l_t + r d)                 P_b: projection on the ball of radius b, the friction bound

l_n = p and l_t = -sigma_tau are the multipliers of docs/conventions.md.
"""
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

import laws

LONG = np.longdouble


class Unsettled(Exception):
    pass


class Data:
    """What a step is given: see contact_exchange.py."""


class Step:
    def __init__(self, data):
        self.__dict__.update(data.__dict__)
        m, dim, body = len(self.nodes), self.dim, self.body
        s = body.stride
        self.m, self.N = m, body.n + m * dim
        self.u = s * self.nodes[:, None] + np.arange(dim)  # m x dim
        self.phi, self.theta = s * self.nodes + body.PHI, s * self.nodes + body.THETA
        self.ln = body.n + np.arange(m)
        self.lt = body.n + m + np.arange(m * (dim - 1)).reshape(m, dim - 1)
        held = np.zeros(self.N, bool)
        held[list(body.held)] = True
        self.held = held
        self.set_scales()

    def set_scales(self):
        diagonal = np.abs(self.K.diagonal())
        self.scale = np.ones(self.N)
        self.scale[:self.body.n] = 1 / np.sqrt(diagonal)
        stiffness = diagonal[self.u].mean(1)
        w = self.w.astype(float)
        self.r = stiffness / w  # N/m^3
        self.scale[self.ln] = np.sqrt(stiffness) / w
        self.scale[self.lt] = (np.sqrt(stiffness) / w)[:, None]
        self.row_scale = self.scale.copy()  # rows of multipliers say tractions
        self.row_scale[self.ln] = w / np.sqrt(stiffness)
        self.row_scale[self.lt] = (w / np.sqrt(stiffness))[:, None]

    # -- the state at the contact -------------------------------------------------------------------------------------

    def local(self, X):
        u = X[self.u]
        delta = (u * self.nu).sum(1) - self.gap  # gap: g + u_f.nu
        d = np.einsum("mad,ma->md", self.T, u - self.u_stuck)
        return delta, d, X[self.phi], X[self.theta], X[self.ln], X[self.lt]

    def coefficients(self, X):
        """The numbers that depend on the contact's state, with derivatives: bound, psi, pressed exchange."""
        delta, d, _, _, p, _ = (a.astype(float) for a in self.local(X))
        case, size = self.case, np.sqrt((d ** 2).sum(1))
        if case.normal["law"] == "bilateral":
            closed = np.ones(self.m, bool)
        elif case.normal["law"] == "unilateral":
            closed = p + self.r * delta > 0
        else:
            closed = delta > 0
        return {"closed": closed, "bound": laws.friction_bound(case.friction, p, closed, size, self.slid, case.k),
                "pressed": laws.pressed_exchange(p, case.pressure), "heat_psi": laws.ramp(delta, case.heat_ramp),
                "charge_psi": laws.ramp(delta, case.charge_ramp), "friction_heat": self.friction_heat(X)[0].astype(float)}

    def friction_heat(self, X):
        """share (-tau.d)/k into the body, per area; derivatives by l_t and by u."""
        _, d, _, _, _, lt = self.local(X)
        a = self.case.share / LONG(self.case.k)
        return a * (lt * d).sum(1), a * d, a * np.einsum("mad,md->ma", self.T, lt)

    def flows(self, X, c):
        """Lumped heat and charge out of the body per area, without memory and without friction heat."""
        delta, _, phi, theta, _, _ = self.local(X)
        pressed = c["pressed"][0] * (theta - self.theta_f)
        faded = self.k_c * c["heat_psi"][0] * (theta - self.theta_f) if self.case.lump_heat else 0 * theta
        charge = self.c_e * c["charge_psi"][0] * (phi - self.phi_f) * self.rate if self.case.lump_charge else 0 * phi
        return pressed + faded, charge

    # -- residual and derivative --------------------------------------------------------------------------------------

    def residual(self, X, frozen=None):
        """frozen: coefficients to hold; their derivatives are left out then."""
        body, n, w = self.body, self.body.n, self.w
        c = frozen or self.coefficients(X)
        delta, d, _, _, p, lt = self.local(X)
        R = np.zeros(self.N, LONG)
        R[:n] = body.K @ X[:n] - self.b
        R[self.u] += w[:, None] * (p[:, None] * self.nu + np.einsum("mad,md->ma", self.T, lt))
        heat, charge = self.flows(X, c)
        friction = c["friction_heat"] if frozen else self.friction_heat(X)[0]
        R[self.theta] -= body.tau * w * (heat - friction)
        R[self.phi] -= w * charge
        R[:n][self.held[:n]] = (X[:n] - self.prescribed)[self.held[:n]]
        law = self.case.normal
        if law["law"] == "bilateral":
            R[self.ln] = self.r * delta
        elif law["law"] == "unilateral":
            R[self.ln] = np.where(p + self.r * delta > 0, -self.r * delta, p)
        else:
            R[self.ln] = p - law["coefficient"] * np.where(delta > 0, delta, 0) ** law.get("exponent", 1)
        bound = c["bound"][0]
        y = lt + self.r[:, None] * d
        size = np.sqrt((y ** 2).sum(1))
        out = (size > bound) | (bound == 0)
        unit = y / np.where(size > 0, size, 1)[:, None]
        R[self.lt] = np.where(out[:, None], lt - bound[:, None] * unit, -self.r[:, None] * d)
        R *= self.row_scale
        R[self.held] *= np.divide(1, self.scale ** 2)[self.held]
        return R

    def jacobian(self, X, frozen=None):
        body, n, w, dim, case = self.body, self.body.n, self.w.astype(float), self.dim, self.case
        c = frozen or self.coefficients(X)
        live = frozen is None
        delta, d, phi, theta, p, lt = (a.astype(float) for a in self.local(X))
        tau, entries = float(body.tau), []

        def put(rows, cols, values):
            rows, cols, values = np.broadcast_arrays(rows, cols, values)
            entries.append((rows.ravel(), cols.ravel(), values.ravel()))

        nu, T, u, r = self.nu.astype(float), self.T.astype(float), self.u, self.r
        put(u, self.ln[:, None], w[:, None] * nu)
        put(u[:, :, None], self.lt[:, None, :], w[:, None, None] * T)
        out_heat = c["pressed"][0] + (self.k_c * c["heat_psi"][0] if case.lump_heat else 0)
        put(self.theta, self.theta, -tau * w * out_heat)
        if case.lump_charge:
            put(self.phi, self.phi, -w * self.c_e * c["charge_psi"][0] * self.rate)
        if live:
            warmth = theta - self.theta_f
            put(self.theta, self.ln, -tau * w * c["pressed"][1] * warmth)
            if case.lump_heat:
                put(self.theta[:, None], u, (-tau * w * self.k_c * c["heat_psi"][1] * warmth)[:, None] * nu)
            if case.lump_charge:
                put(self.phi[:, None], u, (-w * self.c_e * c["charge_psi"][1] * self.rate * (phi - self.phi_f))[:, None] * nu)
            _, by_l, by_u = self.friction_heat(X)
            put(self.theta[:, None], self.lt, (tau * w)[:, None] * by_l.astype(float))
            put(self.theta[:, None], u, (tau * w)[:, None] * by_u.astype(float))
        law = case.normal
        if law["law"] == "compliance":
            slope = law["coefficient"] * law.get("exponent", 1) * np.where(delta > 0, delta, 0) ** (law.get("exponent", 1) - 1.0)
            put(self.ln, self.ln, 1.0)
            put(self.ln[:, None], u, np.where(delta > 0, -slope, 0)[:, None] * nu)
        else:
            closed = np.ones(self.m, bool) if law["law"] == "bilateral" else p + r * delta > 0
            put(self.ln[:, None], u, np.where(closed, r if law["law"] == "bilateral" else -r, 0)[:, None] * nu)
            put(self.ln, self.ln, np.where(closed, 0.0, 1.0))
        bound, by_p, by_d = c["bound"]
        y = lt + r[:, None] * d
        _, P, unit, out = laws.on_ball(y, bound)
        eye = np.eye(dim - 1)
        put(self.lt[:, :, None], self.lt[:, None, :], np.where(out[:, None, None], eye - P, 0))
        along = np.where(out[:, None, None], P, eye) * r[:, None, None]
        if live:
            put(self.lt, self.ln[:, None], -np.where(out, by_p, 0)[:, None] * unit)
            size = np.sqrt((d ** 2).sum(1))
            way = d / np.where(size > 0, size, 1)[:, None]
            along = along + np.where(out, by_d, 0)[:, None, None] * unit[:, :, None] * way[:, None, :]
        put(self.lt[:, :, None], u[:, None, :], -np.einsum("mij,maj->mia", along, T))
        row, col, value = (np.concatenate(a) for a in zip(*entries))
        keep = (value != 0) & ~self.held[row]
        contact = sp.csr_matrix((value[keep], (row[keep], col[keep])), shape=(self.N, self.N))
        free = sp.diags((~self.held[:n]).astype(float))
        base = sp.block_diag([free @ self.K + sp.diags(self.held[:n].astype(float)), sp.csr_matrix((self.N - n, self.N - n))], "csr")
        rows = self.row_scale.copy()
        rows[self.held] = 1 / self.scale[self.held]
        return (sp.diags(rows) @ (base + contact) @ sp.diags(self.scale)).tocsc()

    # -- solution -----------------------------------------------------------------------------------------------------

    def size(self, X):
        """By which residuals are judged: the largest entry of the rows' terms, scaled."""
        terms = np.abs(self.K) @ np.abs(X[:self.body.n]).astype(float) * self.row_scale[:self.body.n]
        return max(float(terms[~self.held[:self.body.n]].max()), 1e-300)

    def newton(self, X, frozen=None, limit=60, tolerance=1e-15, descend=True):
        """A zero from X on. The last steps are refinement: they go on until the residual no longer falls."""
        X = X.copy()
        X[:self.body.n][self.held[:self.body.n]] = self.prescribed[self.held[:self.body.n]]
        R = self.residual(X, frozen)
        merit, best, idle = float(R @ R), None, 0
        for iteration in range(limit):
            step = -self.scale * sla.splu(self.jacobian(X, frozen)).solve(R.astype(float))
            if not np.all(np.isfinite(step)):
                raise Unsettled("singular")
            trials = []
            for length in (1.0,) + (tuple(0.5 ** j for j in range(1, 11)) if descend else ()):
                new = X + length * step
                r = self.residual(new, frozen)
                trials.append((float(r @ r), length, new, r))
                if trials[-1][0] < (1 - 0.2 * length) * merit:
                    break
            value, length, X, R = min(trials, key=lambda t: t[0])
            small = np.sqrt(value) / self.size(X)
            if best is None or value < best[0] * 0.25:
                best, idle = (value, X, small), 0
            else:
                idle += 1
                if value < best[0]:
                    best = (value, X, small)
            merit = value
            if best[2] < tolerance and idle >= 2:
                return best[1], best[2], iteration + 1
        if best[2] < 1e-13:
            return best[1], best[2], limit
        raise Unsettled(f"residual {best[2]:.1e} after {limit} iterations")

    def by_frozen(self, X, rounds=400):
        """Another way: coefficients held during a programme that is convex, then renewed, damped."""
        c = self.coefficients(X)
        change = np.inf
        for k in range(rounds):
            X, _, _ = self.newton(X, c, 200)
            new = self.coefficients(X)
            change, mixed = 0.0, {"closed": new["closed"]}
            for name in ("bound", "pressed", "heat_psi", "charge_psi", "friction_heat"):
                old_value, value = (v if name == "friction_heat" else v[0] for v in (c[name], new[name]))
                felt = new["closed"] if name in ("bound", "pressed", "friction_heat") else True  # open nodes have round-off only
                change = max(change, float(np.max(np.abs(value - old_value) * felt) / max(np.max(np.abs(value) * felt), 1e-300)))
                value = old_value + 0.6 * (value - old_value)
                mixed[name] = value if name == "friction_heat" else (value,) + new[name][1:]
            c = mixed
            if change < 1e-9:
                return self.newton(X, None, 60)
        raise Unsettled(f"coefficients still change by {change:.1e}")

    def solve(self, start, state, random, starts):
        """The step from `start`, Newton's method, else held coefficients, else loads of contact grown from random states."""
        attempts = [lambda: self.newton(start), lambda: self.newton(start, descend=False), lambda: self.by_frozen(start)]
        attempts += [lambda: self.newton(self.random_state(start, random)) for _ in range(20)]
        for attempt in attempts:
            try:
                X, residual, iterations = attempt()
                break
            except (Unsettled, RuntimeError) as problem:
                self.log = getattr(self, "log", []) + [str(problem)]
        else:
            raise Unsettled("; ".join(self.log))
        check = {"residual": residual, "newton_iterations": iterations, "margin": self.margin(X)}
        if starts:
            check |= self.other_solutions(X, random, starts)
        return X, check

    def random_state(self, X, random):
        """Another state of the contact: displacements, tractions, temperatures and potentials there."""
        Y = X.copy()
        for rows in (self.u, self.phi, self.theta, self.ln, self.lt):
            size = max(float(np.max(np.abs(X[rows]))), float(np.median(self.scale[rows])) * 1e-6)
            Y[rows] += random.standard_normal(np.shape(rows)) * size * 10 ** random.uniform(-2, 0.5)
        return Y

    def other_solutions(self, X, random, starts):
        other, failed = 0, 0
        for s in range(starts + 1):
            try:
                if s == 0:
                    found = self.by_frozen(X)[0]
                else:
                    found = self.newton(self.random_state(X, random), limit=100)[0]
                other += self.distance(found, X) > 1e-8
            except (Unsettled, RuntimeError):
                failed += 1
        return {"other_starts": starts + 1, "other_solution": int(other), "unsettled": failed}

    def distance(self, A, B):
        difference = np.abs((A - B) / self.scale)[~self.held]
        return float(difference.max() / np.abs(B / self.scale).max())

    def margin(self, X):
        """How far the nearest node is from another status, as a share of the largest traction."""
        delta, d, _, _, p, lt = (a.astype(float) for a in self.local(X))
        values = [np.inf]
        if self.case.normal["law"] == "unilateral":
            values.append(np.min(np.abs(p + self.r * delta)))
        bound = self.coefficients(X)["bound"][0]
        if self.case.friction["law"] != "none":
            y = np.sqrt(((lt + self.r[:, None] * d) ** 2).sum(1))
            carrying = bound > 0
            values.append(np.min(np.abs(y - bound)[carrying], initial=np.inf))
        size = max(np.max(np.abs(p)), np.max(np.abs(lt), initial=0), np.max(np.abs(self.r * delta)) if self.case.normal["law"] == "unilateral" else 0)
        return float(min(values) / size) if size and np.isfinite(min(values)) else None
