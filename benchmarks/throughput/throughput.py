"""Throughput of studies and ensembles from Python: asteroids, satellites with dampers, reduced trajectories.

Run with the package of a release build, from this folder: ``python throughput.py``. Trajectories are compared with SciPy's DOP853 and, where it is
installed, heyoka's batch mode on the same polynomials: each at a tolerance that gives the same error, against a reference at 1e-13.
"""

from __future__ import annotations

import importlib.util
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import quasirigid
from scipy.integrate import solve_ivp

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
CORES = os.cpu_count() or 1


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    found = work()
    return time.perf_counter() - start, found


def row(task: str, count: int, *seconds: float | None) -> None:
    cells = ["" if each is None else f"{each / count * 1e3:.3f} ms | {count / each:,.0f}" for each in seconds]
    print(f"| {task} | {count} | " + " | ".join(cells) + " |")


def study(task: str, entries: dict[str, Any], count: int) -> None:
    """Time of a row on one core and on all, beside the loop over models that users write."""
    entries = {**entries, "samples": count}
    one, found = timed(lambda: quasirigid.sweep(entries, threads=1))
    every, again = timed(lambda: quasirigid.sweep(entries))
    assert found.answered.all() and all(np.array_equal(found[name], again[name]) for name in found.columns if name[0] == "e")
    row(task, count, one, every)


def asteroids(count: int) -> dict[str, Any]:
    return {
        "model": EXAMPLES / "apophis" / "model.toml",
        "sampling": "latin-hypercube",
        "vary": {
            "ellipsoid.1.semi_axes.1": {"uniform": ["160 m", "260 m"]},
            "ellipsoid.1.semi_axes.3": {"uniform": ["100 m", "139 m"]},
            "material.rock.shear": {"log-uniform": ["10 MPa", "10 GPa"]},
        },
        "answer": {"quantities": ["evolve.time"]},
    }


def satellites(count: int) -> dict[str, Any]:
    return {
        "model": EXAMPLES / "nutation-damper" / "model.toml",
        "vary": {
            "spring.1.stiffness": {"log-uniform": ["0.4 N/m", "1.6 N/m"]},
            "point.damper.mass": {"uniform": [0.05, 0.2]},
        },
        "answer": {"quantities": ["modes.nutation.time_constant"]},
    }


def trajectories(count: int) -> None:
    """Reduced trajectories of a thousand turns, each method at its own tolerance, with the error that it makes."""
    model = quasirigid.Model.from_file(EXAMPLES / "axial-mass" / "model.toml")
    reduced = model.reduce()
    generator = np.random.default_rng(7)
    starts = generator.normal(size=(count, 3))
    spin = np.linalg.norm(model.simulate(duration=1, samples=2).angular_velocity[0])
    starts *= spin / np.linalg.norm(starts, axis=1, keepdims=True)
    end = 1000 * 2 * np.pi / spin

    def ours(tolerance: float) -> np.ndarray:
        return model.simulate(initial=starts, duration=end, samples=2, tolerance=tolerance, form="angular-velocity").angular_velocity[:, -1]

    def scipy(tolerance: float) -> np.ndarray:
        def rate(_: float, omega: np.ndarray) -> np.ndarray:
            return reduced.rate(omega)

        runs = (solve_ivp(rate, (0, end), start, "DOP853", rtol=tolerance, atol=1e-3 * tolerance * spin) for start in starts[:4])
        return np.array([run.y[:, -1] for run in runs])

    def lanes(tolerance: float) -> np.ndarray:
        many = np.resize(starts, (50 * count, 3))
        return model.spins(many, [end], tolerance=1e-2 * tolerance, form="angular-velocity").angular_velocity[:, -1]

    reference = ours(1e-13)
    methods: list[tuple[str, Callable[[float], np.ndarray], float]] = [
        ("quasirigid with attitude and accounts", ours, 1e-9),
        ("quasirigid, spins", lanes, 1e-9),
        ("SciPy DOP853", scipy, 1e-9),
    ]
    if importlib.util.find_spec("heyoka"):
        methods.append(("heyoka, batches of 8", heyoka_batches(reduced, starts, end), 1e-10))
    for name, method, tolerance in methods:
        seconds, found = timed(lambda: method(tolerance))
        error = np.abs(found - np.resize(reference, found.shape)).max() / spin
        print(f"| 1000 revolutions, {name}, error {error:.0e} | {len(found)} | {seconds / len(found) * 1e3:.2f} ms | {len(found) / seconds:,.0f} | | |")


def ellipsoids(count: int) -> None:
    """The averaged tumbling of a population, each its own ellipsoid, half of them about the long axis at the start."""
    generator = np.random.default_rng(11)
    axes = np.sort(generator.uniform(0.4, 1.0, (count, 3)) * 10 ** generator.uniform(1, 4, (count, 1)))
    least = (axes[:, 0] ** 2 + axes[:, 1] ** 2) / (axes[:, 1] ** 2 + axes[:, 2] ** 2)
    population = {
        "density": generator.uniform(1000, 3500, count),
        "shear": 10 ** generator.uniform(7, 10, count),
        "quality_factor": 10 ** generator.uniform(1, 3, count),
        "spin": 2 * np.pi / (3600 * 10 ** generator.uniform(0.5, 2.5, count)),
        "ratio": least + (1 - least) * generator.uniform(0.05, 0.95, count),
        "until_nutation": np.radians(5),
    }
    seconds, found = timed(lambda: quasirigid.evolve_ellipsoids(axes, **population))
    print(f"| `evolve_ellipsoids`, {found.holds.mean():.1%} hold | {count} | | | {1e6 * seconds / count:.2f} µs | {count / seconds:,.0f} |")


def heyoka_batches(reduced: quasirigid.Reduced, starts: np.ndarray, end: float) -> Callable[[float], np.ndarray]:
    import heyoka

    equations = reduced.to_sympy()
    names = [str(symbol) for symbol in equations.omega]
    variables = heyoka.make_vars(*names)
    rates = [heyoka.from_sympy(rate) for rate in equations.rate]
    system = list(zip(variables, rates, strict=True))

    def follow(tolerance: float) -> np.ndarray:
        taylor = heyoka.taylor_adaptive_batch(system, np.zeros((3, 8)), tol=tolerance)
        found = []
        for first in range(0, len(starts), 8):
            block = starts[first : first + 8]
            taylor.set_time(0.0)
            taylor.state[:] = np.resize(block, (8, 3)).T
            taylor.propagate_until(np.full(8, end))
            found.append(taylor.state.T[: len(block)].copy())
        return np.concatenate(found)

    return follow


def main() -> None:
    print(f"| task | rows | a row, one core | rows/s | a row, {CORES} cores | rows/s |")
    print("|---|---|---|---|---|---|")
    study("`evolve` of an asteroid, each its own ellipsoid", asteroids(4000), 4000)
    study("`modes` of a satellite with a damper", satellites(20000), 20000)
    trajectories(200)
    ellipsoids(1_000_000)


if __name__ == "__main__":
    main()
