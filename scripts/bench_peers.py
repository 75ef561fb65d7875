#!/usr/bin/env python3
"""Measure lapjury beside libigl, potpourri3d, LaPy and robust_laplacian, on the same meshes in the same run.

    pip install libigl scipy matplotlib potpourri3d lapy robust_laplacian
    cargo build --release --example bench_operators
    python3 scripts/bench_peers.py [--quick] [--repeats 5] [--threads 1,2] [--sizes 10000,100000,1000000]

writes reports/bench/peers.csv and reports/bench/peers.svg. Each library runs in a process of its own that holds the mesh and
answers with the seconds of one construction; the processes take turns, A B C A B C …, so that whatever else the machine does
falls on all of them. A ratio is that of the two runs of one turn. What is not installed is skipped with a notice.

What is timed, from arrays in memory to matrices in memory:

    cotan       cotangent Laplacian and barycentric (lumped) mass
    intrinsic   cotangent Laplacian of the intrinsic Delaunay triangulation, of a Delaunay mesh with a tenth of its edges flipped
    verdicts    our structural verdicts of a given matrix, beside libigl's assembly of that matrix (`cotan`)

Our side is measured from the validated surface with its connectivity, as the library holds it, and, as `+topology`, from bare
positions and faces, as the other libraries get them. Peak memory is that of a fresh process over what it held with the mesh.
Columns of the CSV: seconds and CPU seconds (all threads) as median, least and most; `ratio_*` = this over libigl, turn by turn.
"""

import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
from itertools import product

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "target" / "release" / "examples" / "bench_operators"
OUT = ROOT / "reports" / "bench"
OURS = "lapjury"
# The library that ratios are over, and what each of our tasks is compared with.
REFERENCE = "libigl"
PLACES = (("plane", False), ("space", True))
# Flips are made one by one; a million vertices would take longer to make than to measure.
LARGEST_FLIPPED = 100_000
TASKS = {
    "cotan": {OURS: ["cotan", "cotan+topology"], "peers": ["libigl", "potpourri3d", "LaPy"], "as": "cotan"},
    "intrinsic": {OURS: ["intrinsic", "intrinsic+topology"], "peers": ["libigl", "robust_laplacian"], "as": "intrinsic"},
    "verdicts": {OURS: ["verdicts"], "peers": ["libigl"], "as": "cotan"},
}


def functions(library, task):
    """The construction as a function of vertices and faces; ImportError where the library is not installed."""
    if library == "libigl":
        import igl

        if task == "cotan":
            return lambda v, f: (igl.cotmatrix(v, f), igl.massmatrix(v, f, igl.MASSMATRIX_TYPE_BARYCENTRIC))
        if not hasattr(igl, "intrinsic_delaunay_cotmatrix"):
            raise ImportError("this libigl has no intrinsic_delaunay_cotmatrix")

        def intrinsic(v, f):
            stiffness, lengths, faces = igl.intrinsic_delaunay_cotmatrix(v, f)
            return stiffness, igl.massmatrix_intrinsic(lengths, faces, igl.MASSMATRIX_TYPE_BARYCENTRIC)

        return intrinsic
    if library == "potpourri3d":
        import potpourri3d

        return lambda v, f: (potpourri3d.cotan_laplacian(v, f), potpourri3d.vertex_areas(v, f))
    if library == "LaPy":
        import lapy

        # The constructor computes stiffness and lumped mass; the mesh object also its connectivity, as its users need it.
        return lambda v, f: lapy.Solver(lapy.TriaMesh(v, f), lump=True)
    if library == "robust_laplacian":
        import robust_laplacian

        return lambda v, f: robust_laplacian.mesh_laplacian(v, f)
    raise ImportError(f"no library {library}")


def version(library):
    from importlib.metadata import version as installed

    return installed({"LaPy": "lapy"}.get(library, library))


# --- the worker of a library --------------------------------------------------------------------------------------------


