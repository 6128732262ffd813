"""Reference of large.rs: a planar cantilever with a tip mass on a hub that turns by psi = alpha t^2/2, as a chain of N rigid
links with torsional springs at their starts (the first stands for half a link) and masses at their ends; 16 and 32 links, with
the error taken to fall with the square of their length. numpy and scipy. Prints alpha, then time and displacement of the tip
across the beam."""
import numpy as np
from scipy.integrate import solve_ivp

RADIUS, WALL, YOUNG, DENSITY = 15e-3, 1e-3, 90e9, 1600.0
LENGTH, ROOT, TIP = 6.0, 1.5, 3.0
INNER = RADIUS - WALL
AREA = np.pi * (RADIUS**2 - INNER**2)
SECOND = np.pi / 4 * (RADIUS**4 - INNER**4)


def tip(alpha, times, n):
    link = LENGTH / n
    springs = np.full(n, YOUNG * SECOND / link)
    springs[0] *= 2
    masses = np.full(n, DENSITY * AREA * link)
    masses[-1] = masses[-1] / 2 + TIP
    beyond = np.cumsum(masses[::-1])[::-1]
    shared = link**2 * beyond[np.maximum.outer(np.arange(n), np.arange(n))]

    def rate(t, y):
        angles, rates = y[:n], y[n:]
        psi, omega = 0.5 * alpha * t * t, alpha * t
        turned = psi + angles
        c, s = np.cos(turned), np.sin(turned)
        gap = turned[:, None] - turned[None, :]
        ax = -ROOT * (omega**2 * np.cos(psi) + alpha * np.sin(psi))
        ay = ROOT * (-(omega**2) * np.sin(psi) + alpha * np.cos(psi))
        moments = springs * np.diff(np.concatenate([[0.0], angles]))
        load = -moments
        load[:-1] += moments[1:]
        load -= link * beyond * (-s * ax + c * ay) + shared * np.sin(gap) @ (omega + rates) ** 2
        return np.concatenate([rates, np.linalg.solve(shared * np.cos(gap), load) - alpha])

    found = solve_ivp(rate, [0, times[-1]], np.zeros(2 * n), "LSODA", times, rtol=1e-8, atol=1e-9)
    return link * np.sin(found.y[:n]).sum(axis=0)


for share in (0.03, 0.06, 0.1, 0.15, 0.188):
    alpha = share * 3 * 1.937**2 / 7.3
    times = np.array([0.5, 1.0, 1.5])
    coarse, fine = tip(alpha, times, 16), tip(alpha, times, 32)
    print(alpha, list(zip(times, fine + (fine - coarse) / 3)))
