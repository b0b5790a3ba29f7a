#!/usr/bin/python3
"""The paper's conductive example solved with GetFEM: the benchmark's peer.

Ouafik (2020), section 4, by the paper's own method (37)-(44): the monolithic Newton iteration on (u, phi, theta, lambda)
with the augmented Lagrangians (40), (41). GetFEM supplies mesh, finite elements, assembly, the global tangent matrix and
the linear solver; this file supplies the time loop, the Newton loop and the pointwise contact law. README.md beside it
says which settings make it as fast as GetFEM can be and what each is worth.

The discrete problem: n x n squares, each split by the diagonal from lower right to upper left; P1 for all fields;
backward Euler; multipliers at the nodes of Gamma_C with the lumped weights h, h/2; all other integrals exact.

Everything is written in scaled unknowns, u = U u', phi = PHI phi', theta = THETA theta', and in the symmetric form of the
equations (electric row times -1, heat row times -k/theta_ref), which LDL^T and conjugate gradients need. GetFEM sees one
vector field (u_x, u_y, phi, theta) and the multipliers: nodal forces w_i lambda_i in the same scaling.
"""
import os
import time

START = time.perf_counter()


def process_age():
    """Seconds since the interpreter was started, from the kernel's clock ticks."""
    with open('/proc/self/stat') as stat, open('/proc/uptime') as uptime:
        begin = int(stat.read().rsplit(')', 1)[1].split()[19]) / os.sysconf('SC_CLK_TCK')
        return max(0.0, float(uptime.read().split()[0]) - begin)


AGE = process_age()

# Before the libraries are loaded: one thread (Scotch, MUMPS' ordering, would take every core), and the AVX-512 kernels
# where OpenBLAS does not know the processor, unless the environment says which.
for variable in ('OPENBLAS_NUM_THREADS', 'OMP_NUM_THREADS', 'SCOTCH_PTHREAD_NUMBER'):
    os.environ[variable] = '1'
with open('/proc/cpuinfo') as cpuinfo:
    text = cpuinfo.read()
    if 'AuthenticAMD' in text and 'avx512f' in text:
        os.environ.setdefault('OPENBLAS_CORETYPE', 'SkylakeX')

import argparse
import ctypes
import json
import platform
import resource
import subprocess
import sys

import getfem as gf
import numpy as np

L = 0.1                                                       # side of the body [m]
END = 0.2                                                     # T [s]
BOUND = 15.0                                                  # S [N/m^2]
EXCHANGE, FOUNDATION = 1.0, -27.0                             # k_c [W/(m^2 K)], theta_f [K]
LOAD_RATE = -0.5                                              # f_N = (0, -0.5 t) on the top edge [N/m^2]
THETA_REF = 293.0                                             # [K]
CONSTANTS = dict(c11=166e9, c13=78e9, c33=162e9, c44=43e9,    # [Pa]
                 e31=-4.4, e33=18.6, e15=11.6,                # [C/m^2]
                 b11=11.2e-9, b33=12.6e-9,                    # [C/(V m)]
                 m11=2.24e6, m33=1.89e6,                      # [N/(K m^2)]
                 p3=1e-4,                                     # [C/(K m^2)], sign of the printed matrix
                 k11=50.0, k33=75.0,                          # [W/(K m)]
                 alpha=5500 * 420 / THETA_REF)                # rho c_v / theta_ref

# Scales: elasticity, permittivity and heat capacity become numbers near 1.
U, PHI, THETA = 1e11 ** -0.5, 1e-8 ** -0.5, CONSTANTS['alpha'] ** -0.5
SCALE = {'c': U * U, 'e': U * PHI, 'b': PHI * PHI, 'm': U * THETA, 'p': PHI * THETA, 'k': THETA * THETA, 'a': THETA * THETA}

HEAT = 3                                                      # component of theta in the field (u_x, u_y, phi, theta)


