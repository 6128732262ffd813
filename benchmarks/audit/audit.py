"""Damping that integrators invent: histories of a free rigid body by MuJoCo, SciPy and a plain Runge-Kutta, audited by quasirigid.

pip install mujoco scipy numpy; python benchmarks/audit/audit.py target/release/quasirigid
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np
import scipy
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

MOMENTS = np.array([10.0, 14.0, 17.0])
RATES = np.array([0.15, 0.0, 1.0])
DURATION = 600.0
ROWS = 3001
BODY = """<mujoco><option gravity="0 0 0" timestep="{step}" integrator="{name}"/>
<worldbody><body><freejoint/><inertial pos="0 0 0" mass="100" diaginertia="10 14 17"/></body></worldbody></mujoco>"""

Rows = NDArray[np.float64]


def acceleration(_: float, w: Rows) -> Rows:
    return np.cross(MOMENTS * w, w) / MOMENTS


def of_mujoco(name: str, step: float) -> Rows:
    """Rows t, w, q; the rates of a free joint are in body axes."""
    model = mujoco.MjModel.from_xml_string(BODY.format(step=step, name=name))
    data = mujoco.MjData(model)
    data.qvel[3:] = RATES
    every = round(DURATION / step / (ROWS - 1))
    rows = [[0.0, *data.qvel[3:6], *data.qpos[3:7]]]
    for k in range(1, ROWS):
        for _ in range(every):
            mujoco.mj_step(model, data)
        rows.append([k * every * step, *data.qvel[3:6], *data.qpos[3:7]])
    return np.array(rows)


def of_scipy(method: str, tolerance: float) -> Rows:
    times = np.linspace(0.0, DURATION, ROWS)
    found = solve_ivp(acceleration, (0.0, DURATION), RATES, method, times, rtol=tolerance, atol=1e-3 * tolerance)
    return np.column_stack([found.t, found.y.T])


def runge_kutta(step: float) -> Rows:
    every = round(DURATION / step / (ROWS - 1))
    w, rows = RATES.copy(), []
    for k in range(ROWS):
        rows.append([k * every * step, *w])
        for _ in range(every):
            a = acceleration(0.0, w)
            b = acceleration(0.0, w + step / 2 * a)
            c = acceleration(0.0, w + step / 2 * b)
            d = acceleration(0.0, w + step * c)
            w = w + step / 6 * (a + 2 * b + 2 * c + d)
    return np.array(rows)


def cases() -> Iterator[tuple[str, str, Rows]]:
    for name in ("Euler", "implicit", "implicitfast", "RK4"):
        for step in (0.002, 0.01):
            yield f"MuJoCo {mujoco.__version__} {name}", f"{step * 1e3:g} ms", of_mujoco(name, step)
    for method in ("RK45", "DOP853", "Radau", "LSODA"):
        for tolerance in (1e-3, 1e-6, 1e-9):
            yield f"SciPy {scipy.__version__} {method}", f"rtol {tolerance:g}", of_scipy(method, tolerance)
    for step in (0.1, 0.2):
        yield "Runge-Kutta 4", f"{step:g} s", runge_kutta(step)


def main() -> None:
    program = sys.argv[1] if len(sys.argv) > 1 else "quasirigid"
    print("| integrator | step | energy | angular momentum | invented time constant (s) |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, step, rows in cases():
            file = Path(folder, "spin.csv")
            heading = "t,wx,wy,wz,qw,qx,qy,qz" if rows.shape[1] == 8 else "t,wx,wy,wz"
            np.savetxt(file, rows, fmt="%.17g", delimiter=",", header=heading, comments="")
            line = [program, "audit", str(file), "--inertia", "10,14,17", "--json"]
            found = json.loads(subprocess.run(line, capture_output=True, check=True, text=True).stdout)
            constant = found["invented_time_constant"]
            told = "none" if constant is None else f"{constant:.4g}"
            print(f"| {name} | {step} | {found['energy_drift']:.2e} | {found['momentum_drift']:.2e} | {told} |")


if __name__ == "__main__":
    main()
