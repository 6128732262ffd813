"""MJX: MuJoCo in JAX, on a processor, in its default single precision."""

from __future__ import annotations

from importlib.metadata import version as installed

import jax
import mujoco
import numpy as np
from mujoco import mjx

from bodies import MASS, Body, Rows
from simulators import Method
from simulators.mujoco_ import FIRST, MODEL, STEPS

TITLE = "MJX"
SCAN = (0.008, 0.032)
METHODS = (
    Method("Euler, single precision", STEPS, SCAN, "default", FIRST, default=True),
    Method("implicitfast, single precision", STEPS, SCAN, "default", "Its derivatives hold dampers and actuators alone (`derivative.py`), so a free body gets the step of Euler."),
    Method("RK4, single precision", STEPS, (0.1, 0.2, 0.4), "default", "As MuJoCo's, but for the rounding of single precision, which walks."),
)


def version() -> str:
    return installed("mujoco-mjx")


def history(method: Method, body: Body, step: float) -> Rows:
    moments = " ".join(map(repr, body.moments))
    xml = MODEL.format(step=step, name=method.name.partition(",")[0], mass=MASS, moments=moments)
    model = mjx.put_model(mujoco.MjModel.from_xml_string(xml))
    data = mjx.make_data(model)
    data = data.replace(qvel=data.qvel.at[3:].set(np.array(body.rates)))
    every, rows = body.schedule(step)

    def between(data, _):
        data = jax.lax.fori_loop(0, every, lambda _, data: mjx.step(model, data), data)
        return data, (data.qvel[3:6], data.qpos[3:7])

    _, (w, q) = jax.jit(lambda data: jax.lax.scan(between, data, None, length=rows))(data)
    w = np.vstack([body.rates, np.array(w, dtype=float)])
    q = np.vstack([[1.0, 0.0, 0.0, 0.0], np.array(q, dtype=float)])
    times = np.arange(rows + 1) * every * step
    return np.column_stack([times, w, q / np.linalg.norm(q, axis=1)[:, None]])