def status(field):
    with open("/proc/self/status") as lines:
        return next((int(line.split()[1]) * 1024 for line in lines if line.startswith(field + ":")), 0)


def worker(library, task, mesh):
    """Answers each line of the input with the seconds of one run, or measures memory once: `memory:TASK`."""
    import contextlib
    import io

    import numpy as np

    vertices, faces = np.load(mesh + ".v.npy"), np.load(mesh + ".f.npy")
    memory = task.startswith("memory:")
    run = functions(library, task.removeprefix("memory:"))
    if memory:
        pathlib.Path("/proc/self/clear_refs").write_text("5")
        before = status("VmRSS")
        with contextlib.redirect_stdout(io.StringIO()):
            run(vertices, faces)
        print(json.dumps({"peak_bytes": max(status("VmHWM") - before, 0)}))
        return
    print("ready", flush=True)
    for _ in sys.stdin:
        with contextlib.redirect_stdout(io.StringIO()):
            cpu, start = time.process_time(), time.perf_counter()
            result = run(vertices, faces)
            seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
        del result
        print(json.dumps({"seconds": seconds, "cpu_seconds": cpu}), flush=True)


# --- the driver ---------------------------------------------------------------------------------------------------------


def grid(n, curved):
    """A jittered grid with random diagonals, n vertices or a little fewer: in the plane, or as a landscape in space."""
    import numpy as np

    m, rng = int(n**0.5), np.random.default_rng(1)
    y, x = np.divmod(np.arange(m * m), m)
    p = np.stack([x + 0.4 * (rng.random(m * m) - 0.5), y + 0.4 * (rng.random(m * m) - 0.5), np.zeros(m * m)], 1) / m
    if curved:
        p[:, 2] = 0.1 * np.sin(7 * p[:, 0]) * np.cos(5 * p[:, 1])
    j, i = np.divmod(np.arange((m - 1) ** 2), m - 1)
    k, rising = j * m + i, rng.random((m - 1) ** 2) < 0.5
    lower = np.where(rising[:, None], np.stack([k, k + 1, k + m + 1], 1), np.stack([k, k + 1, k + m], 1))
    upper = np.where(rising[:, None], np.stack([k, k + m + 1, k + m], 1), np.stack([k + 1, k + m + 1, k + m], 1))
    return p, np.stack([lower, upper], 1).reshape(-1, 3)


def flipped(n, curved, folder):
    """A Delaunay triangulation of n random points with a tenth of its 3n edges flipped, made by lapjury's own generator."""
    import numpy as np

    recipe, path = f"random-delaunay:n={n},seed=1 | flip:count={3 * n // 10},seed=1", folder / "flipped.off"
    lapjury = ROOT / "target" / "release" / "lapjury"
    subprocess.run([lapjury, "generate", recipe, "--out", path], check=True, stdout=subprocess.DEVNULL)
    text = path.read_text().split()
    count, faces = int(text[1]), int(text[2])
    p = np.array(text[4 : 4 + 3 * count], dtype=np.float64).reshape(-1, 3)
    f = np.array(text[4 + 3 * count : 4 + 3 * count + 4 * faces], dtype=np.int64).reshape(-1, 4)[:, 1:]
    if curved:
        p[:, 2] = 0.1 * np.sin(7 * p[:, 0]) * np.cos(5 * p[:, 1])
    return p, np.ascontiguousarray(f)


def save(name, mesh, folder):
    """The same numbers as a binary PLY file and as arrays."""
    import numpy as np

    v, f = np.ascontiguousarray(mesh[0], "<f8"), np.ascontiguousarray(mesh[1], np.int64)
    stem = folder / name
    np.save(f"{stem}.v.npy", v)
    np.save(f"{stem}.f.npy", f)
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(v)}\nproperty double x\nproperty double y\n"
        f"property double z\nelement face {len(f)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.empty(len(f), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, f
    pathlib.Path(f"{stem}.ply").write_bytes(header.encode() + v.tobytes() + rows.tobytes())
    return str(stem), len(v)


