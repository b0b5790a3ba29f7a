#!/usr/bin/env python3
"""Tests of docs/case.schema.json with a JSON Schema validator that is not ours: Debian's python3-jsonschema."""
import copy
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import tomllib
import unittest

import jsonschema

PROGRAM = sys.argv.pop(1)
SOURCE = pathlib.Path(__file__).resolve().parents[2]
SHIPPED = sorted((SOURCE / "cases").rglob("*.toml"))

# Whole cases, each small; wrong and right ones differ from them in one place.
SQUARE = """
mesh.box = { min = [0, 0], max = [1, 1], cells = [4, 4] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
boundary = [{ on = "right", displacement = [0, 0], potential = 0 }]
contact = { on = "left", friction = { law = "tresca", bound = 15 } }
"""
CUBE = """
mesh.box = { min = [0, 0, 0], max = [1, 1, 1], cells = [2, 2, 2], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
boundary = [{ on = "bottom", displacement = [0, 0, 0], potential = 0 }]
"""
TUBE = """
mesh.annulus = { inner = 0.1, outer = 0.2, height = 0.1, cells = [2, 16, 2], cell = "tetrahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
boundary = [{ on = "outer", displacement = [0, 0, 0], potential = 0 }]
contact.on = "inner"
"""
LAYERS = """
mesh.box = { min = [0, 0], max = [1, 1], cells = [4, 4] }
region = [{ where = "y < 0.5", material = { library = "BaTiO3-Liu2014" } },
          { where = "y > 0.5", material = { library = "steel", poling = [1, 0] } }]
time = { end = 1, steps = 2 }
boundary = [{ on = "right", displacement = [0, 0], potential = 0 }]
"""

# Wants nothing of a library, so that each of its constants may be changed.
PLAIN = """
mesh.box = { min = [0, 0], max = [1, 1], cells = [4, 4] }
time = { end = 1, steps = 2 }
material = { symmetry = "isotropic", young = 1, poisson = 0.3, beta11 = 1, k11 = 1, density = 1, specific_heat = 1, reference_temperature = 1 }
boundary = [{ on = "right", displacement = [0, 0], potential = 0, temperature = 0 }, { on = "top" }]
electrode = [{ name = "plate", on = "bottom", voltage = 1 }]
contact = { on = "left", friction = {}, heat = {} }
load = {}
initial = {}
solver = {}
output = {}
"""
JAWS = PLAIN.replace('contact = { on = "left", friction = {}, heat = {} }',
                     'contact = [{ on = "left", friction = {} }, { on = "right", heat = {} }]').replace(
                         "displacement = [0, 0], ", "")

# A table that may also be given as a value comes in all its forms.
TRESCA = 'law = "tresca", bound = 15'
COULOMB = 'law = "coulomb", coefficient = '
CONTACT = 'contact = { on = "left", friction = { law = "tresca", bound = 15 } }'


def contacts(*others):
    """Beside the one of the square."""
    return "contact = [" + ", ".join([CONTACT.removeprefix("contact = "), *others]) + "]"


