"""DART: a free joint without damping, which is its default."""

from __future__ import annotations

from importlib.metadata import version as installed

import dartpy as dart
import numpy as np

from bodies import MASS, Body, Rows
from simulators import Method
from simulators.plain import turned

TITLE = "DART"
WHY = "Velocities by the forces at the start of the step, attitude by the new ones: the rates are explicit Euler's."
METHODS = (
    Method("semi-implicit Euler", (0.001, 0.0005), (0.008, 0.032), "default", WHY, default=True),
)


def version() -> str:
    return installed("dartpy")


def history(method: Method, body: Body, step: float) -> Rows:
    world = dart.simulation.World()
    world.setGravity([0.0, 0.0, 0.0])
    world.setTimeStep(step)
    skeleton = dart.dynamics.Skeleton("body")
    joint, whole = skeleton.createFreeJointAndBodyNodePair()
    inertia = dart.dynamics.Inertia(MASS, np.zeros(3), np.diag(body.moments))
    whole.setInertia(inertia)
    world.addSkeleton(skeleton)
    skeleton.setVelocities([*body.rates, 0.0, 0.0, 0.0])

    def row(time: float) -> list[float]:
        rotation = whole.getWorldTransform().rotation()
        q = dart.math.Quaternion(rotation)
        rates = rotation.T @ np.asarray(whole.getAngularVelocity()).ravel()
        return [time, *rates, q.w(), q.x(), q.y(), q.z()]

    return body.followed(step, world.step, row)
