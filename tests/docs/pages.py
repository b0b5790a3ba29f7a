"""Files and commands of a page of the documents: a file is a fenced block after a line that ends with its `name`:, a
command a block of `sh`."""
import contextlib
import csv
import os
import pathlib
import re
import subprocess
import tempfile


def blocks(page):
    """(name or None, language, text) of every fenced block."""
    for match in re.finditer(r"^```(\w*)\n(.*?)^```$", page, re.M | re.S):
        before = page[:match.start()].rstrip()
        name = re.search(r"`([\w.]+)`:$", before)
        yield name and name.group(1), match.group(1), match.group(2)


def run_all(page, folder, environment):
    """Saves every file and runs every command in the order of the page."""
    for name, language, text in blocks(page):
        if language == "sh":
            done = subprocess.run(["bash", "-euc", text], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            assert done.returncode == 0, f"exit status {done.returncode} of\n{text}{done.stderr}"
        else:
            assert name, f"a block has no name:\n{text}"
            (folder / name).write_text(text)


@contextlib.contextmanager
def done(program, page):
    """A folder in which all of the page was done, with the program under its name and Debian's Python, which has
    matplotlib."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "bin").mkdir()
        (folder / "bin/tourmaline").symlink_to(program)
        run_all(page, folder, os.environ | {"PATH": f"{folder}/bin:/usr/bin:{os.environ['PATH']}"})
        yield folder


def column(file, name):
    with open(file, newline="") as table:
        return [float(row[name]) for row in csv.DictReader(table)]


def texts(file, name):
    with open(file, newline="") as table:
        return [row[name] for row in csv.DictReader(table)]
