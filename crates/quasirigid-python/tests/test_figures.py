"""Figures are drawn without a screen, and say where an answer does not hold."""

from __future__ import annotations

import subprocess
import sys

import pytest

import quasirigid
from quasirigid import Model


def test_every_answer_with_a_figure_draws_it() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    boom = Model(quasirigid.EXAMPLE)
    starts = [[-0.17, 1.24, -0.05], [0.1, 1.2, 0.0]]
    for answer in (
        boom.simulate(duration=60, samples=7),
        boom.evolve(),
        boom.modes(),
        boom.verify(orders=[3], revolutions=1, halvings=2),
        boom.run(duration=60, samples=7),
        boom.simulate(initial=starts, duration=60, samples=7),
        boom.evolve(initial=starts),
    ):
        figure = answer.plot()
        figure.canvas.draw()
        assert all(axes.get_ylabel() for axes in figure.axes)
        plt.close(figure)


def test_without_matplotlib_the_message_says_how_to_get_it() -> None:
    script = (
        "import sys; sys.modules['matplotlib'] = None; sys.modules['sympy'] = None\n"
        "import quasirigid\n"
        "model = quasirigid.Model(quasirigid.EXAMPLE)\n"
        "for ask in (lambda: model.modes().plot(), lambda: model.reduce().to_sympy()):\n"
        "    try: ask()\n"
        "    except ImportError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert "pip install matplotlib" in done.stdout and "pip install sympy" in done.stdout


def test_importing_loads_nothing_that_is_not_needed() -> None:
    script = "import sys, quasirigid; print([m for m in ('matplotlib', 'sympy', 'tqdm', 'pandas') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
