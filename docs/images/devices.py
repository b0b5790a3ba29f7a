#!/usr/bin/python3
"""Draws harvester-power.svg and stick-slip.svg from what the commands in cases/devices/README.md leave in results:
harvester-stop and harvester-free (sweeps), stick-slip-actuator (a run)."""
import csv
import math
import pathlib

here = pathlib.Path(__file__).resolve().parent
results = here.parent.parent / "results"
colours = ("#1f5fa8", "#c2571a", "#3f8f3f")


def rows(path):
    with open(results / path, newline="") as file:
        return list(csv.DictReader(file))


def panel(left, title, curves, x_range, y_range, x_ticks, y_ticks, scale=float):
    """A frame of 400 by 300 with polylines, (points, label) each; `scale` maps the abscissa."""
    width, height, top = 310, 210, 40
    low, high = scale(x_range[0]), scale(x_range[1])
    x = lambda v: left + width * (scale(v) - low) / (high - low)
    y = lambda v: top + height * (y_range[1] - v) / (y_range[1] - y_range[0])
    out = [f'<text x="{left}" y="24" font-size="13">{title}</text>',
           f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>']
    for v in x_ticks:
        out.append(f'<line x1="{x(v):.1f}" x2="{x(v):.1f}" y1="{top}" y2="{top + height}" stroke="#ddd"/>'
                   f'<text x="{x(v):.1f}" y="{top + height + 16}" text-anchor="middle">{v:g}</text>')
    for v in y_ticks:
        out.append(f'<line x1="{left}" x2="{left + width}" y1="{y(v):.1f}" y2="{y(v):.1f}" stroke="#ddd"/>'
                   f'<text x="{left - 6}" y="{y(v) + 4:.1f}" text-anchor="end">{v:g}</text>')
    for n, (points, label) in enumerate(curves):
        path = " ".join(f"{x(a):.1f},{y(b):.1f}" for a, b in points)
        out.append(f'<polyline fill="none" stroke="{colours[n]}" stroke-width="1.6" points="{path}"/>'
                   f'<text x="{left + 10}" y="{top + 18 + 16 * n}" fill="{colours[n]}">{label}</text>')
    return out


def write(name, panels):
    body = "\n".join(line for lines in panels for line in lines)
    (here / name).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {400 * len(panels)} 290" font-family="sans-serif" '
        f'font-size="12" fill="#333"><rect width="{400 * len(panels)}" height="290" fill="white"/>\n{body}\n</svg>\n')


def powers(folder):
    return [(float(row["electrode[1].resistor"]), -1e3 * float(row["mean:electric_power"]))
            for row in rows(f"{folder}/sweep.csv")]


history = rows("harvester-stop/resistor=540/history.csv")
voltage = [(1e3 * float(row["time"]), float(row["electrode_load_voltage"])) for row in history]
write("harvester-power.svg", [
    panel(50, "mean power [mW/m] over resistance [Ω m]",
          [(powers("harvester-free"), "without stop"), (powers("harvester-stop"), "with stop")],
          (50, 6000), (0, 4), (100, 300, 1000, 3000), (0, 1, 2, 3, 4), math.log),
    panel(445, "voltage [V] over time [ms], 540 Ω m, with stop", [(voltage, "")], (0, 25), (-2, 2), (0, 5, 10, 15, 20, 25),
          (-2, -1, 0, 1, 2))])

history = rows("stick-slip-actuator/history.csv")
slips = {}
for row in rows("stick-slip-actuator/contact.csv"):
    slips.setdefault(row["step"], []).append(1e9 * float(row["slip_x"]))
foot = [(1e3 * float(row["time"]), sum(slips[row["step"]]) / len(slips[row["step"]])) for row in history]
volts = [(1e3 * float(row["time"]), 1e-3 * float(row["electrode_drive_voltage"])) for row in history]
write("stick-slip.svg", [
    panel(50, "voltage [kV] over time [ms]", [(volts, "")], (0, 2), (0, 1.2), (0, 0.5, 1, 1.5, 2), (0, 0.4, 0.8, 1.2)),
    panel(445, "way of the foot [nm] over time [ms]", [(foot, "")], (0, 2), (-50, 400), (0, 0.5, 1, 1.5, 2),
          (0, 100, 200, 300, 400))])
