"""Writes the bodies of this folder with gmsh, and their matrices with CalculiX; see README.md."""

import itertools
import os
import pathlib
import shutil
import subprocess
import tempfile

import gmsh
import numpy as np
import scipy.sparse as sp

HERE = pathlib.Path(__file__).parent

# Places are whole numbers of 10⁻⁶: the 14 digits of gmsh's .inp and the 20 characters that CalculiX reads hold them.
PLACES = 6


def round_places(places):
    for tag in gmsh.model.mesh.getNodes()[0]:
        place, parameters, _, _ = gmsh.model.mesh.getNode(tag)
        gmsh.model.mesh.setNode(tag, np.round(place, places), parameters)


def mesh(name, entities):
    """Cells of second order in files of gmsh and of CalculiX; the names are those of the groups, which make sets."""
    for label, (dimension, entity) in entities.items():
        gmsh.model.addPhysicalGroup(dimension, [entity], name=label)
    round_places(PLACES - 1)
    gmsh.model.mesh.setOrder(2)
    round_places(PLACES)
    gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", 1)
    gmsh.option.setNumber("Mesh.SaveGroupsOfElements", -1000)  # volumes only: CalculiX would make plates of surfaces
    gmsh.write(f"{name}.inp")
    gmsh.write(f"{name}.msh")


def far_surface(volume, point):
    """The surface of a volume whose centre is the farthest from a point."""
    surfaces = [tag for _, tag in gmsh.model.getBoundary([(3, volume)], oriented=False)]
    away = lambda tag: np.linalg.norm(np.array(gmsh.model.occ.getCenterOfMass(2, tag)) - point)
    return max(surfaces, key=away)


def hook():
    """A quarter of a ring with a block at its end (mm); the cells of the ring are curved."""
    gmsh.model.add("hook")
    occ = gmsh.model.occ
    section = occ.addRectangle(20, -5, 0, 12, 10)
    ring = next(e for e in occ.revolve([(2, section)], 0, 0, 0, 0, 1, 0, np.pi / 2) if e[0] == 3)
    block = occ.addBox(-14, -8, -36, 14, 16, 20)
    _, [[(_, ring)], [(_, block)]] = occ.fragment([ring], [(3, block)])
    volumes = occ.getEntities(3)
    occ.rotate(volumes, 0, 0, 0, 0, 0, 1, 0.7)
    occ.rotate(volumes, 0, 0, 0, 1, 0, 0, -0.4)
    occ.translate(volumes, 30, -12, 8)
    occ.synchronize()
    root = far_surface(ring, np.array(occ.getCenterOfMass(3, block)))
    gmsh.option.setNumber("Mesh.MeshSizeMin", 20)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 20)
    gmsh.option.setNumber("Mesh.MinimumCircleNodes", 4)
    gmsh.model.mesh.generate(3)
    mesh("hook", {"RING": (3, ring), "BLOCK": (3, block), "ROOT": (2, root)})


def spur():
    """Two tapered bars on a common face (mm), cut into six tetrahedra each, with straight edges."""
    gmsh.model.add("spur")
    entities = {"STEM": (3, 1), "TIP": (3, 2), "ROOT": (2, 3)}
    for entity in entities.values():
        gmsh.model.addDiscreteEntity(*entity)
    corners = list(itertools.product(range(3), range(2), range(2)))
    label = lambda corner: 1 + corners.index(tuple(corner))
    places = [along_spur(corner) for corner in corners]
    gmsh.model.mesh.addNodes(3, 1, list(range(1, 13)), np.concatenate(places))
    for tag, first in (1, 0), (2, 1):
        cells = []
        for order in itertools.permutations(range(3)):
            steps = np.eye(3, dtype=int)[list(order)]
            path = np.array([first, 0, 0]) + np.vstack([np.zeros(3, int), np.cumsum(steps, 0)])
            odd = np.linalg.det(steps) < 0
            cells += [label(path[i]) for i in ([0, 2, 1, 3] if odd else [0, 1, 2, 3])]
        gmsh.model.mesh.addElementsByType(tag, 4, [], cells)
    root = [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 0, 0), (0, 1, 1), (0, 1, 0)]
    gmsh.model.mesh.addElementsByType(3, 2, [], [label(corner) for corner in root])
    mesh("spur", entities)


