"""Writes the meshes of this folder with gmsh, VTK and meshio; see README.md."""

import os
import pathlib

import gmsh
import meshio
import numpy as np
import vtk

os.chdir(pathlib.Path(__file__).parent)  # gmsh writes the name of the file into .inp
# Every cell is the reference cell of its program, mapped by this, and moved by its number.
MAP = np.array([[0.9, -0.2, 0.1], [0.3, 0.8, -0.15], [-0.05, 0.25, 1.1]])
ORIGIN = np.array([-3.0, 0.7, 11.0])
STEP = np.array([2.5, 0.5, -0.25])


def place(number, xi):
    return ORIGIN + number * STEP + MAP @ np.asarray(xi)


# In the order of their numbers: type of gmsh, type of VTK, group.
ZOO = [
    (1, 3, "edge"), (8, 21, "edge"),
    (2, 5, "face"), (9, 22, "face"), (3, 9, "face"), (16, 23, "face"), (10, 28, "face"),
    (4, 10, "left"), (6, 13, "left"), (5, 12, "left"),
    (11, 24, "right"), (18, 26, "right"), (17, 25, "right"), (12, 29, "right"),
]
GROUPS = {"edge": (1, 40), "face": (2, 7), "left": (3, 1), "right": (3, 2)}  # dimension, number of the group


def gmsh_zoo():
    """Cells from the reference cells of gmsh, whose lines, quadrilaterals and hexahedra go from -1 to 1, and wedges
    from -1 to 1 along their third axis; in the space of this folder all go from 0 to 1."""
    gmsh.model.add("zoo")
    gmsh.model.addDiscreteEntity(0, 1)
    entities = {group: [] for group in GROUPS}
    node = 100  # a gap in the numbers
    element = 30
    for number, (kind, _, group) in enumerate(ZOO):
        _, dim, _, count, local, _ = gmsh.model.mesh.getElementProperties(kind)
        local = np.array(local).reshape(count, dim)
        halves = {1: [1, 0, 0], 8: [1, 0, 0], 6: [0, 0, 1], 18: [0, 0, 1]}
        halves.update({k: [1, 1, 0] for k in (3, 16, 10)} | {k: [1, 1, 1] for k in (5, 17, 12)})
        half = np.array(halves.get(kind, [0, 0, 0]))
        xi = np.zeros((count, 3))
        xi[:, :dim] = local
        xi = np.where(half == 1, (xi + 1) / 2, xi)
        tags = [node + 3 * i for i in range(count)]
        node += 3 * count
        d, entity = GROUPS[group][0], 10 + number
        gmsh.model.addDiscreteEntity(d, entity)  # one for each kind, since gmsh names only one type for each in .inp
        entities[group].append(entity)
        gmsh.model.mesh.addNodes(d, entity, tags, np.concatenate([place(number, x) for x in xi]))
        gmsh.model.mesh.addElementsByType(entity, kind, [element], tags)
        element += 2
    gmsh.model.mesh.addElementsByType(1, 15, [element], [100])
    for name, (d, group) in GROUPS.items():
        gmsh.model.addPhysicalGroup(d, entities[name], group, "" if name == "edge" else name)
    gmsh.model.addPhysicalGroup(3, entities["left"] + entities["right"], 9, "all of it")
    gmsh.model.addPhysicalGroup(0, [1], 3, "tip")


def write_gmsh(name):
    for version in ("2.2", "4.0", "4.1"):
        for binary in (0, 1) if version != "4.0" else (0,):  # gmsh writes 4.0 as text only
            gmsh.option.setNumber("Mesh.MshFileVersion", float(version))
            gmsh.option.setNumber("Mesh.Binary", binary)
            gmsh.write(f"{name}-{version}-{'binary' if binary else 'text'}.msh")


