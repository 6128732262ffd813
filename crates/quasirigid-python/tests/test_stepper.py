"""Steps under held torques: the numbers of histories, states, refusals."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import Model

BOOM = Model(quasirigid.EXAMPLE)

# Torques (N m), each held for a second.
TORQUES = [[0.3, -0.1, 0.2], [0.0, 0.0, 0.0], [-0.2, 0.4, 0.1]]


def timetable() -> str:
    """The same torques as forces of the model."""
    windows = [(torque, start) for start, torque in enumerate(TORQUES) if any(torque)]
    tables = [
        f'[[force]]\nname = "t{start}"\nkind = "expression"\ntorque = {[str(part) for part in torque]}\nduring = [["{start} s", "{start + 1} s"]]\n'
        for torque, start in windows
    ]
    return quasirigid.EXAMPLE + "\n" + "\n".join(tables)


def gap(body: quasirigid.Stepper, history: quasirigid.History, row: int) -> float:
    return float(max(abs(body.state["omega"] - history.angular_velocity[row]).max(), abs(body.attitude - history.attitude[row]).max()))


def test_steps_of_the_full_system_are_those_of_simulate() -> None:
    times = [0.0, 1.0, 2.0, 3.0]
    undeformed = {"initial.displacements": "rest"}  # the slow manifold at the start depends on the torque
    history = Model(timetable()).with_(undeformed).simulate("full", times=times, tolerance=1e-12)
    body = BOOM.with_(undeformed).stepper("full", tolerance=1e-12)
    for row, torque in enumerate(TORQUES, start=1):
        for _ in range(50):
            assert body.step(np.array(torque), 0.02) == "holds"
        assert gap(body, history, row) < 1e-9


def test_steps_of_the_reduced_equations_are_those_of_simulate_without_torque() -> None:
    history = BOOM.simulate("reduced", times=[0.0, 5.0], tolerance=1e-13)
    body = BOOM.stepper(tolerance=1e-13)
    for _ in range(250):
        body.step([0, 0, 0], 0.02)
    assert gap(body, history, 1) < 1e-9 and body.range is not None and body.range[0] > 1.2
    # with torques what they bend is left out
    history = Model(timetable()).simulate("reduced", times=[0.0, 1.0, 2.0, 3.0], tolerance=1e-12)
    body = BOOM.stepper()
    for torque in TORQUES:
        for _ in range(50):
            body.step(torque, 0.02)
    assert gap(body, history, 3) < 1e-3


def test_states_are_taken_and_given() -> None:
    body = BOOM.stepper("full")
    start = body.state
    body.step([5, 0, 0], 0.1)
    assert body.omega[0] != start["omega"][0]
    body.place(start["omega"], start["attitude"], q=start["q"], rate=start["rate"], position=start["place"], velocity=start["velocity"])
    for name, value in body.state.items():
        np.testing.assert_allclose(value, start[name], atol=1e-13)
    assert repr(body) == "quasirigid.Stepper: t = 0 s, holds"
    reduced = BOOM.stepper()
    assert reduced.range is not None
    reduced.place([0, reduced.range.mean(), 0], [1, 0, 0, 0])
    assert reduced.step([0, 0, 0], 1e-6) == "marginal" == reduced.status


@pytest.mark.parametrize(
    "torque, dt, said",
    [([0, 0], 0.1, "three numbers"), ([0, 0, 0], -1, "no positive length"), ([np.nan, 0, 0], 0.1, "is not finite"), ("fast", 0.1, "three numbers")],
)
def test_wrong_steps_are_refused(torque: Any, dt: float, said: str) -> None:
    for system in ("reduced", "full"):
        with pytest.raises(quasirigid.InputError, match=said):
            BOOM.stepper(system).step(torque, dt)


def test_wrong_bodies_are_refused() -> None:
    with pytest.raises(quasirigid.InputError, match="give 'reduced' or 'full'"):
        BOOM.stepper("rigid")
    with pytest.raises(quasirigid.UnsupportedError, match="changes at given times"):
        Model(timetable()).stepper("full")
    with pytest.raises(quasirigid.UnsupportedError, match="no external forces"):
        Model(timetable()).stepper()
    with pytest.raises(quasirigid.InputError, match="give both q and rate"):
        BOOM.stepper("full").place([0, 0, 1], [1, 0, 0, 0], q=[0.0])
    with pytest.raises(quasirigid.InputError, match="have no coordinates"):
        BOOM.stepper().place([0, 0, 1], [1, 0, 0, 0], q=[0.0], rate=[0.0])
    with pytest.raises(quasirigid.Error):
        BOOM.stepper(tolerance=1.0)


STEPPERS = """
from pathlib import Path
import quasirigid

def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

def steps(number):
    for turn in range(number):
        points = "".join(
            f'[[point]]\\nname = "p{i}"\\nmass = 0.01\\nposition = [{i % 7}, {i % 5 + 0.1 * turn}, {i % 3}]\\n'
            f'[[spring]]\\nfrom = "p{i}"\\nto = "carrier"\\nstiffness = 100.0\\ndamping = 0.1\\n'
            for i in range(300)
        )
        quasirigid.Model(quasirigid.EXAMPLE + points).stepper("full").step([0, 0, 1], 1e-3)

steps(3)
before = resident()
steps(8)
print(resident() - before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the memory of a process is read from /proc")
def test_bodies_end_with_their_steppers() -> None:
    """In a process of its own, whose memory nothing else takes: each body has 3 MB."""
    told = subprocess.run([sys.executable, "-c", STEPPERS], capture_output=True, text=True, check=True)
    assert int(told.stdout) < 8e6
