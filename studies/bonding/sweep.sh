#!/bin/sh
# sweep.sh BIN PACKING FOLDER [PREFIX...]: pulls the packing apart with both softening laws, two fracture energies and
# three penalties, in FOLDER, PREFIX (RUN of Makefile.studies) before each run; the table on standard output. What has
# been run already is not run again.
set -eu
bin=$1
packing=$2
folder=$3
shift 3
here=studies/bonding
columns='softening,fracture_energy [N/mm],penalty_factor,peak_tension [MPa],strain_at_peak,mean_damage_before'
columns=$columns',mean_damage_at_peak,damage_dissipation [mJ],tension_at_end [MPa],energy_residual_over_work'
echo "$columns"
for law in exponential energy; do
  for energy in 0.05 0.5; do
    for factor in 3 10 30; do
      name=$law-$energy-$factor
      run=$folder/$name.h5
      [ -e "$run" ] || {
        "$@" "$bin/mpfem" run $here/pulling.toml -o "$folder/new-$name.h5" --set "packing=$packing" \
          --set "bond.softening=$law" --set "bond.fracture_energy=$energy" --set "contact.stiffness_factor=$factor" \
          --threads 1 --resume
        rm -f "$folder/new-$name."*.checkpoint.h5
        mv "$folder/new-$name.h5" "$run"
      }
      "$bin/postproc" curve "$run" --quiet -o "$folder/$name.csv"
      awk -f studies/common/verdict.awk -f $here/strength.awk -v "label=$law,$energy,$factor" "$folder/$name.csv"
    done
  done
done
