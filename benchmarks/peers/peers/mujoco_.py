"""MuJoCo: a free body with a point on three sliding joints, each with spring and damper.

Only its Runge-Kutta method is used. The default one and the implicit ones are of first
order and change the angular momentum far more than the dashpot changes the energy.
"""

import mujoco
import numpy as np

from measure import Diverged, Result, Setting, result, timed
from problem import (
    ANCHOR,
    CASES,
    HUB_INERTIA,
    HUB_MASS,
    POINT_MASS,
    START_SPIN,
    hub_start,
)


def numbers(values) -> str:
    """Numbers as MuJoCo's XML takes them."""
    return " ".join(repr(float(x)) for x in values)


def model(case: str, method: str, step: float) -> str:
    """The problem as MuJoCo's XML."""
    spring = f'stiffness="{CASES[case].stiffness}" damping="{CASES[case].damping}"'
    slides = "".join(
        f'<joint type="slide" axis="{numbers(axis)}" {spring}/>' for axis in np.eye(3)
    )
    return f"""<mujoco>
  <compiler boundmass="0" boundinertia="0"/>
  <option gravity="0 0 0" timestep="{step!r}" integrator="{method}">
    <flag contact="disable" autoreset="disable"/>
  </option>
  <worldbody>
    <body>
      <freejoint/>
      <inertial pos="0 0 0" mass="{HUB_MASS}" diaginertia="{numbers(HUB_INERTIA)}"/>
      <body pos="{numbers(ANCHOR)}">
        {slides}
        <inertial pos="0 0 0" mass="{POINT_MASS}" diaginertia="1e-12 1e-12 1e-12"/>
      </body>
    </body>
  </worldbody>
</mujoco>"""


def run(case: str, setting: Setting) -> Result:
    """Steps to the end of the case; the set-up reads the model."""
    xml = model(case, setting.method, setting.value)
    built, setup = timed(lambda: mujoco.MjModel.from_xml_string(xml))
    data = mujoco.MjData(built)
    data.qpos[:3], data.qvel[:3] = hub_start()
    data.qvel[3:6] = START_SPIN
    steps = round(CASES[case].duration / setting.value)
    _, seconds = timed(lambda: mujoco.mj_step(built, data, nstep=steps))
    unstable = sum(warning.number for warning in data.warning)
    if unstable:
        raise Diverged(f"unstable, {unstable} warnings")
    return result(data.qvel[3:6], data.qpos[7:], data.qvel[6:], seconds, steps, setup)
