"""Arguments of every bad kind are refused by name, before any work."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import InputError, Model

BOOM = Model(quasirigid.EXAMPLE)
CARRIER = {"carrier": {"mass": 40.0, "center_of_mass": [0, 0.1, 0], "inertia": [9, 13, 16]}}


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: BOOM.simulate("ful"), "system = \"ful\" is not one of"),
        (lambda: BOOM.simulate(3), "system = 3 is not a text"),
        (lambda: BOOM.simulate(duration=-1), "duration = -1"),
        (lambda: BOOM.simulate(duration=0), "duration = 0"),
        (lambda: BOOM.simulate(duration=float("nan")), "duration = nan"),
        (lambda: BOOM.simulate(duration=float("inf")), "duration = inf"),
        (lambda: BOOM.simulate(duration="2 km"), "duration = \"2 km\""),
        (lambda: BOOM.simulate(duration="-2 h"), "is not a duration"),
        (lambda: BOOM.simulate(duration=True), "duration = True"),
        (lambda: BOOM.simulate(duration=[1, 2]), "duration = "),
        (lambda: BOOM.simulate(samples=1), "samples 1 is out of range"),
        (lambda: BOOM.simulate(samples=-3), "samples = -3 is out of range"),
        (lambda: BOOM.simulate(samples=2.5), "samples = 2.5 is not a whole number"),
        (lambda: BOOM.simulate(samples=10**30), "samples = "),
        (lambda: BOOM.simulate(times=[]), "times"),
        (lambda: BOOM.simulate(times=[[1, 2]]), "times"),
        (lambda: BOOM.simulate(times=3), "times"),
        (lambda: BOOM.simulate(times=[0, 1], samples=3), "times replace duration"),
        (lambda: BOOM.simulate("rigid", coordinates=True), "no internal coordinates"),
        (lambda: BOOM.simulate(form="x"), "form"),
        (lambda: BOOM.simulate(integrator="x"), "integrator"),
        (lambda: BOOM.simulate(tolerance="x"), "tolerance"),
        (lambda: BOOM.evolve(until=2.0), "between 0 and 1"),
        (lambda: BOOM.evolve(until="3 km"), "until"),
        (lambda: BOOM.evolve(until=0.1), "D/I3 = 0.1"),
        (lambda: BOOM.evolve(start=float("nan")), "start"),
        (lambda: BOOM.evolve(duration=-1), "duration"),
        (lambda: BOOM.evolve(samples=1), "samples 1 is out of range"),
        (lambda: BOOM.evolve(samples=10**7 + 1), "give 2 to 10000000"),
        (lambda: BOOM.evolve(power="x"), "power"),
        (lambda: BOOM.modes([1, 2]), "spin has the shape"),
        (lambda: BOOM.modes(np.ma.array([1.0, 2, 3], mask=[0, 1, 0])), "spin has masked values"),
        (lambda: BOOM.modes([1.0, 2, np.ma.masked]), "spin has masked values"),
        (lambda: BOOM.evolve(initial=np.ma.masked_less([[1.0, 2, 3]], 2)), "initial has masked values"),
        (lambda: BOOM.simulate(duration=np.ma.masked), "duration is masked"),
        (lambda: BOOM.with_({"carrier.mass": np.ma.masked}), "carrier.mass"),
        (lambda: BOOM.evolve(uncertainty_samples=1), "uncertainty_samples 1 is out of range"),
        (lambda: BOOM.evolve(initial=[[1.0, 2, 3]], uncertainty_samples=3), "leave initial out"),
        (lambda: Model("\ud800"), "surrogate"),
        (lambda: Model(quasirigid.EXAMPLE, file="\ud800"), "is not a path"),
        (lambda: Model.from_file("\ud800"), "is not a path"),
        (lambda: quasirigid.read_sweep("\ud800"), "is not a path"),
        (lambda: quasirigid.sweep("\ud800"), "is not a path"),
        (lambda: Model.from_dict({"body": {"name": "\ud800"}}), "surrogates"),
        (lambda: BOOM.with_({"\ud800": 1}), "surrogates"),
        (lambda: BOOM.modes(axis="\ud800"), "surrogate"),
        (lambda: BOOM.simulate(duration="\ud800"), "surrogate"),
        (lambda: BOOM.modes([1, 2, np.nan]), "finite"),
        (lambda: BOOM.modes(axis="x"), "axis"),
        (lambda: BOOM.check(order=-1), "order = -1"),
        (lambda: BOOM.check(order=True), "order = True"),
        (lambda: BOOM.verify(orders=3), "orders"),
        (lambda: BOOM.verify(halvings=1.5), "halvings"),
        (lambda: BOOM.check(progress=3), "progress"),
        (lambda: BOOM.evolve(initial=[1, 2, 3]), r"initial has the shape \(3,\)"),
        (lambda: BOOM.evolve(initial=np.zeros((2, 4))), r"initial has the shape \(2, 4\)"),
        (lambda: BOOM.evolve(initial=np.zeros((2, 3, 3))), "initial has the shape"),
        (lambda: BOOM.evolve(initial=np.zeros((2, 3), complex)), "complex"),
        (lambda: BOOM.evolve(initial=[["a", "b", "c"]]), "give real numbers"),
        (lambda: BOOM.evolve(initial=[[1, 2, 3], [4, 5]]), "different length"),
        (lambda: BOOM.evolve(initial=np.array([[None, 1, 2]])), "object"),
        (lambda: BOOM.reduce().torque([1, 2]), "omega has the shape"),
        (lambda: BOOM.reduce().power(3), "omega has the shape"),
        (lambda: BOOM.reduce().torque(np.zeros(3, bool)), "bool"),
        (lambda: BOOM.reduce().coefficients("mu"), "there is no polynomial"),
    ],
)
def test_bad_arguments(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        call()


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        (lambda: BOOM.reduce(13), quasirigid.ReductionError),
        (lambda: BOOM.simulate(tolerance=1.0), quasirigid.PropagationError),
        (lambda: BOOM.simulate(tolerance=float("nan")), quasirigid.PropagationError),
        (lambda: BOOM.simulate(times=[2.0, 1.0]), quasirigid.PropagationError),
        (lambda: BOOM.simulate(times=[float("nan")]), quasirigid.PropagationError),
        (lambda: BOOM.verify(revolutions=-1), quasirigid.VerificationError),
        (lambda: BOOM.verify(orders=[]), quasirigid.VerificationError),
        (lambda: BOOM.simulate(initial=np.ones((10**6, 3)), samples=10**6), quasirigid.TooLargeError),
    ],
)
def test_refusals_of_the_study_have_their_own_kind(call: Callable[[], Any], kind: type[Exception]) -> None:
    with pytest.raises(kind) as caught:
        call()
    assert isinstance(caught.value, quasirigid.Error) and str(caught.value)


def test_former_names_are_taken_with_a_warning_that_says_those_of_today() -> None:
    former: list[tuple[Callable[[], object], str]] = [
        (lambda: BOOM.simulate("rigid", times=[0, 1], **_any(method="explicit")), "method is now called integrator"),
        (lambda: BOOM.simulate(times=[0, 1], form="paper"), 'form = "paper" is now called "angular-velocity"'),
        (lambda: BOOM.verify(orders=[1], halvings=1, **_any(rotations=0.1)), "rotations is now called revolutions"),
        (lambda: Model.from_dict({**CARRIER, "run": {"verify": {"rotations": 2}}}), "`rotations` in `verify` is now called `revolutions`"),
    ]
    for call, note in former:
        with pytest.warns(DeprecationWarning, match=re.escape(note)) as told:
            call()
        assert len(told) == 1 and told[0].filename == __file__
    with pytest.raises(InputError, match="the former name of revolutions"):
        BOOM.verify(revolutions=1, **_any(rotations=1))


def _any(**arguments: Any) -> dict[str, Any]:
    return arguments
