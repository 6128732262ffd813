"""The stiffness matrix of an elastic cube in other direct solvers, one thread each.

cargo bench --bench solid -- 32 cube.bin double
python solid.py cube.bin cholmod pardiso mumps

Needs scikit-sparse 0.4 (with SuiteSparse), pypardiso and python-mumps (with MUMPS); a solver that is missing is
skipped. Times are of the processor, in seconds; memory is the peak of a process of its own for each solver.
"""

import os
import resource
import subprocess
import sys
import time

for library in ("OMP", "MKL", "OPENBLAS"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

import numpy as np
import scipy.sparse as sp

WIDTH = 9


def lower_triangle(path):
    """The matrix that `cargo bench --bench solid` wrote."""
    with open(path, "rb") as file:
        size, places = np.fromfile(file, "<u8", 2)
        starts = np.fromfile(file, "<u8", size + 1).astype(np.int32)
        rows = np.fromfile(file, "<u4", places).astype(np.int32)
        return sp.csc_matrix((np.fromfile(file, "<f8", places), rows, starts), shape=(size, size))


def cholmod(lower):
    from sksparse.cholmod import analyze

    factor = analyze(lower, mode="supernodal", ordering_method="metis")
    yield
    factor.cholesky_inplace(lower)
    yield
    yield factor


def pardiso(lower):
    from pypardiso import PyPardisoSolver

    solver = PyPardisoSolver(mtype=2)
    upper = sp.csr_matrix(lower.T)
    nothing = np.zeros((lower.shape[0], WIDTH), order="F")

    def phase(number, right):
        solver.set_phase(number)
        return solver._call_pardiso(upper, right)

    phase(11, nothing)
    yield
    phase(22, nothing)
    yield
    yield lambda right: phase(33, right)


def mumps(lower):
    import mumps

    context = mumps.Context()
    context.set_matrix(lower + sp.tril(lower, -1).T, symmetric=True)
    context.analyze(ordering="metis")
    yield
    context.factor(reuse_analysis=True)
    yield
    yield context.solve


SOLVERS = {solver.__name__: solver for solver in (cholmod, pardiso, mumps)}


def measured(path, name):
    """One line: the time of the order, of the factor and of the solutions; residual; memory with and without."""
    lower = lower_triangle(path)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    right = np.asfortranarray(np.cos(0.7 * np.arange(WIDTH * lower.shape[0])).reshape(-1, WIDTH))
    clock = [time.process_time()]
    phases = SOLVERS[name](lower)
    for _ in range(2):
        next(phases)
        clock.append(time.process_time())
    solution = next(phases)(right)
    clock.append(time.process_time())
    gap = lower @ solution + lower.T @ solution - lower.diagonal()[:, None] * solution - right
    order, factor, solve = np.diff(clock)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(
        f"{name:8} {lower.shape[0]:8} order {order:.2f} factor {factor:.2f} solve {solve:.2f}"
        f" residual {np.linalg.norm(gap) / np.linalg.norm(right):.1e} peak {peak / 1e3:.0f} MB"
        f" (matrix {before / 1e3:.0f} MB)"
    )


def main():
    path, *names = sys.argv[1:]
    if len(names) == 1:
        return measured(path, names[0])
    for name in names or SOLVERS:
        run = subprocess.run([sys.executable, __file__, path, name], capture_output=True, text=True)
        print(run.stdout.strip() or f"{name}: {(run.stderr.strip().splitlines() or ['no output'])[-1]}")


if __name__ == "__main__":
    main()