class Body:
    """Mesh, spaces without the prescribed values, the linear operator and its loads, inside a GetFEM model."""

    def __init__(self, n, k):
        # GetFEM's grid has the other diagonal; a quarter turn gives ours.
        x = np.linspace(0, L, n + 1)
        mesh = gf.Mesh('triangles grid', x, x)
        mesh.transform([[0, -1], [1, 0]])
        mesh.translate([L, 0])
        e = L / n / 8
        contact, top = 1, 2
        mesh.set_region(contact, mesh.outer_faces_in_box([-e, -e], [e, L + e]))
        mesh.set_region(top, mesh.outer_faces_in_box([-e, L - e], [L + e, L + e]))

        # One field (u_x, u_y, phi, theta): the unknowns of a node stand together, which incomplete factors need.
        whole, trace = gf.MeshFem(mesh, 4), gf.MeshFem(mesh, 1)
        whole.set_classical_fem(1)
        trace.set_classical_fem(1)
        p, q = whole.basic_dof_nodes(), trace.basic_dof_nodes()
        kind = np.arange(p.shape[1]) % 4
        prescribed = (p[0] > L - e) | ((kind == HEAT) & ((p[1] < e) | (p[1] > L - e)))
        self.free = np.flatnonzero(~prescribed)
        on_contact = np.flatnonzero(q[0] < e)
        space = lambda fem, dofs: gf.MeshFem('partial', fem, dofs)
        spaces = dict(field=space(whole, self.free), normal=space(trace, on_contact), tangential=space(trace, on_contact))
        self.points = p[:, ::4]
        self.keep = [mesh, whole, trace, spaces]               # the model only refers to them
        self.heat = np.flatnonzero(kind[self.free] == HEAT)

        # Contact nodes: rows of u_x and u_y in the field, lumped weights.
        here = p[0, self.free] < e
        self.ux, self.uy = (np.flatnonzero(here & (kind[self.free] == component)) for component in (0, 1))
        self.y = q[1, on_contact]
        assert np.array_equal(p[1, self.free][self.uy], self.y)
        self.w = np.full(n + 1, L / n)
        self.w[(self.y < e) | (self.y > L - e)] /= 2

        self.md = md = gf.Model('real')
        for name, mf in spaces.items():
            md.add_fem_variable(name, mf)
        for name, value in CONSTANTS.items():
            factor = k / THETA_REF if name[0] == 'k' else 1.0
            md.add_initialized_data(name, value * SCALE[name[0]] * factor)
        md.add_initialized_data('kc', k / THETA_REF * EXCHANGE * SCALE['k'])

        # Gradients are constant on a cell: one point is exact for everything but the heat capacity.
        once = gf.MeshIm(mesh, gf.Integ('IM_TRIANGLE(1)'))
        exact = gf.MeshIm(mesh, gf.Integ('IM_TRIANGLE(2)'))
        self.keep += [once, exact]
        linear = lambda mim, expression, region=-1: md.add_linear_term(mim, expression, region, 1, 0)
        linear(once,                                          # (31), (32), couplings of (33)
               '(c11*Grad_field(1,1)+c13*Grad_field(2,2)+e31*Grad_field(3,2)-m11*field(4))*Grad_Test_field(1,1)'
               '+(c13*Grad_field(1,1)+c33*Grad_field(2,2)+e33*Grad_field(3,2)-m33*field(4))*Grad_Test_field(2,2)'
               '+(c44*(Grad_field(1,2)+Grad_field(2,1))+e15*Grad_field(3,1))*(Grad_Test_field(1,2)+Grad_Test_field(2,1))'
               '+(e15*(Grad_field(1,2)+Grad_field(2,1))-b11*Grad_field(3,1))*Grad_Test_field(3,1)'
               '+(e31*Grad_field(1,1)+e33*Grad_field(2,2)-b33*Grad_field(3,2)+p3*field(4))*Grad_Test_field(3,2)'
               '-(m11*Grad_field(1,1)+m33*Grad_field(2,2)-p3*Grad_field(3,2))*Test_field(4)')
        linear(exact, '-alpha*field(4)*Test_field(4)')
        conduction = '-k11*Grad_field(4,1)*Grad_Test_field(4,1)-k33*Grad_field(4,2)*Grad_Test_field(4,2)'
        exchange = '-kc*field(4)*Test_field(4)'               # (13), (18)
        linear(once, conduction)
        linear(exact, exchange, contact)
        md.assembly('build_matrix')
        self.K = md.tangent_matrix()
        self.K.to_csc()
        # What the heat rows of K do not have from the last step: conduction and exchange.
        flux = gf.asm_generic(once, 2, conduction, -1, md)
        self.flux = gf.Spmat('add', flux, gf.asm_generic(exact, 2, exchange, contact, md))
        self.flux.to_csc()

        self.at = {name: slice(first, first + count)
                   for name in spaces for first, count in [md.interval_of_variable(name)]}
        # (19) for f_N = (0, 1) and the exchange with theta_f (18), both constant on an edge
        self.traction = U * gf.asm_generic(exact, 1, 'Test_field(2)', top, md)
        self.foundation = -FOUNDATION / THETA * gf.asm_generic(exact, 1, 'kc*Test_field(4)', contact, md)


