"""Exudyn: a rigid body with Euler parameters by its default implicit solver, and with the rotation vector by explicit solvers on the Lie group."""

from __future__ import annotations

from importlib.metadata import version as installed

import exudyn as exu
import numpy as np
from exudyn.utilities import RigidBodyInertia, SensorBody

from bodies import MASS, Body, Rows
from simulators import Method

TITLE = "Exudyn"
STEPS = (0.01, 0.005)
ALPHA = "Of second order, and with a spectral radius of 0.9; what it takes of a slow wobble falls with the third to fourth power of the step."
FOURTH = "The classical method: the fifth power of the step."
FIRST = "Explicit Euler for the rates."
METHODS = (
    Method("GeneralizedAlpha, Euler parameters", STEPS, (0.04, 0.08), "default", ALPHA, default=True),
    Method("GeneralizedAlpha, rotation vector", STEPS, (0.04, 0.08), "default", ALPHA),
    Method("RK44, rotation vector on the Lie group", STEPS, (0.1, 0.2), "default", FOURTH),
    Method("ExplicitEuler, rotation vector on the Lie group", STEPS, (0.04, 0.08), "default", FIRST),
)


def version() -> str:
    return installed("exudyn")


def quaternion(matrix: Rows) -> Rows:
    """Of a rotation matrix, by the largest of its four squares."""
    m = matrix.reshape(3, 3)
    trace = np.trace(m)
    squares = np.array([trace, *np.diag(m)])
    k = int(np.argmax(squares))
    skew = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    if k == 0:
        q = np.array([1.0 + trace, *skew])
    else:
        i = k - 1
        q = np.array([skew[i], *(m[:, i] + m[i, :])])
        q[k] = 1.0 + 2.0 * m[i, i] - trace
    return q / np.sqrt(q @ q)


def history(method: Method, body: Body, step: float) -> Rows:
    every, rows = body.schedule(step)
    system = exu.SystemContainer().AddSystem()
    inertia = RigidBodyInertia(mass=MASS, inertiaTensor=np.diag(body.moments))
    kinds = exu.NodeType
    kind = kinds.RotationEulerParameters if "parameters" in method.name else kinds.RotationRotationVector
    whole = system.CreateRigidBody(inertia=inertia, nodeType=kind, initialAngularVelocity=list(body.rates))
    outputs = exu.OutputVariableType
    sensors = [
        system.AddSensor(
            SensorBody(bodyNumber=whole, storeInternal=True, writeToFile=False, outputVariableType=output)
        )
        for output in (outputs.AngularVelocityLocal, outputs.RotationMatrix)
    ]
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = every * step
    settings.timeIntegration.endTime = rows * every * step
    settings.timeIntegration.numberOfSteps = rows * every
    settings.timeIntegration.automaticStepSize = False
    settings.timeIntegration.verboseMode = 0
    solver = getattr(exu.DynamicSolverType, method.name.split(",")[0])
    system.SolveDynamic(settings, solverType=solver)
    rates, matrices = (np.array(system.GetSensorStoredData(sensor)) for sensor in sensors)
    return np.column_stack([rates, [quaternion(m) for m in matrices[:, 1:]]])
