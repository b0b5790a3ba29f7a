#!/usr/bin/env python3
"""Runs the program on exact solutions, on finer and finer meshes of the paper's example, and on the cases of
other codes, and writes what it finds to docs/verification.md. Nothing in that page is written by hand."""
import argparse
import pathlib

import exact_cases
import other_codes
import paper_example
import runs


def introduction(program, command):
    return f"""# Verification

Written by `{command}` from runs of {program.version()}; do not edit. Every reference is labelled: *analytic*, a
closed form or a computation that shares nothing with the program; *other code*; or *regression*, numbers of
this program that nobody else has.
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=runs.ROOT / "build/release/apps/tourmaline/tourmaline")
    parser.add_argument("--output", type=pathlib.Path, default=runs.ROOT / "docs/verification.md")
    parser.add_argument("--finest", type=int, default=256, choices=[128, 256, 512],
                        help="squares along a side of the finest mesh (default 256)")
    return parser.parse_args()


def main():
    asked = arguments()
    program = runs.Program(asked.program)
    values = paper_example.Values(program, asked.finest)
    command = "./dev verify" + (f" --finest {asked.finest}" if asked.finest != 256 else "")
    sections = [introduction(program, command), exact_cases.section(program), other_codes.section(program),
                paper_example.mesh_section(values), paper_example.corner_section(values),
                paper_example.step_section(values)]
    asked.output.write_text("\n".join(sections))
    print(f"verify: wrote {asked.output}")


if __name__ == "__main__":
    main()
