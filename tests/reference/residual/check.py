#!/usr/bin/python3
"""check.py PROGRAM [CASE...] [-- OPTION...]: runs the program on cases/ and puts what it wrote into the equations.

    check.py build/release/apps/tourmaline/tourmaline
    check.py build/release/apps/tourmaline/tourmaline sheet -- --set solver.method=monolithic

Nothing is solved. Every field file gives forces, charges and heats that each node lacks (equations.py); they must be what
loads, contact and supports are said to be, and add up to every column of the probes' tables, of the electrodes and of
charge_, heat_ in history.csv. A column's largest difference is taken over the sizes of the terms that it is summed of,
that of a field over the field's largest value. Exit status 1 above 1e-10. Needs numpy.
"""
import base64
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import xml.etree.ElementTree as xml
import zlib

import numpy as np

from equations import LONG, Body, Material, value

HERE = pathlib.Path(__file__).resolve().parent
TOLERANCE = 1e-10
KINDS = {(5, 2): "triangle", (9, 2): "quadrilateral", (10, 3): "tetrahedron", (12, 3): "hexahedron"}
AXES = "xyz"


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def vtu(path):
    """The arrays of a field file by name."""
    out = {}
    for array in xml.parse(path).getroot().iter("DataArray"):
        if array.get("format") != "binary":
            continue
        text = array.text.strip()
        end = text.index("=") + 1 if "=" in text else len(text)
        while end < len(text) and text[end] == "=":
            end += 1
        blocks = int(np.frombuffer(base64.b64decode(text[:12])[:8], np.uint64)[0])
        head = 4 * -(-8 * (3 + blocks) // 3)
        sizes = np.frombuffer(base64.b64decode(text[:head]), np.uint64)[3:3 + blocks]
        raw, at, data = base64.b64decode(text[head:]), 0, b""
        for size in sizes:
            data += zlib.decompress(raw[at:at + int(size)])
            at += int(size)
        kind = {"Float64": np.float64, "Int64": np.int64, "Int32": np.int32, "UInt8": np.uint8, "Float32": np.float32}[array.get("type")]
        values = np.frombuffer(data, kind)
        parts = int(array.get("NumberOfComponents", 1))
        out[array.get("Name")] = values.reshape(-1, parts) if parts > 1 else values
    return out


def names(entry):
    on = entry.get("on", [])
    return [on] if isinstance(on, str) else on


class Check:
    def __init__(self, case, folder):
        self.case, self.folder, self.worst = case, folder, {}
        first = vtu(folder / "result_0000.vtu")
        nodes = table(folder / "nodes.csv")
        self.dim = 3 if "z" in nodes[0] else 2
        places = np.array([[float(n[a]) for a in AXES[:self.dim]] for n in nodes])
        # Points beyond the nodes repeat places where regions meet.
        known = {tuple(p): i for i, p in enumerate(places)}
        points = first["Points"][:, :self.dim]
        same = np.array([known[tuple(p)] for p in points])
        self.n = len(places)
        kind = KINDS[int(first["types"][0]), self.dim]
        cells = same[first["connectivity"]].reshape(len(first["types"]), -1)
        model = case.get("model", {})
        self.plane = model.get("plane", "strain")
        thermal, electric = model.get("thermal", True), model.get("electric", True)
        self.static = case["time"].get("regime") == "static"
        materials = [r["material"] for r in case.get("region", [])] or [case["material"]]
        centres = places[cells].mean(1)
        self.region_of = np.zeros(len(cells), int)
        for number, region in enumerate(case.get("region", [])):
            if "where" in region:
                self.region_of[value(region["where"], centres, 0) != 0] = number
            else:
                self.region_of[:] = first["region"]
        constants, index, seen = [], np.zeros(len(cells), int), {}
        for cell, number in enumerate(self.region_of):
            default = [0, 1] if self.dim == 2 else [0, 0, 1]
            poling = tuple(float(value(p, centres[cell:cell + 1], 0)[0]) for p in materials[number].get("poling", default))
            key = number, poling
            if key not in seen:
                m = Material(materials[number], thermal, electric)
                seen[key] = len(constants)
                constants.append((*m.turned(poling), m.reference))
            index[cell] = seen[key]
        self.body = Body(places, kind, cells, self.plane, constants, index)
        boundaries = json.loads((folder / "boundaries.json").read_text())["boundaries"]
        self.facets = {b["name"]: np.array(b["facets"]) for b in boundaries}
        self.on = {name: np.unique(f) for name, f in self.facets.items()}
        self.electrodes = self.find_electrodes()
        self.owners()

    def find_electrodes(self):
        """Nodes of each electrode."""
        out = {}
        for e in self.case.get("electrode", []):
            nodes = [self.on[name] for name in names(e) if name in self.on]
            if "where" in e:
                inside = value(e["where"], self.body.points, 0) != 0
                nodes.append(np.unique([f for f in self.inner_facets() if inside[list(f)].all()]).astype(int))
            out[e["name"]] = np.unique(np.concatenate(nodes))
        return out

    def inner_facets(self):
        corners = {"triangle": [(0, 1), (1, 2), (2, 0)], "quadrilateral": [(0, 1), (1, 2), (2, 3), (3, 0)],
                   "tetrahedron": [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)],
                   "hexahedron": [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (3, 2, 6, 7), (0, 3, 7, 4), (1, 2, 6, 5)]}[self.body.kind]
        count = {}
        for cell in self.body.cells:
            for c in corners:
                key = tuple(sorted(int(cell[i]) for i in c))
                count[key] = count.get(key, 0) + 1
        return [f for f, times in count.items() if times == 2]

    def owners(self):
        """By node the boundary (or electrode) that prescribes each unknown; the rules of docs/conventions.md."""
        self.u_owner, self.phi_owner, self.theta_owner = [{} for _ in range(self.dim)], {}, {}
        for entry in self.case.get("boundary", []):
            for name in names(entry):
                for i in self.on[name]:
                    for a in range(self.dim):
                        if "displacement" in entry and entry["displacement"][a] != "free":
                            self.u_owner[a].setdefault(i, name)
                    if "potential" in entry:
                        self.phi_owner.setdefault(i, name)
                    if "temperature" in entry:
                        self.theta_owner.setdefault(i, name)
        self.potential_given = set(self.phi_owner)
        for e in self.case.get("electrode", []):
            for name in names(e):
                for i in self.on.get(name, []):
                    self.phi_owner.setdefault(i, name)
            for i in self.electrodes[e["name"]]:
                self.phi_owner.setdefault(i, "inside " + e["name"])
        if self.plane == "axisymmetric":
            for i in np.flatnonzero(self.body.points[:, 0] == 0):
                self.u_owner[0].setdefault(i, "axis")
        contacts = self.case.get("contact", [])
        self.contacts = [contacts] if isinstance(contacts, dict) else contacts
        self.contact_owner = {}
        weights, normals = [], []  # by contact
        for contact in self.contacts:
            w, normal = np.zeros(self.n, LONG), np.zeros((self.n, self.dim), LONG)
            for name in names(contact):
                for N, weight, _, nu in self.body.facets(self.facets[name]):
                    np.add.at(w, self.facets[name], np.outer(weight, N))
                    np.add.at(normal, self.facets[name], np.einsum("f,a,fd->fad", weight, N, nu))
                for i in self.on[name]:
                    self.contact_owner.setdefault(i, name)
            weights.append(w)
            normals.append(normal)
        unit = lambda v: v / np.maximum(np.sqrt((v ** 2).sum(-1, keepdims=True)), 1e-300)
        self.w, normal = sum(weights, np.zeros(self.n, LONG)), sum(normals, np.zeros((self.n, self.dim), LONG))
        # At an edge between contacts a node has the weight and the normal of the first one alone.
        for i in self.contact_owner:
            there = [c for c, w in enumerate(weights) if w[i] > 0]
            if any(unit(normals[c][i]) @ unit(normal[i]) < np.cos(np.radians(41)) for c in there):
                self.w[i], normal[i] = weights[there[0]][i], normals[there[0]][i]
        self.nu = unit(normal)

    def wrong(self, name, difference, size):
        difference = float(np.max(np.abs(difference), initial=0))
        ratio = difference / max(float(size), 1e-300) if difference > 0 else 0.0
        if not ratio <= self.worst.get(name, (-1,))[0]:
            self.worst[name] = ratio, self.step

    # -- what is natural on the boundary, facets of one name at a time -------------------------------------------------

    def natural(self, name, t, state):
        """Nodal forces, charges out, heats out that are given on the facets of a boundary."""
        f, q, h = np.zeros((self.n, self.dim), LONG), np.zeros(self.n, LONG), np.zeros(self.n, LONG)
        for N, weight, places, nu in self.body.facets(self.facets[name]):
            def add(target, values):
                np.add.at(target, self.facets[name], np.outer(values * weight, N))
            for entry in self.case.get("boundary", []):
                if name not in names(entry):
                    continue
                for a, text in enumerate(entry.get("traction", [])):
                    add(f[:, a], value(text, places, t))
                if "surface_charge" in entry:
                    add(q, value(entry["surface_charge"], places, t))
                if "heat_flux" in entry:
                    add(h, value(entry["heat_flux"], places, t))
            for contact in self.contacts:
                if name not in names(contact):
                    continue
                heat, electric = contact.get("heat", {}), contact.get("electric", {})
                theta, phi = (np.einsum("a,fa->f", N, s[self.facets[name]]) for s in (state[2], state[1]))
                if "coefficient" in heat:
                    add(h, value(heat["coefficient"], places, t) * (theta - value(heat["foundation_temperature"], places, t)))
                if "coefficient" in electric:
                    add(q, value(electric["coefficient"], places, t) * (phi - value(electric["foundation_potential"], places, t)))
        return f, q, h

    def state(self, step):
        arrays = vtu(self.folder / f"result_{step:04}.vtu")
        return (arrays["displacement"][:self.n, :self.dim].astype(LONG), arrays["potential"][:self.n].astype(LONG),
                arrays["temperature"][:self.n].astype(LONG))

    def run(self):
        history = table(self.folder / "history.csv")
        probes = {p["name"]: table(self.folder / f"probe-{p['name']}.csv") for p in self.case.get("probe", [])}
        contact_rows = {}
        if self.contacts:
            for row in table(self.folder / "contact.csv"):
                contact_rows.setdefault(int(row["step"]), []).append(row)
        number = {tuple(float(v) for v in p): i for i, p in enumerate(self.body.points)}
        before, t0, memory = self.state(0), 0.0, {}
        for row in history:
            self.step, t = int(row["step"]), float(row["time"])
            state, k = self.state(self.step), t - t0
            load = self.case.get("load", {})

            def volume(kind, places):
                if kind == "force":
                    return [value(f, places, t) for f in load.get("force", [0] * self.dim)]
                return value(load.get(kind, 0), places, t)

            (f, q, h), sizes = self.body.lack(state, before, k, volume, self.static)
            given = {name: self.natural(name, t, state) for name in self.facets}
            total = [sum(g[i] for g in given.values()) for i in range(3)]
            f_contact, h_contact = np.zeros_like(f), np.zeros_like(h)
            rows = contact_rows.get(self.step, [])
            at = np.array([number[tuple(float(r[a]) for a in AXES[:self.dim])] for r in rows], int)
            if len(at):
                column = lambda name: np.array([float(r[name]) for r in rows], LONG)
                tau = np.stack([column("tangential_traction_" + a) for a in AXES[:self.dim]], 1)
                f_contact[at] = self.w[at, None] * (column("normal_traction")[:, None] * self.nu[at] + tau)
                self.laws(rows, column, at, tau, state, before, t, t0, memory)
                for i, r in zip(at, rows):  # heat that crosses by the contact's state
                    contact = self.contact_of(i)
                    heat = contact.get("heat", {})
                    place = self.body.points[i:i + 1]
                    plain = 0 if "coefficient" not in heat else \
                        value(heat["coefficient"], place, t)[0] * (state[2][i] - value(heat["foundation_temperature"], place, t)[0])
                    h_contact[i] = self.w[i] * (LONG(float(r["heat_flux"])) - plain)
            rest = [f - total[0] - f_contact, q - total[1], h - total[2] - h_contact]
            self.free(rest, sizes)
            self.row, self.given, self.rest, self.sizes = row, given, rest, sizes
            self.f_contact, self.h_contact, self.values = f_contact, h_contact, state
            self.history(row, history, t, k)
            for probe in self.case.get("probe", []):
                self.probe(probe, [r for r in probes[probe["name"]] if int(r["step"]) == self.step])
            before, t0 = state, t
        return self.worst

    def contact_of(self, i):
        name = self.contact_owner[i]
        return next(c for c in self.contacts if name in names(c))

    def free(self, rest, sizes):
        """Nodes that nothing holds lack nothing."""
        for a in range(self.dim):
            loose = np.setdiff1d(np.arange(self.n), list(self.u_owner[a]))
            self.wrong("force at free nodes", rest[0][loose, a], sizes[0].max())
        loose = np.setdiff1d(np.arange(self.n), list(self.phi_owner))
        self.wrong("charge at free nodes", rest[1][loose], sizes[1].max())
        loose = np.setdiff1d(np.arange(self.n), list(self.theta_owner))
        self.wrong("heat at free nodes", rest[2][loose], sizes[2].max())

    def laws(self, rows, column, at, tau, state, before, t, t0, memory):
        p, rate = -column("normal_traction"), column("slip_rate")
        u = state[0][at]
        for i, (node, row) in enumerate(zip(at, rows)):
            contact = self.contact_of(node)
            place = self.body.points[node:node + 1]
            moved = lambda time: np.array([value(v, place, time)[0] for v in contact.get("foundation_displacement", [0] * self.dim)])
            gap = value(contact.get("gap", 0), place, t)[0]
            nu = self.nu[node]
            relative, old = u[i] - moved(t), before[0][node] - moved(t0)
            if t0 == 0:
                old = before[0][node] - moved(0)
            delta = relative @ nu - gap
            size = np.abs(u).max() + np.abs(moved(t)).max() + abs(gap)
            self.wrong("gap", float(row["gap"]) + delta, size)
            slip = (relative - old) - ((relative - old) @ nu) * nu
            now = relative - (relative @ nu) * nu
            self.wrong("slip", np.array([float(row["slip_" + a]) for a in AXES[:self.dim]]) - now, size)
            self.wrong("slip rate", rate[i] * (t - t0) - np.sqrt(slip @ slip), size)
            normal = contact.get("normal", "bilateral")
            law = normal if isinstance(normal, str) else normal["law"]
            if any(node in o for o in self.u_owner):
                continue
            if law == "unilateral":
                self.wrong("unilateral", min(p[i], 0), np.abs(p).max())
                self.wrong("unilateral", max(delta, 0), size)
                self.wrong("unilateral", p[i] * delta, np.abs(p).max() * size)
            elif law == "compliance":
                self.wrong("compliance", p[i] - normal["coefficient"] * max(delta, 0) ** normal.get("exponent", 1), np.abs(p).max())
            else:
                self.wrong("bilateral", delta, size)
            friction = contact.get("friction", {"law": "none"})
            if friction == "none" or friction["law"] == "none":
                bound = LONG(0)
            elif friction["law"] == "tresca":
                bound = value(friction["bound"], place, t)[0]
            else:
                bound = max(LONG(0), value(friction.get("cohesion", 0), place, t)[0] + value(friction["coefficient"], place, t)[0] * p[i])
                bound = min(bound, value(friction.get("limit", 1e300), place, t)[0])
                if law != "bilateral" and row["status"] == "open":
                    bound = LONG(0)
            borne, largest = np.sqrt(tau[i] @ tau[i]), np.abs(tau).max() + np.abs(p).max()
            self.wrong("friction bound", max(borne - bound, 0), largest)
            gone = np.sqrt(slip @ slip)
            if row["status"] == "stick":
                self.wrong("stick", gone, size)
            elif row["status"] == "slip" and gone > 1e-9 * size:
                self.wrong("friction against the slip", tau[i] + bound * slip / gone, largest)

    # -- what the tables say -------------------------------------------------------------------------------------------

    def through(self, chosen):
        """Force by node, charge, heat through boundaries, with sizes."""
        nodes = np.unique(np.concatenate([self.on[name] for name in chosen]))
        force = sum((self.given[name][0] for name in set(chosen)), np.zeros((self.n, self.dim), LONG))
        charge, heat = (sum(self.given[name][i].sum() for name in set(chosen)) for i in (1, 2))
        for a in range(self.dim):
            for i, name in self.u_owner[a].items():
                if name in chosen:
                    force[i, a] += self.rest[0][i, a]
        for i, name in self.contact_owner.items():
            if name in chosen:
                force[i] += self.f_contact[i]
                heat += self.h_contact[i]
        charge += sum(self.rest[1][i] for i, name in self.phi_owner.items() if name in chosen)
        heat += sum(self.rest[2][i] for i, name in self.theta_owner.items() if name in chosen)
        sizes = self.sizes[0][nodes].sum(), self.sizes[1][nodes].sum(), self.sizes[2][nodes].sum()
        return force, charge, heat, sizes

    def history(self, row, history, t, k):
        for name in self.facets:
            _, charge, heat, sizes = self.through([name])
            if "charge_" + name in row:
                self.wrong("history: charge_", float(row["charge_" + name]) - charge, sizes[1])
            if "heat_" + name in row:
                self.wrong("history: heat_", float(row["heat_" + name]) - heat, sizes[2])
        previous = history[int(row["step"]) - 2] if int(row["step"]) > 1 else None
        seen = set(self.potential_given)
        for e in self.case.get("electrode", []):
            nodes = [i for i in self.electrodes[e["name"]] if i not in seen]
            seen |= set(nodes)
            get = lambda what, of=None, r=None: float((r or row)[f"electrode_{of or e['name']}_{what}"])
            self.wrong("electrode: one potential", self.values[1][nodes] - get("voltage"), np.abs(self.values[1]).max())
            self.wrong("electrode: charge", get("charge") + self.rest[1][nodes].sum(), self.sizes[1][nodes].sum())
            source = value(e.get("voltage", 0), np.zeros((1, self.dim)), t)[0]
            if "resistor" in e or "capacitor" in e:
                if previous is None:
                    continue  # the state at the time 0 is not in the table
                other = lambda r, time: float(r[f"electrode_{e['to']}_voltage"]) if "to" in e else value(e.get("voltage", 0), np.zeros((1, self.dim)), time)[0]
                now, then = get("voltage") - other(row, t), get("voltage", r=previous) - other(previous, t - k)
                flow = (k / e["resistor"] * now if "resistor" in e else 0) + e.get("capacitor", 0) * (now - then)
                # Others may lead to this electrode.
                for o in self.case["electrode"]:
                    if o.get("to") == e["name"]:
                        d1 = get("voltage") - get("voltage", o["name"])
                        d0 = get("voltage", r=previous) - get("voltage", o["name"], previous)
                        flow += (k / o["resistor"] * d1 if "resistor" in o else 0) + o.get("capacitor", 0) * (d1 - d0)
                change = get("charge") - get("charge", r=previous)
                self.wrong("electrode: circuit", change + flow, self.sizes[1][nodes].sum())
            elif "charge" in e:
                self.wrong("electrode: given charge", get("charge") - value(e["charge"], np.zeros((1, self.dim)), t)[0], self.sizes[1][nodes].sum())
            elif "voltage" in e:
                self.wrong("electrode: given voltage", get("voltage") - source, max(abs(source), 1e-300))
            elif previous is not None and not any(o.get("to") == e["name"] for o in self.case["electrode"]):
                self.wrong("electrode: open", get("charge") - get("charge", r=previous), self.sizes[1][nodes].sum())
            if "resistor" in e:
                across = get("voltage") - (get("voltage", e["to"]) if "to" in e else source)
                self.wrong("electrode: power in its resistor", get("resistor_power") - across ** 2 / e["resistor"], get("resistor_power"))
            if previous is not None:
                self.wrong("electrode: current", get("current") * k - get("charge") + get("charge", r=previous), self.sizes[1][nodes].sum())

    def probe(self, probe, rows):
        row = rows[0]
        if "on" in probe:
            chosen = names(probe)
            force, charge, heat, sizes = self.through(chosen)
            radial = self.plane == "axisymmetric"
            for a in range(self.dim):
                if f"force_{AXES[a]}" in row:
                    self.wrong("probe: force_" + AXES[a], float(row[f"force_{AXES[a]}"]) - force[:, a].sum(), sizes[0])
            arm = self.body.points - np.array(probe.get("about", [0] * self.dim), float)
            moment = np.cross(arm, force) if self.dim == 3 else arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
            for a in range(3):
                if f"moment_{AXES[a]}" in row:
                    value_here = moment[:, a].sum() if self.dim == 3 else moment.sum()
                    self.wrong("probe: moment", float(row[f"moment_{AXES[a]}"]) - value_here, sizes[0] * np.abs(arm).max())
            if radial and "moment_z" in row:
                self.wrong("probe: moment of a body of revolution", 1, 1)
            if "charge" in row:
                self.wrong("probe: charge", float(row["charge"]) - charge, sizes[1])
            if "heat" in row:
                self.wrong("probe: heat", float(row["heat"]) - heat, sizes[2])
            area = sum(w.sum() for name in set(chosen) for _, w, _, _ in self.body.facets(self.facets[name]))
            self.wrong("probe: area", float(row["area"]) - area, area)
        elif "region" in probe:
            wanted = [probe["region"]] if isinstance(probe["region"], str) else probe["region"]
            numbers = [i for i, r in enumerate(self.case["region"]) if r.get("name", "+".join(names(r))) in wanted]
            expected = self.body.region(self.values, np.isin(self.region_of, numbers))
            energies = [n for n in expected if n.endswith("_energy")]
            for name, number in expected.items():
                if name not in row:
                    continue
                if name in energies:
                    size = sum(abs(expected[n]) for n in energies)
                elif name == "volume":
                    size = number
                else:
                    field = name.split("_", 1)[1]
                    all_values = {"potential": self.values[1], "temperature": self.values[2]}.get(field, self.values[0])
                    size = np.abs(all_values).max()
                self.wrong("probe: " + name, float(row[name]) - number, size)
            missing = set(row) - set(expected) - {"step", "time"}
            if missing:
                self.wrong(f"probe: columns {sorted(missing)}", 1, 1)
        else:
            nodal = np.concatenate([self.values[0], self.values[1][:, None], self.values[2][:, None]], 1)
            for r in rows:
                place = np.array([float(r[a]) for a in AXES[:self.dim]])
                got = self.body.at(place, nodal)
                fields = [f"u_{a}" for a in AXES[:self.dim]] + ["potential", "temperature"]
                for a, name in enumerate(fields):
                    if name in r:
                        size = np.abs(nodal[:, :self.dim] if a < self.dim else nodal[:, a]).max()
                        self.wrong("probe: field at a place", float(r[name]) - got[a], size)


def main():
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1:] if "--" in arguments else []
    program, *chosen = arguments[:arguments.index("--")] if "--" in arguments else arguments
    cases = sorted(HERE.glob("cases/*.toml"))
    failed = False
    for path in cases:
        if chosen and path.stem not in chosen:
            continue
        with tempfile.TemporaryDirectory() as folder:
            command = [program, "run", str(path), "-q", "-o", folder, "--set", "output.report=false", "--set", "output.every=1", *options]
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            if done.returncode != 0:
                print(f"{path.stem}: exit status {done.returncode}: {done.stderr}")
                failed = True
                continue
            worst = Check(tomllib.loads(path.read_text()), pathlib.Path(folder)).run()
        print(path.stem)
        for name, (ratio, step) in sorted(worst.items(), key=lambda w: -w[1][0]):
            bad = not ratio <= TOLERANCE
            failed |= bad
            print(f"  {ratio:9.1e}  {name}" + (f"  (step {step})  TOO LARGE" if bad else ""))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
