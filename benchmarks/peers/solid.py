"""Static solution of an elastic cube in quasirigid and in other direct solvers: the same matrix, as many threads each.

python solid.py 22 32 46
python solid.py 32 46 --threads 2 --repeat 3
python solid.py 69 --precision single --peers "" --limit 21

Takes the nodes along an edge of the cubes; needs cargo. A peer that is missing or runs out of memory is one line of
the table. Times are of the processor on one thread and on the wall on several, in seconds; memory is the peak of a process of its
own for each solver. Repeated runs take turns, so that whatever else the machine does meets all of them.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import scipy.sparse as sp

WIDTH = 9
GIGABYTE = 10**9
WORKSPACE = Path(__file__).resolve().parents[2]


def lower_triangle(path):
    """The matrix that `cargo bench --bench solid` wrote."""
    with open(path, "rb") as file:
        size, places = np.fromfile(file, "<u8", 2)
        starts = np.fromfile(file, "<u8", size + 1).astype(np.int32)
        rows = np.fromfile(file, "<u4", places).astype(np.int32)
        return sp.csc_matrix((np.fromfile(file, "<f8", places), rows, starts), shape=(size, size))


# Each solver yields the entries of its factor once it has ordered the unknowns, if it tells; then nothing once it has
# factored; then a function from right-hand sides to solutions.


def cholmod(lower):
    from sksparse.cholmod import analyze

    factor = analyze(lower, mode="supernodal", ordering_method="metis")
    yield None
    factor.cholesky_inplace(lower)
    yield None
    yield factor


def pardiso(lower):
    from pypardiso import PyPardisoSolver

    solver = PyPardisoSolver(mtype=2)
    # Own parameters: nested dissection, no refinement (two steps if not asked), count the entries.
    for place, value in ((1, 1), (2, 2), (8, 0), (18, -1)):
        solver.set_iparm(place, value)
    upper = sp.csr_matrix(lower.T)
    nothing = np.zeros((lower.shape[0], WIDTH), order="F")

    def phase(number, right):
        solver.set_phase(number)
        return solver._call_pardiso(upper, right)

    phase(11, nothing)
    # Counted in 32 bits.
    yield int(solver.get_iparm(18)) % 2**32
    phase(22, nothing)
    yield None
    yield lambda right: phase(33, right)


def mumps(lower):
    import mumps

    context = mumps.Context()
    context.set_matrix(lower.T, symmetric=True)
    # SCOTCH where MUMPS was built without METIS.
    context.analyze(ordering="metis")
    yield context.analysis_stats.est_nonzeros
    context.factor(reuse_analysis=True)
    yield None
    yield context.solve


PEERS = {solver.__name__: solver for solver in (cholmod, pardiso, mumps)}


PHASES = ("order", "factor", f"solve{WIDTH}")


def now():
    """Time of the processor, of all threads, and on the wall."""
    return time.process_time(), time.perf_counter()


def solve(path, name, limit):
    """Solves in this process and prints lines of a name and a value, as the benchmark of quasirigid does."""
    resource.setrlimit(resource.RLIMIT_AS, (int(limit * GIGABYTE),) * 2)
    lower = lower_triangle(path)
    right = np.asfortranarray(np.cos(0.7 * np.arange(WIDTH * lower.shape[0])).reshape(-1, WIDTH))
    clock = [now()]
    phases = PEERS[name](lower)
    entries = next(phases)
    clock.append(now())
    if entries:
        print("entries", entries, flush=True)
        if 8 * entries > limit * GIGABYTE:
            sys.exit(f"the factor would take {8 * entries / GIGABYTE:.1f} GB")
    next(phases)
    clock.append(now())
    solution = next(phases)(right)
    clock.append(now())
    peak = 1.024e-3 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    gap = lower @ solution + lower.T @ solution - lower.diagonal()[:, None] * solution - right
    for phase, (processor, wall) in zip(PHASES, np.diff(clock, axis=0), strict=True):
        print(phase, round(processor, 3))
        print(f"{phase}_wall", round(wall, 3))
    print("residual", np.linalg.norm(gap) / np.linalg.norm(right))
    print("peak", peak)


def figures(command, **options):
    """Names and values that a command prints; `failure` if it fails."""
    run = subprocess.run(command, capture_output=True, text=True, **options)
    pairs = dict(line.split() for line in run.stdout.splitlines())
    if run.returncode != 0:
        pairs["failure"] = (run.stderr.strip().splitlines() or [f"ended with {run.returncode}"])[-1]
    return pairs


def best(runs, suffix):
    """The run with the least time in all, and the first that failed if any did."""
    failed = [run for run in runs if "failure" in run]
    return failed[0] if failed else min(runs, key=lambda run: total(run, suffix))


def total(run, suffix):
    return sum(float(run[name + suffix]) for name in PHASES)


def columns(suffix):
    """Columns of the table; with a suffix, times on the wall and the processor time of all threads."""
    found = {
        "ordering": lambda run: float(run["order" + suffix]),
        "factorisation": lambda run: float(run["factor" + suffix]),
        f"{WIDTH} solutions": lambda run: float(run[f"solve{WIDTH}" + suffix]),
        "total": lambda run: total(run, suffix),
    }
    if suffix:
        found["processor"] = lambda run: total(run, "")
    found["memory (GB)"] = lambda run: float(run["peak"]) / 1000
    return found


def rows(ours, peers, suffix):
    """Lines of the table for one matrix, with the ratios of ours to the best peer last."""
    shown = columns(suffix)
    size = f"{int(ours['unknowns']):,}".replace(",", " ")
    for name, run in {"**quasirigid**": ours, **peers}.items():
        entries = f"{float(run['entries']) / 1e6:.1f}" if "entries" in run else "–"
        assembly = run.get("assembly" + suffix, "–")
        if "failure" in run:
            yield f"| {size} | {name} | {entries} | {assembly} | {run['failure']} |" + len(shown) * " |"
            continue
        values = " | ".join(f"{column(run):.3g}" for column in shown.values())
        yield f"| {size} | {name} | {entries} | {assembly} | {values} | {float(run['residual']):.0e} |"
    finished = [run for run in peers.values() if "failure" not in run]
    if finished and "failure" not in ours:
        ratios = (column(ours) / min(map(column, finished)) for column in shown.values())
        yield f"| {size} | ratio | | | {' | '.join(f'{ratio:.2f}' for ratio in ratios)} | |"


def compare(arguments):
    suffix = "_wall" if arguments.threads > 1 else ""
    heading = ["unknowns", "solver", "entries (10⁶)", "assembly", *columns(suffix), "residual"]
    print(f"| {' | '.join(heading)} |\n{'|---' * len(heading)}|", flush=True)
    bench = ["cargo", "bench", "--quiet", "--package", "quasirigid", "--bench", "solid", "--"]
    bench = [arguments.program] if arguments.program else bench
    names = list(filter(None, arguments.peers.split(",")))
    count = str(arguments.threads)
    threads = {f"{library}_NUM_THREADS": count for library in ("RAYON", "OMP", "MKL", "OPENBLAS")}
    environment = {**os.environ, **threads}
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "matrix")
        for nodes in arguments.nodes:
            runs = {name: [] for name in ("", *names)}
            for _ in range(arguments.repeat):
                command = [*bench, str(nodes), path, arguments.precision]
                runs[""].append(figures(command, cwd=WORKSPACE, env=environment))
                for name in names:
                    command = [sys.executable, __file__, "--matrix", path, "--peers", name]
                    command += ["--limit", str(arguments.limit)]
                    runs[name].append(figures(command, env=environment))
            ours, *peers = (best(found, suffix) for found in runs.values())
            print("\n".join(rows(ours, dict(zip(names, peers, strict=True)), suffix)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("nodes", type=int, nargs="*", help="nodes along an edge")
    parser.add_argument("--precision", choices=("double", "single"), default="double", help="of quasirigid")
    parser.add_argument("--peers", default=",".join(PEERS), help="solvers beside quasirigid; empty for none")
    parser.add_argument("--repeat", type=int, default=1, help="runs of each, of which the fastest counts")
    parser.add_argument("--threads", type=int, default=1, help="threads of each solver")
    parser.add_argument("--program", help="command of the benchmark of quasirigid, in place of cargo")
    parser.add_argument("--limit", type=float, default=20, help="GB of memory for a peer")
    parser.add_argument("--matrix", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.matrix:
        solve(arguments.matrix, arguments.peers, arguments.limit)
    else:
        compare(arguments)


if __name__ == "__main__":
    main()
