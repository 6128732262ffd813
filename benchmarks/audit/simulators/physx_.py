"""PhysX by SAPIEN: a dynamic body, in single precision. SAPIEN switches the gyroscopic forces on, which are off in PhysX by default."""

from __future__ import annotations

from importlib.metadata import version as installed

import numpy as np
import sapien

from bodies import MASS, Body, Rows
from simulators import Method
from simulators.plain import seen_from_body

TITLE = "PhysX (SAPIEN)"
STEPS, SCAN = (0.01, 0.005), (0.04, 0.08)
DAMPED = "PhysX damps every body; the wobble is hidden by that."
WHY = "An explicit gyroscopic step whose angular momentum is set back to its length (its source): of first order; the length walks in single precision."
METHODS = (
    Method("dynamic body", STEPS, SCAN, "default", DAMPED, default=True, damping="angular damping of 0.05 a second"),
    Method("dynamic body, damping 0", STEPS, SCAN, "default", WHY),
)


def version() -> str:
    return installed("sapien")


def history(method: Method, body: Body, step: float) -> Rows:
    system = sapien.physx.PhysxCpuSystem()
    system.config.gravity = [0.0, 0.0, 0.0]
    scene = sapien.Scene([system])
    scene.set_timestep(step)
    whole = sapien.physx.PhysxRigidDynamicComponent()
    whole.attach(sapien.physx.PhysxCollisionShapeBox([0.1, 0.1, 0.1], sapien.physx.get_default_material()))
    entity = sapien.Entity()
    entity.add_component(whole)
    scene.add_entity(entity)
    whole.set_mass(MASS)
    whole.set_inertia(list(body.moments))
    whole.set_angular_velocity(list(body.rates))
    if "damping 0" in method.name:
        whole.set_angular_damping(0.0)
        whole.set_linear_damping(0.0)

    def row(time: float) -> list[float]:
        q = np.array(entity.pose.q, dtype=float)
        q /= np.sqrt(q @ q)
        return [time, *seen_from_body(q, np.array(whole.angular_velocity, dtype=float)), *q]

    return body.followed(step, scene.step, row)
