"""REBOUND: its Bulirsch-Stoer method on the equations of motion compiled by numba.

REBOUND has no elastic bodies; its interface for further differential equations takes
any right-hand side. The one given here is compiled, so that no Python runs in a step.
"""

import ctypes

import numba as nb
import numpy as np
import rebound

from measure import Result, Setting, result, timed
from peers.compiled import rates
from problem import CASES, START_SPIN

Rates = ctypes.CFUNCTYPE(
    None,
    ctypes.c_void_p,
    ctypes.POINTER(ctypes.c_double),
    ctypes.POINTER(ctypes.c_double),
    ctypes.c_double,
)
SIGNATURE = nb.void(
    nb.types.voidptr,
    nb.types.CPointer(nb.float64),
    nb.types.CPointer(nb.float64),
    nb.float64,
)


def compiled_rates(case: str):
    """The right-hand side as a C function; it lives as long as the object returned."""
    k, c = CASES[case].stiffness, CASES[case].damping

    @nb.cfunc(SIGNATURE)
    def function(_, out, y, t):
        rates(nb.carray(y, 9), nb.carray(out, 9), k, c)

    return function


def run(case: str, setting: Setting) -> Result:
    """Integrates to the end of the case; the set-up is numba's compilation."""
    function, setup = timed(lambda: compiled_rates(case))
    simulation = rebound.Simulation()
    simulation.integrator = "BS"
    simulation.integrator.eps_rel = setting.value
    simulation.integrator.eps_abs = setting.value
    equations = simulation.create_ode(length=9, needs_nbody=False)
    for i, value in enumerate([*START_SPIN, *np.zeros(6)]):
        equations.y[i] = value
    equations.derivatives = Rates(function.address)
    _, seconds = timed(lambda: simulation.integrate(CASES[case].duration))
    omega, q, v = np.split(np.array(equations.y[:9]), 3)
    return result(omega, q, v, seconds, simulation.steps_done, setup)
