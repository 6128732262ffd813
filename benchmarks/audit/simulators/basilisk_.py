"""Basilisk: a hub alone; the attitude is kept as modified Rodrigues parameters. It has no default step: 0.1 s is that of its attitude tutorials."""

from __future__ import annotations

from importlib.metadata import version as installed

import numpy as np
from Basilisk.simulation import spacecraft, svIntegrators
from Basilisk.utilities import SimulationBaseClass, macros

from bodies import MASS, Body, Rows
from simulators import Method

TITLE = "Basilisk"
METHODS = (
    Method("RK4", (0.1, 0.05), (0.2, 0.4), "tutorials", "The classical method: the fifth power of the step.", default=True),
    Method("RK2", (0.1, 0.05), (0.2, 0.4), "tutorials", "Heun's method lengthens the wobble by $(\\lambda h)^4/8$ a step."),
)
TASK = "task"


def version() -> str:
    return installed("bsk")


def quaternion(mrp: Rows) -> Rows:
    square = mrp @ mrp
    return np.array([1.0 - square, *(2.0 * mrp)]) / (1.0 + square)


def history(method: Method, body: Body, step: float) -> Rows:
    simulation = SimulationBaseClass.SimBaseClass()
    simulation.CreateNewProcess("process").addTask(simulation.CreateNewTask(TASK, macros.sec2nano(step)))
    craft = spacecraft.Spacecraft()
    craft.hub.mHub = MASS
    craft.hub.IHubPntBc_B = np.diag(body.moments).tolist()
    craft.hub.omega_BN_BInit = [[rate] for rate in body.rates]
    simulation.AddModelToTask(TASK, craft)
    integrator = getattr(svIntegrators, f"svIntegrator{method.name}")(craft)
    craft.setIntegrator(integrator)
    every, rows = body.schedule(step)
    record = craft.scStateOutMsg.recorder(macros.sec2nano(every * step))
    simulation.AddModelToTask(TASK, record)
    simulation.InitializeSimulation()
    simulation.ConfigureStopTime(macros.sec2nano(rows * every * step))
    simulation.ExecuteSimulation()
    q = np.array([quaternion(np.array(mrp)) for mrp in record.sigma_BN])
    return np.column_stack([np.array(record.times()) * 1e-9, record.omega_BN_B, q])
