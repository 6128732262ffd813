"""PyBullet: a free body as a multibody, its default, and in maximal coordinates. The default damping of the former is switched off in another row."""

from __future__ import annotations

from importlib.metadata import version as installed

import numpy as np
import pybullet

from bodies import MASS, Body, Rows
from simulators import Method
from simulators.plain import seen_from_body

TITLE = "PyBullet"
H = 1.0 / 240.0
STEPS, SCAN = (H, H / 2), (4 * H, 12 * H)
DAMPED = "angular damping of $0.04(1+\\lvert\\omega\\rvert)$ a second"
HIDDEN = "`btMultiBody` damps every free body by default; the wobble is hidden by that."
EXPLICIT = "The gyroscopic term of `btMultiBody` is that at the start of the step: explicit Euler."
IMPLICIT = "`btRigidBody` takes one step of Newton's method in body axes by default: to first order implicit Euler; no damping acts."
METHODS = (
    Method("multibody", STEPS, SCAN, "default", HIDDEN, default=True, damping=DAMPED),
    Method("multibody, damping 0", STEPS, SCAN, "default", EXPLICIT),
    Method("maximal coordinates", STEPS, SCAN, "default", IMPLICIT),
)


def version() -> str:
    return installed("pybullet")


def row(time: float, body: int) -> list[float]:
    x, y, z, w = pybullet.getBasePositionAndOrientation(body)[1]
    q = np.array([w, x, y, z])
    rates = np.array(pybullet.getBaseVelocity(body)[1])
    return [time, *seen_from_body(q, rates), *q]


def history(method: Method, body: Body, step: float) -> Rows:
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setTimeStep(step)
    shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[0.1, 0.1, 0.1])
    whole = pybullet.createMultiBody(MASS, shape, useMaximalCoordinates=method.name.startswith("maximal"))
    pybullet.changeDynamics(whole, -1, localInertiaDiagonal=body.moments)
    if "damping 0" in method.name:
        pybullet.changeDynamics(whole, -1, linearDamping=0.0, angularDamping=0.0)
    pybullet.resetBaseVelocity(whole, angularVelocity=body.rates)
    found = body.followed(step, pybullet.stepSimulation, lambda time: row(time, whole))
    pybullet.disconnect(client)
    return found
