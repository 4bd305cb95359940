# awk -f ../common/verdict.awk -f references.awk runs.csv values.csv fig05/finite-elements.csv fig04/cohesive.csv
# die_transmission.csv one-grain/limits.csv: what the values of each scene should be, and their uncertainty:
# scene,quantity,reference,uncertainty,source,extrapolated.
#
# Spheres and hemispheres in elastic contact, the plastic pair and the scenes with friction have references of others:
# Hertz with the finite-sphere factor (tests/reference/README.md), axisymmetric finite elements, boundary elements,
# Cattaneo and Mindlin. The mean stress of 329 grains has the limits by one grain (studies/one-grain). All else is
# extrapolated from the runs that differ in mesh and element alone: tet4 and tet4-anp (tet4-patch has no part in the
# answer that it is measured by) tend to one answer q as their size x = tets^(-1/3), of hemispheres and caps the element
# size at the contact, vanishes,
#   value(element, x) = q + c(element) x^order(element),
# fitted by least squares to the finest four meshes of each element with all pairs of orders from 1 to 2. The reference
# is the middle of the q of all pairs that fit nearly as well as the best (at most 1.5 times its scatter, or 0.5 %,
# taken as the noise of single meshes), its uncertainty half of their range and the scatter. References of others are
# taken as good to 1 %, an assumption, but for the transmission of a die (die_uncertainty) and the limits by one grain;
# what the runs themselves tend to stands beside them.

BEGIN { FS = "," }
FNR == 1 { ++file; split("", column) }
/^#/ { next }
!(file in headed) { headed[file] = 1; read_header(); next } # a comment may stand before the header
file == 1 && $need("lever") == "mesh" && ($need("element") == "tet4" || $need("element") == "tet4-anp") {
  scene[$1] = $need("scene")
  element[$1] = $need("element")
  size[$1] = $2 ~ /^p/ ? 1 / $need("fineness") : $need("tets")^(-1 / 3)
}
file == 2 && $1 in scene {
  key = scene[$1] SUBSEP $2
  if (!(key in points)) order_of[++quantities] = key
  i = ++points[key]
  what[key, i] = element[$1]
  x[key, i] = size[$1]
  y[key, i] = $3
}
file == 3 && $need("approach") != "" { finite[$need("approach") + 0] = $need("table_1") }
file == 4 && $need("energy") == 0.1 && $need("lambda") == 2 { cohesive = $need("pull_off_over_jkr") }
file == 5 && $need("H_over_D") == 1 { through_die[$need("nu"), $need("mu")] = $need("transmission") }
file == 6 {
  density = $need("relative_density") + 0
  limit[density] = $need("mean_stress")
  limit_unsure[density] = $need("uncertainty")
}

# Fit of q, c(tet4), c(tet4-anp) with given orders; returns q, sets `scatter` (root mean square).
function fit(key, plain, averaged,   i, j, k, a, b, s, row, sum, count) {
  split("", a)
  split("", b)
  for (i = 1; i <= points[key]; ++i) {
    if (!used[key, i]) continue
    row[1] = 1
    row[2] = what[key, i] == "tet4" ? x[key, i]^plain : 0
    row[3] = what[key, i] == "tet4" ? 0 : x[key, i]^averaged
    for (j = 1; j <= 3; ++j) { for (k = 1; k <= 3; ++k) a[j, k] += row[j] * row[k]; b[j] += row[j] * y[key, i] }
  }
  # Gauss; the matrix is symmetric and positive.
  for (j = 1; j <= 3; ++j)
    for (i = j + 1; i <= 3; ++i) {
      s = a[i, j] / a[j, j]
      for (k = j; k <= 3; ++k) a[i, k] -= s * a[j, k]
      b[i] -= s * b[j]
    }
  for (j = 3; j >= 1; --j) { for (k = j + 1; k <= 3; ++k) b[j] -= a[j, k] * b[k]; b[j] /= a[j, j] }
  for (i = 1; i <= points[key]; ++i)
    if (used[key, i]) {
      sum += (y[key, i] - b[1] - (what[key, i] == "tet4" ? b[2] * x[key, i]^plain : b[3] * x[key, i]^averaged))^2
      ++count
    }
  scatter = sqrt(sum / count)
  return b[1]
}