def environment(threads):
    one = {key: "1" for key in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
    many = {key: str(threads) for key in ("RAYON_NUM_THREADS", "IGL_NUM_THREADS", "OMP_NUM_THREADS")}
    return {**os.environ, **one, **many}


def command(library, task, mesh):
    if library == OURS:
        return [str(EXAMPLE), mesh + ".ply", task]
    return [sys.executable, __file__, "--worker", library, task, mesh]


class Worker:
    def __init__(self, library, task, mesh, threads):
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
        self.name, self.times, self.cpu = (library, task), [], []
        self.process = subprocess.Popen(command(library, task, mesh), env=environment(threads), **pipes)
        if self.process.stdout.readline().strip() != "ready":
            raise RuntimeError(f"{library} {task} did not start")

    def turn(self):
        self.process.stdin.write("go\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        self.times.append(answer["seconds"])
        self.cpu.append(answer["cpu_seconds"])
        return answer

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def peak(library, task, mesh, threads):
    answer = subprocess.run(
        command(library, "memory:" + task, mesh), env=environment(threads), check=True, capture_output=True, text=True
    )
    return json.loads(answer.stdout)["peak_bytes"]


def installed(peers):
    """Which of the libraries can be asked; a notice for the others."""
    found = []
    for library in peers:
        try:
            for task, spec in TASKS.items():
                if library in spec["peers"]:
                    functions(library, spec["as"])
            found.append(library)
        except ImportError as missing:
            print(f"SKIPPED {library}: {missing}", file=sys.stderr)
    return found


def compare(mesh_name, mesh, vertices, task, threads, repeats, available):
    """The rows of one comparison: every side takes its turn `repeats` times, after one that does not count."""
    spec = TASKS[task]
    sides = [(OURS, t) for t in spec[OURS]] + [(p, spec["as"]) for p in spec["peers"] if p in available]
    workers = [Worker(library, t, mesh, threads) for library, t in sides]
    for worker in workers:
        worker.turn()
        worker.times.clear()
        worker.cpu.clear()
    for _ in range(repeats):
        for worker in workers:
            worker.turn()
    reference = next((w for w in workers if w.name[0] == REFERENCE), None)
    rows = []
    for worker in workers:
        worker.end()
        row = {"task": task, "mesh": mesh_name, "vertices": vertices, "threads": threads}
        row |= {"library": worker.name[0], "measured": worker.name[1], "repeats": repeats}
        for name, values in (("seconds", worker.times), ("cpu_seconds", worker.cpu)):
            row |= {name: statistics.median(values), f"{name}_min": min(values), f"{name}_max": max(values)}
        if reference is not None:
            for name, mine, theirs in (
                ("ratio", worker.times, reference.times),
                ("ratio_cpu", worker.cpu, reference.cpu),
            ):
                ratios = [a / b for a, b in zip(mine, theirs)]
                row |= {name: statistics.median(ratios), f"{name}_min": min(ratios), f"{name}_max": max(ratios)}
        row["ns_per_vertex"] = 1e9 * row["seconds"] / vertices
        row["peak_bytes"] = peak(*worker.name, mesh, threads)
        print(
            f"{task:10} {mesh_name:8} n={vertices:<8} threads={threads} {worker.name[0]:17} {worker.name[1]:19}"
            f" {row['seconds']:8.4f} s  ratio {row.get('ratio', float('nan')):6.3f} (CPU {row.get('ratio_cpu', float('nan')):6.3f})"
            f"  {row['peak_bytes'] / 1e6:7.1f} MB",
            flush=True,
        )
        rows.append(row)
    return rows


def plot(rows, path):
    try:
        import matplotlib

        matplotlib.use("svg")
        import matplotlib.pyplot as plt
    except ImportError as missing:
        print(f"SKIPPED the plot: {missing}", file=sys.stderr)
        return
    matplotlib.rcParams["svg.hashsalt"] = "lapjury"
    threads = sorted({row["threads"] for row in rows})
    groups = [(task, t) for task in TASKS for t in threads if any(r["task"] == task and r["threads"] == t for r in rows)]
    figure, axes = plt.subplots(len(TASKS), len(threads), figsize=(6 * len(threads), 4 * len(TASKS)), squeeze=False)
    for task, t in groups:
        axis = axes[list(TASKS).index(task)][threads.index(t)]
        chosen = [r for r in rows if r["task"] == task and r["threads"] == t]
        for label in dict.fromkeys((r["library"], r["measured"], r["mesh"]) for r in chosen):
            line = sorted((r for r in chosen if (r["library"], r["measured"], r["mesh"]) == label), key=lambda r: r["vertices"])
            x, y = [r["vertices"] for r in line], [r["seconds"] for r in line]
            low = [r["seconds"] - r["seconds_min"] for r in line]
            high = [r["seconds_max"] - r["seconds"] for r in line]
            style = "-" if label[0] == OURS else "--"
            axis.errorbar(x, y, yerr=[low, high], label=" ".join(label), linestyle=style, marker="o", markersize=3, capsize=3)
        axis.set(xscale="log", yscale="log", xlabel="vertices", ylabel="seconds", title=f"{task}, {t} thread{'s' * (t > 1)}")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=6)
    figure.suptitle("median of paired runs; bars from the fastest to the slowest")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    if sys.argv[1:2] == ["--worker"]:
        return worker(*sys.argv[2:5])
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--sizes", default="10000,100000,1000000")
    parser.add_argument("--quick", action="store_true", help="the smallest size only, twice, and nothing written")
    parser.add_argument("--tasks", default=",".join(TASKS))
    arguments = parser.parse_args()
    try:
        import numpy  # noqa: F401
    except ImportError as missing:
        print(f"SKIPPED: {missing}; install with: pip install libigl scipy", file=sys.stderr)
        return
    if not EXAMPLE.exists():
        sys.exit("build our side first: cargo build --release --bin lapjury --example bench_operators")
    sizes = [int(n) for n in arguments.sizes.split(",")][: 1 if arguments.quick else None]
    repeats, tasks = (2 if arguments.quick else arguments.repeats), arguments.tasks.split(",")
    counts = [int(t) for t in arguments.threads.split(",")]
    available, rows = installed(sorted({p for spec in TASKS.values() for p in spec["peers"]})), []
    print("beside " + ", ".join(f"{library} {version(library)}" for library in available))
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for n in sizes:
            meshes = [(name, *save(f"{name}-{n}", grid(n, curved), folder)) for name, curved in PLACES]
            for task, threads in product((t for t in tasks if t != "intrinsic"), counts):
                for name, mesh, vertices in meshes:
                    rows += compare(name, mesh, vertices, task, threads, repeats, available)
            if n <= LARGEST_FLIPPED and "intrinsic" in tasks:
                meshes = [(name, *save(f"flipped-{name}-{n}", flipped(n, curved, folder), folder)) for name, curved in PLACES]
                for threads, (name, mesh, vertices) in product(counts, meshes):
                    rows += compare(name, mesh, vertices, "intrinsic", threads, repeats, available)
            if not arguments.quick:
                write(rows)
    if not arguments.quick:
        plot(rows, OUT / "peers.svg")


def write(rows):
    """The table, as far as it has come."""
    OUT.mkdir(parents=True, exist_ok=True)
    with open(OUT / "peers.csv", "w", newline="") as file:
        names = list(dict.fromkeys(key for row in rows for key in row))
        table = csv.DictWriter(file, names, lineterminator="\n")
        table.writeheader()
        table.writerows({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)


if __name__ == "__main__":
    main()
