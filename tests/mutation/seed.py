#!/usr/bin/env python3
"""Seeds the faults of faults.toml one after another and says which test finds each; see CONTRIBUTING.md, "Tests".

The sources stay as they are: a faulty copy of one file is compiled and linked in front of the library of a build, as
that build compiles and links. Writes docs/mutation.md. Exit status: 0 when all were found, 1 when some were not, or
when the list does not fit the sources."""

import argparse
import hashlib
import json
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = ROOT / "tests/mutation"
# Whose tests are asked, in this order, from that of the fault's own room on.
ROOMS = ["contact", "condensation", "solve", "cases", "verification", "cli", "parallel"]
# These start the program.
WITH_PROGRAM = {"cli", "parallel"}
# Of processor time. A run that a fault keeps from ending is found by that.
MOST_SECONDS = 1800


def faults_of(path):
    faults = tomllib.loads(path.read_text())["fault"]
    for fault in faults:
        count = (ROOT / "src" / fault["file"]).read_text().count(fault["text"])
        if count != 1:
            raise SystemExit(f"{path.name}: this text is {count} times in src/{fault['file']}, and must be there once:\n"
                             f"{fault['text']}")
    return faults


class Build:
    """Compiles one source and links what is made of it, as the build in `folder` does."""

    def __init__(self, folder, scratch):
        self.folder, self.scratch = folder, scratch
        commands = json.loads((folder / "compile_commands.json").read_text())
        self.compile = {entry["file"]: shlex.split(entry["command"]) for entry in commands}

        self.linker = "-fuse-ld=lld" if shutil.which("ld.lld") else ""
        self.read_headers()

    def compiled(self, source, *options):
        command = [part for part in self.compile[str(source)] if not part.endswith("ccache")]
        start, end = command.index("-o"), command.index("-c")
        # What is unused now must not keep it from being compiled.
        command = [*command[:start], *command[start + 2 : end], *command[end + 2 :], "-w", *options]
        return subprocess.run(command, cwd=self.scratch, capture_output=True, text=True)

    def read_headers(self):
        """Those of the rooms, once for all faults: reading them takes longer than compiling."""
        rooms = [f"src/{room}/*.h" for room in ("contact", "condensation", "solve")]
        headers = sorted(header for room in rooms for header in ROOT.glob(room))
        (self.scratch / "all.h").write_text("".join(f'#include "{header}"\n' for header in headers))
        made = self.scratch / "all.h.gch"
        if made.exists() and made.stat().st_mtime > max(file.stat().st_mtime for file in (ROOT / "src").rglob("*.h")):
            return
        some = next(source for source in self.compile if source.startswith(str(ROOT / "src/solve")))
        self.compiled(some, "-x", "c++-header", "all.h", "-o", "all.h.gch").check_returncode()

    def object_of(self, source, text, name):
        faulty = self.scratch / f"{name}.cc"
        faulty.write_text(text)
        done = self.compiled(source, "-include", "all.h", "-iquote", source.parent, "-c", faulty, "-o", f"{name}.o")
        if done.returncode != 0:
            raise SystemExit(f"{name} cannot be compiled, so nothing is known of it:\n{done.stderr}")
        return self.scratch / f"{name}.o"

    def link(self, target, in_front, name):
        commands = subprocess.run(["ninja", "-t", "commands", target], cwd=self.folder, capture_output=True, text=True,
                                  check=True).stdout
        made = self.scratch / name / Path(target).name
        made.parent.mkdir(exist_ok=True)
        line = next(line for line in reversed(commands.splitlines()) if f" -o {target} " in line)
        line = line.replace(f" -o {target} ", f" {self.linker} {in_front} -o {made} ")
        subprocess.run(line, cwd=self.folder, shell=True, check=True)
        return made


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def failing_test(executable, tests, program):
    """The first test that fails, or during which the process ends; None when all pass."""
    command = [executable, "--gtest_fail_fast", f"--gtest_filter={tests}"]
    environment = {**os.environ, **({"TOURMALINE_BINARY": str(program)} if program else {})}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, errors="replace", preexec_fn=limit)
    if " 0 tests from 0 test suites" in done.stdout:
        raise SystemExit(f"{executable.name} has no test that is called {tests}")
    if done.returncode == 0:
        return None
    failed = re.findall(r"^\[  FAILED  \] ([^\s,]+)", done.stdout, re.M)
    running = re.findall(r"^\[ RUN      \] (\S+)", done.stdout, re.M)
    return failed[0] if failed else f"{running[-1] if running else 'none'} (the process ends)"