# Sets best and uncertainty; false where there are too few runs.
function extrapolate(key,   i, j, rank, count, plain, averaged, q, least, low, high) {
  for (i = 1; i <= points[key]; ++i) {
    rank = 1
    for (j = 1; j <= points[key]; ++j) if (what[key, j] == what[key, i] && x[key, j] < x[key, i]) ++rank
    used[key, i] = rank <= finest
    if (used[key, i]) ++count[what[key, i]]
  }
  if (count["tet4"] < 2 || count["tet4-anp"] < 2 || count["tet4"] + count["tet4-anp"] < 5) return 0
  least = -1
  for (plain = 1; plain < 2.01; plain += 0.1)
    for (averaged = 1; averaged < 2.01; averaged += 0.1) {
      fit(key, plain, averaged)
      if (least < 0 || scatter < least) least = scatter
    }
  low = high = ""
  for (plain = 1; plain < 2.01; plain += 0.1)
    for (averaged = 1; averaged < 2.01; averaged += 0.1) {
      q = fit(key, plain, averaged)
      if (scatter > 1.5 * least && scatter > noise * absolute(q)) continue
      if (low == "" || q < low) low = q
      if (high == "" || q > high) high = q
    }
  best = (low + high) / 2
  uncertainty = (high - low) / 2 + (least > noise * best ? least : noise * best)
  return 1
}

# Force of an elastic sphere on a plane over E R^2, for an approach over R as seen from its centre, nu = 0.3.
function hertz(approach, factor) { return factor * 4 / 3 / (1 - 0.3^2) * approach^1.5 }

# Of a transmission t = exp(-4 mu K H/D): meshes agree within 1e-4, and the reference is linear, while the column, at
# the end of its press 0.2 % shorter, transmits more by 0.2 % of -log(t).
function die_uncertainty(t) { return 1e-4 - 0.002 * log(t) * t }

END {
  if (failed) exit 1
  finest = 4
  noise = 0.005
  taken_as = 0.01
  pi = atan2(0, -1)
  # Factors at 2 approach/R = 0.04 and 0.08, and for two spheres at approach/R = 0.01.
  known["hertz", "force-0.02"] = hertz(0.02, 1.068)
  known["hertz", "force-0.04"] = hertz(0.04, 1.105)
  source["hertz"] = "Hertz with the finite-sphere factor"
  for (h in finite) known["pair", "force-" h] = finite[h]
  source["pair"] = "axisymmetric finite elements"
  # Two spheres: half the reduced modulus and radius of one on a plane. Pull-off of JKR 1.5 pi w R/2.
  known["pull-off", "force-0.01"] = 1.030 * 4 / 3 / (2 * (1 - 0.3^2)) * sqrt(0.5) * 0.01^1.5
  known["pull-off", "pull-off"] = cohesive * 1.5 * pi * 0.1 * 0.05 / (5000 * 0.1^2)
  source["pull-off"] = "Hertz and boundary elements"
  # Differences from the theory over mu P, and a loss over that of the theory.
  known["partial-slip", "shear-force-loading"] = known["partial-slip", "shear-force-unloading"] = 1
  known["partial-slip", "loss"] = 1
  source["partial-slip"] = "Cattaneo and Mindlin"
  die["transmission-0.1"] = through_die["0.3", "0.1"]
  die["transmission-0.3"] = through_die["0.4", "0.3"]
  for (q in die) {
    known["die-column", q] = die[q]
    known_unsure["die-column", q] = die_uncertainty(die[q])
  }
  source["die-column"] = "axisymmetric finite elements"
  for (d in limit) {
    known["full", "mean-stress-" d] = limit[d]
    known_unsure["full", "mean-stress-" d] = limit_unsure[d]
  }
  source["full"] = "one grain"
  print "scene,quantity,reference,uncertainty,source,extrapolated,uncertainty_of_extrapolation"
  for (i = 1; i <= quantities; ++i) {
    key = order_of[i]
    split(key, part, SUBSEP)
    tends = extrapolate(key) ? sprintf("%.6g,%.2g", best, uncertainty) : ","
    if ((part[1], part[2]) in known) {
      value = known[part[1], part[2]]
      unsure = (part[1], part[2]) in known_unsure ? known_unsure[part[1], part[2]] : taken_as * value
      printf "%s,%s,%.6g,%.2g,%s,%s\n", part[1], part[2], value, unsure, source[part[1]], tends
    } else if (tends != ",")
      printf "%s,%s,%.6g,%.2g,%s,%s\n", part[1], part[2], best, uncertainty, "extrapolated", tends
  }
}
