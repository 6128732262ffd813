"""Renders the shapes of the tests pixel by pixel, with NumPy alone, and writes shapes.txt and brightness.csv beside it.

Independent of the crate: no facets are added up. Rays go from a square of pixels to the body, and from each place that they meet to
the Sun, against every triangle. The error is that of the pixels at edges, limbs and shadows, below 0.4 %.

    python render.py
"""

import csv
from pathlib import Path

import numpy as np

PIXELS = 420
HERE = Path(__file__).parent


def grid(radius, rows=9, columns=16):
    """Closed surface in latitude and longitude, whose distance from the origin is radius(x, y, z)."""
    vertices = [[0, 0, 1]]
    for row in range(1, rows):
        theta = np.pi * row / rows
        for column in range(columns):
            phi = 2 * np.pi * column / columns
            vertices.append([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
    vertices.append([0, 0, -1])
    at = lambda row, column: 1 + (row - 1) * columns + column % columns
    triangles = []
    for column in range(columns):
        triangles.append([0, at(1, column), at(1, column + 1)])
        triangles.append([len(vertices) - 1, at(rows - 1, column + 1), at(rows - 1, column)])
        for row in range(1, rows - 1):
            a, b, c, d = at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)
            triangles += [[a, b, c], [a, c, d]]
    return np.array([radius(*v) * np.array(v) for v in vertices]), np.array(triangles)


def prism(outline, filling, height):
    count = len(outline)
    vertices = [[x, y, z] for z in (0, height) for x, y in outline]
    triangles = [t for a, b, c in filling for t in ([a, c, b], [a + count, b + count, c + count])]
    for k in range(count):
        n = (k + 1) % count
        triangles += [[k, n, n + count], [k, n + count, k + count]]
    return np.array(vertices, float), np.array(triangles)


def shapes():
    ellipsoid, faces = grid(lambda x, y, z: 1.0)
    corner = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 2.5], [0, 2.5]]
    lobes = lambda x, y, z: 1 + 0.6 * (x * x - 0.5) + 0.25 * y * z
    bite = lambda x, y, z: 1 - 0.55 * np.exp(-4 * ((x - 0.8) ** 2 + y * y + (z - 0.4) ** 2))
    return {
        "tetrahedron": (np.array([[0, 0, 0], [2.0, 0.3, 0], [0.2, 1.5, 0.1], [0.4, 0.3, 1.2]]),
                        np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])),
        "ellipsoid": (ellipsoid * np.array([2.0, 1.1, 0.8]), faces),
        "corner": prism(corner, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], 1.2),
        "lobes": grid(lobes),
        "bite": grid(bite),
    }


def first_hit(origins, direction, corners):
    """Distance to the first triangle that rays of one direction meet, and its number; infinite where there is none."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    slope = normal @ direction
    best, which = np.full(len(origins), np.inf), np.full(len(origins), -1)
    for k in np.nonzero(np.abs(slope) > 1e-14)[0]:
        t = ((a[k] - origins) @ normal[k]) / slope[k]
        p = origins + t[:, None] * direction
        inside = t > 1e-7
        for u, v in ((a[k], b[k]), (b[k], c[k]), (c[k], a[k])):
            inside &= np.cross(v - u, p - u) @ normal[k] >= 0
        nearer = inside & (t < best)
        best[nearer], which[nearer] = t[nearer], k
    return best, which


def render(vertices, triangles, sun, observer):
    """Sums over the pixels of the cosine of incidence over that of emission to the laws, per area of the picture."""
    corners = vertices[triangles]
    middle = vertices.mean(axis=0)
    size = np.linalg.norm(vertices - middle, axis=1).max()
    right = np.cross(observer, [0.3, -0.5, 0.81])
    right /= np.linalg.norm(right)
    up = np.cross(observer, right)
    step = 2 * size / PIXELS
    place = (np.arange(PIXELS) + 0.5) * step - size
    x, y = (side.ravel() for side in np.meshgrid(place, place))
    origins = middle + 3 * size * observer + x[:, None] * right + y[:, None] * up
    distance, which = first_hit(origins, -observer, corners)
    seen = which >= 0
    points, which = origins[seen] - distance[seen, None] * observer, which[seen]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    incidence, emission = normal[which] @ sun, normal[which] @ observer
    shadow, _ = first_hit(points + 1e-6 * size * normal[which], sun, corners)
    lit = (incidence > 0) & ~np.isfinite(shadow)
    i, e = incidence[lit], emission[lit]
    pixel = step * step  # the facet behind it has pixel / e
    return {"lommel-seeliger": (2 * i / (i + e)).sum() * pixel, "lambert": (1.5 * i).sum() * pixel}


def main():
    rows = []
    with open(HERE / "shapes.txt", "w") as out:
        for name, (vertices, triangles) in shapes().items():
            out.write(f"shape {name}\n")
            out.writelines("v %r %r %r\n" % tuple(map(float, v)) for v in vertices)
            out.writelines("f %d %d %d\n" % tuple(t) for t in triangles)
            for k, degrees in enumerate((8, 55, 100)):
                sun = np.array([np.sin(1.3 * k + 0.4), np.cos(1.3 * k + 0.4), 0.35 - 0.4 * k])
                sun /= np.linalg.norm(sun)
                across = np.cross(sun, [0.2, 0.4, 0.9 - k])
                across /= np.linalg.norm(across)
                observer = np.cos(np.radians(degrees)) * sun + np.sin(np.radians(degrees)) * across
                for law, value in render(vertices, triangles, sun, observer).items():
                    rows.append([name, law, *map(float, sun), *map(float, observer), float(value)])
    with open(HERE / "brightness.csv", "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow("shape law sun_x sun_y sun_z observer_x observer_y observer_z brightness".split())
        writer.writerows(rows)


if __name__ == "__main__":
    main()
