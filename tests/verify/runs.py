"""Runs of the program and the tables they leave."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


class NotSolved(SystemExit):
    """A run ended with exit status 3; unless a table has a place for that, so does this program."""


class Table:
    """A CSV file by the names of its columns."""

    def __init__(self, names, rows):
        self.names, self.rows = names, rows

    @staticmethod
    def read(path):
        with open(path, newline="") as file:
            names, *rows = csv.reader(file)
        return Table(names, rows)

    def texts(self, column):
        place = self.names.index(column)
        return [row[place] for row in self.rows]

    def numbers(self, column):
        return [float(text) for text in self.texts(column)]

    def only(self, column, value):
        """The rows in which a column has this number."""
        place = self.names.index(column)
        return Table(self.names, [row for row in self.rows if float(row[place]) == value])


class Run:
    def __init__(self, folder):
        self.folder = folder

    def table(self, name):
        return Table.read(self.folder / f"{name}.csv")

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())


def commit_of_program():
    """The last commit that changed what the program is made of."""
    of_program = ["src", "include", "apps", "web", "cmake", "CMakeLists.txt"]

    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words, "--", *of_program], capture_output=True, text=True,
                              check=True).stdout.strip()

    return git("log", "-1", "--format=%h") + (" with changes" if git("status", "--porcelain") else "")


def kernels():
    """OpenBLAS's kernels that this processor has; None is its own choice."""
    cpu = pathlib.Path("/proc/cpuinfo")
    flags = set(cpu.read_text().split()) if cpu.exists() else set()
    wanted = {"Prescott": "pni", "Sandybridge": "avx", "Haswell": "avx2", "SkylakeX": "avx512bw"}
    return [None, *(name for name, flag in wanted.items() if flag in flags)]


class Program:
    def __init__(self, path, commit):
        self.commit = commit
        self.path = pathlib.Path(path).resolve()
        self._folders = tempfile.TemporaryDirectory(prefix="tourmaline-verify-")
        self._runs = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._folders.cleanup()

    def version(self):
        done = subprocess.run([self.path, "--version"], capture_output=True, text=True, check=True)
        return done.stdout.strip().splitlines()[0]

    def run(self, case, kernel=None, **settings):
        """Runs a case of the repository; settings are keys of the case file with "__" for "."."""
        key = (str(case), kernel, *sorted(settings.items()))
        if key not in self._runs:
            self._runs[key] = self._start(case, kernel, settings)
        return self._runs[key]

    def _start(self, case, kernel, settings):
        folder = pathlib.Path(self._folders.name) / str(len(self._runs))
        command = [self.path, "run", ROOT / case, "-o", folder, "--set", "output.fields=false",
                   "--set", "output.report=false"]
        for name, value in settings.items():
            command += ["--set", f"{name.replace('__', '.')}={value}"]
        environment = os.environ | ({"OPENBLAS_CORETYPE": kernel} if kernel else {})
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        if done.returncode != 0:
            failure = NotSolved if done.returncode == 3 else SystemExit
            raise failure(f"verify: {case} {settings} failed:\n{done.stderr}")
        return Run(folder)
