#!/usr/bin/env python3
"""Tests of docs/check-equation-map: the table as it stands passes, and whatever is taken from it is missed."""
import functools
import importlib.machinery
import importlib.util
import pathlib
import re
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
loader = importlib.machinery.SourceFileLoader("checker", str(DOCS / "check-equation-map"))
checker = importlib.util.module_from_spec(importlib.util.spec_from_loader("checker", loader))
loader.exec_module(checker)


def replaced(page, number, column, text):
    """The page with another cell in a row."""
    row = re.search(rf"^\| \({number}\) \|.*$", page, re.M)[0]
    cells = row.split("|")
    cells[column] = f" {text} "
    return page.replace(row, "|".join(cells))


class EquationMap(unittest.TestCase):
    def setUp(self):
        self.page = (DOCS / "equations.md").read_text()

    @functools.lru_cache
    def complaints(self, page):
        return "\n".join(checker.complaints(page))

    def refused(self, page, words):
        self.assertIn(words, self.complaints(page))

    def test_it_holds(self):
        self.assertEqual(list(checker.complaints(self.page)), [])

    def test_a_row_without_a_test_is_refused_whichever_it_is(self):
        for nothing in ("", "by inspection", "`tests/contact/tresca.cc`"):
            page = self.page
            for number in checker.EQUATIONS:
                page = replaced(page, number, 5, nothing)
            for number in checker.EQUATIONS:
                self.refused(page, f"({number}): names no test")

    def test_a_test_that_is_not_there_is_refused(self):
        self.refused(replaced(self.page, 9, 5, "`tests/contact/tresca.cc`: `Tresca.Holds`"), "holds no test Tresca.Holds")
        self.refused(replaced(self.page, 9, 5, "`Tresca.TheTractionOpposesTheSlip`"), "no file before")

    def test_missing_rows_files_and_names_are_refused(self):
        self.refused(re.sub(r"^\| \(43\).*\n", "", self.page, flags=re.M), "(43): 0 rows")
        self.refused(replaced(self.page, 43, 3, "`src/solve/nothing.cc`"), "there is no file src/solve/nothing.cc")
        self.refused(replaced(self.page, 43, 4, "`nobody`"), "no file of the row holds nobody")


if __name__ == "__main__":
    unittest.main()