class Contact:
    """The augmented Lagrangians (40), (41) at the contact nodes: gradient and tangent, both pointwise.

    With nodal forces as multipliers the lumped weights are in the bound S w_i alone. r multiplies the scaled increment of
    u and is of the order of the stiffness' diagonal; a full Newton step does not depend on it."""

    def __init__(self, body, r=1.0):
        self.body, self.r = body, r
        self.bound = U * BOUND * body.w
        self.count, self.size = len(body.w), body.at['field'].stop - body.at['field'].start
        self.sliding = np.zeros(self.count, bool)
        add = body.md.add_explicit_matrix
        add('field', 'normal', self.matrix('field', 'normal', body.ux, np.ones(self.count)), 1)
        self.bricks = [add(a, b, matrix, 1) for a, b, matrix in self.tangent(self.sliding)]

    def matrix(self, a, b, rows, values):
        """The block (a, b) with `values` at the contact nodes' rows; its columns are the same nodes'."""
        shape = [self.size if name == 'field' else self.count for name in (a, b)]
        columns = rows if b == 'field' else np.arange(self.count)
        block = gf.Spmat('empty', *shape)
        for row, column, value in zip(rows, columns, values):
            if value:
                block.assign(int(row), int(column), float(value))
        return block

    def tangent(self, sliding):
        """Second derivatives of (40), (41): sticking nodes couple u and lambda, sliding nodes hold lambda."""
        body, nodes = self.body, np.arange(self.count)
        yield 'field', 'tangential', self.matrix('field', 'tangential', body.uy, np.where(sliding, 0.0, 1.0))
        yield 'field', 'field', self.matrix('field', 'field', np.concatenate([body.ux, body.uy]),
                                            self.r * np.concatenate([np.ones(self.count), ~sliding]))
        yield 'tangential', 'tangential', self.matrix('tangential', 'tangential', nodes, np.where(sliding, -1.0 / self.r, 0.0))

    def set_tangent(self, sliding):
        if not np.array_equal(sliding, self.sliding):
            for brick, (_, _, block) in zip(self.bricks, self.tangent(sliding)):
                self.body.md.set_private_matrix(brick, block)
            self.sliding = sliding

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


class Direct:
    """GetFEM's model solver: one MUMPS analysis, factorisation and solve for each call."""

    def __init__(self, body, name):
        self.body, self.name, self.seconds = body, name, 0.0
        self.slots = {name: body.md.add_explicit_rhs(name, np.zeros(s.stop - s.start)) for name, s in body.at.items()}

    def solve(self, residual):
        begin = time.perf_counter()
        md, dx = self.body.md, np.empty(len(residual))
        for name, s in self.body.at.items():
            md.set_private_rhs(self.slots[name], residual[s])
        md.solve('lsolver', self.name)
        for name, s in self.body.at.items():
            dx[s] = md.variable(name)
        self.seconds += time.perf_counter() - begin
        return dx


