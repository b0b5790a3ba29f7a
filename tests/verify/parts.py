#!/usr/bin/env python3
"""Tests of what verify.py computes without the program."""
import contextlib
import io
import pathlib
import tempfile
import unittest
import unittest.mock

import comparison
import corner
import exact_cases
import extrapolation
import monolithic
import page
import runs
import verify
from tolerance import Absolute, Bar, Count, Error, Relative, Same, Tolerance


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


class Tolerances(unittest.TestCase):
    def test_each_kind_holds_up_to_its_size_and_no_further(self):
        for kind, before, near, far in [
                (Same(), "340 of 340", "340 of 340", "339 of 340"),
                (Relative(1e-3), "−1.000e-07", "−1.0009e-07", "−1.002e-07"),
                (Relative(1e-3), "0.06 V", "0.06 V", "none"),
                (Relative(1e-3), "none", "none", "0.5"),
                (Absolute(0.05), "1.98", "2.02", "2.04"),
                (Error(1e-12), "5.7e-16", "9.9e-13", "1.1e-12"),
                (Error(1e-12), "2.2e-06", "3.3e-06", "3.4e-06"),
                (Error(1e-12), "0", "0", "nan"),
                (Bar(), "(−1.25741 ± 0.00007)e-3", "(−1.25753 ± 0.00006)e-3", "(−1.25755 ± 0.00006)e-3"),
                (Bar(), "0.065043 ± 0.000007", "0.0650 ± 0.0001", "0.06506 ± 0.000001"),
                (Count(0.1), "60 to 64 (5)", "72 (5 to 6)", "60 to 64 (9)"),
                (Count(0.1), "60 to 64 (5)", "52 (5)", "20 (5)")]:
            self.assertTrue(kind.holds(before, near), (kind.words, before, near))
            self.assertFalse(kind.holds(before, far), (kind.words, before, far))

    def test_rows_come_before_columns(self):
        tolerance = Tolerance(Same(), {"b": Absolute(1)}, {"order": Absolute(2)})
        kinds = [tolerance.of("order", "b"), tolerance.of("16", "b"), tolerance.of("16", "a")]
        self.assertEqual([kind.words for kind in kinds], ["to 2", "to 1", "exactly"])


MESHES = Tolerance(Relative(1e-6), {"u": Error(1e-12)}, {"converged": Bar()}, finest=["converged"])


def measured(rows, tolerance=MESHES):
    document = page.Page("abc1234")
    document.add("# Page\n\n## Meshes, uniform", (["n", "φ [V]", "u"], rows, tolerance), "### Other",
                 (["case", "quantity", "exact"], [["a", "x", 1], ["a", "y", 2]], Tolerance(Same())))
    return document


ROWS = [[16, "−1.289052e-05", "1.0e-15"], [32, "−1.467448e-05", "2.0e-15"], ["converged", "(−1.78 ± 0.05)e-5", "0"]]


