#!/usr/bin/env bash
# Exports libigl's matrices afresh and brings each before the jury: no flag, the promises of its documentation, and an
# entry-by-entry comparison with the built-in operator.   usage: scripts/check_libigl.sh [PYTHON]
set -euo pipefail
cd "$(dirname "$0")/.."
python=${1:-python3}
lapjury=${LAPJURY:-target/release/lapjury}

if ! "$python" -c 'import igl, scipy' 2>/dev/null; then
    echo "SKIPPED: libigl is not installed; pip install libigl scipy"
    exit 0
fi
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"$lapjury" generate 'random-delaunay:n=200,seed=3' --out "$out/planar.off" --quiet
meshes=(fixtures/meshes/{spot,bob_small,fox}.ply fixtures/meshes/{eight,anchor,three_peaks,retinal,oblong,bones}.off "$out/planar.off")
"$python" scripts/export_libigl.py "$out/libigl" "${meshes[@]}" >/dev/null
passed=0
for mesh in "${meshes[@]}"; do
    name=$(basename "${mesh%.*}")
    for mass in barycentric voronoi full; do
        "$lapjury" check --mesh "$mesh" --stiffness "$out/libigl/$name/L.mtx.gz" --mass "$out/libigl/$name/M-$mass.mtx.gz" \
            --property FIN,LOC,SYM,NULL,KER,PSD,LIN,ENERGY,FLUX,MASS --promises LOC,SYM,NULL,PSD,LIN,ENERGY,FLUX,MASS \
            --against cotan --quiet >"$out/answer" \
            || { cat "$out/answer"; echo "$name, mass $mass: libigl's matrices do not come out as promised"; exit 1; }
    done
    passed=$((passed + 1))
done
echo "libigl: $passed meshes with 3 masses each, no promise broken, no entry beyond the bound of its mesh"
