"""heyoka: Taylor's method on the equations of motion, compiled at run time."""

from collections.abc import Sequence

import heyoka as hy
import numpy as np

from measure import Diverged, Result, Setting, result, timed
from problem import (
    ANCHOR,
    CASES,
    HUB_INERTIA,
    HUB_MASS,
    POINT_MASS,
    START_SPIN,
    Vector,
)

# Each run tells what compilation costs the first time.
hy.llvm_state.set_diskcache_enabled(False)

Triple = list[hy.expression]


def cross(a: Triple, b: Triple) -> Triple:
    """Vector product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def constants(values: Sequence[float] | Vector, real: type) -> list:
    """Numbers whose shortest decimals are meant, in the arithmetic `real`."""
    return [real(repr(float(x))) for x in values]


def equations(
    case: str, real: type = np.float64
) -> list[tuple[hy.expression, hy.expression]]:
    """Rates of the spin, the elongation and its rate: nine unknowns."""
    inertia = constants(HUB_INERTIA, real)
    anchor = constants(ANCHOR, real)
    hub_mass, point_mass = constants([HUB_MASS, POINT_MASS], real)
    reduced_mass = hub_mass * point_mass / (hub_mass + point_mass)
    w = hy.make_vars("w1", "w2", "w3")
    q = hy.make_vars("q1", "q2", "q3")
    v = hy.make_vars("v1", "v2", "v3")
    r = [anchor[i] + q[i] for i in range(3)]
    k, c = CASES[case].stiffness, CASES[case].damping
    force = [k * q[i] + c * v[i] for i in range(3)]
    torque = cross(r, force)
    gyroscopic = cross(w, [inertia[i] * w[i] for i in range(3)])
    w_rate = [(torque[i] - gyroscopic[i]) / inertia[i] for i in range(3)]
    euler = cross(w_rate, r)
    coriolis = cross(w, v)
    centrifugal = cross(w, cross(w, r))
    v_rate = [
        -force[i] / reduced_mass - euler[i] - 2.0 * coriolis[i] - centrifugal[i]
        for i in range(3)
    ]
    return list(zip([*w, *q, *v], [*w_rate, *v, *v_rate], strict=True))


def run(case: str, setting: Setting) -> Result:
    """Propagates to the end of the case; the set-up is heyoka's compilation."""
    start = np.concatenate((START_SPIN, np.zeros(6)))
    integrator, setup = timed(
        lambda: hy.taylor_adaptive(equations(case), start, tol=setting.value)
    )
    end = CASES[case].duration
    outcome, seconds = timed(lambda: integrator.propagate_until(end))
    if outcome[0] != hy.taylor_outcome.time_limit:
        raise Diverged(str(outcome[0]))
    omega, q, v = np.split(integrator.state, 3)
    return result(omega, q, v, seconds, outcome[3], setup)
