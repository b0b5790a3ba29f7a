#!/usr/bin/python3
"""Closed forms of heat and charge through the contact. Run by itself it prints the numbers. Needs nothing but Python.

Signs as in docs/conventions.md: s = sigma_yy (pressure is negative), nu outward, D.nu and q.nu out of the body.
"""
import math

# -- friction heat: a layer 0 < y < L, far side at 0, sliding with v under the pressure p ---------------------------------


def layer_steady(share, mu, p, v, conductivity, length, k_c=0.0, theta_f=0.0):
    """Of the heat share mu p v + k_c (theta_f - theta) that goes in, k theta/L leaves at the far side."""
    return (share * mu * p * v + k_c * theta_f) / (conductivity / length + k_c)


def layer_steps(flux, conductivity, capacity, length, cells, k, k_c=0.0, theta_f=0.0):
    """theta at the contact by backward Euler on linear elements, flux[n] the heat in of the step n [W/m^2]."""
    h = length / cells
    main, side = 2 * capacity * h / 3, capacity * h / 6  # mass
    stiff = conductivity / h
    theta, contact = [0.0] * cells, []  # node 0 at the contact, node `cells` held at 0
    for q in flux:
        old = theta + [0.0]
        right = [side * (old[i - 1] if i else 0) + (main if i else main / 2) * old[i] + side * old[i + 1] for i in range(cells)]
        right[0] += k * (q + k_c * theta_f)
        diagonal = [main + 2 * k * stiff] * cells
        diagonal[0] = main / 2 + k * (stiff + k_c)
        beside = side - k * stiff
        for i in range(1, cells):  # Thomas
            factor = beside / diagonal[i - 1]
            diagonal[i] -= factor * beside
            right[i] -= factor * right[i - 1]
        theta = [0.0] * cells
        for i in reversed(range(cells)):
            theta[i] = (right[i] - (beside * theta[i + 1] if i + 1 < cells else 0)) / diagonal[i]
        contact.append(theta[0])
    return contact


def layer_flux(share, mu, p, v, shear, length, k, steps):
    """Heat in: the slip of the first step is v k less the layer's shear, mu p L/G."""
    return [share * mu * p * (v - (mu * p * length / shear / k if n == 0 else 0.0)) for n in range(steps)]


def half_space(flux, conductivity, capacity, t):
    """theta at the surface, a constant flux since 0 (Carslaw and Jaeger, 2.9)."""
    return 2 * flux * math.sqrt(t / (math.pi * conductivity * capacity))


def half_space_steps(flux, conductivity, capacity, k):
    """The same by backward Euler, exact in space: sqrt(kappa c/k) sum w_(n-j) theta_j = q_n, sum w_j z^j = sqrt(1 - z)
    (docs/exact-solutions.md, 2)."""
    w, theta = [1.0], []
    for n, q in enumerate(flux):
        if n:
            w.append(w[-1] * (n - 1.5) / n)
        theta.append(q / math.sqrt(conductivity * capacity / k) - sum(w[n - j] * theta[j] for j in range(n)))
    return theta


# -- charge: a column 0 < y < h along the poling axis, phi = 0 on top, under s = f eps - e E - m theta -------------------


def column_constants(m):
    """b* = beta + e^2/f, P* = P + e m/f."""
    return m["beta33"] + m["e33"] ** 2 / m["c33"], m["p3"] + m["e33"] * m["m33"] / m["c33"]


def column_potential(m, s, h, c=0.0, phi_f=0.0, theta=0.0):
    """phi at the foot on D.nu = c (phi - phi_f)."""
    b, P = column_constants(m)
    return (c * phi_f - m["e33"] * s / m["c33"] - P * theta) / (c + b / h)


def column_leak(m, s, h, G, k, steps, phi_f=0.0):
    """phi at the foot on d(D.nu)/dt = G (phi - phi_f) by backward Euler, s at once at the first step."""
    b, _ = column_constants(m)
    leaked, phi = 0.0, []
    for _ in range(steps):
        phi.append((-m["e33"] * s / m["c33"] - leaked + k * G * phi_f) / (b / h + k * G))
        leaked += k * G * (phi[-1] - phi_f)
    return phi


