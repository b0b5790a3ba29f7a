#!/usr/bin/python3
"""The twisted block of cases/block-3d/twisted.toml solved with GetFEM: the benchmark's peer in three dimensions.

By the method of getfem_paper.py, which see: the monolithic Newton iteration on (u, phi, theta, lambda) with the augmented
Lagrangians (40), (41), in scaled unknowns and in the symmetric form of the equations. Friction is Tresca's on a disc, so
the tangent of a sliding node turns with its slip and the iteration converges quadratically instead of in finitely many steps.

The discrete problem: n x n x n cubes, each split into five tetrahedra; P1 for all fields; backward Euler; multipliers at
the nodes of Gamma_C with the lumped weights, the integrals of the shape functions; all other integrals exact.
"""
import sys

sys.dont_write_bytecode = True                                 # nothing is left among the sources

from getfem_common import (BOUND, CONSTANTS, FOUNDATION, L, LOAD_RATE, PHI, THETA, U, Clock, Direct, Incomplete, Operator,
                           add_options, block, free_scratch, march, node_rows, partial, quiet, write_csv,
                           write_measurements)

import argparse
import itertools

import getfem as gf
import numpy as np

END = 0.02                                                    # two of the case's steps [s]
TWIST_RATE = 400.0                                            # shear tractions 400 t^2 on four sides [N/m^2]
C12 = 77e9                                                    # [Pa], completes the paper's constants
SOLID = dict(CONSTANTS, c12=C12, c66=(CONSTANTS['c11'] - C12) / 2)
HEAT = 4                                                      # component of theta in the field (u_x, u_y, u_z, phi, theta)

# Voigt's strains and the gradient of the potential; the crystal is poled along z.
EXX, EYY, EZZ = 'Grad_field(1,1)', 'Grad_field(2,2)', 'Grad_field(3,3)'
GYZ, GXZ, GXY = ('(Grad_field(%d,%d)+Grad_field(%d,%d))' % (a, b, b, a) for a, b in ((2, 3), (1, 3), (1, 2)))
PX, PY, PZ = ('Grad_field(4,%d)' % axis for axis in (1, 2, 3))


def sum_of_products(*pairs):
    """Of stresses, electric displacements or heat fluxes with the gradients of the test functions."""
    return '+'.join('(%s)*%s' % (flux, gradient.replace('Grad_field', 'Grad_Test_field')) for flux, gradient in pairs)


COUPLED = sum_of_products(                                    # (31), (32), couplings of (33)
    (f'c11*{EXX}+c12*{EYY}+c13*{EZZ}+e31*{PZ}-m11*field(5)', EXX),
    (f'c12*{EXX}+c11*{EYY}+c13*{EZZ}+e31*{PZ}-m11*field(5)', EYY),
    (f'c13*{EXX}+c13*{EYY}+c33*{EZZ}+e33*{PZ}-m33*field(5)', EZZ),
    (f'c44*{GYZ}+e15*{PY}', GYZ),
    (f'c44*{GXZ}+e15*{PX}', GXZ),
    (f'c66*{GXY}', GXY),
    (f'e15*{GXZ}-b11*{PX}', PX),
    (f'e15*{GYZ}-b11*{PY}', PY),
    (f'e31*{EXX}+e31*{EYY}+e33*{EZZ}-b33*{PZ}+p3*field(5)', PZ),
) + f'-(m11*{EXX}+m11*{EYY}+m33*{EZZ}-p3*{PZ})*Test_field(5)'
CAPACITY = '-alpha*field(5)*Test_field(5)'
CONDUCTION = '-(%s)' % sum_of_products(*(('k%s*Grad_field(5,%d)' % (k, axis), 'Grad_field(5,%d)' % axis)
                                     for k, axis in (('11', 1), ('11', 2), ('33', 3))))
HEAT_EXCHANGE = '-kc*field(5)*Test_field(5)'                  # (13), (18)


def tetrahedra(n):
    """The corners of all cells on the lattice, (n^3, 5, 4, 3).

    The lattice points of odd sum in a cube are the corners of one tetrahedron, each of its points of even sum and its
    three neighbours those of another. So neighbouring cubes split their common face alike."""
    corners = [np.array(c) for c in itertools.product((0, 1), repeat=3)]

    def split(cube):
        odd = [c for c in corners if (c.sum() + cube) % 2]
        rest = [[c] + [np.where(np.arange(3) == axis, 1 - c, c) for axis in range(3)]
                for c in corners if (c.sum() + cube) % 2 == 0]
        return [odd] + rest

    splits = np.array([split(0), split(1)])
    cubes = np.array(list(itertools.product(range(n), repeat=3)))
    return splits[cubes.sum(axis=1) % 2] + cubes[:, None, None, :]


