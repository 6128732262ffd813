"""Euler's closed form in Jacobi's functions, in 30 digits, of a wobble about the axis of least inertia.

With `2E = sum J w^2`, `G^2 = sum (J w)^2 < 2E J2`:

    w1 = a1 dn(u|m),   w2 = a2 sn(u|m),   w3 = a3 cn(u|m),   u = u0 + n t,
    n = a1 sqrt((J2 - J1)(J3 - J1) / (J2 J3)),   m = (J3 - J2)(G^2 - 2E J1) / ((J2 - J1)(2E J3 - G^2)).
"""

from __future__ import annotations

from typing import Any

import mpmath as mp


def solve(data: dict[str, Any], times: list[float]) -> dict[str, Any]:
    with mp.workdps(30):
        J1, J2, J3 = (mp.mpf(moment) for moment in data["carrier"]["moments"])
        w1, w2, w3 = (mp.mpf(str(rate)) for rate in data["start"]["angular_velocity"])
        twice = J1 * w1**2 + J2 * w2**2 + J3 * w3**2
        square = (J1 * w1) ** 2 + (J2 * w2) ** 2 + (J3 * w3) ** 2
        assert J1 < J2 < J3 and square < twice * J2 and w1 > 0
        a1 = mp.sqrt((twice * J3 - square) / (J1 * (J3 - J1)))
        a2 = mp.sqrt((square - twice * J1) / (J2 * (J2 - J1)))
        a3 = mp.sqrt((square - twice * J1) / (J3 * (J3 - J1)))
        n = a1 * mp.sqrt((J2 - J1) * (J3 - J1) / (J2 * J3))
        m = (J3 - J2) * (square - twice * J1) / ((J2 - J1) * (twice * J3 - square))
        u0 = mp.ellipf(mp.atan2(w2 / a2, w3 / a3), m)
        rows = []
        for t in times:
            u = u0 + n * mp.mpf(str(t))
            rows.append([a1 * mp.ellipfun("dn", u, m), a2 * mp.ellipfun("sn", u, m), a3 * mp.ellipfun("cn", u, m)])
        return {
            "omega": [[float(x) for x in row] for row in rows],
            "energy": [float(twice / 2)] * len(times),
        }
