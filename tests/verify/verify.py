#!/usr/bin/env python3
"""Runs the program on exact solutions, on finer and finer meshes of the paper's example, on the cases of other codes and
on the paper's own iteration, and compares what it finds with docs/verification.md and docs/monolithic.md. Exit status 1
when a number has moved by more than the page allows. With --write the pages are written anew."""
import argparse
import pathlib
import sys

import comparison
import contact_laws
import exact_cases
import monolithic
import other_codes
import page
import paper_example
import runs

DOCS = runs.ROOT / "docs"


def introduction(program, command):
    return f"""# Verification

Written by `{command}` from runs of {program.version()}; do not
edit. Every reference is labelled: *analytic*, a closed form or a computation that shares nothing with the program;
*other code*; or *regression*, numbers of this program that nobody else has. Below each table stand the state of
the program that was measured, and how far its numbers may move until `./dev verify` fails."""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=runs.ROOT / "build/release/apps/tourmaline/tourmaline")
    parser.add_argument("--commit", help="the state that the program was built from, if it is not that of the tree")
    parser.add_argument("--finest", type=int, default=128, choices=[128, 256, 512],
                        help="squares along a side of the finest mesh (default 128)")
    parser.add_argument("--write", action="store_true",
                        help="write the pages, counts with all kernels of the BLAS, whatever has moved")
    return parser.parse_args()


def verification(program, asked, command):
    values = paper_example.Values(program, asked.finest)
    document = page.Page(program.commit)
    document.add(introduction(program, command))
    exact_cases.add_to(document, program)
    contact_laws.add_to(document, program)
    other_codes.add_to(document, program)
    paper_example.add_meshes(document, values)
    paper_example.add_corners(document, values)
    paper_example.add_steps(document, values)
    return document


def own_iteration(program, asked, command):
    document = page.Page(program.commit)
    monolithic.add_to(document, program, runs.kernels() if asked.write else [None], command)
    return document


def finest_in(text):
    """Of the mesh sequences of a page, 0 if there are none."""
    return max((int(row[0]) for (heading, _), (header, rows) in comparison.read_tables(text).items()
                if header[0] == "n" and "uniform" in heading for row in rows if row[0].isdigit()), default=0)


def check(name, document, kept, asked):
    """What moved in a page; all of it before `kept` is left as it is. Writes the page when asked to."""
    before = (DOCS / name).read_text()
    start = before.index(kept) if kept else 0
    same_finest = finest_in(before) in (0, asked.finest)
    if asked.write:
        (DOCS / name).write_text(before[:start] + document.text())
    return [f"docs/{name}: {words}" for words in comparison.compare(before[start:], document.tables, same_finest)]


def main():
    asked = arguments()
    command = f"./dev verify --finest {asked.finest} --write"
    with runs.Program(asked.program, asked.commit or runs.commit_of_program()) as program:
        moved = check("verification.md", verification(program, asked, command), "", asked)
        moved += check("monolithic.md", own_iteration(program, asked, command), monolithic.HEADING, asked)
    for words in moved:
        print("verify:", words, file=sys.stderr)
    if asked.write:
        print("verify: wrote docs/verification.md and docs/monolithic.md")
        return 0
    print(f"verify: {len(moved)} numbers moved" if moved else "verify: every number is where it was")
    return 1 if moved else 0


if __name__ == "__main__":
    sys.exit(main())
