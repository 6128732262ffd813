"""Counts how files of shapes from other projects are read: opened, repaired, refused with a reason, wrong.

    python count.py --program quasirigid --details rows.jsonl assimp=FOLDER trimesh=FOLDER

A file is valid if trimesh (or meshio, for the formats that trimesh has not) finds triangles in it, and bounds a body if these close once
corners at the same place are one. Volume and the six components of the inertia about the mass centre are compared with trimesh's, relative
to the largest, and told wrong above 1e-6. A folder is identified by the SHA-256 of the sorted list of the SHA-256 of its files. Needs
trimesh, meshio, networkx and scipy.
"""

import argparse
import collections
import hashlib
import json
import re
import subprocess
import tempfile
from pathlib import Path

import meshio
import numpy as np
import trimesh

ENDINGS = {".obj", ".stl", ".ply", ".off", ".wrl", ".vrml", ".gltf", ".glb", ".vtp", ".vtk", ".tab", ".plt"}
MODEL = """[material.rock]
density = 1
shear = "1 GPa"
poisson = 0.25
[[surface]]
file = {file}
unit = "m"
material = "rock"
degree = 1
"""
# Words of a refusal, and the reason in the table; what is not among them was not read.
REASONS = {
    "open": r"\bholes?\b|enclose nothing|[Tt]hree or more triangles|edge",
    "crosses itself": r"cross or touch|lies inside the body",
    "several bodies": r"bodies that nothing joins",
    "flat facets": r"has no area|no volume",
    "part of a scene": r"moves or resizes",
}
WRONG = 1e-6


def reference(file: Path):
    """Volume and inertia of the closed body, or its number of triangles alone; nothing for a file that is not valid."""
    try:
        mesh = trimesh.load(file, force="mesh", process=True)
        mesh.merge_vertices(merge_tex=True, merge_norm=True)
    except Exception:
        try:
            cells = meshio.read(file).cells_dict
        except (Exception, SystemExit):
            return None
        return {"triangles": sum(len(cells.get(kind, ())) for kind in ("triangle", "quad", "polygon"))}
    found = {"triangles": len(mesh.faces)}
    if len(mesh.faces) and mesh.is_watertight:
        if not mesh.is_winding_consistent:
            mesh.fix_normals()
        volume, inertia = sums(mesh.vertices[mesh.faces])
        found |= {"volume": abs(volume), "inertia": (np.sign(volume) * inertia).tolist()}
    return found


def sums(corners: np.ndarray):
    """Volume and inertia about the mass centre of what triangles ``(n, 3, 3)`` bound, of density 1."""
    corners = np.asarray(corners, dtype=np.longdouble)
    corners = corners - corners.mean(axis=(0, 1))
    volumes = np.einsum("ni,ni->n", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    total, volume = corners.sum(axis=1), volumes.sum()
    centre = volumes @ total / (4 * volume)
    second = np.einsum("n,ni,nj->ij", volumes, total, total) + np.einsum("n,nki,nkj->ij", volumes, corners, corners)
    second = second / 20 - volume * np.outer(centre, centre)
    return float(volume), np.asarray(np.trace(second) * np.eye(3) - second, dtype=float)


def answer(program: str, file: Path, timeout: float):
    """What the program says of a file: its status, with numbers or words."""
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder, "model.toml")
        model.write_text(MODEL.format(file=json.dumps(str(file.resolve()))))
        try:
            ran = subprocess.run(
                [program, "derive", str(model), "--order", "0", "--json"], capture_output=True, timeout=timeout, check=False
            )
        except subprocess.TimeoutExpired:
            return {"status": "too long"}
    words = " ".join(re.sub(r"[│╭╰╯─┬┴]", " ", ran.stderr.decode(errors="replace")).split())
    if ran.returncode in (0, 1) and ran.stdout:
        found = json.loads(ran.stdout)
        status = "repaired" if "was repaired" in words else "opened"
        return {"status": status, "volume": found["mass"], "inertia": found["inertia"], "words": words}
    reason = next((reason for reason, said in REASONS.items() if re.search(said, words)), None)
    status = "refused" if ran.returncode == 2 else "failed"
    return {"status": status if reason or status == "failed" else "unread", "reason": reason, "words": words[:600]}


def difference(ours, theirs) -> float:
    """Largest difference, relative to the volume and to the largest component of the inertia."""
    inertia = np.asarray(theirs["inertia"])
    return max(
        abs(ours["volume"] / theirs["volume"] - 1), np.abs(np.asarray(ours["inertia"]) - inertia).max() / np.abs(inertia).max()
    )


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", default="quasirigid")
    arguments.add_argument("--timeout", type=float, default=120)
    arguments.add_argument("--details", type=Path, help="a line of JSON for each file")
    arguments.add_argument("folders", nargs="+", metavar="NAME=FOLDER")
    asked = arguments.parse_args()
    details = asked.details.open("w") if asked.details else None
    names = ["files", "MB", "valid", "bound a body", "opened", "repaired", "refused", "unread", "wrong"]
    print("| project | " + " | ".join(names) + " | hash |\n|" + "---|" * (len(names) + 2))
    for name, folder in (each.split("=", 1) for each in asked.folders):
        counts, hashes = collections.Counter(), []
        for file in sorted(Path(folder).rglob("*")):
            if file.suffix.lower() not in ENDINGS or not file.is_file():
                continue
            content = file.read_bytes()
            hashes.append(hashlib.sha256(content).hexdigest())
            counts["files"] += 1
            counts["bytes"] += len(content)
            theirs = reference(file)
            row = {"file": str(file), "sha256": hashes[-1], "reference": theirs}
            if theirs and theirs["triangles"]:
                ours = answer(asked.program, file, asked.timeout)
                counts["valid"] += 1
                counts["bound a body"] += "volume" in theirs
                counts[ours["status"]] += 1
                row |= ours
                if "volume" in ours and "volume" in theirs:
                    row["difference"] = difference(ours, theirs)
                    counts["wrong"] += not row["difference"] < WRONG
            if details:
                details.write(json.dumps(row) + "\n")
                details.flush()
        counts["MB"] = round(counts["bytes"] / 1e6)
        digest = hashlib.sha256("\n".join(sorted(hashes)).encode()).hexdigest()[:12]
        print(f"| {name} | " + " | ".join(str(counts[key]) for key in names) + f" | {digest} |", flush=True)


if __name__ == "__main__":
    main()
