"""The contact laws, each by its statement: a number in, a number out. Lengths in m, pressures in N/m^2."""
import math


class Normal:
    """delta = u_nu - u_f.nu - g, positive when pressed in; p >= 0 is pressure."""

    def __init__(self, table, k):
        self.law, self.k = table["law"], k
        self.c, self.m = table.get("coefficient"), table.get("exponent", 1)

    @property
    def rigid(self):
        return self.law in ("bilateral", "unilateral")

    def pressure(self, delta, before):
        """p and dp/ddelta of the laws that are functions; before: delta at the end of the step before."""
        if self.law == "compliance":
            return (self.c * delta**self.m, self.c * self.m * delta**(self.m - 1)) if delta > 0 else (0.0, 0.0)
        advance = delta - max(before, 0.0)
        return (self.c / self.k * advance, self.c / self.k) if advance > 0 else (0.0, 0.0)


class Friction:
    """Bound on the size of the tangential traction of a closed node."""

    def __init__(self, table, k):
        self.law, self.k = table["law"], k
        self.table = table

    def coefficient(self, d, s0):
        """mu and dmu/d|d|; d the size of the slip increment, s0 the slip accumulated before the step."""
        mu = self.table["coefficient"]
        if not isinstance(mu, dict):
            return mu, 0.0
        speed = mu["speed"] * self.k if "speed" in mu else mu["distance"]
        fade = math.exp(-(d if "speed" in mu else s0 + d) / speed)
        drop = (mu["static"] - mu["kinetic"]) * fade
        return mu["kinetic"] + drop, -drop / speed

    def bound(self, p, d, s0):
        """Bound and its derivatives by p and by |d|."""
        if self.law == "none":
            return 0.0, 0.0, 0.0
        if self.law == "tresca":
            return self.table["bound"], 0.0, 0.0
        mu, slope = self.coefficient(d, s0)
        value, limit = self.table.get("cohesion", 0.0) + mu * p, self.table.get("limit", math.inf)
        if value >= limit:
            return limit, 0.0, 0.0
        return (value, mu, slope * p) if value > 0 else (0.0, 0.0, 0.0)