def along_spur(corner):
    """A corner of the spur, which becomes narrower along its length and stands askew."""
    length, across, high = np.array([0, 24, 33])[corner[0]], corner[1] - 0.4, corner[2] - 0.6
    narrow = 1 - 0.015 * length
    turn = np.array([[0.74, -0.59, 0.31], [0.62, 0.79, 0.02], [-0.26, 0.18, 0.95]])
    return np.array([30, -12, 8]) + turn @ [length, 10 * narrow * across, 6 * narrow * high]


def brick():
    """Parallelepipeds of three sizes (in), as CalculiX numbers hexahedra, with their set of cells and that of the held
    nodes."""
    steps = [[0, 1, 1.7, 3], [0, 1, 2], [0, 1]]
    edges = np.array([[0.8, 0.1, -0.05], [-0.15, 0.5, 0.1], [0.05, -0.08, 0.4]])
    counts = [len(along) for along in steps]
    label = lambda *at: 11 + 2 * np.ravel_multi_index(at, counts)
    lines = ["*NODE"]
    for at in itertools.product(*map(range, counts)):
        place = np.array([2.0, -3.0, 1.0]) + np.array([along[i] for along, i in zip(steps, at)]) @ edges
        lines.append(f"{label(*at)}, " + ", ".join(f"{x:.{PLACES}f}" for x in place))
    lines.append("*ELEMENT, TYPE=C3D8I, ELSET=BRICK")
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    for number, at in enumerate(itertools.product(*(range(count - 1) for count in counts)), 1):
        nodes = [label(*np.add(at, corner)) for corner in corners]
        lines.append(f"{number}, " + ", ".join(map(str, nodes)))
    root = [label(0, j, k) for j, k in itertools.product(range(counts[1]), range(counts[2]))]
    lines += ["*NSET, NSET=ROOT", ", ".join(map(str, root))]
    pathlib.Path("brick.inp").write_text("\n".join(lines) + "\n")


