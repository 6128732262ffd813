"""Which settings of each program are run on each case.

They were chosen so that, where a program can, one setting ends with an error in the spin
just below 1e-6 rad/s and one just below 1e-9. A stiff spring bounds the step of an
explicit method, so there the cheapest setting that is stable can be better than asked.
"""

from measure import Setting
from problem import CASES

Settings = list[Setting]


def steps(method: str, *values: float) -> Settings:
    """One setting for each step."""
    return [Setting(method, value, fixed=True) for value in values]


def tolerances(method: str, *values: float) -> Settings:
    """One setting for each tolerance."""
    return [Setting(method, value, fixed=False) for value in values]


def everywhere(settings: Settings) -> dict[str, Settings]:
    """The same settings for every case."""
    return {case: settings for case in CASES}


SETTINGS: dict[str, dict[str, Settings]] = {
    "heyoka": everywhere(tolerances("Taylor", 1e-4, 1e-6, 1e-7, 1e-9)),
    "scipy": {
        "A": tolerances("LSODA", 1e-11, 4e-14) + tolerances("DOPRI5", 1e-3, 1e-5),
        "B": tolerances("LSODA", 1e-12, 4e-14) + tolerances("DOPRI5", 1e-4, 1e-6),
        "C": tolerances("LSODA", 1e-11, 4e-14) + tolerances("DOPRI5", 1e-4),
        "over": tolerances("LSODA", 1e-10, 1e-11, 4e-14) + tolerances("Radau", 1e-9),
        "soft": tolerances("LSODA", 4e-14) + tolerances("DOP853", 1e-4, 1e-6, 3e-7),
        "long": tolerances("LSODA", 4e-14) + tolerances("DOP853", 1e-4, 1e-6),
    },
    "rebound": {
        "A": tolerances("Bulirsch–Stoer", 1e-4, 1e-5, 1e-7),
        "B": tolerances("Bulirsch–Stoer", 1e-5, 1e-7),
        "C": tolerances("Bulirsch–Stoer", 1e-5, 1e-7),
        "over": tolerances("Bulirsch–Stoer", 1e-4, 1e-6),
        "soft": tolerances("Bulirsch–Stoer", 1e-6, 1e-8),
        "long": tolerances("Bulirsch–Stoer", 1e-5, 1e-7),
    },
    "mujoco": {
        "A": steps("RK4", 20e-3, 3.2e-3),
        "B": steps("RK4", 2.5e-3, 2e-3),
        "C": steps("RK4", 0.25e-3),
        "over": steps("RK4", 0.125e-3),
        "soft": steps("RK4", 16e-3, 4e-3),
        "long": steps("RK4", 5e-3, 2e-3),
    },
    "exudyn": {
        "A": steps("RK44", 20e-3, 5e-3),
        "B": steps("RK44", 2.5e-3, 2e-3),
        "C": steps("RK44", 0.25e-3),
        "over": steps("RK44", 0.125e-3),
        "soft": steps("RK67", 25e-3, 8e-3),
        "long": steps("RK44", 5e-3) + steps("RK67", 10e-3),
    },
    "basilisk": {
        "A": steps("RK4", 20e-3) + steps("RKF45", 25e-3),
        "B": steps("RK4", 2.5e-3, 2e-3),
        "C": steps("RK4", 0.25e-3),
        "over": steps("RK4", 0.125e-3),
        "soft": steps("RK4", 16e-3, 4e-3),
        "long": steps("RK4", 8e-3),
    },
    "drake": {
        "A": steps("runge_kutta5", 20e-3, 10e-3),
        "B": steps("runge_kutta5", 2.5e-3, 2e-3),
        "C": steps("runge_kutta3", 0.16e-3) + steps("runge_kutta5", 0.2e-3),
        "over": steps("runge_kutta3", 0.11e-3),
        "soft": steps("runge_kutta5", 12.5e-3, 4e-3),
        "long": steps("runge_kutta5", 10e-3),
    },
}
