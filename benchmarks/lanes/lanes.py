"""Ensembles of the dense quartic and quintic equation in lanes: quasirigid, heyoka's batch mode, and a compiled Runge-Kutta method of order 8
with a fixed step, in one run on one core.

Run from this folder, with NumPy, SciPy, Numba and heyoka installed: ``python lanes.py``. A row has the microseconds that a second of motion
of one trajectory takes, and the largest error of 256 trajectories after 1000 s: of quasirigid and heyoka against themselves at their smallest
tolerance, of the fixed step against heyoka.
"""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import heyoka
import numba
import numpy as np
from numpy.typing import NDArray
from scipy.integrate._ivp.dop853_coefficients import A, B

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "data" / "published" / "quartic_quintic"
INERTIA = np.array([10.3366, 14.8812, 17.7228])
END = 1000.0
COUNT = 256
REPEATS = 5

Array = NDArray[np.float64]


def coefficients() -> list[dict[tuple[int, int, int], float]]:
    """Coefficient of each monomial, for each component of the rate."""
    found: list[dict[tuple[int, int, int], float]] = [{}, {}, {}]
    for row in np.loadtxt(DATA / "coefficients.csv", delimiter=",", skiprows=1):
        for axis in range(3):
            found[axis][int(row[1]), int(row[2]), int(row[3])] = float(row[4 + axis])
    for axis in range(3):
        after, before = (axis + 1) % 3, (axis + 2) % 3
        exponents = [0, 0, 0]
        exponents[after] = exponents[before] = 1
        found[axis][exponents[0], exponents[1], exponents[2]] = float(-(INERTIA[before] - INERTIA[after]) / INERTIA[axis])
    return found


def starts() -> Array:
    first = np.loadtxt(DATA / "reference.csv", delimiter=",", skiprows=1)[0, 1:]
    i, axis = np.meshgrid(np.arange(COUNT), np.arange(3), indexing="ij")
    return first * (1 + 0.01 * np.sin(3 * i + axis))


def horner(terms: dict[tuple[int, int, int], float], names: tuple[str, str, str]) -> str:
    """The polynomial in nested form: in x, within it in y, within it in z."""

    def nested(parts: dict[int, str], name: str) -> str:
        text = ""
        for power in range(max(parts), -1, -1):
            part = parts.get(power)
            text = part or "" if not text else f"({text})*{name}" + (f"+{part}" if part else "")
        return f"({text})"

    planes: dict[int, str] = {}
    for i in sorted({e[0] for e in terms}):
        lines = {j: nested({e[2]: repr(c) for e, c in terms.items() if e[:2] == (i, j)}, names[2]) for j in {e[1] for e in terms if e[0] == i}}
        planes[i] = nested(lines, names[1])
    return nested(planes, names[0])


def shortest(work: Callable[[], Array]) -> tuple[float, Array]:
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        found = work()
        times.append(time.perf_counter() - start)
    return min(times), found


def row(name: str, setting: str, error: float, seconds: float) -> None:
    print(f"| {name} | {setting} | {error:.1e} | {1e6 * seconds / (COUNT * END):.3f} |", flush=True)


def of_quasirigid() -> None:
    command = ["cargo", "bench", "-q", "-p", "quasirigid", "--bench", "lanes"]
    for line in subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines():
        if line.count(" | ") == 3:
            print(f"| quasirigid, {line} |", flush=True)


def heyoka_batches(tolerance: float) -> Callable[[], Array]:
    variables = heyoka.make_vars("x", "y", "z")
    names = {"x": variables[0], "y": variables[1], "z": variables[2]}
    rates = [eval(horner(terms, ("x", "y", "z")), {"__builtins__": {}}, names) for terms in coefficients()]
    lanes = heyoka.recommended_simd_size()
    taylor = heyoka.taylor_adaptive_batch(list(zip(variables, rates, strict=True)), np.zeros((3, lanes)), tol=tolerance)
    begun = starts()

    def follow() -> Array:
        found = []
        for first in range(0, COUNT, lanes):
            taylor.set_time(0.0)
            taylor.state[:] = begun[first : first + lanes].T
            taylor.propagate_until(np.full(lanes, END))
            found.append(taylor.state.T.copy())
        return np.concatenate(found)

    return follow


def fixed_steps(steps: int) -> Callable[[], Array]:
    """Order 8 of Dormand and Prince with a fixed step, eight trajectories side by side, every line of the method written out."""
    terms = coefficients()
    lines = ["def advance(y, steps, h):", "    for step in range(steps):", "        for lane in range(8):"]
    lines.append("            " + "; ".join(f"s{i} = y[{i}, lane]" for i in range(3)))
    for stage in range(12):
        for i in range(3):
            sums = "+".join(f"{float(A[stage, j])!r}*k{j}_{i}" for j in range(stage) if A[stage, j] != 0)
            lines.append(f"            p{i} = s{i}" + (f" + h*({sums})" if sums else ""))
        lines += [f"            k{stage}_{i} = {horner(terms[i], ('p0', 'p1', 'p2'))}" for i in range(3)]
    for i in range(3):
        sums = "+".join(f"{float(B[j])!r}*k{j}_{i}" for j in range(12) if B[j] != 0)
        lines.append(f"            y[{i}, lane] = s{i} + h*({sums})")
    made: dict[str, Callable[[Array, int, float], None]] = {}
    exec("\n".join(lines), made)
    advance = numba.njit(fastmath=True, error_model="numpy")(made["advance"])
    begun = starts()

    def follow() -> Array:
        found = []
        for first in range(0, COUNT, 8):
            block = np.ascontiguousarray(begun[first : first + 8].T)
            advance(block, steps, END / steps)
            found.append(block.T)
        return np.concatenate(found)

    follow()
    return follow


def main() -> None:
    print("| program | tolerance or step | error | µs |")
    print("|---|---|---|---|")
    of_quasirigid()
    exact = heyoka_batches(1e-16)()
    for tolerance in (1e-9, 1e-10, 1e-12):
        seconds, found = shortest(heyoka_batches(tolerance))
        row(f"heyoka, batches of {heyoka.recommended_simd_size()}", f"{tolerance:.0e}", np.abs(found - exact).max(), seconds)
    for steps in (2000, 3000, 3200, 5000):
        seconds, found = shortest(fixed_steps(steps))
        row("fixed step, Numba, 8 lanes", f"{END / steps:.3f} s", np.abs(found - exact).max(), seconds)


if __name__ == "__main__":
    main()
