"""Writes the stiffness in beam.sti in every other format; see README.md."""

import numpy as np
import scipy.io
import scipy.sparse as sp
from pyNastran.bdf.bdf import BDF
from pyNastran.op4.op4 import OP4
from pyyeti.nastran import op4

rows, columns, values = np.loadtxt("beam.sti", unpack=True)
upper = sp.coo_array((values, (rows.astype(int) - 1, columns.astype(int) - 1)))
K = (upper + sp.triu(upper, 1).T).tocsr()
full = K.toarray()
freedoms = [tuple(map(int, line.split("."))) for line in open("beam.dof")]

scipy.io.mmwrite("symmetric.mtx", K, comment="beam", precision=14, symmetry="symmetric")
scipy.io.mmwrite("general.mtx", K, precision=14, symmetry="general")
scipy.io.mmwrite("array.mtx", full, precision=14, symmetry="symmetric")

np.save("rows.npy", full)
np.save("columns_big_endian.npy", np.asfortranarray(full).astype(">f8"))
with open("version2.npy", "wb") as file:
    np.lib.format.write_array(file, full, version=(2, 0))
sp.save_npz("csr.npz", sp.csr_array(K))
sp.save_npz("csc.npz", sp.csc_matrix(K), compressed=False)
sp.save_npz("coo.npz", K.tocoo())
# No size is divisible by 17 and 2 but one: the matrix, and twice the matrix below it.
sp.save_npz("bsr.npz", sp.bsr_array(sp.kron(np.diag([1.0, 2.0]), full), blocksize=(2, 17)))
np.savez("dense.npz", K=full, M=2 * full)
np.savez_compressed("dense_compressed.npz", K=full, M=2 * full)
scipy.io.savemat("sparse.mat", {"K": sp.csc_matrix(K), "about": "beam"}, do_compression=True)
scipy.io.savemat("dense.mat", {"K": full, "M": 2 * full})

model = BDF(debug=None)
lower = [(i, j) for j in range(len(full)) for i in range(j, len(full)) if full[i, j] != 0.0]
terms = ([freedoms[j] for _, j in lower], [freedoms[i] for i, _ in lower], [full[i, j] for i, j in lower])
model.add_dmig("KAAX", 6, 2, 0, 0, None, *terms)
model.write_bdf("large.bdf", size=16, is_double=True)
model = BDF(debug=None)
model.add_dmig("KAAX", 6, 1, 0, 0, None, *terms)
model.write_bdf("small.bdf", size=8)

OP4(debug=None).write_op4("pynastran.op4", {"KAAX": (6, full)}, is_binary=False)
pair = {"KAAX": (full, 6), "MAAX": (2 * full, 6)}
for sparse in ["dense", "bigmat", "nonbigmat"]:
    op4.write(f"text_{sparse}.op4", {"KAAX": (full, 6)}, binary=False, digits=13, sparse=sparse)
    op4.write(f"binary_{sparse}.op4", pair, sparse=sparse, endian=">" if sparse == "dense" else "<")
    # pyNastran reads the same from them.
    for file in [f"text_{sparse}.op4", f"binary_{sparse}.op4"]:
        read = OP4(debug=None).read_op4(file)["KAAX"].data
        assert np.array_equal(read.toarray() if sp.issparse(read) else read, full), file

# Two rows, three columns and no symmetry: rows and columns cannot be mistaken for each other.
wide = np.array([[1.0, 3.0, 5.0], [2.0, 4.0, 0.0]])
np.save("wide.npy", wide)
np.save("wide_columns.npy", np.asfortranarray(wide.astype("i4")))
sp.save_npz("wide_csr.npz", sp.csr_array(wide))
sp.save_npz("wide_csc.npz", sp.csc_array(wide.astype("f4")))
# The 5 is 2 and 3.
i, j, x = [1, 0, 0, 1, 0, 0], [0, 2, 0, 1, 2, 1], [2.0, 2.0, 1.0, 4.0, 3.0, 3.0]
sp.save_npz("wide_coo.npz", sp.coo_array((x, (i, j)), shape=(2, 3)))
op4.write("wide_text.op4", {"W": (wide, 2)}, binary=False, sparse="nonbigmat")
op4.write("wide_binary.op4", {"W": (wide, 2)}, sparse="bigmat", endian=">")
