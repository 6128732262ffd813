"""Newton: one body on a free joint, on a processor, in single precision. Its examples take 600 steps a second."""

from __future__ import annotations

from importlib.metadata import version as installed

import newton
import numpy as np
import warp as wp

from bodies import MASS, Body, Rows
from simulators import Method
from simulators.plain import seen_from_body

TITLE = "Newton"
SHORT = 60.0
H = 1.0 / 600.0
STEPS, SCAN = (H, H / 2), (4 * H, 16 * H)
SOLVERS = {
    "SolverXPBD": newton.solvers.SolverXPBD,
    "SolverSemiImplicit": newton.solvers.SolverSemiImplicit,
    "SolverFeatherstone": newton.solvers.SolverFeatherstone,
}
WHY = "The gyroscopic torque is that at the start of the step (`solver.py`): explicit Euler; in single precision the angular momentum walks."
HIDDEN = "This solver damps every body by default; the wobble is hidden by that."
FEATHERSTONE = "The rates are explicit Euler's; its `angular_damping` does not act on a free joint."
METHODS = (
    Method("SolverXPBD", STEPS, SCAN, "examples", WHY),
    Method("SolverSemiImplicit", STEPS, SCAN, "examples", HIDDEN, damping="angular damping of 0.05 a second"),
    Method("SolverSemiImplicit, damping 0", STEPS, SCAN, "examples", WHY),
    Method("SolverFeatherstone", STEPS, SCAN, "examples", FEATHERSTONE),
)


def version() -> str:
    return installed("newton")


def history(method: Method, body: Body, step: float) -> Rows:
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    link = builder.add_link(mass=MASS, inertia=wp.mat33(np.diag(body.moments)), lock_inertia=True)
    builder.add_articulation([builder.add_joint_free(link)])
    model = builder.finalize(device="cpu")
    name, _, undamped = method.name.partition(", ")
    solver = SOLVERS[name](model, angular_damping=0.0) if undamped else SOLVERS[name](model)
    state, other = model.state(), model.state()
    rates = [0.0, 0.0, 0.0, *body.rates]
    for each in (state, other):
        each.joint_qd.assign(np.array(rates, dtype=np.float32))
        each.body_qd.assign(np.array([rates], dtype=np.float32))

    def row(time: float) -> list[float]:
        x, y, z, w = np.array(state.body_q.numpy()[0][3:7], dtype=float)
        q = np.array([w, x, y, z])
        q /= np.sqrt(q @ q)
        return [time, *seen_from_body(q, np.array(state.body_qd.numpy()[0][3:6], dtype=float)), *q]

    def advance() -> None:
        nonlocal state, other
        state.clear_forces()
        solver.step(state, other, None, None, step)
        state, other = other, state

    return body.followed(step, advance, row, SHORT)
