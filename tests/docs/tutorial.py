#!/usr/bin/env python3
"""tutorial.py PROGRAM PAGE [--pictures FOLDER]: does all that the tutorial says in an empty folder, then checks what the
page says of the results. With --pictures its pictures are put into FOLDER."""
import argparse
import pathlib
import re
import shutil

from pages import column, done, texts

parser = argparse.ArgumentParser()
parser.add_argument("program", type=lambda text: pathlib.Path(text).resolve())
parser.add_argument("page", type=pathlib.Path)
parser.add_argument("--pictures", type=lambda text: pathlib.Path(text).resolve())
arguments = parser.parse_args()

# Where each picture comes from, by the number of its step.
PICTURES = {1: ("tutorial-press.svg", "press-figures/potential.svg"),
            2: ("tutorial-foot.svg", "foot-figures/von_mises.svg"),
            3: ("tutorial-sensor.svg", "sensor-figures/potential.svg"),
            4: ("tutorial-rub.svg", "rub-figures/von_mises.svg"),
            5: ("tutorial-sweep.svg", "resistors/sweep.svg"),
            6: ("tutorial-power.svg", "power.svg")}


def check_steps(page):
    """Six steps, each with a command and its picture, which is there."""
    steps = re.split(r"^## (?=\d)", page, flags=re.M)[1:]
    assert [step[0] for step in steps] == list("123456"), [step[:20] for step in steps]
    for number, step in enumerate(steps, 1):
        assert "```sh\n" in step, f"step {number} has no command"
        named = re.findall(r"!\[[^]]+\]\(images/([\w.-]+)\)", step)
        assert named == [PICTURES[number][0]], f"pictures of step {number}: {named}"
        assert (arguments.page.parent / "images" / named[0]).stat().st_size > 1000, named


def check(folder):
    """What the page claims."""
    potential = max(column(folder / "press/history.csv", "max_potential"))
    assert abs(potential - 3.8) < 0.05, f"3.8 V: {potential}"
    assert (folder / "press/report.html").stat().st_size > 1e5
    # The load, -1e5 N/m^2 on 10 mm, is what the sole bears.
    assert abs(column(folder / "foot/history.csv", "reaction_y")[-1] - 1e3) < 1e-6
    voltage = max(map(abs, column(folder / "sensor/history.csv", "electrode_lid_voltage")[40:]))
    assert abs(voltage - 4.4) < 0.05, f"reaches 4.4 V: {voltage}"
    assert max(column(folder / "rub/history.csv", "slip")) == 51 and max(column(folder / "rub/history.csv", "stick")) == 51
    assert texts(folder / "resistors/sweep.csv", "status") == ["done"] * 5
    assert "result_" in (folder / "rub/result.pvd").read_text()
    fields = min((folder / "rub").glob("result_*.vtu")).read_bytes()
    for array in (b'"von_mises"', b'"displacement"'):
        assert array in fields, array


def check_powers(folder):
    """The most power goes to a resistor amid those of step 5."""
    powers = []
    for resistance in texts(folder / "resistors/sweep.csv", "electrode[1].resistor"):
        run = folder / "resistors" / f"resistor={resistance}"
        voltage = column(run / "history.csv", "electrode_lid_voltage")[40:]
        powers.append(sum(v * v for v in voltage) / float(resistance))
    assert 0 < powers.index(max(powers)) < len(powers) - 1, powers


text = arguments.page.read_text()
check_steps(text)
with done(arguments.program, text) as folder:
    check(folder)
    check_powers(folder)
    for picture, source in PICTURES.values():
        assert (folder / source).stat().st_size > 1000, source
        if arguments.pictures:
            shutil.copy(folder / source, arguments.pictures / picture)
