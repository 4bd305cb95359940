#!/usr/bin/env bash
# tests/reliability/instrumented-run.sh BIN THREADS [PREFIX]: packs, meshes and compacts eight bonded grains with an
# instrumented build (a sanitizer's, or under valgrind by PREFIX), begins a branch at the checkpoint of the compaction,
# and reads the run with postproc where BIN has it. Exit code 0: the instruments found nothing.
set -euo pipefail
bin=$(realpath "$1")
threads=$2
read -ra prefix <<<"${3:-}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat >powder.toml <<'TOML'
count = 8
relative_density = 0.45
box = [0.4, 0.4, 0.4]
smallest_gap = 0.004
seed = 1
size_scale_tolerance = 0.5
[size_distribution]
kind = "table"
measure = "diameter"
weight = "number"
values = [0.17, 0.2]
cumulative = [0.0, 1.0]
TOML
cat >scenario.toml <<'TOML'
packing = "packing.h5"
[material]
density = 1.55e-9
youngs_modulus = 5000.0
poissons_ratio = 0.3
[material.hardening]
law = "power"
yield_stress = 25.0
coefficient = 125.0
exponent = 0.3
[bond]
tensile_strength = 25.0
shear_strength = 18.0
fracture_energy = 0.1
[output]
history_rows = 10
[[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = 0.6
wall_speed = 40000.0
damping_rate = 2e6
damping_fade_stress = 1.0
[[stages]]
name = "unloading"
type = "isotropic_unloading"
mean_stress = 0.0
wall_speed = 40000.0
TOML
"$bin/pack-gen" spheres powder.toml -o spheres.h5 --quiet
"$bin/pack-gen" mesh spheres.h5 --size 0.05 -o packing.h5 --quiet
run=("${prefix[@]}" "$bin/mpfem" run scenario.toml --threads "$threads" --quiet)
"${run[@]}" -o run.h5
"${run[@]}" -o branch.h5 --from run.compaction.checkpoint.h5 --set stages.0.relative_density=0.62
if [[ -x $bin/postproc ]]; then
  postproc=("${prefix[@]}" "$bin/postproc")
  for file in packing.h5 run.h5 run.compaction.checkpoint.h5; do "${postproc[@]}" validate "$file" >log.txt; done
  for verb in summary 'contact --history' elastic-recovery quasi-static damage 'section-stress --threshold 25' \
    'energy --packing packing.h5'; do
    read -ra words <<<"$verb"
    "${postproc[@]}" "${words[@]}" run.h5 -o result.json --quiet >log.txt
  done
  "${postproc[@]}" section run.h5 --axis z --field damage -o section.png --quiet >log.txt
  "${postproc[@]}" vtk run.h5 -o vtk --quiet >log.txt
fi
echo "no findings: $(basename "$bin") with $threads threads ${3:-}"