class Incomplete:
    """Conjugate gradients with incomplete LDL^T factors that are kept while few nodes have changed their status.

    The tangent is quasi-definite, not definite, but with such factors the preconditioned matrix is near the identity.
    Nothing rests on that: the Newton iteration stops by its true residual only."""

    FILL, DROP = 15, 1e-3                                      # ILDLTT: entries more than the matrix has in a row, threshold
    REDUCTION, LIMIT = 1e-9, 3000                              # of the residual in one call; iterations
    CHANGED = 0.1                                              # share of the nodes after which the factors are renewed

    def __init__(self, body, contact):
        self.body, self.contact, self.seconds = body, contact, 0.0
        self.tangent_at = self.factors_at = self.tangent = self.factors = None

    def solve(self, residual):
        begin = time.perf_counter()
        sliding = self.contact.sliding
        if self.tangent_at is not sliding:
            self.body.md.assembly('build_matrix')
            self.tangent, self.tangent_at = self.body.md.tangent_matrix(), sliding
        if self.factors is None or (sliding != self.factors_at).sum() > self.CHANGED * len(sliding):
            self.factors = gf.Precond('ildltt', self.tangent, self.FILL, self.DROP)
            self.factors_at = sliding
        dx = gf.linsolve_cg(self.tangent, residual, self.factors, 'res', self.REDUCTION, 'maxiter', self.LIMIT)
        self.seconds += time.perf_counter() - begin
        return dx


def run(options):
    seconds = {'start': AGE + time.perf_counter() - START}
    mark = time.perf_counter()
    k = END / options.steps
    body = Body(options.cells, k)
    contact = Contact(body)
    ctypes.CDLL(None).malloc_trim(0)                          # the assembly's scratch memory
    at = body.at
    if options.solver == 'fastest':
        options.solver = 'cg' if 10_000 < len(body.traction) < 50_000 else 'auto'
    solver = Incomplete(body, contact) if options.solver == 'cg' else Direct(body, options.solver)
    seconds['assemble'] = time.perf_counter() - mark

    mark = time.perf_counter()
    heat = at['field'].start + body.heat
    old = older = product = np.zeros(max(s.stop for s in at.values()))
    iterations, rows = [], []
    for step in range(1, (options.run_steps or options.steps) + 1):
        history = product - body.flux.mult(old)               # heat rows of (33): what the last step left
        load = LOAD_RATE * k * step * body.traction + body.foundation
        load[heat] += history[heat]

        x = 2 * old - older if options.prediction == 'linear' else old
        for count in range(options.max_iterations + 1):
            product = body.K.mult(x)
            forces, sliding = contact.residual(x, old)
            residual = load - product - forces
            if np.abs(residual).max() <= options.tolerance * np.abs(load).max():
                break
            contact.set_tangent(sliding)
            x = x + solver.solve(residual)
        else:
            sys.exit('step %d: not converged after %d Newton iterations' % (step, options.max_iterations))
        iterations.append(count)
        rows += contact_rows(body, step, k, x, old, sliding)
        old, older = x, old
    seconds['steps'] = time.perf_counter() - mark
    seconds['linear_solves'] = solver.seconds
    seconds['total'] = AGE + time.perf_counter() - START
    seconds['processor'] = time.process_time()
    return body, x, rows, iterations, seconds


def contact_rows(body, step, k, x, old, sliding):
    uy, dy = U * x[body.at['field']][body.uy], U * (x - old)[body.at['field']][body.uy]
    # lambda = -sigma nu and nu = (-1, 0): the normal traction is +lambda_x, the tangential one -lambda_y.
    normal, tangential = x[body.at['normal']] / (U * body.w), -x[body.at['tangential']] / (U * body.w)
    return [(step, k * step, 0.0, body.y[i], normal[i], tangential[i], uy[i], abs(dy[i]) / k,
             'slip' if sliding[i] else 'stick') for i in np.argsort(body.y)]


