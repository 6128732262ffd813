"""Ensembles: rows are the single answers, on any number of threads, in any process; signals end them."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import quasirigid
from quasirigid import Model

BOOM = Model(quasirigid.EXAMPLE)
STARTS = np.array([[-0.17, 1.24, -0.05], [0.1, 1.2, 0.0], [0.0, 0.0, 0.0], [np.nan, 0.0, 1.0], [0.02, 0.03, 1.0]])


def single(start: np.ndarray[Any, Any]) -> Model:
    """The model with another start, written in its text."""
    head = quasirigid.EXAMPLE[: quasirigid.EXAMPLE.index("[initial]")]
    return Model(f"{head}[initial]\nangular_velocity = {start.tolist()!r}\n")


def test_rows_are_the_single_evolutions() -> None:
    many = BOOM.evolve(initial=STARTS)
    assert len(many) == 5 and not many and many.holds.tolist() == [True, True, False, False, True]
    for row in np.flatnonzero(many.holds):
        one = single(STARTS[row]).evolve()
        assert (many.time[row], many.turns[row], many.message[row]) == (one.time, one.turns, one.message)
        for name in ("power", "separatrix_time", "damping_time", "growth_time"):
            alone = getattr(one, name)
            assert getattr(many, name)[row] == alone or (alone is None and np.isnan(getattr(many, name)[row])), name
    np.testing.assert_array_equal(many.initial, STARTS)
    assert "does not turn" in many.message[2] and "not finite" in many.message[3]
    assert np.isnan(many.time[[2, 3]]).all() and many.status[2] == "error"
    assert "3 of 5 rows hold; DO NOT HOLD" in repr(many) and "does not turn" in repr(many)


def test_rows_are_the_single_histories() -> None:
    many = BOOM.simulate(initial=STARTS, times=[0, 10, 20])
    for row in (0, 1, 4):
        one = single(STARTS[row]).simulate(times=[0, 10, 20])
        np.testing.assert_array_equal(many.angular_velocity[row], one.angular_velocity)
        np.testing.assert_array_equal(many.attitude[row], one.attitude)
        for name in many.columns:
            np.testing.assert_array_equal(many[name][row], one.table[name])
    assert not many.holds[3] and np.isnan(many.energy[3]).all() and "not finite" in many.message[3]
    assert many.t.shape == (5, 3) and many.units == one.table.units
    with pytest.raises(KeyError):
        many["none"]


def test_empty_and_hopeless_ensembles() -> None:
    assert len(BOOM.evolve(initial=np.zeros((0, 3)))) == 0
    none = BOOM.simulate(initial=np.full((2, 3), np.nan), times=[0, 1])
    assert none.energy.shape == (2, 2) and np.isnan(none.angular_velocity).all() and not none
    assert BOOM.simulate(initial=np.zeros((0, 3)), times=[0, 1]).energy.shape == (0, 2)


def times(_: object) -> list[float]:
    return BOOM.evolve(initial=STARTS[:2]).time.tolist()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_a_forked_child_has_threads_of_its_own() -> None:
    here = times(None)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(times, range(4)).get(timeout=120) == [here] * 4


def test_threads_of_python_share_a_model() -> None:
    here = times(None)
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(times, range(5))) == [here] * 5


def test_the_lock_of_the_interpreter_is_released() -> None:
    ticks: list[float] = []
    done = threading.Event()

    def tick() -> None:
        while not done.wait(0.01):
            ticks.append(time.monotonic())

    watching = threading.Thread(target=tick)
    watching.start()
    BOOM.verify(orders=[3], revolutions=5, halvings=5)
    done.set()
    watching.join()
    assert len(ticks) >= 3


def test_the_number_of_threads_changes_no_bit() -> None:
    script = textwrap.dedent(
        """
        import numpy, quasirigid, sys
        starts = numpy.random.default_rng(5).normal(scale=0.1, size=(6, 3)) + [0, 1.2, 0]
        model = quasirigid.Model(quasirigid.EXAMPLE)
        sys.stdout.write(model.evolve(initial=starts).time.tobytes().hex())
        sys.stdout.write(model.simulate(initial=starts, times=[0, 50]).energy.tobytes().hex())
        """
    )

    def bits(threads: str) -> str:
        environment = {**os.environ, "RAYON_NUM_THREADS": threads}
        return subprocess.run(
            [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
        ).stdout

    assert bits("1") == bits("4") != ""


def test_progress_is_told_and_may_end_the_work() -> None:
    told: list[tuple[str, float]] = []
    BOOM.verify(orders=[3], revolutions=5, halvings=5, progress=lambda *stage: told.append(stage))
    assert all(0 <= share <= 1 and stage for stage, share in told)

    def stop(stage: str, share: float) -> bool:
        return False

    with pytest.raises(quasirigid.Interrupted):
        BOOM.simulate("full", duration="10000 h", samples=2, progress=stop)
    with pytest.raises(quasirigid.Interrupted):
        BOOM.simulate("full", initial=STARTS[:2], duration="10000 h", samples=2, progress=stop)
    with pytest.raises(ZeroDivisionError):
        BOOM.simulate("full", duration="10000 h", samples=2, progress=lambda *stage: 1 / 0)


def test_a_bar_is_shown_where_tqdm_is_installed(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    BOOM.simulate(duration=60, samples=3, progress=True)
    BOOM.evolve(initial=STARTS[:2], progress=True)


WORKS = {
    "a history": "model.simulate('full', duration='100000 h', samples=2)",
    "histories": "model.simulate('full', initial=[[0.1, 1.2, 0.0]] * 8, duration='100000 h', samples=2)",
    "a verification": "model.verify(revolutions=1e6)",
}


@pytest.mark.skipif(os.name == "nt", reason="signals of another kind")
@pytest.mark.parametrize("work", WORKS)
def test_ctrl_c_ends_the_work(work: str) -> None:
    script = textwrap.dedent(
        f"""
        import quasirigid, signal, sys
        # a shell without job control starts what runs behind it deaf to SIGINT
        signal.signal(signal.SIGINT, signal.default_int_handler)
        model = quasirigid.Model(quasirigid.EXAMPLE)
        print("ready", flush=True)
        try:
            {WORKS[work]}
        except KeyboardInterrupt:
            print("interrupted", model.check().holds, flush=True)
            sys.exit(7)
        """
    )
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "ready\n"
    time.sleep(0.7)
    child.send_signal(signal.SIGINT)
    try:
        out, err = child.communicate(timeout=30)
    finally:
        child.kill()
    assert (child.returncode, out) == (7, "interrupted True\n"), err


def test_spins_are_those_of_the_histories() -> None:
    times = [0.0, 10.0, 200.0]
    paths, histories = (BOOM.spins(STARTS, times), BOOM.simulate(initial=STARTS, times=times))
    assert paths.angular_velocity.shape == (5, 3, 3) and paths.holds.tolist() == [True, True, False, False, True]
    for row in (0, 1, 4):
        size = np.linalg.norm(STARTS[row])
        np.testing.assert_allclose(paths.angular_velocity[row], histories.angular_velocity[row], rtol=0, atol=1e-9 * size)
        assert paths.notes[row] == histories.notes[row] and paths.message[row] == "the run reached its end"
    assert np.isnan(paths.angular_velocity[[2, 3]]).all() and paths.status[2] == "error"
    assert "3 of 5 rows hold; DO NOT HOLD" in repr(paths)
    with pytest.raises(ValueError):
        paths.angular_velocity[0, 0, 0] = 1.0


def test_spins_do_not_depend_on_their_neighbours_or_the_block() -> None:
    generator = np.random.default_rng(5)
    starts = generator.normal(size=(150, 3)) * 10.0 ** generator.uniform(-2, 0, (150, 1))
    for settings in ({}, {"reproducible": True, "form": "paper"}):
        whole = BOOM.spins(starts, [3.0, 50.0], **settings).angular_velocity
        for rows in (slice(0, 1), slice(60, 70), slice(149, 150), slice(None, None, 7)):
            np.testing.assert_array_equal(BOOM.spins(starts[rows], [3.0, 50.0], **settings).angular_velocity, whole[rows])


def test_spins_whose_reduced_equations_fail_do_not_hold() -> None:
    paths = BOOM.spins([[0.0, 0.0, 1.0], [0.0, 200.0, 1.0]], [1.0], tolerance=1e-6)
    assert paths.holds.tolist() == [True, False] and "the theory does not hold" in paths.message[1]


def test_spins_refuse_forces_events_and_bad_settings() -> None:
    with pytest.raises(quasirigid.UnsupportedError, match="ends its histories at an event"):
        Model(quasirigid.EXAMPLE + 'stop = { nutation = "30 deg" }\n').spins(STARTS, [1.0])
    with pytest.raises(quasirigid.UnsupportedError, match="forces act"):
        Model(f'{quasirigid.EXAMPLE}\n[[force]]\nkind = "drag"\non = "tip 1"\ncoefficient = "0.2 N s/m"\n').spins(STARTS, [1.0])
    with pytest.raises(quasirigid.InputError, match="times"):
        BOOM.spins(STARTS, [])
    with pytest.raises(quasirigid.InputError, match="shape"):
        BOOM.spins([0.1, 0.2, 0.3], [1.0])
    assert "ascend" in BOOM.spins(STARTS[:1], [2.0, 1.0]).message[0]
    assert "out of range" in BOOM.spins(STARTS[:1], [2.0], tolerance=1.0).message[0]
