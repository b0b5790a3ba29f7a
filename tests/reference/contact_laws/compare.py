#!/usr/bin/python3
"""compare.py PROGRAM [CASE...] [-- OPTION...]: runs the program on cases and compares with results/.

    compare.py build/release/apps/tourmaline/tourmaline
    compare.py build/release/apps/tourmaline/tourmaline ssnv128 damped -- --set solver.method=monolithic

For every column of contact.csv: the largest difference over all steps and nodes, divided by the column's largest
value, or, for a column that is 1e-9 of its kind or less (tractions, lengths, rates), by that of its kind; of nodes.csv, divided by the
largest value of the field over all steps. Exit status 1 where a
difference is larger than 1e-9, a status differs, or the program fails. Needs nothing but Python.
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
    "traction": ["normal_traction", "tangential_traction_x", "tangential_traction_y"],
    "length": ["normal_displacement", "slip_x", "slip_y", "gap", "u_x", "u_y"],
    "rate": ["slip_rate"], "temperature": ["temperature"], "potential": ["potential"], "heat": ["heat_flux"],
}
KIND = {column: kind for kind, columns in KINDS.items() for column in columns}


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def by_place(table):
    return {(round(float(r["x"]), 9), round(float(r["y"]), 9)): r for r in table}


class Differences:
    """Of each column the largest difference and the largest expected value."""

    def __init__(self, step=1.0):
        self.largest, self.size, self.at = {}, {}, {}
        self.step = step  # length of a time step [s]

    def add(self, column, value, expected, where, name=None):
        name = name or column
        difference = abs(value - expected)
        difference = math.inf if math.isnan(difference) else difference
        if difference > self.largest.get(name, -1):
            self.largest[name], self.at[name] = difference, where
        self.size[column] = max(self.size.get(column, 0.0), abs(expected))

    def relative(self, name):
        column = name.split(" ")[0]
        kind = max(self.size.get(c, 0.0) for c in KINDS[KIND[column]])
        if KIND[column] == "rate":
            kind = max(kind, max(self.size.get(c, 0.0) for c in KINDS["length"]) / self.step)
        size = self.size[column] if self.size[column] > 1e-9 * kind else kind
        return self.largest[name] / size if size else self.largest[name]


def status_agrees(friction, mine, expected):
    """Without friction stick and slip say nothing; open says something always."""
    return mine == expected or friction == "none" and "open" not in (mine, expected)


def compare_contact(result, table, report):
    """Differences of contact.csv; the nodes whose status differs."""
    differences, mismatches, missing = Differences(result["steps"][0]["time"]), [], set()
    steps = {}
    for row in table:
        steps.setdefault(int(row["step"]), []).append(row)
    for step in result["steps"]:
        mine, contact = by_place(steps.get(step["step"], [])), step["contact"]
        for i, place in enumerate(zip(contact["x"], contact["y"])):
            row = mine.get((round(place[0], 9), round(place[1], 9)))
            if row is None:
                report(f"  step {step['step']}: no contact node at {place}")
                missing.add("node")
                continue
            if not status_agrees(result["friction_law"], row["status"], contact["status"][i]):
                mismatches.append((step["step"], place, row["status"], contact["status"][i]))
            for column in KIND:
                if column in ("u_x", "u_y"):
                    continue
                if column not in row:
                    missing.add(column)
                    continue
                borne = contact["supported"][i] and column.startswith("tangential")
                differences.add(column, float(row[column]), contact[column][i], (step["step"], place),
                                column + " (beside a support)" if borne else None)
    return differences, mismatches, missing


def compare_nodes(result, table):
    differences, mine, expected = Differences(), by_place(table), result["nodes"]
    for column in ("u_x", "u_y", "potential", "temperature"):
        differences.size[column] = result["largest"][column]
        for i, place in enumerate(zip(expected["x"], expected["y"])):
            row = mine.get((round(place[0], 9), round(place[1], 9)))
            differences.add(column, float(row[column]) if row else math.nan, expected[column][i], place)
    return differences


def show(title, differences, report):
    worst = 0.0
    for name in differences.largest:
        value = differences.relative(name)
        worst = max(worst, value)
        report(f"  {title} {name:42} {value:9.1e}" + (f"   at {differences.at[name]}" if value > TOLERANCE else ""))
    return worst


def compare(program, name, options):
    result = json.loads((HERE / "results" / f"{name}.json").read_text())
    print(name)
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run([program, "run", str(HERE / "cases" / f"{name}.toml"), "-o", folder, *options],
                             capture_output=True, text=True)
        if run.returncode:
            print(f"  exit status {run.returncode}: {run.stderr.strip()}")
            return False
        folder = pathlib.Path(folder)
        contact, mismatches, missing = compare_contact(result, rows(folder / "contact.csv"), print)
        nodes = compare_nodes(result, rows(folder / "nodes.csv"))
    worst = max(show("contact", contact, print), show("nodes  ", nodes, print))
    for step, place, mine, expected in mismatches[:10]:
        print(f"  status at step {step}, {place}: {mine}, expected {expected}")
    count = sum(len(s["contact"]["status"]) for s in result["steps"])
    print(f"  statuses: {count - len(mismatches)} of {count}" + "".join(f"; no column {c}" for c in sorted(missing)))
    return worst <= TOLERANCE and not mismatches and not missing


def main():
    arguments, options = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1:]
    if not arguments:
        raise SystemExit(__doc__)
    names = [pathlib.Path(a).stem for a in arguments[1:]] or sorted(p.stem for p in (HERE / "results").glob("*.json"))
    failed = [name for name in names if not compare(arguments[0], name, options)]
    print(f"{len(names) - len(failed)} of {len(names)} cases agree" + (": not " + ", ".join(failed) if failed else ""))
    raise SystemExit(1 if failed else 0)


if __name__ == "__main__":
    main()
