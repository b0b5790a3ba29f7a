#!/usr/bin/python3
"""The paper's conductive example solved with GetFEM: the benchmark's peer.

Ouafik (2020), section 4, by the paper's own method (37)-(44): the monolithic Newton iteration on (u, phi, theta, lambda)
with the augmented Lagrangians (40), (41). GetFEM supplies mesh, finite elements, assembly, the global tangent matrix and
the linear solver; this file supplies the weak form and the pointwise contact law, getfem_common.py the time loop and the
Newton loop. README.md beside it says which settings make it as fast as GetFEM can be and what each is worth.

The discrete problem: n x n squares, each split by the diagonal from lower right to upper left; P1 for all fields;
backward Euler; multipliers at the nodes of Gamma_C with the lumped weights h, h/2; all other integrals exact.

Everything is written in scaled unknowns, u = U u', phi = PHI phi', theta = THETA theta', and in the symmetric form of the
equations (electric row times -1, heat row times -k/theta_ref), which LDL^T and conjugate gradients need. GetFEM sees one
vector field (u_x, u_y, phi, theta) and the multipliers: nodal forces w_i lambda_i in the same scaling.
"""
import sys

sys.dont_write_bytecode = True                                 # nothing is left among the sources

from getfem_common import (BOUND, CONSTANTS, FOUNDATION, L, LOAD_RATE, PHI, THETA, U, Clock, Direct, Incomplete, Operator,
                           add_options, block, free_scratch, march, node_rows, partial, quiet, write_csv,
                           write_measurements)

import argparse

import getfem as gf
import numpy as np

END = 0.2                                                     # T [s]
HEAT = 3                                                      # component of theta in the field (u_x, u_y, phi, theta)

COUPLED = (                                                   # (31), (32), couplings of (33)
    '(c11*Grad_field(1,1)+c13*Grad_field(2,2)+e31*Grad_field(3,2)-m11*field(4))*Grad_Test_field(1,1)'
    '+(c13*Grad_field(1,1)+c33*Grad_field(2,2)+e33*Grad_field(3,2)-m33*field(4))*Grad_Test_field(2,2)'
    '+(c44*(Grad_field(1,2)+Grad_field(2,1))+e15*Grad_field(3,1))*(Grad_Test_field(1,2)+Grad_Test_field(2,1))'
    '+(e15*(Grad_field(1,2)+Grad_field(2,1))-b11*Grad_field(3,1))*Grad_Test_field(3,1)'
    '+(e31*Grad_field(1,1)+e33*Grad_field(2,2)-b33*Grad_field(3,2)+p3*field(4))*Grad_Test_field(3,2)'
    '-(m11*Grad_field(1,1)+m33*Grad_field(2,2)-p3*Grad_field(3,2))*Test_field(4)')
CAPACITY = '-alpha*field(4)*Test_field(4)'
CONDUCTION = '-k11*Grad_field(4,1)*Grad_Test_field(4,1)-k33*Grad_field(4,2)*Grad_Test_field(4,2)'
HEAT_EXCHANGE = '-kc*field(4)*Test_field(4)'                  # (13), (18)


class Body(Operator):
    """Mesh, spaces without the prescribed values, the linear operator and its loads, inside a GetFEM model."""

    def __init__(self, n, k):
        # GetFEM's grid has the other diagonal; a quarter turn gives ours.
        x = np.linspace(0, L, n + 1)
        self.mesh = mesh = gf.Mesh('triangles grid', x, x)
        mesh.transform([[0, -1], [1, 0]])
        mesh.translate([L, 0])
        e = L / n / 8
        contact, top = 1, 2
        mesh.set_region(contact, mesh.outer_faces_in_box([-e, -e], [e, L + e]))
        mesh.set_region(top, mesh.outer_faces_in_box([-e, L - e], [L + e, L + e]))

        # One field (u_x, u_y, phi, theta): the unknowns of a node stand together, which incomplete factors need.
        self.whole, self.trace = whole, trace = gf.MeshFem(mesh, 4), gf.MeshFem(mesh, 1)
        whole.set_classical_fem(1)
        trace.set_classical_fem(1)
        p, q = whole.basic_dof_nodes(), trace.basic_dof_nodes()
        kind = np.arange(p.shape[1]) % 4
        prescribed = (p[0] > L - e) | ((kind == HEAT) & ((p[1] < e) | (p[1] > L - e)))
        self.free = np.flatnonzero(~prescribed)
        on_contact = np.flatnonzero(q[0] < e)
        self.points = p[:, ::4]

        # Contact nodes: rows of u_x and u_y in the field, lumped weights.
        here = p[0, self.free] < e
        self.ux, self.uy = (np.flatnonzero(here & (kind[self.free] == component)) for component in (0, 1))
        self.y = q[1, on_contact]
        assert np.array_equal(p[1, self.free][self.uy], self.y)
        self.w = np.full(n + 1, L / n)
        self.w[(self.y < e) | (self.y > L - e)] /= 2

        spaces = dict(field=partial(whole, self.free), normal=partial(trace, on_contact), tangential=partial(trace, on_contact))
        super().__init__(spaces, np.flatnonzero(kind[self.free] == HEAT), k, CONSTANTS)
        # Gradients are constant on a cell: one point is exact for everything but the heat capacity.
        exact = gf.MeshIm(mesh, gf.Integ('IM_TRIANGLE(2)'))
        self.assemble(gf.MeshIm(mesh, gf.Integ('IM_TRIANGLE(1)')), exact, COUPLED, CAPACITY, CONDUCTION, HEAT_EXCHANGE, contact)
        # (19) for f_N = (0, 1) and the exchange with theta_f (18), both constant on an edge
        self.traction = U * gf.asm_generic(exact, 1, 'Test_field(2)', top, self.md)
        self.foundation = -FOUNDATION / THETA * gf.asm_generic(exact, 1, 'kc*Test_field(4)', contact, self.md)

    def load(self, t):
        return LOAD_RATE * t * self.traction + self.foundation