class Found:
    """What earlier runs have found, for faults and sources that have not changed since."""

    def __init__(self, file):
        self.file = file
        self.by_text = json.loads(file.read_text()) if file.exists() else {}

    @staticmethod
    def key(fault):
        text = (ROOT / "src" / fault["file"]).read_text().replace(fault["text"], fault["seeded"])
        return hashlib.sha256(text.encode()).hexdigest()

    def get(self, fault):
        return self.by_text.get(self.key(fault))

    def put(self, fault, test):
        if test:
            self.by_text[self.key(fault)] = test
            self.file.write_text(json.dumps(self.by_text, indent=1))


def rooms_to_ask(fault):
    own = ROOMS.index(fault["file"].split("/")[0])
    begin = fault.get("begin", ROOMS[own]).split()
    return [(begin[0], begin[1] if len(begin) > 1 else "*"), *((room, "*") for room in ROOMS[own:])]


def found_by(build, number, fault, few):
    """Which test of which room finds the fault; None when none does."""
    source = ROOT / "src" / fault["file"]
    name = f"fault{number}"
    faulty = build.object_of(source, source.read_text().replace(fault["text"], fault["seeded"]), name)
    for room, tests in rooms_to_ask(fault)[: 2 if few else None]:
        program = build.link("apps/tourmaline/tourmaline", faulty, name) if room in WITH_PROGRAM else None
        if test := failing_test(build.link(f"tests/test_{room}", faulty, name), tests, program):
            return f"`{room}`: {test}"
    return None


def page(faults, found):
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True,
                            check=True).stdout.strip()
    rows = "\n".join(f"| `{fault['file']}` | {fault['wrong']} | {test or '**none**'} |"
                     for fault, test in zip(faults, found))
    return f"""# Seeded faults

Written by `./dev mutate`, which seeds faults of [tests/mutation/faults.toml](../tests/mutation/faults.toml) one after
another into a copy of one source and runs tests until one fails. Here: {len(faults)} faults, {len(faults) - found.count(None)} of them found, on
commit {commit}. A fault is looked for in its own room's tests first, then in those of the rooms behind it; the table has the first
test that failed.

| file below `src/` | what is wrong there | found by |
|---|---|---|
{rows}
"""


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--build", type=Path, default=ROOT / "build/release", help="folder of a build with its tests")
    options.add_argument("--jobs", type=int, default=os.cpu_count(), help="faults at a time")
    options.add_argument("--few", action="store_true", help="ask the own room's tests only")
    options.add_argument("--only", default="", help="faults of files whose names match this expression")
    options.add_argument("--again", action="store_true", help="also those that were found before")
    asked = options.parse_args()
    every = faults_of(HERE / "faults.toml")
    faults = [fault for fault in every if re.search(asked.only, fault["file"])]
    scratch = ROOT / "build/mutation"
    scratch.mkdir(parents=True, exist_ok=True)
    known = Found(scratch / "found.json")
    faults = [fault for fault in faults if asked.again or not known.get(fault)]
    build = Build(asked.build.resolve(), scratch)

    def look(number):
        test = found_by(build, number, faults[number], asked.few)
        known.put(faults[number], test)
        print(f"{faults[number]['file']}: {faults[number]['wrong']}: {test or 'NOT FOUND'}", flush=True)
        return test

    with ThreadPoolExecutor(asked.jobs) as pool:
        found = list(pool.map(look, range(len(faults))))
    print(f"{len(faults)} faults, {found.count(None)} not found")
    if not asked.few and not asked.only:
        (ROOT / "docs/mutation.md").write_text(page(every, [known.get(fault) for fault in every]))
    return 1 if None in found else 0


if __name__ == "__main__":
    sys.exit(main())
