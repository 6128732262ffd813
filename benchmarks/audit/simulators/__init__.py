"""One module a simulator. Each has `TITLE`, `version()`, `METHODS` and `history(method, body, step)`.

`history` gives rows t (s), angular velocity in body axes (rad/s), and the unit quaternion from body to inertial axes, scalar first. A step is in
seconds, or a tolerance or accuracy where the program takes one.
"""

from __future__ import annotations

from dataclasses import dataclass

NAMES = (
    "plain",
    "mujoco_",
    "mjx_",
    "drake_",
    "exudyn_",
    "basilisk_",
    "bullet_",
    "dart_",
    "newton_",
    "physx_",
    "scipy_",
    "heyoka_",
)


@dataclass(frozen=True)
class Method:
    """An integrator of a program.

    `steps` begins with that of its users: the program's default, or that of its tutorials, as `of` says; then its half, or a smaller tolerance. `scan`
    adds steps that show the order. `damping` is what the program damps by default, in words; empty for none.
    """

    name: str
    steps: tuple[float, ...]
    scan: tuple[float, ...]
    of: str
    why: str
    default: bool = False
    tolerance: bool = False
    damping: str = ""
