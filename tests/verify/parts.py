#!/usr/bin/env python3
"""Tests of what verify.py computes without the program."""
import unittest

import corner
import exact_cases
import extrapolation
import page


def isotropic(poisson_ratio):
    """A body without couplings, Young's modulus 1 + nu; a little anisotropy keeps its three p apart."""
    shear, lame = 0.5, poisson_ratio / (1 - 2 * poisson_ratio)
    return {"c11": lame + 2.0002 * shear, "c33": lame + 2 * shear, "c13": lame, "c44": 1.0001 * shear,
            "e31": 0, "e33": 0, "e15": 1e-9, "beta11": 1e-8, "beta33": 1.01e-8}


class Corner(unittest.TestCase):
    def test_clamped_free_right_angle_of_an_isotropic_body_has_the_exponent_of_williams(self):
        # M. L. Williams (1952): sin^2(s w) = (4 (1 - nu)^2 - s^2 sin^2 w)/(3 - 4 nu), w = pi/2, nu = 0.3.
        sides = [(corner.BOTTOM, corner.FREE), (corner.CONTACT, corner.CLAMPED)]
        found = corner.exponents(sides, constants=isotropic(0.3))
        self.assertEqual(len(found), 1)
        self.assertAlmostEqual(found[0], 0.71117, places=3)

    def test_free_and_roller_corners_are_regular(self):
        for kind in (corner.FREE, corner.ROLLER):
            self.assertEqual(corner.exponents([(corner.BOTTOM, corner.FREE), (corner.CONTACT, kind)]), [])

    def test_null_vectors_solve_the_pencil(self):
        q, r, t = corner.blocks(corner.scaled(corner.CONSTANTS))
        for p, a, _ in corner.modes(corner.CONSTANTS):
            for row in corner.pencil(q, r, t, p):
                self.assertLess(abs(sum(x * y for x, y in zip(row, a))), 1e-10)

    def test_a_singular_consistent_system_is_solved(self):
        rows, right = [[1.0, 2.0, 0.0], [2.0, 4.0, 0.0], [0.0, 1.0, 1.0]], [3.0, 6.0, 2.0]
        x = corner.solve_consistent(rows, right)
        for row, value in zip(rows, right):
            self.assertAlmostEqual(sum(a * b for a, b in zip(row, x)), value)


class Extrapolation(unittest.TestCase):
    def test_a_geometric_approach_is_extrapolated_exactly_and_its_order_found(self):
        limit = extrapolation.limit([7 + 3 * 4.0 ** -k for k in range(4)])
        self.assertAlmostEqual(limit.value, 7)
        self.assertAlmostEqual(limit.order, 2)

    def test_the_bar_holds_the_limit_of_a_mixture_of_orders(self):
        limit = extrapolation.limit([1 + 2.0 ** -k + 4.0 ** -k for k in range(6)])
        self.assertLess(abs(limit.value - 1), limit.bar)

    def test_without_a_trend_there_is_no_extrapolation(self):
        limit = extrapolation.limit([1.0, 1.2, 1.1])
        self.assertEqual((limit.value, limit.order), (1.1, None))
        self.assertAlmostEqual(limit.bar, 0.2)

    def test_growth_of_a_power_beside_a_constant_is_found_from_differences(self):
        values = [5 + 2.0 ** (0.3 * k) for k in range(6)]
        self.assertAlmostEqual(extrapolation.growth(values)[1], 0.3)


class ExactCases(unittest.TestCase):
    def test_backward_euler_of_the_half_space_tends_to_the_closed_form(self):
        errors = [exact_cases.cooled_in_steps(n) - exact_cases.cooled(1) for n in (100, 200)]
        self.assertAlmostEqual(errors[0] / errors[1], 2, places=2)

    def test_the_plate_turns_at_odd_seconds(self):
        self.assertEqual([round(exact_cases.plate(t) * 1e11) for t in (0, 1, 2, 3, 4, 5)], [0, 3, 0, -3, 0, 3])


class Page(unittest.TestCase):
    def test_error_bars_are_rounded_up_and_fix_the_digits(self):
        self.assertEqual(page.with_error_bar(0.065047, 0.000021), "0.06505 ± 0.00003")
        self.assertEqual(page.with_error_bar(-1.257412e-3, 6.1e-8), "(−1.25741 ± 0.00007)e-3")
        self.assertEqual(page.with_error_bar(3.5, 0), "3.5")


if __name__ == "__main__":
    unittest.main()
