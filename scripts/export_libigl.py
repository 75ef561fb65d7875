#!/usr/bin/env python3
"""Write libigl's cotangent Laplacian and mass matrices of meshes, as fixtures that lapjury judges.

    pip install libigl scipy
    python3 scripts/export_libigl.py fixtures/operators/libigl fixtures/meshes/fox.ply fixtures/meshes/eight.off …

For each mesh NAME it writes NAME/L.mtx.gz (cotmatrix), NAME/M-barycentric.mtx.gz, NAME/M-voronoi.mtx.gz and
NAME/M-full.mtx.gz (massmatrix), and beside them one manifest.json with the versions and the SHA-256 of every file, meshes
included. Numbers are written with 17 significant digits, so that reading gives the same bits; the gzip streams carry no
time stamp, so that the same input and the same versions give the same files. Two meshes of one name are refused, as one
would overwrite the other. (libigl prints "Error: bad line (0)" for a comment in an OFF file and reads on.)
"""

import gzip
import hashlib
import json
import pathlib
import platform
import sys
import zlib

try:
    import igl
    import numpy as np
    import scipy
    from importlib.metadata import version
except ImportError as missing:
    print(f"SKIPPED: {missing}; install with: pip install libigl scipy", file=sys.stderr)
    sys.exit(0)

MASSES = {
    "barycentric": igl.MASSMATRIX_TYPE_BARYCENTRIC,
    "voronoi": igl.MASSMATRIX_TYPE_VORONOI,
    "full": igl.MASSMATRIX_TYPE_FULL,
}


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def write_matrix(path, matrix):
    """Matrix Market, general, entries by column, 17 significant digits."""
    matrix = matrix.tocsc()
    matrix.sort_indices()
    entries = matrix.tocoo()
    lines = ["%%MatrixMarket matrix coordinate real general", f"{matrix.shape[0]} {matrix.shape[1]} {matrix.nnz}"]
    lines += [f"{i + 1} {j + 1} {v:.17g}" for i, j, v in zip(entries.row, entries.col, entries.data)]
    path.write_bytes(gzip.compress(("\n".join(lines) + "\n").encode(), 9, mtime=0))


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[1])
    stems = [pathlib.Path(name).stem for name in sys.argv[2:]]
    if twice := sorted({stem for stem in stems if stems.count(stem) > 1}):
        sys.exit(f"two meshes are called {', '.join(twice)}; rename one, or export them to different folders")
    meshes = []
    for name in sys.argv[2:]:
        mesh = pathlib.Path(name)
        vertices, faces = igl.read_triangle_mesh(str(mesh))
        vertices, faces = np.asarray(vertices, dtype=np.float64), np.asarray(faces, dtype=np.int64)
        folder = out / mesh.stem
        folder.mkdir(parents=True, exist_ok=True)
        stiffness = folder / "L.mtx.gz"
        write_matrix(stiffness, igl.cotmatrix(vertices, faces))
        entry = {
            "mesh": mesh.as_posix(),
            "sha256": sha256(mesh),
            "stiffness": stiffness.relative_to(out).as_posix(),
            "stiffness_sha256": sha256(stiffness),
            "masses": {},
        }
        for kind, code in MASSES.items():
            mass = folder / f"M-{kind}.mtx.gz"
            write_matrix(mass, igl.massmatrix(vertices, faces, code))
            entry["masses"][kind] = {"file": mass.relative_to(out).as_posix(), "sha256": sha256(mass)}
        meshes.append(entry)
        print(f"{mesh}: {len(vertices)} vertices, {len(faces)} faces")
    manifest = {
        "format": "laplacian-export",
        "version": 1,
        "operator": {"name": "libigl cotmatrix", "library": f"libigl {version('libigl')}"},
        "kind": "stiffness",
        "sign": "negative-semidefinite",
        "scale": 1.0,
        "degree": 0,
        "promises": ["LOC", "SYM", "NULL", "PSD", "LIN"],
        "written_with": {
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "zlib": zlib.ZLIB_RUNTIME_VERSION,
            "command": "scripts/export_libigl.py",
        },
        "meshes": meshes,
    }
    (out / "manifest.json").write_text(json.dumps(manifest, indent=2) + "\n")


if __name__ == "__main__":
    main()
