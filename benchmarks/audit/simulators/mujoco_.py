"""MuJoCo: a free joint, its five integrators. Nothing damps a free joint by default."""

from __future__ import annotations

import mujoco
import numpy as np

from bodies import MASS, Body, Rows
from simulators import Method

TITLE = "MuJoCo"
STEPS, SCAN, OF = (0.002, 0.001), (0.008, 0.032), "default"
FIRST = "The gyroscopic torque is that at the start of the step: the rates are explicit Euler's, which feeds energy."
IMPLICIT = "The derivative of the gyroscopic torque takes part: to first order implicit Euler, which takes energy."
FAST = "Documented to leave derivatives of Coriolis forces out; on one free body it gives the numbers of `implicit`."
DISCRETE = "On one free body it gives the numbers of `implicit`."
METHODS = (
    Method("Euler", STEPS, SCAN, OF, FIRST, default=True),
    Method("implicit", STEPS, SCAN, OF, IMPLICIT),
    Method("implicitfast", STEPS, SCAN, OF, FAST),
    Method("discrete", STEPS, SCAN, OF, DISCRETE),
    Method("RK4", STEPS, (0.1, 0.2, 0.4), OF, "The classical method on rates and attitude; at the default step its loss is under the rounding."),
)
MODEL = """<mujoco><option gravity="0 0 0" timestep="{step!r}" integrator="{name}"/>
<worldbody><body><freejoint/><inertial pos="0 0 0" mass="{mass}" diaginertia="{moments}"/></body></worldbody></mujoco>"""


def version() -> str:
    return mujoco.__version__


def history(method: Method, body: Body, step: float) -> Rows:
    moments = " ".join(map(repr, body.moments))
    xml = MODEL.format(step=step, name=method.name, mass=MASS, moments=moments)
    model = mujoco.MjModel.from_xml_string(xml)
    # axes of inertia may be reordered: rates are read in the axes of the body, which are those given here
    data = mujoco.MjData(model)
    data.qvel[3:] = body.rates
    every, rows = body.schedule(step)
    found = [[0.0, *data.qvel[3:6], *data.qpos[3:7]]]
    for k in range(1, rows + 1):
        mujoco.mj_step(model, data, nstep=every)
        found.append([k * every * step, *data.qvel[3:6], *data.qpos[3:7]])
    return np.array(found)
