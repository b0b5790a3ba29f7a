#!/usr/bin/python3
"""compare.py PROGRAM [CASE...] [-- OPTION...]: runs the program on cases and compares with results/.

    compare.py build/release/apps/tourmaline/tourmaline
    compare.py build/release/apps/tourmaline/tourmaline block-heated -- --set solver.method=monolithic

For every column of contact.csv, nodes.csv and history.csv that results have: the largest difference over all steps and nodes
over the column's largest value, or over that of its kind where the column has 1e-9 of it or less. Exit status 1 where a
difference is larger than 1e-9, a status differs, a column is missing or the program fails. Where a result with another
reading of what is lumped is there (results/NAME.lumped.json) and agrees better, that is said. Needs nothing but Python.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TOLERANCE = 1e-9
KINDS = {
    "traction": ["normal_traction", "tangential_traction", "friction_bound"],
    "length": ["normal_displacement", "slip", "gap", "u"], "rate": ["slip_rate"], "temperature": ["temperature"],
    "potential": ["potential"], "heat flux": ["heat_flux"], "charge flux": ["charge_flux"], "power": ["friction_dissipation", "heat"],
    "charge": ["charge"], "force": ["contact_force"],
}
# The documents name no column for the split of friction's heat; without friction no bound, without it no dissipation.
OPTIONAL = {"friction_bound", "accumulated_slip", "friction_dissipation", "friction_heat_body", "friction_heat_foundation",
            "contact_force_x", "contact_force_y", "contact_force_z"}
NOT_COMPARED = {"x", "y", "z", "status", "temperature_held", "potential_held", "accumulated_slip"}


def kind(column):
    plain = column[:-2] if column[-2:] in ("_x", "_y", "_z") else column
    return next((k for k, names in KINDS.items() if plain in names), column)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def place(row):
    return tuple(round(float(row[a]), 9) for a in "xyz" if a in row)


class Differences:
    """Of each column the largest difference and the largest expected value."""

    def __init__(self):
        self.largest, self.size, self.at, self.missing = {}, {}, {}, set()

    def add(self, column, value, expected, where, name=None):
        name = name or column
        if value is None:
            if column not in OPTIONAL:
                self.missing.add(column)
            return
        difference = abs(float(value) - expected)
        difference = math.inf if math.isnan(difference) else difference
        self.size[column] = max(self.size.get(column, 0.0), abs(expected))
        if difference > self.largest.get(name, -1):
            self.largest[name], self.at[name] = difference, where

    def relative(self, name):
        column = name.split(" ")[0]
        own = self.size.get(column, 0.0)
        whole = max([v for c, v in self.size.items() if kind(c) == kind(column)], default=0.0)
        size = own if own > 1e-9 * whole else whole
        return self.largest[name] / size if size else self.largest[name]

    def worst(self):
        return max((self.relative(n) for n in self.largest if "(" not in n), default=0.0)


def compare_contact(result, table, differences):
    """The nodes whose status differs."""
    steps, mismatches = {}, []
    for row in table:
        steps.setdefault(int(row["step"]), {})[place(row)] = row
    for step in result["steps"]:
        contact = step["contact"]
        for i in range(len(contact["x"])):
            here = tuple(round(contact[a][i], 9) for a in "xyz" if a in contact)
            row = steps.get(step["step"], {}).get(here)
            if row is None:
                differences.missing.add(f"node {here} of step {step['step']}")
                continue
            expected = contact["status"][i]
            if row["status"] != expected and (result["friction_law"] != "none" or "open" in (row["status"], expected)):
                mismatches.append((step["step"], here, row["status"], expected))
            for column in contact.keys() - NOT_COMPARED:
                held = column == "heat_flux" and contact["temperature_held"][i] or column == "charge_flux" and contact["potential_held"][i]
                differences.add(column, row.get(column), contact[column][i], (step["step"], here),
                                column + " (where its field is prescribed)" if held else None)
    return mismatches


def compare_history(result, table, differences):
    """Heat and charge over the contact are compared where all its nodes are free in them."""
    by_step, side = {int(r["step"]): r for r in table}, result["on"]
    for step in result["steps"]:
        row, contact = by_step.get(step["step"], {}), step["contact"]
        for column, value in step["history"].items():
            if column in ("heat", "charge"):
                field = {"heat": "temperature_held", "charge": "potential_held"}[column]
                names = [f"{column}_{name}" for name in side]
                if any(contact[field]) or not value:
                    continue
                present = [float(row[n]) for n in names if n in row]
                differences.add(column, sum(present) if present else None, value, step["step"])
            else:
                differences.add(column, row.get(column), value, step["step"])


def compare_nodes(result, table, differences):
    mine, expected = {place(r): r for r in table}, result["nodes"]
    for column in result["largest"]:
        differences.size[column] = result["largest"][column]
        for i in range(len(expected["x"])):
            here = tuple(round(expected[a][i], 9) for a in "xyz" if a in expected)
            row = mine.get(here, {})
            differences.add(column, row.get(column), expected[column][i], here)


def judge(result, folder):
    parts, found = {}, []
    for part in ("contact", "history", "nodes"):
        parts[part] = Differences()
        table = rows(folder / f"{part}.csv")
        if part == "contact":
            found = compare_contact(result, table, parts[part])
        else:
            {"history": compare_history, "nodes": compare_nodes}[part](result, table, parts[part])
    return parts, found


def compare(program, name, options):
    print(name)
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run([program, "run", str(HERE / "cases" / f"{name}.toml"), "-o", folder, *options],
                             capture_output=True, text=True)
        if run.returncode:
            print(f"  exit status {run.returncode}: {run.stderr.strip()}")
            return False
        result = json.loads((HERE / "results" / f"{name}.json").read_text())
        parts, mismatches = judge(result, pathlib.Path(folder))
        other = HERE / "results" / f"{name}.lumped.json"
        lumped = judge(json.loads(other.read_text()), pathlib.Path(folder))[0] if other.exists() else {}
    missing = set()
    for part, differences in parts.items():
        missing |= {f"{part}: {m}" for m in differences.missing}
        for column in sorted(differences.largest):
            value = differences.relative(column)
            print(f"  {part:8}{column:48}{value:9.1e}" + (f"   at {differences.at[column]}" if value > TOLERANCE else ""))
    for step, here, mine, expected in mismatches[:10]:
        print(f"  status at step {step}, {here}: {mine}, expected {expected}")
    for m in sorted(missing)[:10]:
        print(f"  missing: {m}")
    worst = max(d.worst() for d in parts.values())
    print(f"  largest {worst:.1e}, {len(mismatches)} statuses differ" + (
        f"; with the other reading of what is lumped {max(d.worst() for d in lumped.values()):.1e}" if lumped else ""))
    return worst <= TOLERANCE and not mismatches and not missing


def main():
    arguments, options = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1:]
    if not arguments:
        raise SystemExit(__doc__)
    names = [pathlib.Path(a).stem for a in arguments[1:]] or sorted(p.stem for p in (HERE / "cases").glob("*.toml"))
    failed = [name for name in names if not compare(arguments[0], name, options)]
    print(f"{len(names) - len(failed)} of {len(names)} cases agree" + (": not " + ", ".join(failed) if failed else ""))
    raise SystemExit(1 if failed else 0)


if __name__ == "__main__":
    main()