class Contact:
    """The augmented Lagrangians (40), (41) at the contact nodes: gradient and tangent, both pointwise.

    With nodal forces as multipliers the lumped weights are in the bound S w_i alone. r multiplies the scaled increment of
    u and is of the order of the stiffness' diagonal; a full Newton step does not depend on it. The state is which nodes
    slide."""

    def __init__(self, body, r=1.0):
        self.body, self.r = body, r
        self.bound = U * BOUND * body.w
        self.count, self.size = len(body.w), body.at['field'].stop - body.at['field'].start
        self.state = np.zeros(self.count, bool)
        add = body.md.add_explicit_matrix
        add('field', 'normal', self.matrix('field', 'normal', body.ux, np.ones(self.count)), 1)
        self.bricks = [add(a, b, matrix, 1) for a, b, matrix in self.tangent(self.state)]

    def matrix(self, a, b, rows, values):
        """The block (a, b) with `values` at the contact nodes' rows; its columns are the same nodes'."""
        shape = [self.size if name == 'field' else self.count for name in (a, b)]
        return block(shape, rows, rows if b == 'field' else np.arange(self.count), values)

    def tangent(self, sliding):
        """Second derivatives of (40), (41): sticking nodes couple u and lambda, sliding nodes hold lambda."""
        body, nodes = self.body, np.arange(self.count)
        yield 'field', 'tangential', self.matrix('field', 'tangential', body.uy, np.where(sliding, 0.0, 1.0))
        yield 'field', 'field', self.matrix('field', 'field', np.concatenate([body.ux, body.uy]),
                                            self.r * np.concatenate([np.ones(self.count), ~sliding]))
        yield 'tangential', 'tangential', self.matrix('tangential', 'tangential', nodes, np.where(sliding, -1.0 / self.r, 0.0))

    def set_tangent(self, sliding):
        if not np.array_equal(sliding, self.state):
            for brick, (_, _, matrix) in zip(self.bricks, self.tangent(sliding)):
                self.body.md.set_private_matrix(brick, matrix)
            self.state = sliding

    def share_changed_from(self, sliding):
        return (self.state != sliding).sum() / self.count

    def residual(self, x, x_old):
        """First derivatives of (40), (41), and which nodes slide: |lambda + r du| > S."""
        body, at, r = self.body, self.body.at, self.r
        w, dw = x[at['field']], (x - x_old)[at['field']]
        augmented = x[at['tangential']] + r * dw[body.uy]
        projected = np.clip(augmented, -self.bound, self.bound)
        out = np.zeros(len(x))
        out[at['field'].start + body.ux] = x[at['normal']] + r * w[body.ux]
        out[at['field'].start + body.uy] = projected
        out[at['normal']] = w[body.ux]
        out[at['tangential']] = (projected - x[at['tangential']]) / r
        return out, np.abs(augmented) > self.bound


def run(options):
    clock = Clock()
    k = END / options.steps
    body = Body(options.cells, k)
    contact = Contact(body)
    free_scratch()
    if options.solver == 'fastest':
        options.solver = 'cg' if 10_000 < len(body.traction) < 50_000 else 'auto'
    solver = Direct(body, options.solver) if options.solver != 'cg' else Incomplete(
        body, contact, fill=15, drop=1e-3, reduction=1e-9, changed=0.1)
    clock.stage('assemble')

    rows = []
    x, iterations = march(body, contact, solver, k, options.run_steps or options.steps, options,
                          lambda step, *state: rows.extend(contact_rows(body, step, k, *state)))
    clock.stage('steps')
    return body, x, rows, iterations, clock.end(solver)


def contact_rows(body, step, k, x, old, sliding):
    uy, dy = U * x[body.at['field']][body.uy], U * (x - old)[body.at['field']][body.uy]
    # lambda = -sigma nu and nu = (-1, 0): the normal traction is +lambda_x, the tangential one -lambda_y.
    normal, tangential = x[body.at['normal']] / (U * body.w), -x[body.at['tangential']] / (U * body.w)
    return [(step, k * step, 0.0, body.y[i], normal[i], tangential[i], uy[i], abs(dy[i]) / k,
             'slip' if sliding[i] else 'stick') for i in np.argsort(body.y)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--cells', type=int, required=True, help='squares along each side')
    add_options(parser, 20, '0.2 s')
    parser.add_argument('--run-steps', type=int, help='stop after so many of them')
    parser.add_argument('--contact', help='CSV of the contact nodes in all steps')
    parser.add_argument('--solver', choices=['fastest', 'cg', 'auto', 'mumps'], default='fastest',
                        help="cg with kept incomplete factors, or GetFEM's lsolver: auto is MUMPS' LDL^T, mumps its LU; "
                             'fastest is cg between 10 000 and 50 000 unknowns, else auto')
    options = parser.parse_args()

    quiet()
    body, x, rows, iterations, seconds = run(options)
    if options.nodes:
        write_csv(options.nodes, 'x,y,u_x,u_y,potential,temperature',
                  node_rows(body.points, body.free, x[body.at['field']], [U, U, PHI, THETA]))
    if options.contact:
        write_csv(options.contact, 'step,time,x,y,normal_traction,tangential_traction_y,slip_y,slip_rate,status', rows)
    write_measurements(options, len(x), iterations, seconds)


if __name__ == '__main__':
    main()
