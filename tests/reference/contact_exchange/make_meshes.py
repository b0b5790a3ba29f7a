#!/usr/bin/python3
"""Writes the meshes of cases/ that are not boxes: a plate and a block that are turned, and an arch."""
import math
import pathlib

import numpy as np

from body import box_mesh

HERE = pathlib.Path(__file__).resolve().parent


def write(name, points, cells, sides):
    """Gmsh's text format 2.2."""
    dim = points.shape[1]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(sides) + 1)]
    lines += [f'{dim - 1} {i} "{side}"' for i, side in enumerate(sides, 1)] + [f'{dim} {len(sides) + 1} "body"', "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(points))]
    lines += [" ".join([str(i), *(repr(float(v)) for v in [*p, 0.0][:3])]) for i, p in enumerate(points, 1)] + ["$EndNodes"]
    elements = [(1 if dim == 2 else 3, i, f) for i, side in enumerate(sides, 1) for f in sides[side]]
    elements += [(3 if dim == 2 else 5, len(sides) + 1, c) for c in cells]
    lines += ["$Elements", str(len(elements))]
    lines += [" ".join(map(str, [n, kind, 2, tag, tag, *(v + 1 for v in nodes)])) for n, (kind, tag, nodes) in enumerate(elements, 1)]
    (HERE / "cases" / name).write_text("\n".join(lines + ["$EndElements"]) + "\n")


def turned(axis, angle):
    a = np.array(axis) / np.linalg.norm(axis)
    W = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + math.sin(angle) * W + (1 - math.cos(angle)) * W @ W


def main():
    points, _, cells, sides = box_mesh({"min": [0, 0], "max": [0.02, 0.01], "cells": [14, 7], "cell": "quadrilateral"})
    c, s = math.cos(math.radians(25)), math.sin(math.radians(25))
    write("plate-turned.msh", points @ np.array([[c, s], [-s, c]]), cells, sides)
    points, _, cells, sides = box_mesh({"min": [0, 0, 0], "max": [0.008, 0.006, 0.004], "cells": [4, 3, 3], "cell": "hexahedron"})
    write("block-turned.msh", points @ turned([1, 2, 0.5], math.radians(35)).T, cells, sides)
    # An arch about the origin, from 60 to 120 degrees, radii 0.01 and 0.016: its inner side is in contact.
    points, _, cells, sides = box_mesh({"min": [0, 0], "max": [1, 1], "cells": [14, 6], "cell": "quadrilateral"})
    angle, radius = np.radians(120 - 60 * points[:, 0]), 0.01 + 0.006 * points[:, 1]
    write("arch.msh", np.stack([radius * np.cos(angle), radius * np.sin(angle)], 1), cells, sides)


if __name__ == "__main__":
    main()
