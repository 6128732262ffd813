"""Drake: a free body, by the discrete plant and by integrators with control of the error, of which a step is the accuracy."""

from __future__ import annotations

from importlib.metadata import version as installed

import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.multibody.tree import RotationalInertia, SpatialInertia
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig

from bodies import MASS, Body, Rows
from simulators import Method

TITLE = "Drake"
ACCURACY = (1e-4, 1e-5)
DISCRETE = "The gyroscopic term is that at the start of the step: the rates are explicit Euler's."
INERTIAL = "The velocity of a free body is kept in inertial axes, where it turns with the spin, faster than the wobble; at loose accuracies the largest step, 0.1 s, decides."
EULER = "Of first order and implicit: under its control of the error it takes steps that still the wobble in a minute."
CENIC = "Of first order: at accuracy 1e-3 it has the numbers of explicit Euler at half of the largest step, 0.1 s."
METHODS = (
    Method("discrete plant", (0.001, 0.0005), (0.008, 0.032), "default of its configuration", DISCRETE, default=True),
    Method("runge_kutta3", ACCURACY, (1e-3, 1e-6), "default of a continuous plant", INERTIAL, tolerance=True),
    Method("implicit_euler", ACCURACY, (1e-3, 1e-6), "default accuracy", EULER, tolerance=True),
    Method("radau3", ACCURACY, (1e-3, 1e-6), "default accuracy", INERTIAL, tolerance=True),
    Method("cenic", ACCURACY, (1e-3, 1e-6), "default accuracy", CENIC, tolerance=True),
)


def version() -> str:
    return installed("drake")


def history(method: Method, body: Body, step: float) -> Rows:
    discrete = not method.tolerance
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, step if discrete else 0.0)
    plant.mutable_gravity_field().set_gravity_vector(np.zeros(3))
    inertia = SpatialInertia.MakeFromCentralInertia(MASS, np.zeros(3), RotationalInertia(*body.moments))
    whole = plant.AddRigidBody("body", inertia)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    if not discrete:
        ApplySimulatorConfig(SimulatorConfig(integration_scheme=method.name, accuracy=step), simulator)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(context, whole, RigidTransform())
    plant.SetFreeBodySpatialVelocity(context, whole, SpatialVelocity(np.array(body.rates), np.zeros(3)))
    simulator.Initialize()

    def row(time: float) -> list[float]:
        rotation = plant.EvalBodyPoseInWorld(context, whole).rotation()
        rates = plant.EvalBodySpatialVelocityInWorld(context, whole).rotational()
        q = rotation.ToQuaternion()
        return [time, *rotation.inverse().multiply(rates), q.w(), q.x(), q.y(), q.z()]

    every, rows = body.schedule(step)
    times = np.arange(rows + 1) * every * step if discrete else body.times()
    found = []
    for time in times:
        if time > 0.0:
            simulator.AdvanceTo(time)
        found.append(row(time))
    return np.array(found)