class Comparison(unittest.TestCase):
    def moved(self, rows, same_finest=True, before=ROWS):
        return list(comparison.compare(measured(before).text(), measured(rows).tables, same_finest))

    def test_a_page_agrees_with_what_it_was_written_from(self):
        self.assertEqual(self.moved(ROWS), [])

    def test_what_moved_is_named_with_its_place_both_numbers_and_what_is_allowed(self):
        rows = [ROWS[0], [32, "−1.467548e-05", "2.0e-15"], ROWS[2]]
        self.assertEqual(self.moved(rows), ["Meshes, uniform, table 1, 32, φ [V]: was −1.467448e-05, is −1.467548e-05; "
                                            "allowed: to 1e-06 of itself"])

    def test_each_single_number_is_compared(self):
        for i, j in ((i, j) for i in range(3) for j in (1, 2)):
            rows = [list(row) for row in ROWS]
            rows[i][j] = "1"
            self.assertEqual(len(self.moved(rows)), 1, (i, j))

    def test_errors_may_change_below_their_limit(self):
        self.assertEqual(self.moved([[16, ROWS[0][1], "9.0e-13"], *ROWS[1:]]), [])

    def test_rows_that_are_missing_or_new_are_named(self):
        self.assertEqual(self.moved(ROWS[1:]), ["Meshes, uniform, table 1, 16: was not measured"])
        self.assertEqual(self.moved(ROWS, before=ROWS[1:]), ["Meshes, uniform, table 1, 16: is not in the page"])

    def test_a_coarser_measurement_is_compared_as_far_as_it_goes(self):
        self.assertEqual(self.moved([ROWS[0], ["converged", "(−1.5 ± 0.01)e-5", "0"]], same_finest=False), [])
        self.assertEqual(len(self.moved([[16, "−1.3e-05", "0"], ROWS[2]], same_finest=False)), 1)

    def test_tables_that_are_missing_are_named(self):
        less = page.Page("abc1234")
        less.add("## Meshes, uniform", (["n", "φ [V]", "u"], ROWS, MESHES))
        self.assertEqual(list(comparison.compare(measured(ROWS).text(), less.tables)), ["Other, table 1: was not measured"])
        self.assertEqual(list(comparison.compare(less.text(), measured(ROWS).tables)), ["Other, table 1: is not in the page"])


class Verify(unittest.TestCase):
    """The command as a whole, with a program that answers what it is told."""

    def outcome(self, rows, *options):
        with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as patches:
            docs = pathlib.Path(folder)
            (docs / "verification.md").write_text(measured(ROWS).text())
            (docs / "monolithic.md").write_text(f"# By hand\n\n{monolithic.HEADING}\n")
            for name, value in {"DOCS": docs, "verification": lambda *_: measured(rows),
                                "own_iteration": lambda *_: page.Page("abc1234")}.items():
                patches.enter_context(unittest.mock.patch.object(verify, name, value))
            patches.enter_context(unittest.mock.patch("sys.argv", ["verify.py", "--commit", "abc1234", *options]))
            said = patches.enter_context(contextlib.redirect_stderr(io.StringIO()))
            patches.enter_context(contextlib.redirect_stdout(io.StringIO()))
            return verify.main(), said.getvalue(), (docs / "verification.md").read_text()

    def test_it_succeeds_when_nothing_moved(self):
        self.assertEqual(self.outcome(ROWS)[:2], (0, ""))

    def test_it_fails_and_names_the_number_that_moved_and_leaves_the_page(self):
        status, said, left = self.outcome([[16, "−1.3e-05", "0"], *ROWS[1:]])
        self.assertEqual((status, left), (1, measured(ROWS).text()))
        self.assertIn("docs/verification.md: Meshes, uniform, table 1, 16, φ [V]: was −1.289052e-05, is −1.3e-05", said)

    def test_it_writes_the_page_when_asked_and_still_names_what_moved(self):
        rows = [[16, "−1.3e-05", "0"], *ROWS[1:]]
        status, said, left = self.outcome(rows, "--write")
        self.assertEqual((status, left), (0, measured(rows).text()))
        self.assertIn("is −1.3e-05", said)


class Pages(unittest.TestCase):
    def test_every_measured_table_names_its_state_and_its_tolerance(self):
        for name, start in {"verification.md": "", "monolithic.md": monolithic.HEADING}.items():
            text = (runs.ROOT / "docs" / name).read_text()
            text = text[text.index(start):]
            captions = [line for line in text.splitlines() if line.startswith("*State ")]
            self.assertGreater(len(captions), 2, name)
            self.assertEqual(len(captions), len(comparison.read_tables(text)), name)
            for caption in captions:
                self.assertRegex(caption, r"^\*State [0-9a-f]{7,}( with changes)?\. May move: .+\.\*$")


if __name__ == "__main__":
    unittest.main()
