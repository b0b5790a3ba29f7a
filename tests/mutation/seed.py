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
import signal
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = ROOT / "tests/mutation"
# Whose tests are asked, in this order, from that of the fault's own room on.
ROOMS = ["body", "contact", "condensation", "solve", "cases", "verification", "cli", "parallel"]
# These start the program.
WITH_PROGRAM = {"cli", "parallel"}
# Of processor time. A run that a fault keeps from ending is found by that.
MOST_SECONDS = 1800


def listed(path=HERE / "faults.toml"):
    return tomllib.loads(path.read_text())["fault"]


def complaint_of(fault):
    """Why the fault cannot be seeded; None when it can."""
    source = ROOT / "src" / fault["file"]
    if source.suffix != ".cc" or not source.exists():
        return f"src/{fault['file']} is no source, of which a faulty copy could be compiled"
    if (count := source.read_text().count(fault["text"])) != 1:
        return f"this text is {count} times in src/{fault['file']}, and must be there once:\n{fault['text']}"
    for room, _ in rooms_to_ask(fault):
        if not (ROOT / "tests" / room).is_dir() or room not in ROOMS:
            return f"there are no tests of {room} to ask about src/{fault['file']}"
    return None


class Build:
    """Compiles one source and links what is made of it, as the build in `folder` does."""

    def __init__(self, folder, scratch):
        self.folder, self.scratch = folder, scratch
        commands = json.loads((folder / "compile_commands.json").read_text())
        self.compile = {entry["file"]: shlex.split(entry["command"]) for entry in commands}
        self.joined = {source: file for file in self.compile if "/joined/" in file for source in included_by(file)}
        self.linker = "-fuse-ld=lld" if shutil.which("ld.lld") else ""
        if not self.joined:
            self.read_headers()

    def compiled(self, source, *options):
        of = self.joined.get(str(source), str(source))
        command = [part for part in self.compile[of] if not part.endswith("ccache")]
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

    def object_of(self, source, text, name, joined=False):
        """Of the source alone, or as the build joins it with others."""
        faulty = self.scratch / f"{name}.cc"
        faulty.write_text(text)
        if joined:
            others = Path(self.joined[str(source)]).read_text()
            faulty = self.scratch / f"{name}-joined.cc"
            faulty.write_text(others.replace(f'"{source}"', f'"{name}.cc"'))
        headers = [] if self.joined else ["-include", "all.h"]
        done = self.compiled(source, *headers, "-iquote", source.parent, "-c", faulty, "-o", f"{name}.o")
        if done.returncode != 0:
            raise SystemExit(f"{name} cannot be compiled, so nothing is known of it:\n{done.stderr}")
        return self.scratch / f"{name}.o"

    def link(self, target, in_front, name):
        commands = subprocess.run(["ninja", "-t", "commands", target], cwd=self.folder, capture_output=True, text=True,
                                  check=True).stdout
        made = self.scratch / name / Path(target).name
        made.parent.mkdir(exist_ok=True)
        line = next(line for line in reversed(commands.splitlines()) if f" -o {target} " in line)
        # Of what stands in the library beside others that are needed the first is taken.
        twice = "-Wl,-z,muldefs" if self.joined else ""
        line = line.replace(f" -o {target} ", f" {self.linker} {twice} {in_front} -o {made} ")
        subprocess.run(line, cwd=self.folder, shell=True, check=True)
        return made


def included_by(file):
    """The sources that a build without ccache has made into one (cmake/Join.cmake)."""
    path = Path(file)
    return re.findall(r'^#include "(/.*)"$', path.read_text(), re.M) if path.exists() else []


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
    # Whole rooms may take longer than that without a fault.
    if done.returncode == 0 or (done.returncode == -signal.SIGXCPU and tests == "*"):
        return None
    failed = re.findall(r"^\[  FAILED  \] ([^\s,]+)", done.stdout, re.M)
    running = re.findall(r"^\[ RUN      \] (\S+)", done.stdout, re.M)
    return failed[0] if failed else f"{running[-1] if running else 'none'} (the process ends)"


class Found:
    """What earlier runs have found, and on which commits, for faults and sources that have not changed since."""

    def __init__(self, file):
        self.file = file
        self.commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True,
                                     check=True).stdout.strip()
        self.by_text = json.loads(file.read_text()) if file.exists() else {}

    @staticmethod
    def key(fault):
        text = (ROOT / "src" / fault["file"]).read_text().replace(fault["text"], fault["seeded"])
        return hashlib.sha256(text.encode()).hexdigest()

    def get(self, fault):
        return self.by_text.get(self.key(fault))

    def put(self, fault, test):
        if test:
            self.by_text[self.key(fault)] = {"test": test, "commit": self.commit}
            self.file.write_text(json.dumps(self.by_text, indent=1))


def rooms_to_ask(fault):
    """Rooms, and of each which of its tests."""
    room = fault["file"].split("/")[0]
    begin = fault.get("begin", room).split()
    first = room if room in ROOMS else begin[0]  # which has none of its own
    behind = ROOMS[ROOMS.index(first) :] if first in ROOMS else [first]
    return [(begin[0], begin[1] if len(begin) > 1 else "*"), *((room, "*") for room in behind)]


def found_by(build, number, fault, few):
    """Which test of which room finds the fault; None when none does."""
    source = ROOT / "src" / fault["file"]
    name = f"fault{number}"
    # Alone it is compiled in a fraction of the time; but where sources are joined, what others have taken into
    # themselves stays sound.
    for joined in (False, True) if str(source) in build.joined else (False,):
        faulty = build.object_of(source, source.read_text().replace(fault["text"], fault["seeded"]), name, joined)
        for room, tests in rooms_to_ask(fault)[: 2 if few else None]:
            program = build.link("apps/tourmaline/tourmaline", faulty, name) if room in WITH_PROGRAM else None
            if test := failing_test(build.link(f"tests/test_{room}", faulty, name), tests, program):
                return f"`{room}`: {test}"
    return None


def page(faults, runs):
    rows = "\n".join(f"| `{fault['file']}` | {fault['wrong']} | {run['test'] if run else '**none**'} | "
                     f"{run['commit'] if run else ''} |" for fault, run in zip(faults, runs))
    return f"""# Seeded faults

Written by `./dev mutate`, which seeds faults of [tests/mutation/faults.toml](../tests/mutation/faults.toml) one after
another into a copy of one source and runs tests until one fails. Here: {len(faults)} faults, {len(faults) - runs.count(None)} of them found. A
fault is looked for in its own room's tests first, then in those of the rooms behind it; the table has the first
test that failed and the commit on which it did.

| file below `src/` | what is wrong there | found by | on |
|---|---|---|---|
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
    every = listed()
    if complaint := next(filter(None, map(complaint_of, every)), None):
        raise SystemExit(f"faults.toml: {complaint}")
    faults = [fault for fault in every if re.search(asked.only, fault["file"])]
    scratch = ROOT / "build/mutation"
    scratch.mkdir(parents=True, exist_ok=True)
    known = Found(scratch / "found-on.json")
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
