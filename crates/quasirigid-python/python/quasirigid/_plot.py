"""Figures of answers; matplotlib is imported here alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from quasirigid._errors import InputError, Refused

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from quasirigid import _answers, _ensemble, _sweep

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


# Units of time (s), the largest first; a year is Julian.
_YEAR = 365.25 * 86400
_TIMES = [("Gyr", 1e9 * _YEAR), ("Myr", 1e6 * _YEAR), ("kyr", 1e3 * _YEAR), ("yr", _YEAR), ("d", 86400.0), ("h", 3600.0)]


def _time_unit(times: Any) -> tuple[str, float]:
    """The unit of time in which the largest of some times is at least two; seconds for short ones."""
    known = np.asarray(times)[np.isfinite(times)]
    longest = float(known.max()) if known.size else 0.0
    return next(((name, unit) for name, unit in _TIMES if longest >= 2 * unit), ("s", 1.0))


def _plain(figure: Figure) -> Figure:
    """The figure, with numbers on its axes that are read without adding an offset."""
    for axis in figure.axes:
        if axis.get_xscale() == "linear":
            axis.ticklabel_format(axis="x", useOffset=False)
        if axis.get_yscale() == "linear":
            axis.ticklabel_format(axis="y", useOffset=False)
    return figure


def _motion(axes: Any, table: Mapping[str, Any], style: str, label: str, unit: tuple[str, float]) -> None:
    t = table["t"] / unit[1]
    for name, color in zip(("wx", "wy", "wz"), ("tab:blue", "tab:orange", "tab:green"), strict=True):
        axes[0].plot(t, table[name], style, color=color, linewidth=1, label=f"{name}{label}")
    axes[1].plot(t, table["energy"], style, color="k", linewidth=1, label=f"energy{label}")
    axes[0].set_ylabel("angular velocity (rad/s)")
    axes[1].set_ylabel("energy (J)")
    axes[1].set_xlabel(f"t ({unit[0]})")


def history(answer: _answers.History) -> Figure:
    figure, axes = _figure(2)
    _motion(axes, answer.table, "-", "", _time_unit(answer.t))
    axes[0].legend(loc="upper right")
    _titled(figure, answer)
    return _plain(figure)


def run(answer: _answers.Run) -> Figure:
    figure, axes = _figure(2)
    longest = [table["t"].max() for table in answer.histories.values()]
    for style, (system, table) in zip(("-", "--", ":"), answer.histories.items(), strict=False):
        _motion(axes, table, style, f" ({system})", _time_unit(longest))
    axes[0].legend(loc="upper right", fontsize="small")
    axes[1].legend(loc="upper right", fontsize="small")
    _titled(figure, answer)
    return _plain(figure)


def evolution(answer: _answers.Evolution) -> Figure:
    if answer.time is None or answer.table.rows == 0:
        raise Refused(answer.sentence)
    figure, axes = _figure(2)
    (name, unit), table = _time_unit(answer.t), answer.table
    t = answer.t / unit
    least, greatest = np.degrees(table["nutation_min"]), np.degrees(table["nutation_max"])
    axes[0].fill_between(t, least, greatest, alpha=0.3)
    axes[0].plot(t, greatest, linewidth=1)
    axes[0].set_ylabel("angle of |K| to the axis\nthat it circles (degrees)")
    axes[1].plot(t, table["energy"], "k", linewidth=1)
    axes[1].set_ylabel("energy (J)")
    axes[1].set_xlabel(f"t ({name})")
    if answer.separatrix_time is not None:
        for axis in axes:
            axis.axvline(answer.separatrix_time / unit, color="tab:red", linestyle="--", linewidth=1)
    _titled(figure, answer)
    return _plain(figure)


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
    return _plain(figure)


def verification(answer: _answers.Verification) -> Figure:
    figure, axes = _figure(1, 3)
    for row in answer.orders:
        label = f"p = {row['p']} ({row['form']})"
        axes[0].loglog(row["epsilons"], row["errors"], "o-", linewidth=1, markersize=3, label=label)
    axes[0].set_xlabel("ε: stiffness C/ε², damping B/ε")
    axes[0].set_ylabel("largest relative difference in spin")
    axes[0].legend()
    _titled(figure, answer)
    return _plain(figure)


def fills(answer: _answers.FillMap) -> Figure:
    figure, axes = _figure(1, 3)
    times = np.abs(answer.time_constants)
    if not np.isfinite(times).any():
        raise Refused(answer.sentence)
    name, unit = _time_unit(np.nanmax(times))
    decays = np.log10(np.where(np.isfinite(times), times / unit, np.nan))
    rpm = answer.spins * 30 / np.pi
    if rpm.size > 1:
        drawn = axes[0].pcolormesh(answer.fills, rpm, decays, shading="nearest", cmap="viridis_r")
        figure.colorbar(drawn, label=f"log10 of the e-folding time of the nutation ({name})")
        axes[0].contour(answer.fills, rpm, answer.time_constants < 0, levels=[0.5], colors="tab:red")
        axes[0].set_ylabel("spin (rpm)")
        for point in answer.worst:
            axes[0].plot(point["fill"], point["spin"] * 30 / np.pi, "kx")
    else:
        axes[0].semilogy(answer.fills, times[0] / unit, "o-", linewidth=1, markersize=3)
        axes[0].set_ylabel(f"e-folding time of the nutation ({name})")
    axes[0].set_xlabel("fill")
    _titled(figure, answer)
    return _plain(figure)


def light_curve(answer: _answers.LightCurve) -> Figure:
    figure, axes = _figure(1)
    name, unit = _time_unit(answer.t)
    axes[0].plot(answer.t / unit, answer.magnitude, linewidth=1)
    axes[0].invert_yaxis()
    axes[0].set_xlabel(f"time ({name})")
    axes[0].set_ylabel("magnitude")
    _titled(figure, answer)
    return _plain(figure)


def histories(answer: _ensemble.Histories) -> Figure:
    figure, axes = _figure(2)
    name, unit = _time_unit(answer.t)
    for row in range(min(len(answer), _LINES)):
        t = answer.t[row] / unit
        axes[0].plot(t, np.linalg.norm(answer.angular_velocity[row], axis=-1), linewidth=0.5)
        axes[1].plot(t, answer.energy[row], linewidth=0.5)
    axes[0].set_ylabel("|angular velocity| (rad/s)")
    axes[1].set_ylabel("energy (J)")
    axes[1].set_xlabel(f"t ({name})")
    if len(answer) > _LINES:
        axes[0].set_title(f"the first {_LINES} of {len(answer)} rows", fontsize="small")
    return _plain(figure)


def evolutions(answer: _ensemble.Evolutions) -> Figure:
    figure, axes = _figure(1, 3)
    known = answer.time[np.isfinite(answer.time) & (answer.time > 0)]
    name, unit = _time_unit(np.median(known)) if known.size else ("s", 1.0)
    if known.size == 0:
        raise Refused("no row has a finite time: " + answer.sentence)
    edges: Any = "auto"
    times = known / unit
    if times.max() > 10 * times.min():
        edges = np.geomspace(times.min(), times.max(), 2 + int(np.sqrt(times.size)))
        edges[[0, -1]] = times.min(), times.max()  # the ends, whatever the rounding
        axes[0].set_xscale("log")
    axes[0].hist(times, bins=edges)
    axes[0].set_xlabel(f"time ({name})")
    axes[0].set_ylabel("rows")
    axes[0].set_title(answer.sentence, fontsize="small")
    return _plain(figure)


def sweep(study: _sweep.Sweep, x: str | None, y: str | None) -> Figure:
    quantities = [row["name"] for row in study.summary["quantities"] if row["kind"] == "number"]
    if y is None:
        if not quantities:
            raise Refused("the study asks for no number; name a column with y")
        y = quantities[0]
    for name in (x, y):
        if name is not None and not (isinstance(study[name], np.ndarray) and study[name].dtype.kind in "fi"):
            raise InputError(f"the column {name!r} holds no numbers")
    named = {name: f"{name} ({unit})" if unit else name for name, unit in study.units.items()}
    figure, axes = _figure(1, 3)
    values = study[y]
    known = np.isfinite(values) if x is None else np.isfinite(values) & np.isfinite(study[x])
    if not known.any():
        raise Refused(f"no row has a finite {y}")
    if x is None:
        axes[0].hist(values[known], bins="auto")
        axes[0].set_xlabel(named[y])
        axes[0].set_ylabel("rows")
    else:
        axes[0].plot(study[x][known], values[known], ".", markersize=3)
        axes[0].set_xlabel(named[x])
        axes[0].set_ylabel(named[y])
    missing = study.rows - int(known.sum())
    if missing:
        axes[0].set_title(f"{missing} of {study.rows} rows have no finite value", fontsize="small")
    return _plain(figure)


def bode(omega: NDArray[np.float64], response: NDArray[np.complex128], label: str, ax: Any) -> Figure:
    """Gain and phase of a response."""
    axes = ax if ax is not None else _figure(2)[1]
    axes[0].semilogx(omega, 20 * np.log10(np.abs(response)), linewidth=1, label=label)
    axes[1].semilogx(omega, np.degrees(np.unwrap(np.angle(response))), linewidth=1)
    axes[0].set_ylabel("gain (dB)")
    axes[1].set_ylabel("phase (°)")
    axes[1].set_xlabel("frequency (rad/s)")
    axes[0].legend(frameon=False)
    figure: Figure = axes[0].figure
    return figure


def nichols(response: NDArray[np.complex128], label: str, ax: Any) -> Figure:
    """Gain over phase of a response."""
    axis = ax if ax is not None else _figure(1)[1][0]
    axis.plot(np.degrees(np.unwrap(np.angle(response))), 20 * np.log10(np.abs(response)), linewidth=1, label=label)
    axis.set_xlabel("phase (°)")
    axis.set_ylabel("gain (dB)")
    axis.legend(frameon=False)
    figure: Figure = axis.figure
    return figure
