"""Basilisk: a hub with three nested translating bodies of which the last has the mass.

`LinearTranslationNDOFStateEffector` carries the exact law. It wants a positive inertia
of each translating body; what that adds is taken off the hub.
"""

import numpy as np
from Basilisk.simulation import (
    linearTranslationNDOFStateEffector as translation,
    spacecraft,
    svIntegrators,
)
from Basilisk.utilities import SimulationBaseClass, macros

from measure import Result, Setting, result, timed
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

SLIDER_INERTIA = 1e-9


def column(values: Vector) -> list[list[float]]:
    """A vector as Basilisk takes it."""
    return [[float(x)] for x in values]


def slider(case: str, axis: int) -> translation.TranslatingBody:
    """The link that slides along one body axis."""
    body = translation.TranslatingBody()
    body.setMass(POINT_MASS if axis == 2 else 0.0)
    body.setIPntFc_F((SLIDER_INERTIA * np.eye(3)).tolist())
    body.setDCM_FP(np.eye(3).tolist())
    body.setR_FcF_F(column(np.zeros(3)))
    body.setR_F0P_P(column(ANCHOR if axis == 0 else np.zeros(3)))
    body.setFHat_P(column(np.eye(3)[axis]))
    body.setRhoInit(0.0)
    body.setRhoDotInit(0.0)
    body.setK(CASES[case].stiffness)
    body.setC(CASES[case].damping)
    return body


def craft() -> spacecraft.Spacecraft:
    """The hub at the start."""
    body = spacecraft.Spacecraft()
    body.ModelTag = "craft"
    body.hub.mHub = HUB_MASS
    body.hub.r_BcB_B = column(np.zeros(3))
    inertia = HUB_INERTIA - 3.0 * SLIDER_INERTIA
    body.hub.IHubPntBc_B = np.diag(inertia).tolist()
    place, velocity = hub_start()
    body.hub.r_CN_NInit = column(place)
    body.hub.v_CN_NInit = column(velocity)
    body.hub.sigma_BNInit = column(np.zeros(3))
    body.hub.omega_BN_BInit = column(START_SPIN)
    return body


class Simulation:
    """The assembled simulation; Basilisk needs its parts kept alive."""

    def __init__(self, case: str, setting: Setting) -> None:
        self.frame = SimulationBaseClass.SimBaseClass()
        process = self.frame.CreateNewProcess("process")
        process.addTask(
            self.frame.CreateNewTask("task", macros.sec2nano(setting.value))
        )
        self.craft = craft()
        self.mass = translation.LinearTranslationNDOFStateEffector()
        self.mass.ModelTag = "mass"
        self.sliders = [slider(case, axis) for axis in range(3)]
        for body in self.sliders:
            self.mass.addTranslatingBody(body)
        self.craft.addStateEffector(self.mass)
        self.frame.AddModelToTask("task", self.mass)
        self.frame.AddModelToTask("task", self.craft)
        method = getattr(svIntegrators, f"svIntegrator{setting.method}")
        self.integrator = method(self.craft)
        self.craft.setIntegrator(self.integrator)
        self.frame.InitializeSimulation()
        self.frame.ConfigureStopTime(macros.sec2nano(CASES[case].duration))

    def state(self, name: str) -> Vector:
        """A state of the simulation by its name."""
        return np.ravel(self.craft.dynManager.getStateObject(name).getState())


def run(case: str, setting: Setting) -> Result:
    """Executes the simulation; the set-up is its assembly."""
    simulation, setup = timed(lambda: Simulation(case, setting))
    _, seconds = timed(simulation.frame.ExecuteSimulation)
    omega = np.array(simulation.craft.scStateOutMsg.read().omega_BN_B)
    q = simulation.state(simulation.mass.getNameOfRhoState())
    v = simulation.state(simulation.mass.getNameOfRhoDotState())
    steps = round(CASES[case].duration / setting.value)
    return result(omega, q, v, seconds, steps, setup)