def matrices(name, regions):
    """Stiffness and mass of a mesh on which nothing is held, by CalculiX; `regions` are sets of cells with Young's
    modulus, Poisson's ratio and density."""
    lines = [f"*INCLUDE, INPUT={name}.inp"]
    for cells, (young, poisson, density) in regions.items():
        lines += [f"*MATERIAL, NAME={cells}", "*ELASTIC", f"{young}, {poisson}", "*DENSITY", f"{density}"]
        lines += [f"*SOLID SECTION, ELSET={cells}, MATERIAL={cells}"]
    lines += ["*STEP", "*FREQUENCY, SOLVER=MATRIXSTORAGE", "1", "*END STEP"]
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(f"{name}.inp", folder)
        pathlib.Path(folder, "job.inp").write_text("\n".join(lines) + "\n")
        subprocess.run(["ccx", "job"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        shutil.copy(f"{folder}/job.sti", f"{name}.sti")
        shutil.copy(f"{folder}/job.dof", f"{name}.dof")
        entries = [line.split() for line in open(f"{folder}/job.mas")]
    filled = [" ".join(words) for words in entries if float(words[2]) != 0]
    pathlib.Path(f"{name}.mas").write_text("\n".join(filled) + "\n")


def without_mass_of_modes():
    """CalculiX gives the cells of the brick three nodes each for their own displacements. Their mass is left out, and
    the table of nodes has them somewhere: without mass it does not matter where."""
    mesh_nodes = [line for line in open("brick.inp") if line[0] in "123456789" and line.count(",") == 3]
    freedoms = open("brick.dof").read().split()
    last = max(int(line.split(",")[0]) for line in mesh_nodes)
    modes = {row for row, freedom in enumerate(freedoms, 1) if int(freedom.split(".")[0]) > last}
    entries = [line.split() for line in open("brick.mas")]
    kept = [" ".join(words) for words in entries if not modes & {int(words[0]), int(words[1])}]
    kept += [f"{row} {row} 0.0" for row in sorted(modes)]
    pathlib.Path("brick.mas").write_text("\n".join(kept) + "\n")
    added = sorted({int(freedoms[row - 1].split(".")[0]) for row in modes})
    table = "".join(mesh_nodes) + "".join(f"{label}, 3, -2.5, 1.2\n" for label in added)
    pathlib.Path("brick-nodes.csv").write_text(table)


def quadratic(L):
    """Shape functions of a tetrahedron of ten nodes, and their derivatives along its barycentric coordinates, in the
    order of CalculiX."""
    edges = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
    values = [l * (2 * l - 1) for l in L] + [4 * L[i] * L[j] for i, j in edges]
    slopes = np.zeros((10, 4))
    slopes[range(4), range(4)] = 4 * L - 1
    for row, (i, j) in enumerate(edges, 4):
        slopes[row, [i, j]] = 4 * L[j], 4 * L[i]
    return np.array(values), slopes


def exact_rule(points):
    """Gauss's rule on a cube with one side shrunk to an edge and the opposite one to a point."""
    x, w = np.polynomial.legendre.leggauss(points)
    x, w = (1 + x) / 2, w / 2
    for (a, u), (b, v), (c, t) in itertools.product(zip(x, w), repeat=3):
        first, second = a * (1 - b) * (1 - c), b * (1 - c)
        yield np.array([1 - first - second - c, first, second, c]), u * v * t * (1 - b) * (1 - c) ** 2


def exact_mass(name, densities):
    """The consistent mass of a gmsh mesh of tetrahedra, integrated to rounding, over the freedoms of `name.dof`."""
    gmsh.open(f"{name}.msh")
    tags, places, _ = gmsh.model.mesh.getNodes()
    place = dict(zip(tags, places.reshape(-1, 3)))
    groups = {gmsh.model.getPhysicalName(3, group): group for _, group in gmsh.model.getPhysicalGroups(3)}
    order = sorted(place)
    M = np.zeros((len(order), len(order)))
    for region, density in densities.items():
        for volume in gmsh.model.getEntitiesForPhysicalGroup(3, groups[region]):
            _, _, [cells] = gmsh.model.mesh.getElements(3, volume)
            for cell in cells.reshape(-1, 10):
                cell = cell[[0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]  # gmsh has the last two the other way round
                nodes = np.array([place[tag] for tag in cell])
                rows = np.searchsorted(order, cell)
                for L, weight in exact_rule(6):
                    values, slopes = quadratic(L)
                    volume_there = np.linalg.det((slopes[:, 1:] - slopes[:, :1]).T @ nodes)
                    assert volume_there > 0
                    M[np.ix_(rows, rows)] += density * weight * volume_there * np.outer(values, values)
    freedoms = [tuple(map(int, line.split("."))) for line in open(f"{name}.dof")]
    row = {tag: number for number, tag in enumerate(order)}
    rows = [3 * row[tag] + axis - 1 for tag, axis in freedoms]
    assert sorted(rows) == list(range(3 * len(order)))
    sp.save_npz(f"{name}-mass.npz", sp.csr_array(np.kron(M, np.eye(3))[np.ix_(rows, rows)]))


# N, mm, s, t: the stiffness is in N/mm, which is t/s², the mass in t.
NYLON, TITANIUM = (2700.0, 0.39, 1.15e-9), (113800.0, 0.342, 4.43e-9)
# lbf, in, s: the mass is in lbf s²/in.
ALUMINIUM = (10.3e6, 0.33, 2.588e-4)

os.chdir(HERE)
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
hook()
spur()
brick()
matrices("spur", {"STEM": NYLON, "TIP": TITANIUM})
matrices("brick", {"BRICK": ALUMINIUM})
without_mass_of_modes()
exact_mass("spur", {"STEM": NYLON[2], "TIP": TITANIUM[2]})
gmsh.finalize()
