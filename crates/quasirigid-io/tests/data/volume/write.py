"""Writes the meshes of this folder with gmsh, VTK and meshio; see README.md."""

import os
import pathlib

import gmsh
import h5py
import meshio
import netCDF4
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


# Exodus has the upright edges before those of the upper face, and the middle of a cell before those of its faces:
# the place in the order of VTK of each of its nodes.
UPRIGHT = list(range(12)) + [16, 17, 18, 19, 12, 13, 14, 15]
EXODUS = {
    3: "BAR2", 21: "BAR3", 5: "TRI3", 22: "TRI6", 9: "SHELL4", 23: "SHELL8", 28: "SHELL9", 10: "TETRA4",
    13: "WEDGE6", 12: "HEX8", 24: "TETRA10", 26: "WEDGE15", 25: "HEX20", 29: "HEX27",
}
EXODUS_ORDER = {
    25: UPRIGHT, 29: UPRIGHT + [26, 24, 25, 20, 21, 22, 23],
    26: [0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11],
}


def write_exodus(name, grid, format):
    """A block for each cell, whose order vtkExodusIIReader was seen to turn back; a named set of nodes and a nameless one."""
    with netCDF4.Dataset(name, "w", format=format) as file:
        file.setncatts({"api_version": np.float32(5.1), "version": np.float32(5.1), "title": "zoo"})
        file.setncatts({"floating_point_word_size": np.int32(8), "file_size": np.int32(1)})
        count = grid.GetNumberOfPoints()
        sizes = {"len_name": 33, "num_dim": 3, "num_nodes": count, "num_elem": len(ZOO), "num_el_blk": len(ZOO)}
        for dimension, size in (sizes | {"num_node_sets": 2, "num_nod_ns1": 2, "num_nod_ns2": 1}).items():
            file.createDimension(dimension, size)
        file.createDimension("time_step", None)
        packed = {"zlib": True} if format == "NETCDF4" else {}

        def variable(name, kind, dimensions, values):
            array = file.createVariable(name, kind, dimensions, **(packed if name.startswith("coord") else {}))
            array[:] = values
            return array

        variable("time_whole", "f8", ("time_step",), [0.5, 1.5])
        variable("vals_nod_var1", "f8", ("time_step", "num_nodes"), np.zeros((2, count)))
        points = np.array([grid.GetPoint(i) for i in range(count)])
        for axis, letter in enumerate("xyz"):
            variable(f"coord{letter}", "f8", ("num_nodes",), points[:, axis])
        variable("node_num_map", "i4", ("num_nodes",), 100 + 3 * np.arange(count))
        variable("eb_prop1", "i4", ("num_el_blk",), 10 + np.arange(len(ZOO)))
        variable("ns_prop1", "i4", ("num_node_sets",), [7, 8])
        for kind, names in (("el_blk", [g if g == "left" else "" for _, _, g in ZOO]), ("node_sets", ["tip", ""])):
            letters = np.array([list(name.ljust(33, "\0")) for name in names], "S1")
            variable("eb_names" if kind == "el_blk" else "ns_names", "S1", (f"num_{kind}", "len_name"), letters)
        variable("node_ns1", "i4", ("num_nod_ns1",), [1, 3])
        variable("node_ns2", "i4", ("num_nod_ns2",), [2])
        for number, (_, kind, _) in enumerate(ZOO):
            cell = grid.GetCell(number)
            nodes = [cell.GetPointId(i) + 1 for i in range(cell.GetNumberOfPoints())]
            nodes = [nodes[i] for i in EXODUS_ORDER.get(kind, range(len(nodes)))]
            block = number + 1
            file.createDimension(f"num_el_in_blk{block}", 1)
            file.createDimension(f"num_nod_per_el{block}", len(nodes))
            array = variable(f"connect{block}", "i4", (f"num_el_in_blk{block}", f"num_nod_per_el{block}"), [nodes])
            array.elem_type = EXODUS[kind]


# MED turns the lower face the other way: the place in the order of VTK of each of its nodes, as gmsh writes the blocks of one type.
TURNED = [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17]
MED = {
    3: ("SE2", None), 21: ("SE3", None), 5: ("TR3", None), 22: ("TR6", None), 9: ("QU4", None), 23: ("QU8", None),
    28: ("QU9", None), 10: ("TE4", [0, 2, 1, 3]), 13: ("PE6", [0, 2, 1, 3, 5, 4]), 12: ("HE8", TURNED[:8]),
    24: ("T10", [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]), 26: ("P15", [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13]),
    25: ("H20", TURNED), 29: ("H27", TURNED + [24, 20, 23, 21, 22, 25, 26]),
}


def write_med(name, grid):
    """Cells by type; families of the groups of the cells and of the first two nodes."""
    with h5py.File(name, "w") as file:
        mesh = file.create_group("ENS_MAA/zoo")
        mesh.attrs.update({"DIM": 3, "ESP": 3, "TYP": 0})
        step = mesh.create_group("-0000000000000000001-0000000000000000001")
        count = grid.GetNumberOfPoints()
        points = np.array([grid.GetPoint(i) for i in range(count)])
        step["NOE/COO"] = points.T.ravel()
        step["NOE/NUM"] = 100 + 3 * np.arange(count)
        step["NOE/FAM"] = [1, 1] + [0] * (count - 2)
        for number, (_, kind, group) in enumerate(ZOO):
            cell = grid.GetCell(number)
            nodes = np.array([cell.GetPointId(i) + 1 for i in range(cell.GetNumberOfPoints())])
            code, order = MED[kind]
            step[f"MAI/{code}/NOD"] = nodes if order is None else nodes[order]
            step[f"MAI/{code}/FAM"] = [-1 - list(GROUPS).index(group)]
        step["MAI/PO1/NOD"] = [1]
        families = [("NOEUD/FAM_1_tip", 1, ["tip"]), ("FAMILLE_ZERO", 0, [])]
        families += [(f"ELEME/FAM_{group}", -1 - i, [group, "all of it"]) for i, group in enumerate(GROUPS)]
        for path, number, groups in families:
            family = file.create_group(f"FAS/zoo/{path}")
            family.attrs["NUM"] = number
            if groups:
                names = family.create_dataset("GRO/NOM", (len(groups),), dtype="80int8")
                for i, name in enumerate(groups):
                    names[i] = list(name.encode().ljust(80, b"\0"))


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
write_med("zoo.med", vtk_zoo())
write_exodus("zoo-2.exo", vtk_zoo(), "NETCDF3_64BIT_OFFSET")
write_exodus("zoo-5.exo", vtk_zoo(), "NETCDF3_64BIT_DATA")
write_exodus("zoo-4.exo", vtk_zoo(), "NETCDF4")

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