def block_mesh(n):
    """The mesh and the region numbers of its sides, which are named as in the case."""
    corners = tetrahedra(n).reshape(-1, 4, 3)
    mesh = gf.Mesh('empty', 3)
    cells = mesh.add_convex(gf.GeoTrans('GT_PK(3,1)'), np.asfortranarray(corners.transpose(2, 1, 0) * (L / n)))
    regions = {}
    for axis, names in enumerate((('left', 'right'), ('front', 'back'), ('bottom', 'top'))):
        for name, place in zip(names, (0, n)):
            on_side = corners[:, :, axis] == place
            here = on_side.sum(axis=1) == 3
            regions[name] = len(regions) + 1
            # GetFEM's face i of a simplex lies opposite to its corner i.
            mesh.set_region(regions[name], np.stack([cells[here], on_side[here].argmin(axis=1)]))
    return mesh, regions


class Body(Operator):
    """Mesh, spaces without the prescribed values, the linear operator and its loads, inside a GetFEM model."""

    def __init__(self, n, k):
        mesh, sides = block_mesh(n)
        self.mesh = mesh                                       # the model only refers to it
        e = L / n / 8

        # One field (u_x, u_y, u_z, phi, theta): the unknowns of a node stand together, which incomplete factors need.
        self.whole = whole = gf.MeshFem(mesh, 5)
        self.traces = traces = {'normal': gf.MeshFem(mesh, 1), 'tangential': gf.MeshFem(mesh, 2)}
        for fem in (whole, *traces.values()):
            fem.set_classical_fem(1)
        p = whole.basic_dof_nodes()
        kind = np.arange(p.shape[1]) % 5
        cold = ((p[1:] < e) | (p[1:] > L - e)).any(axis=0)
        prescribed = (p[0] > L - e) | ((kind == HEAT) & cold)
        self.free = np.flatnonzero(~prescribed)
        self.points = p[:, ::5]

        spaces = {name: partial(fem, np.flatnonzero(fem.basic_dof_nodes()[0] < e)) for name, fem in traces.items()}
        super().__init__(dict(field=partial(whole, self.free), **spaces), np.flatnonzero(kind[self.free] == HEAT), k, SOLID)
        # Gradients are constant on a cell: one point is exact for everything but the heat capacity.
        exact = gf.MeshIm(mesh, gf.Integ('IM_TETRAHEDRON(2)'))
        self.assemble(gf.MeshIm(mesh, gf.Integ('IM_TETRAHEDRON(1)')), exact, COUPLED, CAPACITY, CONDUCTION, HEAT_EXCHANGE,
                      sides['left'])
        self.add_loads(exact, sides)
        self.find_contact_nodes(exact, sides['left'], p[:, self.free], kind[self.free], e)

    def add_loads(self, exact, sides):
        """(19) for the tractions that grow with t and with t^2, and the exchange with theta_f (18)."""
        on = lambda side, expression: gf.asm_generic(exact, 1, expression, sides[side], self.md)
        self.drawn = U * on('top', 'Test_field(3)')
        self.twisted = U * (on('bottom', 'Test_field(2)') - on('top', 'Test_field(2)')
                            + on('back', 'Test_field(3)') - on('front', 'Test_field(3)'))
        self.foundation = -FOUNDATION / THETA * on('left', 'kc*Test_field(5)')

    def find_contact_nodes(self, exact, side, p, kind, e):
        """Rows of u_x, and pairs of rows of u_y and u_z, in the field; lumped weights."""
        x, y, z = (np.flatnonzero((p[0] < e) & (kind == component)) for component in range(3))
        multipliers = self.traces['tangential'].basic_dof_nodes()
        assert np.array_equal(p[:, np.column_stack([y, z]).ravel()], multipliers[:, multipliers[0] < e])
        self.normal, self.tangential = x, np.column_stack([y, z])
        self.w = gf.asm_generic(exact, 1, 'Test_normal', side, self.md)[self.at['normal']]

    def load(self, t):
        return LOAD_RATE * t * self.drawn + TWIST_RATE * t ** 2 * self.twisted + self.foundation


