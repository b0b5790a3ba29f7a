#!/usr/bin/env python3
"""tutorial.py PROGRAM PAGE [--pictures FOLDER]: saves every file of the tutorial under its name and runs every command,
in the order of the page, in an empty folder; then checks what the page says of the results. With --pictures its pictures
are put into FOLDER."""
import argparse
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

parser = argparse.ArgumentParser()
parser.add_argument("program", type=lambda text: pathlib.Path(text).resolve())
parser.add_argument("page", type=pathlib.Path)
parser.add_argument("--pictures", type=lambda text: pathlib.Path(text).resolve())
arguments = parser.parse_args()

# Where each picture comes from.
PICTURES = {"tutorial-press.svg": "press-figures/potential.svg", "tutorial-foot.svg": "foot-figures/von_mises.svg",
            "tutorial-sensor.svg": "sensor-figures/potential.svg", "tutorial-rub.svg": "rub-figures/von_mises.svg",
            "tutorial-sweep.svg": "resistors/sweep.svg", "tutorial-power.svg": "power.svg"}


def blocks(page):
    """(name or None, language, text) of every fenced block; the name stands as `name`: before the fence."""
    for match in re.finditer(r"^```(\w*)\n(.*?)^```$", page, re.M | re.S):
        before = page[:match.start()].rstrip()
        name = re.search(r"`([\w.]+)`:$", before)
        yield name and name.group(1), match.group(1), match.group(2)


def run_all(page, folder, environment):
    for name, language, text in blocks(page):
        if language == "sh":
            subprocess.run(["bash", "-euc", text], cwd=folder, env=environment, check=True, stdin=subprocess.DEVNULL,
                           stdout=subprocess.DEVNULL)
        elif name:
            (folder / name).write_text(text)
        else:
            sys.exit(f"{arguments.page}: a block has no name:\n{text}")


def column(file, name):
    with open(file, newline="") as table:
        return [float(row[name]) for row in csv.DictReader(table)]


def check(folder):
    """What the page claims."""
    potential = max(column(folder / "press/history.csv", "max_potential"))
    assert abs(potential - 3.8) < 0.05, f"3.8 V: {potential}"
    voltage = max(map(abs, column(folder / "sensor/history.csv", "electrode_lid_voltage")[40:]))
    assert abs(voltage - 4.4) < 0.05, f"reaches 4.4 V: {voltage}"
    assert max(column(folder / "rub/history.csv", "slip")) == 51 and max(column(folder / "rub/history.csv", "stick")) == 51
    assert "result_" in (folder / "rub/result.pvd").read_text()
    fields = min((folder / "rub").glob("result_*.vtu")).read_bytes()
    for array in (b'"von_mises"', b'"displacement"'):
        assert array in fields, array
    assert (folder / "press/report.html").stat().st_size > 1e5


with tempfile.TemporaryDirectory() as temporary:
    folder = pathlib.Path(temporary)
    # The program under its name, and Debian's Python, which has matplotlib.
    (folder / "bin").mkdir()
    (folder / "bin/tourmaline").symlink_to(arguments.program)
    environment = os.environ | {"PATH": f"{folder}/bin:/usr/bin:{os.environ['PATH']}"}
    page = arguments.page.read_text()
    run_all(page, folder, environment)
    check(folder)
    named = set(re.findall(r"\(images/(tutorial-[\w.-]+)\)", page))
    assert named == set(PICTURES), named ^ set(PICTURES)
    for picture, source in PICTURES.items():
        assert (folder / source).stat().st_size > 0
        if arguments.pictures:
            shutil.copy(folder / source, arguments.pictures / picture)