# A text that stands in the case, and what stands there instead.
RIGHT = [
    (SQUARE, "end = 1, steps = 2", "interval = [{ until = 0.1, steps = 2 }, { until = 1, steps = 2 }]"),
    (SQUARE, "steps = 2", 'steps = 2, regime = "static"'),
    (SQUARE, "potential = 0 }", "potential = 0 }, { on = 'top', traction = [0, { points = [[0, 1], [1, 2.5]] }] }"),
    (SQUARE, "potential = 0", "potential = { points = [[0, 1], [1, 2.5]] }"),
    (SQUARE, "", ""), (CUBE, "", ""), (TUBE, "", ""), (LAYERS, "", ""),
    (SQUARE, "bound = 15", 'bound = "15*(1 + x)"'),
    (SQUARE, 'law = "tresca", bound = 15', 'law = "none"'),
    (SQUARE, 'law = "tresca", bound = 15', ""),
    (SQUARE, 'on = "left"', 'on = ["bottom", "top"]'),
    (SQUARE, "displacement = [0, 0]", 'displacement = ["free", "1e-9*t"], temperature = 0'),
    (SQUARE, "cells = [4, 4]", 'cells = [4, 4], cell = "quadrilateral", grading = { left = 3, top = 2.5 }'),
    (CUBE, 'cell = "hexahedron"', 'cell = "hexahedron", grading = { front = 3 }'),
    (SQUARE, '"BaTiO3-Liu2014"', '"BaTiO3-Liu2014"\nmaterial.pyroelectric = [0, 1e-4]'),
    (CUBE, '"BaTiO3-Liu2014"', '"BaTiO3-Liu2014"\nmaterial.pyroelectric = [0, 0, 1e-4]'),
    (CUBE, '"BaTiO3-Liu2014"', '"BaTiO3-Liu2014"\nmaterial.poling = ["x", "y", 1]\nmaterial.axis1 = [1, 0, 0]'),
    (SQUARE, "time =", 'solver = { method = "monolithic", multiplier = "piecewise-constant", r_normal = 1e9 }\ntime ='),
    (SQUARE, "time =", 'solver = { body = "direct", threads = 2 }\ntime ='),
    (SQUARE, "time =", "initial = { displacement = [0, 0], temperature = 1 }\nload = { force = [0, 1] }\ntime ="),
    (SQUARE, "time =", 'electrode = [{ name = "lead", on = "top", resistor = 1e9, voltage = "t" }]\ntime ='),
    (SQUARE, 'on = "left",', 'on = "left", normal = "unilateral", gap = "1e-6*y", foundation_displacement = [0, "t"],'),
    (SQUARE, 'on = "left",', 'on = "left", normal = { law = "unilateral" },'),
    (SQUARE, 'on = "left",', 'on = "left", normal = {},'),
    (SQUARE, 'on = "left",', 'on = "left", normal = { law = "compliance", coefficient = "1e13*(1 + y)", exponent = 1.5 },'),
    (SQUARE, 'on = "left",', 'on = "left", normal = { law = "damped", coefficient = 1e9 },'),
    (SQUARE, TRESCA, COULOMB + "0.3"),
    (SQUARE, TRESCA, COULOMB + '"0.3*t", cohesion = 1, limit = "2 + y"'),
    (SQUARE, TRESCA, COULOMB + "{ value = 0.3 }"),
    (SQUARE, TRESCA, COULOMB + '{ static = "0.3 + y", kinetic = 0.2, speed = 1e-3 }'),
    (SQUARE, TRESCA, COULOMB + "{ static = 0.3, kinetic = 0.2, distance = 1e-6 }"),
    (SQUARE, "time =", "output = { fields = false, every = 3, report = false }\nregion = []\ntime ="),
    (SQUARE, CONTACT, contacts()),
    (SQUARE, CONTACT, contacts('{ name = "jaw_2", on = ["bottom"], normal = "unilateral", foundation_displacement = [0, 1], '
                               'friction = { law = "coulomb", coefficient = 0.3 } }')),
    (SQUARE, CONTACT, contacts('{ on = "bottom", normal = { law = "damped", coefficient = 1 } }', '{ on = "top", heat = { '
                               'law = "exchange", coefficient = 1, foundation_temperature = "t" } }')),
]
WRONG = {
    "steps beside intervals": (SQUARE, "steps = 2", "steps = 2, interval = [{ until = 1, steps = 2 }]"),
    "interval without steps": (SQUARE, "end = 1, steps = 2", "interval = [{ until = 1 }]"),
    "regime that is none": (SQUARE, "steps = 2", 'steps = 2, regime = "stationary"'),
    "point without a value": (SQUARE, "potential = 0", "potential = { points = [[0, 1], [1]] }"),
    "table and points": (SQUARE, "potential = 0", 'potential = { table = "a.csv", points = [[0, 1], [1, 2]] }'),
    "table of what does not change": (SQUARE, "time =", "initial.potential = { points = [[0, 1], [1, 2]] }\ntime ="),
    "no contact in a list": (SQUARE, CONTACT, "contact = []"),
    "contact without a boundary": (SQUARE, CONTACT, contacts("{}")),
    "name that is no text": (SQUARE, CONTACT, contacts('{ on = "bottom", name = 3 }')),
    "unknown key of the second contact": (SQUARE, CONTACT, contacts('{ on = "bottom", gpa = 3 }')),
    "law of the second contact without its constant": (SQUARE, CONTACT, contacts('{ on = "bottom", friction.law = "tresca" }')),
    "constant of another law at the second contact": (SQUARE, CONTACT, contacts('{ on = "bottom", friction = { law = "coulomb", coefficient = 1, bound = 3 } }')),
    "three entries of the second foundation in two dimensions": (SQUARE, CONTACT, contacts('{ on = "bottom", foundation_displacement = [0, 0, 0] }')),
    "text among contacts": (SQUARE, CONTACT, contacts('"bottom"')),
    "unknown key": (SQUARE, "bound = 15", "bound = 15, bonud = 15"),
    "unknown table": (SQUARE, "time =", "solvr = {}\ntime ="),
    "missing key": (SQUARE, "end = 1, ", ""),
    "missing table": (SQUARE, "time = { end = 1, steps = 2 }", ""),
    "text for a number": (SQUARE, "end = 1", 'end = "1"'),
    "number for a text": (SQUARE, "time =", "title = 1\ntime ="),
    "fraction for an integer": (SQUARE, "steps = 2", "steps = 2.5"),
    "truth for a formula": (SQUARE, "potential = 0", "potential = true"),
    "number below its range": (SQUARE, "bound = 15", "bound = -15"),
    "number at the open end of its range": (SQUARE, "end = 1", "end = 0"),
    "number above its range": (SQUARE, "cells = [4, 4]", "cells = [4, 4] }\nmesh.degree = 3 #"),
    "integer that does not fit": (SQUARE, "steps = 2", "steps = 3000000000"),
    "wrong choice": (SQUARE, "tresca", "treska"),
    "law that is a key": (SQUARE, "bound = 15 }", 'bound = 15 }, heat = { law = "frictional_heating" }'),
    "law alone that needs a constant": (SQUARE, 'on = "left",', 'on = "left", normal = "damped",'),
    "law in its table without its constant": (SQUARE, 'on = "left",', 'on = "left", normal = { law = "compliance" },'),
    "number for a law": (SQUARE, 'on = "left",', 'on = "left", normal = 1,'),
    "constant of another normal law": (SQUARE, 'on = "left",', 'on = "left", normal = { coefficient = 1 },'),
    "exponent below 1": (SQUARE, 'on = "left",', 'on = "left", normal = { law = "compliance", coefficient = 1, exponent = 0.5 },'),
    "exponent of the damped response": (SQUARE, 'on = "left",', 'on = "left", normal = { law = "damped", coefficient = 1, exponent = 2 },'),
    "three entries of a foundation in two dimensions": (SQUARE, 'on = "left",', 'on = "left", foundation_displacement = [0, 0, 0],'),
    "Coulomb's law without coefficient": (SQUARE, TRESCA, 'law = "coulomb"'),
    "coefficient of another friction law": (SQUARE, TRESCA, TRESCA + ", coefficient = 0.3"),
    "bound of another friction law": (SQUARE, TRESCA, COULOMB + "0.3, bound = 15"),
    "negative coefficient": (SQUARE, TRESCA, COULOMB + "-0.3"),
    "coefficient of nothing": (SQUARE, TRESCA, COULOMB + "{}"),
    "kinetic without static": (SQUARE, TRESCA, COULOMB + "{ kinetic = 0.2, speed = 1 }"),
    "static without kinetic": (SQUARE, TRESCA, COULOMB + "{ static = 0.2, speed = 1 }"),
    "neither speed nor distance": (SQUARE, TRESCA, COULOMB + "{ static = 0.4, kinetic = 0.2 }"),
    "both speed and distance": (SQUARE, TRESCA, COULOMB + "{ static = 0.4, kinetic = 0.2, speed = 1, distance = 1 }"),
    "value beside static": (SQUARE, TRESCA, COULOMB + "{ value = 0.3, static = 0.4 }"),
    "charge law of a later version": (SQUARE, 'on = "left",', 'on = "left", charge = {},'),
    "too short a list": (SQUARE, "min = [0, 0]", "min = [0]"),
    "three displacements in two dimensions": (SQUARE, "displacement = [0, 0]", "displacement = [0, 0, 0]"),
    "two displacements in three dimensions": (CUBE, "displacement = [0, 0, 0]", "displacement = [0, 0]"),
    "two corners' coordinates of a cuboid": (CUBE, "max = [1, 1, 1]", "max = [1, 1]"),
    "side that a rectangle lacks": (SQUARE, 'on = "left"', 'on = "front"'),
    "side of another shape": (TUBE, 'on = "inner"', 'on = "left"'),
    "grading of a side that a rectangle lacks": (SQUARE, "cells = [4, 4]", "cells = [4, 4], grading = { front = 2 }"),
    "one side twice": (SQUARE, 'on = "left"', 'on = ["left", "left"]'),
    "no side": (SQUARE, 'on = "left"', "on = []"),
    "bound without the law": (SQUARE, 'law = "tresca", ', ""),
    "law without its bound": (SQUARE, ", bound = 15", ""),
    "exchange without its coefficient": (SQUARE, "bound = 15 }", 'bound = 15 }, heat = { law = "exchange" }'),
    "coefficient without the exchange": (SQUARE, "bound = 15 }", "bound = 15 }, heat = { coefficient = 1 }"),
    "height of a ring": (TUBE, "tetrahedron", "triangle"),
    "tube without height": (TUBE, "height = 0.1, ", ""),
    "resistor that nobody has": (SQUARE, "time =", 'electrode = [{ name = "a", on = "top", resistor = 5e-324 }]\ntime ='),
    "constant that no material has": (SQUARE, "time =", "material.e31 = 1e200\ntime ="),
    "time that has not begun": (SQUARE, "end = 1", "end = 3e-310"),
    "load of another universe": (SQUARE, "potential = 0", "potential = 1e200"),
    "no mesh": (SQUARE, "mesh.box = { min = [0, 0], max = [1, 1], cells = [4, 4] }", "mesh.degree = 1"),
    "two meshes": (SQUARE, "material.", "mesh.annulus = { inner = 1, outer = 2, cells = [2, 16] }\nmaterial."),
    "mesh file beside a box": (SQUARE, "material.", 'mesh.file = "a.msh"\nmaterial.'),
    "size without a mesh file": (SQUARE, "material.", "mesh.size = 1\nmaterial."),
    "no material": (SQUARE, 'material.library = "BaTiO3-Liu2014"', ""),
    "material beside regions": (LAYERS, "time =", 'material.library = "steel"\ntime ='),
    "region without place": (LAYERS, 'where = "y < 0.5", ', ""),
    "region without material": (LAYERS, ', material = { library = "BaTiO3-Liu2014" }', ""),
    "named region of a box": (LAYERS, 'where = "y < 0.5"', 'on = "lower"'),
    "file of materials without entry": (SQUARE, 'material.library = "BaTiO3-Liu2014"', 'material.file = "own.toml"'),
    "multiplier of the other method": (SQUARE, "time =", 'solver.multiplier = "nodal"\ntime ='),
    "tolerance of what is not iterative": (SQUARE, "time =", 'solver = { body = "direct", linear_tolerance = 1e-9 }\ntime ='),
    "too few rows": (SQUARE, "time =", "material.conductivity = [[1, 0, 0], [0, 1, 0]]\ntime ="),
    "table for an array of tables": (SQUARE, "[{ on = \"right\", displacement = [0, 0], potential = 0 }]", '{ on = "right" }'),
    "value for a table": (SQUARE, "time = { end = 1, steps = 2 }", "time = 1"),
}


