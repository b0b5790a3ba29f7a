"""What the peers share: the environment, the material and its scaling, the linear operator of a step, the Newton and time
loops, the linear solvers, and what a peer writes. README.md beside it says which settings are GetFEM's best and why.

Import it first: it sets the environment before numpy and GetFEM load their libraries.
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

import ctypes
import json
import platform
import resource
import subprocess
import sys

import getfem as gf
import numpy as np

L = 0.1                                                       # side of the body [m]
BOUND = 15.0                                                  # S [N/m^2]
EXCHANGE, FOUNDATION = 1.0, -27.0                             # k_c [W/(m^2 K)], theta_f [K]
LOAD_RATE = -0.5                                              # the top edge or face is drawn down with -0.5 t [N/m^2]
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


def partial(fem, dofs):
    return gf.MeshFem('partial', fem, dofs)


class Operator:
    """The GetFEM model with the linear operator of a step of length k. A body adds its mesh, its weak form and loads."""

    def __init__(self, spaces, heat, k, constants):
        """`spaces` by variable name; `heat`: rows of theta in the variable 'field'."""
        self.spaces, self.heat = spaces, heat                  # the model only refers to the spaces
        self.md = md = gf.Model('real')
        for name, mf in spaces.items():
            md.add_fem_variable(name, mf)
        for name, value in constants.items():
            factor = k / THETA_REF if name[0] == 'k' else 1.0
            md.add_initialized_data(name, value * SCALE[name[0]] * factor)
        md.add_initialized_data('kc', k / THETA_REF * EXCHANGE * SCALE['k'])

    def assemble(self, once, exact, coupled, capacity, conduction, exchange, contact):
        """The expressions are integrated with `once` where one point is exact, else with `exact`."""
        self.integration = [once, exact]                       # the model only refers to them
        md = self.md
        linear = lambda mim, expression, region=-1: md.add_linear_term(mim, expression, region, 1, 0)
        linear(once, coupled)
        linear(exact, capacity)
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
                   for name in self.spaces for first, count in [md.interval_of_variable(name)]}


def block(shape, rows, columns, values):
    """A sparse matrix with these entries and no others."""
    matrix = gf.Spmat('empty', *shape)
    for row, column, value in zip(rows, columns, values):
        if value:
            matrix.assign(int(row), int(column), float(value))
    return matrix


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

    LIMIT = 3000                                               # iterations in one call

    def __init__(self, body, contact, fill, drop, reduction, changed):
        """`fill`, `drop`: ILDLTT's entries more than the matrix has in a row, and its threshold; `reduction` of the residual
        in one call; `changed`: share of the nodes after which the factors are renewed."""
        self.body, self.contact, self.seconds = body, contact, 0.0
        self.fill, self.drop, self.reduction, self.changed = fill, drop, reduction, changed
        self.tangent_at = self.factors_at = self.tangent = self.factors = None

    def solve(self, residual):
        begin = time.perf_counter()
        state = self.contact.state
        if self.tangent_at is not state:
            self.body.md.assembly('build_matrix')
            self.tangent, self.tangent_at = self.body.md.tangent_matrix(), state
        if self.factors is None or self.contact.share_changed_from(self.factors_at) > self.changed:
            self.factors = gf.Precond('ildltt', self.tangent, self.fill, self.drop)
            self.factors_at = state
        dx = gf.linsolve_cg(self.tangent, residual, self.factors, 'res', self.reduction, 'maxiter', self.LIMIT)
        self.seconds += time.perf_counter() - begin
        return dx


def march(body, contact, solver, k, steps, options, each_step=lambda *state: None):
    """The steps, each by Newton's method from the prediction; the last state and the iterations of each step."""
    heat = body.at['field'].start + body.heat
    old = older = product = np.zeros(max(s.stop for s in body.at.values()))
    iterations = []
    for step in range(1, steps + 1):
        history = product - body.flux.mult(old)               # heat rows of (33): what the last step left
        load = body.load(k * step)
        load[heat] += history[heat]

        x = 2 * old - older if options.prediction == 'linear' else old
        for count in range(options.max_iterations + 1):
            product = body.K.mult(x)
            forces, state = contact.residual(x, old)
            residual = load - product - forces
            if np.abs(residual).max() <= options.tolerance * np.abs(load).max():
                break
            contact.set_tangent(state)
            x = x + solver.solve(residual)
        else:
            sys.exit('step %d: not converged after %d Newton iterations' % (step, options.max_iterations))
        iterations.append(count)
        each_step(step, x, old, state)
        old, older = x, old
    return x, iterations


class Clock:
    """Seconds of the stages of a run, from the start of the process on."""

    def __init__(self):
        self.seconds = {'start': AGE + time.perf_counter() - START}
        self.mark = time.perf_counter()

    def stage(self, name):
        now = time.perf_counter()
        self.seconds[name], self.mark = now - self.mark, now

    def end(self, solver):
        self.seconds['linear_solves'] = solver.seconds
        self.seconds['total'] = AGE + time.perf_counter() - START
        self.seconds['processor'] = time.process_time()
        return self.seconds


def free_scratch():
    """Gives back the memory that the assembly has used."""
    ctypes.CDLL(None).malloc_trim(0)


def node_rows(points, free, field, scales):
    """Places and fields of all nodes, ordered by x, then by y, ...; prescribed values are zero."""
    w = np.zeros(len(scales) * points.shape[1])
    w[free] = field
    rows = np.column_stack([points.T, w.reshape(-1, len(scales)) * scales])
    return rows[np.lexsort(points.round(12)[::-1])]


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


def add_options(parser, steps, until):
    parser.add_argument('--steps', type=int, default=steps, help='time steps to ' + until)
    parser.add_argument('--json', required=True, help='where the measurements go')
    parser.add_argument('--nodes', help='CSV of the last step')
    parser.add_argument('--prediction', choices=['linear', 'paper'], default='linear',
                        help='start of a step: the last two states continued, or the last state (the paper)')
    parser.add_argument('--tolerance', type=float, default=1e-9, help='largest residual over the largest load')
    parser.add_argument('--max-iterations', type=int, default=80)


def quiet():
    gf.util_trace_level(0)
    gf.util_warning_level(0)


def write_measurements(options, unknowns, iterations, seconds):
    result = {
        'peer': 'getfem', 'cells': options.cells, 'steps': options.steps, 'steps_run': len(iterations),
        'prediction': options.prediction, 'solver': options.solver, 'unknowns': unknowns,
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
