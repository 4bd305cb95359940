# awk -f ../common/verdict.awk -f points.awk cost.csv references.csv runs.csv values.csv: error and cost of every case,
# a row for each measure of its scene: force (hertz, flattened, pair), axial-stress (confined), pull-off, mean-stress,
# recovery, modulus (small, full), shear-force, loss (partial-slip), transmission (die-column).
#
# error: mean of |value/reference - 1| over the quantities of the measure; bias: the same with signs; uncertainty: that
# of the references, likewise. work: steps x tets x ns of the element per tet-step (cost.csv), in seconds of one core;
# in mixed precision (lever "precision") times the row "mixed" of cost.csv.
# on_front: no cheaper case of the scene and measure has a smaller error, where errors below the reference's uncertainty
# are equal to it.

BEGIN { FS = ","; OFS = "," }
FNR == 1 { ++file; split("", column); read_header(); next }
/^#/ { next }
file == 1 { ns[$1] = $2; next }
file == 2 { reference[$1, $2] = $3; unsure[$1, $2] = $4 / $3; if ($4 < 0 || $3 == 0) exit 1; next }
file == 3 {
  name = $1
  of_scene[name] = $need("scene")
  settings[name] = $1 OFS $2 OFS $3 OFS $4 OFS $5 OFS $6 OFS $7 OFS $8
  element[name] = $need("element")
  factor[name] = $need("lever") == "precision" ? ns["mixed"] : 1
  tets[name] = $need("tets")
  steps[name] = $need("steps")
  steps_all[name] = $need("steps_all")
  seconds[name] = $need("processor_time")
  seconds_all[name] = $need("processor_time_all")
  next
}
# At 0.70 a packing has hardly jammed and its reference is the least certain: it is in the tables of values only.
file == 4 && $2 == "mean-stress-0.7" { next }
file == 4 && ($1 in of_scene) && (of_scene[$1], $2) in reference {
  measure = $2
  sub(/-([0-9.]+|loading|unloading)$/, "", measure)
  if (of_scene[$1] == "pull-off") measure = "pull-off"
  key = $1 SUBSEP measure
  if (!(key in count)) order[++n] = key
  d = $3 / reference[of_scene[$1], $2] - 1
  bias[key] += d
  error[key] += absolute(d)
  doubt[key] += absolute(unsure[of_scene[$1], $2])
  ++count[key]
}

END {
  if (failed) exit 1
  for (i = 1; i <= n; ++i) {
    key = order[i]
    split(key, part, SUBSEP)
    name = part[1]
    later = part[2] == "recovery" || part[2] == "modulus"
    work[key] = (later ? steps_all[name] : steps[name]) * tets[name] * ns[element[name]] * factor[name] * 1e-9
    spent[key] = later ? seconds_all[name] : seconds[name]
    error[key] /= count[key]
    bias[key] /= count[key]
    doubt[key] /= count[key]
    seen[key] = error[key] > doubt[key] ? error[key] : doubt[key]
    group[key] = of_scene[name] SUBSEP part[2]
  }
  print "case,scene,lever,element,fineness,penalty_factor,speed_factor,mass_factor,measure,tets,steps,work [s]," \
        "processor_time [s],error,bias,uncertainty,on_front"
  for (i = 1; i <= n; ++i) {
    key = order[i]
    split(key, part, SUBSEP)
    front = 1
    for (j = 1; j <= n; ++j)
      if (j != i && group[order[j]] == group[key] && work[order[j]] <= work[key] && seen[order[j]] <= seen[key] && \
          (work[order[j]] < work[key] || seen[order[j]] < seen[key])) front = 0
    print settings[part[1]], part[2], tets[part[1]], \
          (part[2] == "recovery" || part[2] == "modulus" ? steps_all[part[1]] : steps[part[1]]), \
          sprintf("%.4g,%s,%.5f,%.5f,%.5f,%d", work[key], spent[key], error[key], bias[key], doubt[key], front)
  }
}
