#!/usr/bin/python3
"""Draws sensor.png from results/friction-sensor-loaded, which `./dev run cases/devices/friction-sensor-loaded.toml`
leaves there. Needs python3-matplotlib."""
import csv
import pathlib

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
results = here.parent.parent / "results" / "friction-sensor-loaded"


def rows(name):
    with open(results / name, newline="") as file:
        return list(csv.DictReader(file))


history = rows("history.csv")
slip = {row["step"]: 1e9 * float(row["slip_x"]) for row in rows("contact.csv")}
time = [0.0] + [float(row["time"]) for row in history]
voltage = [0.0] + [float(row["electrode_sensor_voltage"]) for row in history]
charge = [0.0] + [1e9 * float(row["electrode_sensor_charge"]) for row in history]
figure, (over_time, loop) = plt.subplots(1, 2, figsize=(9.2, 3.6), layout="constrained")
over_time.plot(time, voltage, ".-")
over_time.set(title="voltage of the sensor", xlabel="time [s]", ylabel="voltage [V]")
loop.plot([0.0] + [slip[row["step"]] for row in history], charge, ".-")
loop.set(title="charge over slip", xlabel="slip [nm]", ylabel="charge [nC/m]")
for panel in (over_time, loop):
    panel.grid(alpha=0.3)
figure.savefig(here / "sensor.png", dpi=90)