class Contact:
    """The augmented Lagrangians (40), (41) at the contact nodes: gradient and tangent, both pointwise.

    With nodal forces as multipliers the lumped weights are in the bound S w_i alone. r multiplies the scaled increment of
    u and is the stiffness' diagonal at a contact node, up to a factor near 1: that takes the fewest iterations. The state
    is the derivative of the projection onto the disc at each node: the identity where it sticks."""

    def __init__(self, body, r):
        self.body, self.r = body, r
        self.bound = U * BOUND * body.w
        self.count, self.size = len(body.w), body.at['field'].stop - body.at['field'].start
        self.state = np.tile(np.eye(2), (self.count, 1, 1))
        add, ones, nodes = body.md.add_explicit_matrix, np.ones(self.count), np.arange(self.count)
        add('field', 'normal', block((self.size, self.count), body.normal, nodes, ones), 1)
        add('field', 'field', block((self.size, self.size), body.normal, body.normal, r * ones), 1)
        self.bricks = [add(a, b, matrix, 1) for a, b, matrix in self.tangent(self.state)]

    def tangent(self, derivative):
        """Second derivatives of (41), a 2 x 2 block for each node and each pair of variables."""
        rows, multipliers = self.body.tangential, np.arange(2 * self.count).reshape(-1, 2)
        sizes = {'field': self.size, 'tangential': 2 * self.count}
        for a, b, values in (('field', 'tangential', derivative), ('field', 'field', self.r * derivative),
                             ('tangential', 'tangential', (derivative - np.eye(2)) / self.r)):
            left, right = (rows if name == 'field' else multipliers for name in (a, b))
            left, right = np.broadcast_arrays(left[:, :, None], right[:, None, :])
            yield a, b, block((sizes[a], sizes[b]), left.ravel(), right.ravel(), values.ravel())

    def set_tangent(self, derivative):
        if not np.array_equal(derivative, self.state):
            for brick, (_, _, matrix) in zip(self.bricks, self.tangent(derivative)):
                self.body.md.set_private_matrix(brick, matrix)
            self.state = derivative

    def share_changed_from(self, derivative):
        return (np.abs(self.state - derivative).max(axis=(1, 2)) > 0.5).sum() / self.count

    def residual(self, x, x_old):
        """First derivatives of (40), (41), and the derivative of the projection, whose kink is |lambda + r du| = S."""
        body, at, r = self.body, self.body.at, self.r
        w, dw = x[at['field']], (x - x_old)[at['field']]
        multiplier = x[at['tangential']].reshape(-1, 2)
        augmented = multiplier + r * dw[body.tangential]
        projected, derivative = project(augmented, self.bound)
        out = np.zeros(len(x))
        out[at['field'].start + body.normal] = x[at['normal']] + r * w[body.normal]
        out[at['field'].start + body.tangential] = projected
        out[at['normal']] = w[body.normal]
        out[at['tangential']] = ((projected - multiplier) / r).ravel()
        return out, derivative


def project(points, radius):
    """Projections onto discs of these radii and their derivatives: outside, R/|x| (I - x x^T/|x|^2)."""
    size = np.linalg.norm(points, axis=1)
    outside = size > radius
    direction = points / np.where(outside, size, 1.0)[:, None]
    across = np.eye(2) - direction[:, :, None] * direction[:, None, :]
    projected = np.where(outside[:, None], radius[:, None] * direction, points)
    shrink = (radius / np.where(outside, size, 1.0))[:, None, None]
    return projected, np.where(outside[:, None, None], shrink * across, np.eye(2))


def run(options):
    clock = Clock()
    k = options.end / options.steps
    body = Body(options.cells, k)
    contact = Contact(body, L / options.cells)
    free_scratch()
    if options.solver == 'fastest':
        options.solver = 'cg' if len(body.foundation) > 5_000 else 'auto'
    solver = Direct(body, options.solver) if options.solver != 'cg' else Incomplete(
        body, contact, fill=8, drop=3e-3, reduction=1e-4, changed=0.3)
    clock.stage('assemble')

    x, iterations = march(body, contact, solver, k, options.steps, options)
    clock.stage('steps')
    return body, x, iterations, clock.end(solver)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--cells', type=int, required=True, help='cubes along each side')
    add_options(parser, 2, '--end')
    parser.add_argument('--end', type=float, default=END, help='time of the last step [s]')
    parser.add_argument('--solver', choices=['fastest', 'cg', 'auto', 'mumps'], default='fastest',
                        help="cg with kept incomplete factors, or GetFEM's lsolver: auto is MUMPS' LDL^T, mumps its LU; "
                             'fastest is cg above 5 000 unknowns, else auto')
    options = parser.parse_args()

    quiet()
    body, x, iterations, seconds = run(options)
    if options.nodes:
        write_csv(options.nodes, 'x,y,z,u_x,u_y,u_z,potential,temperature',
                  node_rows(body.points, body.free, x[body.at['field']], [U, U, U, PHI, THETA]))
    write_measurements(options, len(x), iterations, seconds)


if __name__ == '__main__':
    main()
