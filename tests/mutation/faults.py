#!/usr/bin/env python3
"""Tests that seed.py can seed every fault of faults.toml in the sources as they are, without building any."""
import fnmatch
import re
import unittest

import seed


def suites_of(room):
    """Names of its suites of tests, of those with parameters as prefix/suite too."""
    text = "".join(file.read_text() for file in sorted((seed.ROOT / "tests" / room).glob("*.cc")))
    plain = set(re.findall(r"^TEST(?:_F|_P)?\((\w+),", text, re.M))
    return plain | {"/".join(names) for names in re.findall(r"^INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+),", text, re.M)}


class Faults(unittest.TestCase):
    def setUp(self):
        self.faults = seed.listed()

    def test_each_stands_once_in_a_source_and_has_a_room_of_tests(self):
        for fault in self.faults:
            with self.subTest(fault["wrong"]):
                self.assertIsNone(seed.complaint_of(fault))

    def test_each_changes_something_and_says_what_is_wrong_then(self):
        for fault in self.faults:
            with self.subTest(fault["text"]):
                self.assertEqual(set(fault) - {"begin"}, {"file", "text", "seeded", "wrong"})
                self.assertNotEqual(fault["text"], fault["seeded"])

    def test_tests_to_begin_with_are_there(self):
        for fault in self.faults:
            for pattern in fault.get("begin", "").split()[1:]:
                room = fault["begin"].split()[0]
                for suite in (part.split(".")[0] for part in pattern.split(":")):
                    with self.subTest(fault["begin"]):
                        self.assertTrue(fnmatch.filter(suites_of(room), suite), f"tests of {room} have no {suite}")


class Complaints(unittest.TestCase):
    """Of what would be no fault."""

    def test_name_what_cannot_be_seeded(self):
        sound = next(fault for fault in seed.listed() if fault["file"] == "contact/tresca.cc")
        self.assertIsNone(seed.complaint_of(sound))
        for change, part in [({"text": "no such line"}, "is 0 times in src/contact/tresca.cc"),
                             ({"text": "return"}, "times in src/contact/tresca.cc, and must be there once"),
                             ({"file": "contact/tresca.h"}, "is no source"),
                             ({"file": "contact/gone.cc"}, "is no source"),
                             ({"begin": "nowhere Tresca.*"}, "no tests of nowhere")]:
            self.assertIn(part, seed.complaint_of({**sound, **change}))


if __name__ == "__main__":
    unittest.main()
