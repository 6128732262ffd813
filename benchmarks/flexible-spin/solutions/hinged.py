"""Mass matrix of a carrier with rigid appendages on hinges of two axes, at any angle."""

from __future__ import annotations

from typing import Any

import numpy as np
from lagrange import Array, Body, about_center, cross


def turn(axis: Array, angle: Array) -> Array:
    """Rotations (b, k, 3, 3) about unit axes (k, 3) by angles (b, k), after Rodrigues."""
    K = cross(axis)
    return np.array(np.eye(3) + np.sin(angle)[..., None, None] * K + (1 - np.cos(angle))[..., None, None] * (K @ K))


def body(data: dict[str, Any]) -> Body:
    """A carrier and its `hinged` appendages: the first axis is fixed in the carrier and carries the second."""
    parts = data["hinged"]
    n = 2 * len(parts)
    hinge, center = (np.array([part[key] for part in parts]) for key in ("hinge", "center_of_mass"))
    tensor = np.array([part["inertia"] for part in parts])
    axes = np.array([part["axes"] for part in parts], float)
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    masses = np.array([data["carrier"]["mass"]] + [part["mass"] for part in parts])
    middle, own = np.array(data["carrier"]["center_of_mass"]), np.array(data["carrier"]["inertia"])

    def mass(q: Array) -> Array:
        angles = q.reshape(len(q), len(parts), 2)
        first = turn(axes[:, 0], angles[..., 0])
        R = first @ turn(axes[:, 1], angles[..., 1])
        arm = np.einsum("bkij,kj->bki", R, center - hinge)
        second = np.einsum("bkij,kj->bki", first, axes[:, 1])
        A = np.zeros((len(q), len(parts) + 1, 3, 3 + n), complex)
        B, J = np.zeros_like(A), np.zeros((len(q), len(parts) + 1, 3, 3), complex)
        A[:, 0, :, :3], B[:, 0, :, :3], J[:, 0] = -cross(middle), np.eye(3), own
        A[:, 1:, :, :3], B[:, 1:, :, :3] = -cross(hinge + arm), np.eye(3)
        J[:, 1:] = R @ tensor @ np.swapaxes(R, -1, -2)
        for k in range(len(parts)):
            for j, axis in enumerate((np.broadcast_to(axes[k, 0], arm[:, k].shape), second[:, k])):
                A[:, 1 + k, :, 3 + 2 * k + j] = np.cross(axis, arm[:, k])
                B[:, 1 + k, :, 3 + 2 * k + j] = axis
        return about_center(masses, A, B, J)

    return Body(
        mass,
        np.concatenate([part["stiffness"] for part in parts]),
        np.concatenate([part["damping"] for part in parts]),
    )