def changed(case, before, after):
    assert before in case, before
    return case.replace(before, after, 1)


def toml(value):
    """A value as TOML, tables on one line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value) if isinstance(value, (str, bool)) else repr(value)


def random_number(rng, schema):
    """Mostly one that the schema allows, of any size; sometimes a limit, or what lies beyond."""
    low = schema.get("minimum", schema.get("exclusiveMinimum", -1e30))
    high = schema.get("maximum", schema.get("exclusiveMaximum", 1e30))
    if rng.random() < 0.15:
        return rng.choice([low, high, 0.0, low * 2 - 1, high * 2 + 1, 1e-320, 1e308])
    smallest = max(abs(low) if low > 0 else 1e-20, 1e-30)
    size = smallest * (max(abs(high), smallest) / smallest) ** rng.random()
    return -size if low < 0 and rng.random() < 0.5 else size


def random_value(rng, schema):
    """A value for a key, from what its declaration says."""
    if "anyOf" in schema:
        return random_value(rng, rng.choice(schema["anyOf"]))
    if schema.get("$ref", "").endswith("number_with_unit"):
        return rng.choice(["2 mm", "5 kPa", "1e3 V", "-.5 N/mm2", "27 degC", "3 apples", "4e", "5*t"])
    if "$ref" in schema:  # values over time
        return {"points": [[0, rng.choice([0, 1, -1e6])], [rng.choice([0, 1, 2]), 1]]}
    if "enum" in schema:
        return rng.choice(schema["enum"]) if rng.random() < 0.9 else rng.choice([1, "no such choice"])
    kind = schema["type"]
    if kind == "array":
        least = schema.get("minItems", 1)
        length = rng.randint(least, max(least, schema.get("maxItems", 3))) + (rng.random() < 0.05)
        return [random_value(rng, schema["items"]) for _ in range(length)]
    if kind == "integer":
        return rng.choice([1, 2, 3, 8, 1, 2, 3, 8, -1, 0, 2.0, 3000000000])
    if kind == "object":
        names = [name for name, inner in schema["properties"].items() if inner is not False]
        given = rng.sample(names, rng.randint(0, len(names)))
        return {name: random_value(rng, schema["properties"][name]) for name in given}
    if kind == "number":
        return random_number(rng, schema)
    return rng.choice(["0.5*t", "x", "left", "2", "steel"]) if kind == "string" else rng.choice([True, False, 0])


def keys_of(schema, table):
    """Every key that the table and those inside it may have, with where it goes."""
    for name, inner in schema.get("properties", {}).items():
        if inner is False or name in ("file", "library"):  # a random name is that of nothing
            continue
        if inner.get("type") == ["object", "array"]:  # one table, or several
            several = isinstance(table.get(name), list)
            for entry in table[name] if several else [table[name]] if name in table else []:
                yield from keys_of(inner["items"] if several else inner, entry)
        elif inner.get("type") == "object":
            if name in table:
                yield from keys_of(inner, table[name])
        elif inner.get("items", {}).get("type") == "object":
            for entry in table.get(name, []):
                yield from keys_of(inner["items"], entry)
        else:
            yield table, name, inner


def random_case(rng, schema):
    """A small case with one or two keys given at random, of all that are declared."""
    case = copy.deepcopy(tomllib.loads(rng.choice([SQUARE, CUBE, TUBE, LAYERS, PLAIN, PLAIN, JAWS])))
    for _ in range(rng.randint(1, 2)):
        table, name, inner = rng.choice(list(keys_of(schema, case)))
        table[name] = random_value(rng, inner)
    return "".join(f"{key} = {toml(value)}\n" for key, value in case.items())


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def check(text, folder):
    """What `tourmaline check` says of a case."""
    case = pathlib.Path(folder) / "case.toml"
    case.write_text(text)
    return program("check", case)


class CaseSchema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads((SOURCE / "docs/case.schema.json").read_text())
        cls.validator = jsonschema.Draft202012Validator(cls.schema)

    def assert_valid(self, text):
        errors = [f"{error.json_path}: {error.message}" for error in self.validator.iter_errors(tomllib.loads(text))]
        self.assertEqual(errors, [])

    def test_is_the_one_that_the_program_prints(self):
        printed = program("schema").stdout
        self.assertTrue(printed == (SOURCE / "docs/case.schema.json").read_text(),
                        "docs/case.schema.json is out of date: tourmaline schema > docs/case.schema.json")

    def test_is_valid_against_its_meta_schema(self):
        self.assertEqual(self.schema["$schema"], "https://json-schema.org/draft/2020-12/schema")
        jsonschema.Draft202012Validator.check_schema(self.schema)

    def test_says_its_version(self):
        self.assertEqual(self.schema["$id"], f"urn:tourmaline:case-file:{self.schema['version']}")

    def test_accepts_every_shipped_case_and_what_it_resolves_to(self):
        self.assertGreater(len(SHIPPED), 20)
        for case in SHIPPED:
            with self.subTest(case=case.relative_to(SOURCE)):
                self.assert_valid(case.read_text())
                resolved = program("check", case)
                self.assertEqual(resolved.stderr, "")
                self.assert_valid(resolved.stdout)

    def test_accepts_what_the_program_accepts(self):
        with tempfile.TemporaryDirectory() as folder:
            for case, before, after in RIGHT:
                with self.subTest(change=after):
                    text = changed(case, before, after)
                    said = check(text, folder)
                    self.assertEqual(said.stderr, "")
                    self.assert_valid(text)
                    self.assert_valid(said.stdout)

    def test_refuses_what_the_program_refuses(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, change in WRONG.items():
                with self.subTest(name):
                    text = changed(*change)
                    self.assertEqual(check(text, folder).returncode, 2)
                    self.assertFalse(self.validator.is_valid(tomllib.loads(text)))

    def test_agrees_with_the_program_on_random_cases(self):
        rng = random.Random(13)
        accepted = refused = 0
        with tempfile.TemporaryDirectory() as folder:
            for number in range(110):
                text = random_case(rng, self.schema)
                with self.subTest(case=text):
                    said = check(text, folder)
                    self.assertIn(said.returncode, (0, 2), said.stderr)
                    if said.returncode == 0:
                        accepted += 1
                        self.assert_valid(text)
                        self.assert_valid(said.stdout)
                    else:
                        self.assertEqual(said.stderr.count("\n"), 1, said.stderr)
                        refused += not self.validator.is_valid(tomllib.loads(text))
        self.assertGreater(accepted, 12)
        self.assertGreater(refused, 12)

    def test_says_unit_and_default(self):
        as_text, as_table = self.schema["properties"]["contact"]["properties"]["friction"]["anyOf"]
        friction = as_table["properties"]
        self.assertIn("[N/m^2]", friction["bound"]["description"])
        self.assertEqual(friction["law"]["default"], "none")
        self.assertEqual(as_text["enum"], ["none"])


if __name__ == "__main__":
    unittest.main()
