#!/usr/bin/env python3
"""Measure lapjury's eigensolver beside SciPy's `eigsh` with SuperLU and with CHOLMOD, on the same matrices in the same run.

    pip install scipy scikit-sparse        (scikit-sparse needs SuiteSparse: apt-get install libsuitesparse-dev)
    cargo build --release && cargo build --release --example bench_operators
    python3 scripts/bench_eigen.py [--level 7] [--pairs 50] [--repeats 3]

writes reports/bench/eigen.csv. The matrices are cotan and its barycentric mass on an icosphere (level 7: 163,842 vertices). Every
solver gets one thread and a process of its own, in turns A B C A B C …; what is timed is factorisation and iteration, from the
matrices in memory to pairs in memory. Ours computes more: it goes on to the next gap of the spectrum and closes it with an inertia
count, which is a factorisation of its own. Peak memory is the high-water mark over what the process held with the matrices.
SciPy's shift is ours, below the spectrum, and its tolerance that of our shift-inverted residual, 1e-10.
What is not installed is skipped with a notice.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BIN = ROOT / "target" / "release"
OUT = ROOT / "reports" / "bench" / "eigen.csv"
ONE_THREAD = {name: "1" for name in ("RAYON_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")}


def worker(stem, pairs, solver):
    """In a process of its own: one line of JSON with seconds, memory and the largest relative error of the values."""
    import resource
    import time

    import scipy.io
    import scipy.sparse
    import scipy.sparse.linalg

    stiffness = scipy.io.mmread(stem + ".L.mtx").tocsc()
    mass = scipy.io.mmread(stem + ".M.mtx")
    mass = scipy.sparse.diags(mass.ravel()).tocsc() if not scipy.sparse.issparse(mass) else mass.tocsc()
    sigma = -4 * math.pi / mass.sum()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start, cpu = time.perf_counter(), time.process_time()
    options = {"k": pairs, "M": mass, "sigma": sigma, "which": "LM", "tol": 1e-10}
    if solver == "CHOLMOD":
        from sksparse.cholmod import cholesky

        factor = cholesky((stiffness - sigma * mass).tocsc())
        shape = stiffness.shape
        options["OPinv"] = scipy.sparse.linalg.LinearOperator(shape, matvec=factor, dtype=float)
    values, _ = scipy.sparse.linalg.eigsh(stiffness, **options)
    seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
    peak = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
    # The eigenvalues of the unit sphere are l(l + 1), 2l + 1 times: a lost copy shows as a large error.
    exact = [math.isqrt(k) * (math.isqrt(k) + 1) for k in range(pairs)]
    error = max(abs(v - e) / max(e, 1) for v, e in zip(sorted(values), exact))
    print(json.dumps({"seconds": seconds, "cpu_seconds": cpu, "peak_bytes": peak, "error": error}))


def run(command):
    done = subprocess.run(command, env=os.environ | ONE_THREAD, capture_output=True, text=True)
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        print(f"skipped: {pathlib.Path(str(command[0])).name} {' '.join(map(str, command[2:]))}: {last}", file=sys.stderr)
        return None
    return json.loads(done.stdout.strip().splitlines()[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--level", type=int, default=7)
    parser.add_argument("--pairs", type=int, default=50)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--worker", nargs=3, metavar=("STEM", "PAIRS", "SOLVER"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.worker:
        stem, pairs, solver = given.worker
        return worker(stem, int(pairs), solver)
    with tempfile.TemporaryDirectory() as folder:
        stem = str(pathlib.Path(folder) / "sphere")
        recipe = f"icosphere:levels={given.level}"
        subprocess.run([BIN / "lapjury", "-q", "export", "cotan", recipe, "--out", stem], check=True)
        subprocess.run([BIN / "lapjury", "-q", "generate", recipe, "--out", stem + ".off"], check=True)
        bench = [BIN / "examples" / "bench_operators", stem + ".off"]
        ours = lambda: run([*bench, f"spectrum:{given.pairs}", "1"])
        theirs = lambda solver: lambda: run([sys.executable, __file__, "--worker", stem, str(given.pairs), solver])
        solvers = {"lapjury": ours, "eigsh + CHOLMOD": theirs("CHOLMOD"), "eigsh + SuperLU": theirs("SuperLU")}
        measured = {name: [] for name in solvers}
        for turn in range(given.repeats):
            for name, once in solvers.items():
                print(f"turn {turn + 1}: {name}", file=sys.stderr)
                measured[name].append(once())
        memory = run([*bench, f"memory:spectrum:{given.pairs}"])
        for found in filter(None, measured["lapjury"]):
            found |= memory or {}
    rows = []
    for name, found in measured.items():
        found = [(k, f) for k, f in enumerate(found) if f]
        if not found:
            continue
        ratios = lambda key: [measured["lapjury"][k][key] / f[key] for k, f in found if measured["lapjury"][k]]
        row = {
            "solver": name,
            "vertices": 10 * 4**given.level + 2,
            "pairs": given.pairs,
            "seconds": statistics.median(f["seconds"] for _, f in found),
            "cpu_seconds": statistics.median(f["cpu_seconds"] for _, f in found),
            "ours_over_it": statistics.median(ratios("seconds") or [math.nan]),
            "ours_over_it_cpu": statistics.median(ratios("cpu_seconds") or [math.nan]),
            "peak_mb": statistics.median(f.get("peak_bytes", math.nan) / 1e6 for _, f in found),
            "largest_error": max(f.get("error", math.nan) for _, f in found),
        }
        rows.append({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()})
        print("  ".join(f"{key} {value}" for key, value in rows[-1].items()))
    OUT.parent.mkdir(parents=True, exist_ok=True)
    with OUT.open("w", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys())
        table.writeheader()
        table.writerows(rows)
    print(f"written: {OUT.relative_to(ROOT)}")


if __name__ == "__main__":
    sys.exit(main())
