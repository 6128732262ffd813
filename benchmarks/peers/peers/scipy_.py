"""SciPy's integrators on the equations of motion compiled by numba."""

import warnings
from collections.abc import Callable

import numba as nb
import numpy as np
from scipy.integrate import ode, odeint, solve_ivp

from measure import Diverged, Result, Setting, result, timed
from peers.compiled import Array, rates
from problem import CASES, START_SPIN

MOST_STEPS = 50_000_000

End = tuple[Array, int | None]


@nb.njit
def slope(t: float, y: Array, k: float, c: float) -> Array:
    """The rates in the form that SciPy calls."""
    out = np.empty(9)
    rates(y, out, k, c)
    return out


def lsoda(start: Array, case: str, setting: Setting) -> End:
    """LSODA in its compiled driver, several times cheaper than in `solve_ivp`."""
    states, report = odeint(
        slope,
        start,
        [0.0, CASES[case].duration],
        args=(CASES[case].stiffness, CASES[case].damping),
        tfirst=True,
        rtol=setting.value,
        atol=setting.value,
        mxstep=MOST_STEPS,
        full_output=True,
    )
    if report["message"] != "Integration successful.":
        raise Diverged(report["message"])
    return states[-1], int(report["nst"][-1])


def runge_kutta(start: Array, case: str, setting: Setting) -> End:
    """DOPRI5 or DOP853 in its compiled driver, restarted where it suspects stiffness."""
    solver = ode(slope).set_integrator(
        setting.method.lower(),
        rtol=setting.value,
        atol=1e-3 * setting.value,
        nsteps=MOST_STEPS,
    )
    solver.set_f_params(CASES[case].stiffness, CASES[case].damping)
    solver.set_initial_value(start)
    while solver.t < CASES[case].duration:
        before = solver.t
        with warnings.catch_warnings(action="ignore"):
            solver.integrate(CASES[case].duration)
        if not solver.t > before:
            raise Diverged(f"no progress at {before:g} s")
    return solver.y, None


def radau(start: Array, case: str, setting: Setting) -> End:
    """Radau IIA of order 5, which SciPy has in Python only."""
    solution = solve_ivp(
        slope,
        (0.0, CASES[case].duration),
        start,
        method="Radau",
        args=(CASES[case].stiffness, CASES[case].damping),
        rtol=setting.value,
        atol=1e-3 * setting.value,
    )
    if not solution.success:
        raise Diverged(solution.message)
    return solution.y[:, -1], len(solution.t) - 1


METHODS: dict[str, Callable[[Array, str, Setting], End]] = {
    "LSODA": lsoda,
    "DOPRI5": runge_kutta,
    "DOP853": runge_kutta,
    "Radau": radau,
}


def run(case: str, setting: Setting) -> Result:
    """Integrates to the end of the case; the set-up is numba's compilation."""
    start = np.concatenate((START_SPIN, np.zeros(6)))
    _, setup = timed(lambda: slope(0.0, start, 1.0, 1.0))
    integrate = METHODS[setting.method]
    (end, steps), seconds = timed(lambda: integrate(start, case, setting))
    omega, q, v = np.split(end, 3)
    return result(omega, q, v, seconds, steps, setup)
