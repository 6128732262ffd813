"""Exudyn: the hub and its point as one kinematic tree of nine joints.

Three sliding joints and three revolute ones, about Y, X and Z, float the hub; three
sliding joints with P and D control carry the point. In this order the joints are
singular only where the hub's third axis lies along the inertial second one. The start
keeps the angular momentum near that axis, and the motion keeps the hub's third axis
more than 20 degrees away from it. Exudyn's spring-damper connectors are not used: they
have another law (see README.md).
"""

import exudyn as exu
import numpy as np
from exudyn.itemInterface import NodeGenericODE2, ObjectKinematicTree

from measure import Diverged, Result, Setting, result, timed
from problem import (
    ANCHOR,
    CASES,
    HUB_INERTIA,
    HUB_MASS,
    POINT_MASS,
    START_SPIN,
    Vector,
    hub_start,
)

HUB_LINK = 5
POINT_LINK = 8
LINKS = 9
LARGEST_STEP = 0.1
JOINTS = ["PrismaticX", "PrismaticY", "PrismaticZ", "RevoluteY", "RevoluteX"] + [
    "RevoluteZ",
    "PrismaticX",
    "PrismaticY",
    "PrismaticZ",
]
SLIDERS = slice(6, 9)


def at(link: int, value: Vector) -> list[Vector]:
    """A list with `value` at one link and zeros of its shape at the others."""
    return [value if i == link else np.zeros_like(value) for i in range(LINKS)]


def control(gain: float) -> list[float]:
    """Gains of the joints: only the point's are controlled."""
    return [0.0] * 6 + [gain] * 3


def tree(case: str, node: int) -> ObjectKinematicTree:
    """The kinematic tree on the node that has its nine coordinates."""
    masses = [0.0] * LINKS
    masses[HUB_LINK], masses[POINT_LINK] = HUB_MASS, POINT_MASS
    inertias = at(HUB_LINK, np.diag(HUB_INERTIA))
    return ObjectKinematicTree(
        nodeNumber=node,
        jointTypes=[getattr(exu.JointType, name) for name in JOINTS],
        linkParents=list(range(-1, LINKS - 1)),
        jointTransformations=exu.Matrix3DList([np.eye(3)] * LINKS),
        jointOffsets=exu.Vector3DList(at(HUB_LINK + 1, ANCHOR)),
        linkInertiasCOM=exu.Matrix3DList(inertias),
        linkCOMs=exu.Vector3DList([np.zeros(3)] * LINKS),
        linkMasses=masses,
        jointPControlVector=control(CASES[case].stiffness),
        jointDControlVector=control(CASES[case].damping),
        jointPositionOffsetVector=[0.0] * LINKS,
        jointVelocityOffsetVector=[0.0] * LINKS,
    )


def assembled(case: str) -> tuple[exu.MainSystem, int]:
    """The system at the start, and its node."""
    system = exu.SystemContainer().AddSystem()
    place, velocity = hub_start()
    turning = START_SPIN[[1, 0, 2]]
    node = system.AddNode(
        NodeGenericODE2(
            numberOfODE2Coordinates=LINKS,
            referenceCoordinates=[0.0] * LINKS,
            initialCoordinates=[*place, *np.zeros(6)],
            initialCoordinates_t=[*velocity, *turning, *np.zeros(3)],
        )
    )
    system.AddObject(tree(case, node))
    system.Assemble()
    return system, node


def simulation_settings(case: str, setting: Setting) -> exu.SimulationSettings:
    """Exudyn's words for a setting."""
    settings = exu.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    integration = settings.timeIntegration
    integration.verboseMode = 0
    integration.endTime = CASES[case].duration
    integration.explicit.computeEndOfStepAccelerations = False
    step = setting.value if setting.fixed else LARGEST_STEP
    integration.numberOfSteps = round(CASES[case].duration / step)
    integration.automaticStepSize = not setting.fixed
    if not setting.fixed:
        integration.relativeTolerance = setting.value
        integration.absoluteTolerance = setting.value
    return settings


def spin(angles: Vector, rates: Vector) -> Vector:
    """Angular velocity in body axes from the angles about Y, X and Z."""
    _, x, z = angles
    about_y = np.array([0.0, np.cos(x), -np.sin(x)]) * rates[0]
    before_z = about_y + np.array([rates[1], 0.0, rates[2]])
    turn = np.array(
        [[np.cos(z), np.sin(z), 0.0], [-np.sin(z), np.cos(z), 0.0], [0.0, 0.0, 1.0]]
    )
    return turn @ before_z


def run(case: str, setting: Setting) -> Result:
    """Solves to the end of the case; the set-up assembles the system."""
    (system, node), setup = timed(lambda: assembled(case))
    settings = simulation_settings(case, setting)
    solver = getattr(exu.DynamicSolverType, setting.method)
    try:
        _, seconds = timed(lambda: system.SolveDynamic(settings, solverType=solver))
    except Exception as error:
        raise Diverged(str(error).strip().splitlines()[-1]) from error
    kind = exu.OutputVariableType
    y = np.array(system.GetNodeOutput(node, kind.Coordinates))
    rate = np.array(system.GetNodeOutput(node, kind.Coordinates_t))
    steps = system.sys["dynamicSolver"].it.currentStepIndex
    omega = spin(y[3:6], rate[3:6])
    return result(omega, y[SLIDERS], rate[SLIDERS], seconds, steps, setup)