# -- Barber's rod --------------------------------------------------------------------------------------------------------


class Rod:
    """0 < x < L, u(0) = T(0) = 0; a foundation of the temperature T_w at the distance g. s = alpha L T(L)/2 - g."""

    def __init__(self, closed=2e-4, open_exchange=None):
        self.L, self.k, self.alpha, self.E, self.capacity, self.T_w, self.g = 0.1, 50.0, 1e-5, 1e11, 5500 * 420.0, 100.0, 2e-5
        self.closed = closed
        self.open = open_exchange or (lambda gap: 200 * max(1 - gap / 4e-5, 0))

    def s(self, T):
        return self.alpha * self.L * T / 2 - self.g

    def exchange(self, T):
        s = self.s(T)
        return 200 + self.closed * self.E * s / self.L if s > 0 else self.open(-s)

    def lack(self, T):
        return self.k * T / self.L - self.exchange(T) * (self.T_w - T)

    def steady(self):
        """All steady T(L) between 0 and T_w."""
        states, n = [], 20000
        for i in range(n):
            a, b = self.T_w * i / n, self.T_w * (i + 1) / n
            if self.lack(a) * self.lack(b) < 0:
                for _ in range(100):
                    c = (a + b) / 2
                    a, b = (a, c) if self.lack(a) * self.lack(c) <= 0 else (c, b)
                states.append((a + b) / 2)
        return states

    def slope(self, T):
        """dh/ds."""
        d = 1e-4
        return (self.exchange(T + d) - self.exchange(T - d)) / (self.alpha * self.L * d)

    def unstable(self, T):
        return (self.T_w - T) * self.slope(T) * self.alpha * self.L ** 2 / 2 > self.k + self.exchange(T) * self.L

    def growth(self, T):
        """The rate r > 0 of disturbances sinh(q x) exp(r t), q^2 = r rho c/k, of an unstable state."""
        def lack(r):
            q = math.sqrt(r * self.capacity / self.k)
            a = q * self.L
            return (self.k * q * math.cosh(a) + self.exchange(T) * math.sinh(a)
                    - (self.T_w - T) * self.slope(T) * self.alpha * (math.cosh(a) - 1) / q)
        low, high = 1e-9, 1.0
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if lack(middle) < 0 else (low, middle)
        return (low + high) / 2


BATIO3 = dict(c33=1.62e11, e33=18.6, beta33=1.26e-8, m33=1.89e6, p3=-1e-4)


def main():
    print("sliding layers, steady:", layer_steady(0.5, 0.3, 1e8, 1e-4, 50, 0.01), layer_steady(0.3, 0.3, 1e8, 1e-4, 50, 0.01, 5e3, 2))
    q = 0.5 * 0.3 * 1e6 * 1e-2
    print("half-space at 1 s:", half_space(q, 50, 5500 * 420, 1), "20 steps of backward Euler:", half_space_steps([q] * 20, 50, 5500 * 420, 0.05)[-1])
    for c in (0, 1e-7, 1e-6):
        print(f"column on a capacitor of {c:g} F/m^2: {column_potential(BATIO3, -1e6, 0.1, c):.12g} V")
    print("column that leaks, 8 steps:", column_leak(BATIO3, -1e6, 0.1, 5e-7, 0.125, 8))
    for name, rod in (("benchmarks.md", Rod(open_exchange=lambda gap: 200 / (1 + gap / 2e-6))), ("ramp of 4e-5 m", Rod())):
        states = rod.steady()
        print(f"Barber's rod, {name}:", *(f"{T:.12g} " + (f"unstable, growth {rod.growth(T):.8g} 1/s" if rod.unstable(T) else "stable")
                                        for T in states), sep="\n   ")


if __name__ == "__main__":
    main()