def node_rows(body, x):
    px, py = body.points
    w = np.zeros(4 * len(px))
    w[body.free] = x[body.at['field']]
    w = w.reshape(-1, 4) * [U, U, PHI, THETA]
    return [(px[i], py[i], *w[i]) for i in np.lexsort((py.round(12), px.round(12)))]


def write_csv(path, header, rows):
    with open(path, 'w') as out:
        out.write(header + '\n')
        for row in rows:
            out.write(','.join(v if isinstance(v, str) else '%.15g' % v for v in row) + '\n')


def loaded(part):
    """Paths of the shared libraries really loaded whose name contains `part`."""
    with open('/proc/self/maps') as maps:
        paths = {line.split()[-1] for line in maps if '.so' in line}
    return sorted(p for p in paths if part in os.path.basename(p))


def packaged(name):
    """Version of a Debian package; GetFEM does not tell its own."""
    try:
        return subprocess.run(['dpkg-query', '-W', '-f', '${Version}', name], capture_output=True, text=True).stdout or None
    except OSError:
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--cells', type=int, required=True, help='squares along each side')
    parser.add_argument('--steps', type=int, default=20, help='time steps to 0.2 s')
    parser.add_argument('--run-steps', type=int, help='stop after so many of them')
    parser.add_argument('--json', required=True, help='where the measurements go')
    parser.add_argument('--nodes', help='CSV of the last step')
    parser.add_argument('--contact', help='CSV of the contact nodes in all steps')
    parser.add_argument('--prediction', choices=['linear', 'paper'], default='linear',
                        help='start of a step: the last two states continued, or the last state (the paper)')
    parser.add_argument('--solver', choices=['fastest', 'cg', 'auto', 'mumps'], default='fastest',
                        help="cg with kept incomplete factors, or GetFEM's lsolver: auto is MUMPS' LDL^T, mumps its LU; "
                             'fastest is cg between 10 000 and 50 000 unknowns, else auto')
    parser.add_argument('--tolerance', type=float, default=1e-9, help='largest residual over the largest load')
    parser.add_argument('--max-iterations', type=int, default=80)
    options = parser.parse_args()

    gf.util_trace_level(0)
    gf.util_warning_level(0)
    body, x, rows, iterations, seconds = run(options)
    if options.nodes:
        write_csv(options.nodes, 'x,y,u_x,u_y,potential,temperature', node_rows(body, x))
    if options.contact:
        write_csv(options.contact, 'step,time,x,y,normal_traction,tangential_traction_y,slip_y,slip_rate,status', rows)
    result = {
        'peer': 'getfem', 'cells': options.cells, 'steps': options.steps, 'steps_run': len(iterations),
        'prediction': options.prediction, 'solver': options.solver, 'unknowns': len(x),
        'versions': {'getfem': packaged('python3-getfem'), 'mumps': packaged('libmumps-seq-5.5'),
                     'openblas': packaged('libopenblas0-pthread'), 'numpy': np.__version__, 'python': platform.python_version(),
                     'libraries': [os.path.basename(p) for p in loaded('libgetfem') + loaded('mumps')]},
        'blas': {'loaded': [p for p in loaded('blas') + loaded('atlas') if 'mkl' not in p],
                 'threads': os.environ['OPENBLAS_NUM_THREADS'], 'coretype': os.environ.get('OPENBLAS_CORETYPE', '')},
        'seconds': seconds, 'newton_iterations': iterations, 'newton_iterations_total': sum(iterations),
        'peak_rss_bytes': resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024}
    with open(options.json, 'w') as out:
        json.dump(result, out, indent=2)
        out.write('\n')


if __name__ == '__main__':
    main()
