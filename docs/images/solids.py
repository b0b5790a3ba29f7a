#!/usr/bin/python3
"""Draws twisted.png, ring.png and sleeve.png from results/twisted, results/ring and results/sleeve, which
`./dev run cases/block-3d/twisted.toml cases/ring/ring.toml cases/ring/sleeve.toml` leaves there. Needs
python3-matplotlib."""
import csv
import pathlib

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation

here = pathlib.Path(__file__).resolve().parent
results = here.parent.parent / "results"


def table(case, name):
    with open(results / case / name, newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([row[key] if key == "status" else float(row[key]) for row in rows]) for key in rows[0]}


def at(contact, step):
    chosen = contact["step"] == step
    return {key: values[chosen] for key, values in contact.items()}


def save(figure, name):
    figure.savefig(here / name, dpi=90)


def twisted():
    contact = table("twisted", "contact.csv")
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 4.2), layout="constrained")
    for panel, step in zip(panels, (8, 20)):
        c = at(contact, step)
        size = np.hypot(c["slip_y"], c["slip_z"])
        slips = c["status"] == "slip"
        arrows = panel.quiver(c["y"][slips], c["z"][slips], c["slip_y"][slips] / size[slips], c["slip_z"][slips] / size[slips],
                              1e12 * size[slips], pivot="mid", scale=24, width=0.006, cmap="viridis")
        panel.plot(c["y"][~slips], c["z"][~slips], "x", color="tab:red", markersize=5)
        figure.colorbar(arrows, ax=panel, label="slip [pm]", shrink=0.85)
        panel.set(title=f"t = {c['time'][0]:g} s", xlabel="y [m]", ylabel="z [m]", aspect="equal")
    save(figure, "twisted.png")


def ring():
    nodes, contact = table("ring", "nodes.csv"), table("ring", "contact.csv")
    figure, (field, loop) = plt.subplots(1, 2, figsize=(9.2, 4.2), layout="constrained")
    cells = Triangulation(nodes["x"], nodes["y"])
    middle = np.hypot(nodes["x"][cells.triangles].mean(1), nodes["y"][cells.triangles].mean(1))
    cells.set_mask(middle < 0.9999 * np.hypot(nodes["x"], nodes["y"]).min())
    colours = field.tricontourf(cells, nodes["potential"], 24, cmap="RdBu_r")
    figure.colorbar(colours, ax=field, label="potential [V]", shrink=0.85)
    c = at(contact, contact["step"].max())
    some = np.argsort(np.arctan2(c["y"], c["x"]))[::8]
    field.quiver(c["x"][some], c["y"][some], c["tangential_traction_x"][some], c["tangential_traction_y"][some],
                 scale=1.1e4, width=0.005)
    field.set(title="t = 4 s, friction on the ring", xlabel="x [m]", ylabel="y [m]", aspect="equal")
    steps = np.arange(1, int(contact["step"].max()) + 1)
    angle, moment = [0.0], [0.0]
    for step in steps:
        c = at(contact, step)
        weight = 2 * np.pi * 0.02 / len(c["x"])
        angle.append(2e-8 * np.sin(np.pi / 2 * max(c["time"][0] - 1, 0)))
        moment.append(-weight * np.sum(c["x"] * c["tangential_traction_y"] - c["y"] * c["tangential_traction_x"]))
    loop.plot(1e9 * np.array(angle), moment, ".-")
    loop.set(title="moment that turns it", xlabel="angle of the outside [nrad]", ylabel="moment [N m/m]")
    loop.grid(alpha=0.3)
    save(figure, "ring.png")


def sleeve():
    contact = table("sleeve", "contact.csv")
    figure, panels = plt.subplots(3, 1, figsize=(9.2, 6.0), layout="constrained", sharex=True)
    for panel, step in zip(panels, (12, 20, 32)):
        before, c = at(contact, step - 1), at(contact, step)
        angle = np.arctan2(c["y"], c["x"])
        change = {axis: c["slip_" + axis] - before["slip_" + axis] for axis in "xyz"}
        around = change["y"] * np.cos(angle) - change["x"] * np.sin(angle)
        size = np.hypot(around, change["z"])
        arrows = panel.quiver(np.degrees(angle), 1e3 * c["z"], around / size, change["z"] / size, 1e12 * size / 0.125,
                              pivot="mid", scale=45, width=0.0022, cmap="viridis")
        figure.colorbar(arrows, ax=panel, label="slip rate [pm/s]")
        panel.set(title=f"t = {c['time'][0]:g} s", ylabel="z [mm]")
    panels[-1].set(xlabel="place around the shaft [degrees]")
    save(figure, "sleeve.png")


if __name__ == "__main__":
    twisted()
    ring()
    sleeve()
