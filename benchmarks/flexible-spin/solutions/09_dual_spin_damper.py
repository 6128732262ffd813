"""Lagrange's equations of carrier and guided mass, DOP853, and their derivatives about the steady spin."""

from guided import solve

__all__ = ["solve"]
