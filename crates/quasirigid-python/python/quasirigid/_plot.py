"""Figures of answers; matplotlib is imported here alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from quasirigid._errors import Refused

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from quasirigid import _answers, _ensemble

# Largest number of lines that a figure of an ensemble draws.
_LINES = 200


def _figure(rows: int, height: float = 2.4) -> tuple[Figure, Any]:
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        message = "a figure needs matplotlib; install it with: pip install matplotlib"
        raise ImportError(message) from error
    figure, axes = plt.subplots(
        rows, 1, sharex=True, figsize=(7, 1 + height * rows), layout="constrained", squeeze=False
    )
    return figure, axes[:, 0]


def _titled(figure: Figure, answer: _answers.Answer) -> None:
    """An answer that does not hold says so on its figure."""
    if not answer.holds:
        figure.suptitle(f"DOES NOT HOLD: {answer.sentence}", color="tab:red", fontsize="small", wrap=True)


def _motion(axes: Any, table: Mapping[str, Any], style: str, label: str) -> None:
    for name, color in zip(("wx", "wy", "wz"), ("tab:blue", "tab:orange", "tab:green"), strict=True):
        axes[0].plot(table["t"], table[name], style, color=color, linewidth=1, label=f"{name}{label}")
    axes[1].plot(table["t"], table["energy"], style, color="k", linewidth=1, label=f"energy{label}")
    axes[0].set_ylabel("angular velocity (rad/s)")
    axes[1].set_ylabel("energy (J)")
    axes[1].set_xlabel("t (s)")


def history(answer: _answers.History) -> Figure:
    figure, axes = _figure(2)
    _motion(axes, answer.table, "-", "")
    axes[0].legend(loc="upper right")
    _titled(figure, answer)
    return figure


def run(answer: _answers.Run) -> Figure:
    figure, axes = _figure(2)
    for style, (system, table) in zip(("-", "--", ":"), answer.histories.items(), strict=False):
        _motion(axes, table, style, f" ({system})")
    axes[0].legend(loc="upper right", fontsize="small")
    axes[1].legend(loc="upper right", fontsize="small")
    _titled(figure, answer)
    return figure


def evolution(answer: _answers.Evolution) -> Figure:
    if answer.time is None or answer.table.rows == 0:
        raise Refused(answer.sentence)
    figure, axes = _figure(2)
    t, table = answer.t, answer.table
    least, greatest = np.degrees(table["nutation_min"]), np.degrees(table["nutation_max"])
    axes[0].fill_between(t, least, greatest, alpha=0.3)
    axes[0].plot(t, greatest, linewidth=1)
    axes[0].set_ylabel("angle of |K| to the axis\nthat it circles (degrees)")
    axes[1].plot(t, table["energy"], "k", linewidth=1)
    axes[1].set_ylabel("energy (J)")
    axes[1].set_xlabel("t (s)")
    if answer.separatrix_time is not None:
        for axis in axes:
            axis.axvline(answer.separatrix_time, color="tab:red", linestyle="--", linewidth=1)
    _titled(figure, answer)
    return figure


def modes(answer: _answers.Modes) -> Figure:
    figure, axes = _figure(1, 3)
    for spin in answer.steady_spins:
        points = [(mode["frequency"], mode["decay_rate"]) for mode in spin["modes"]]
        if points:
            frequency, decay = np.transpose(points)
            axes[0].plot(frequency, decay, "o", markersize=4, label=f"about the axis: {spin['axis']}")
    axes[0].axhline(0, color="k", linewidth=0.5)
    axes[0].set_xlabel("frequency in body axes (rad/s)")
    axes[0].set_ylabel("decay rate (1/s)")
    axes[0].legend()
    _titled(figure, answer)
    return figure


def verification(answer: _answers.Verification) -> Figure:
    figure, axes = _figure(1, 3)
    for row in answer.orders:
        label = f"p = {row['p']} ({row['form']})"
        axes[0].loglog(row["epsilons"], row["errors"], "o-", linewidth=1, markersize=3, label=label)
    axes[0].set_xlabel("ε: stiffness C/ε², damping B/ε")
    axes[0].set_ylabel("largest relative difference in spin")
    axes[0].legend()
    _titled(figure, answer)
    return figure


def histories(answer: _ensemble.Histories) -> Figure:
    figure, axes = _figure(2)
    for row in range(min(len(answer), _LINES)):
        axes[0].plot(answer.t[row], np.linalg.norm(answer.angular_velocity[row], axis=-1), linewidth=0.5)
        axes[1].plot(answer.t[row], answer.energy[row], linewidth=0.5)
    axes[0].set_ylabel("|angular velocity| (rad/s)")
    axes[1].set_ylabel("energy (J)")
    axes[1].set_xlabel("t (s)")
    if len(answer) > _LINES:
        axes[0].set_title(f"the first {_LINES} of {len(answer)} rows", fontsize="small")
    return figure


def evolutions(answer: _ensemble.Evolutions) -> Figure:
    figure, axes = _figure(1, 3)
    known = answer.time[np.isfinite(answer.time) & (answer.time > 0)]
    if known.size == 0:
        raise Refused("no row has a finite time: " + answer.sentence)
    axes[0].hist(np.log10(known), bins="auto")
    axes[0].set_xlabel("log₁₀ of the time (s)")
    axes[0].set_ylabel("rows")
    axes[0].set_title(answer.sentence, fontsize="small")
    return figure