def vtk_zoo():
    """Cells from the parametric coordinates of VTK, which go from 0 to 1."""
    points, grid = vtk.vtkPoints(), vtk.vtkUnstructuredGrid()
    points.SetDataType(vtk.VTK_DOUBLE)
    region, density, mixed = vtk.vtkIntArray(), vtk.vtkDoubleArray(), vtk.vtkShortArray()
    region.SetName("region"), density.SetName("density"), mixed.SetName("pair")
    mixed.SetNumberOfComponents(2)
    warm = vtk.vtkLongLongArray()
    warm.SetName("warm")
    grid.SetPoints(points)
    groups = list(GROUPS)
    for number, (_, kind, group) in enumerate(ZOO):
        cell = vtk.vtkGenericCell()
        cell.SetCellType(kind)
        count, local = cell.GetNumberOfPoints(), cell.GetParametricCoords()
        ids = [points.InsertNextPoint(place(number, local[3 * i:3 * i + 3])) for i in range(count)]
        grid.InsertNextCell(kind, count, ids)
        region.InsertNextValue(groups.index(group) - 1)
        density.InsertNextValue(2.5 * number)
        mixed.InsertNextTuple2(number, -number)
    grid.InsertNextCell(1, 1, [0])
    region.InsertNextValue(77), density.InsertNextValue(0), mixed.InsertNextTuple2(0, 0)
    for i in range(points.GetNumberOfPoints()):
        warm.InsertNextValue(i)
    for array in (region, density, mixed):
        grid.GetCellData().AddArray(array)
    grid.GetPointData().AddArray(warm)
    return grid


def write_vtk(name, grid):
    for version, number in (("4.2", vtk.vtkDataWriter.VTK_LEGACY_READER_VERSION_4_2), ("5.1", vtk.vtkDataWriter.VTK_LEGACY_READER_VERSION_5_1)):
        for binary in (False, True):
            writer = vtk.vtkUnstructuredGridWriter()
            writer.SetInputData(grid)
            writer.SetFileVersion(number)
            writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
            writer.SetFileName(f"{name}-{version}-{'binary' if binary else 'text'}.vtk")
            writer.Write()
    for label, mode, base64, compressed, wide, big in [
        ("text", vtk.vtkXMLWriter.Ascii, 0, False, False, False),
        ("inline", vtk.vtkXMLWriter.Binary, 1, False, False, False),
        ("inline-zlib", vtk.vtkXMLWriter.Binary, 1, True, True, True),
        ("raw", vtk.vtkXMLWriter.Appended, 0, False, True, True),
        ("raw-zlib", vtk.vtkXMLWriter.Appended, 0, True, False, False),
        ("base64", vtk.vtkXMLWriter.Appended, 1, False, True, False),
        ("base64-zlib", vtk.vtkXMLWriter.Appended, 1, True, False, True),
    ]:
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetInputData(grid)
        writer.SetDataMode(mode)
        writer.SetEncodeAppendedData(base64)
        writer.SetCompressorTypeToZLib() if compressed else writer.SetCompressorTypeToNone()
        writer.SetBlockSize(256)
        writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
        writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
        writer.SetFileName(f"{name}-{label}.vtu")
        writer.Write()


def gmsh_block():
    """Two boxes of 1 x 1 x 1 with a common face, in tetrahedra of second order."""
    gmsh.model.add("block")
    boxes = [gmsh.model.occ.addBox(x, -0.5, 3, 1, 1, 1) for x in (4, 5)]
    gmsh.model.occ.fragment([(3, boxes[0])], [(3, boxes[1])])
    gmsh.model.occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [boxes[0]], 1, "left")
    gmsh.model.addPhysicalGroup(3, [boxes[1]], 2, "right")
    faces = [tag for _, tag in gmsh.model.getEntitiesInBoundingBox(5.9, -1, 2, 6.1, 1, 5, 2)]
    gmsh.model.addPhysicalGroup(2, faces, 3, "tip face")
    gmsh.option.setNumber("Mesh.MeshSizeMin", 2)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh_zoo()
write_gmsh("zoo")
gmsh.write("zoo.inp")
write_vtk("zoo", vtk_zoo())

gmsh_block()
gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
gmsh.option.setNumber("Mesh.Binary", 1)
gmsh.write("block.msh")
gmsh.write("block.vtk")
gmsh.write("block.inp")
gmsh.option.setNumber("Mesh.Binary", 0)
gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
gmsh.write("block-text.msh")
gmsh.finalize()

mesh = meshio.read("block-text.msh")
meshio.write("block-meshio.vtu", mesh)
meshio.write("block-meshio.vtk", mesh)
meshio.write("block-meshio.inp", mesh)
meshio.write("block-meshio.msh", mesh, file_format="gmsh22", binary=True)
