# awk -f ../common/verdict.awk -f verdict.awk -v packing=full|smoke DESCRIPTION.toml spheres.csv target.csv size-distribution.csv
BEGIN { FS = "," }
FNR == 1 { ++file; split("", column) }

file == 1 && /^[ \t]*(count|relative_density|box)[ \t]*=/ {
  key = $0
  sub(/[ \t]*=.*$/, "", key)
  gsub(/[ \t]/, "", key)
  value = $0
  sub(/^[^=]*=[ \t]*/, "", value)
  sub(/#.*$/, "", value)
  gsub(/[][ \t]/, "", value)
  wanted[key] = value
}
file == 2 && FNR > 1 { ++n; for (axis = 1; axis <= 3; ++axis) x[n, axis] = $axis; radius[n] = $4 }
file == 3 && FNR > 1 { ++points; diameter[points] = $1; fraction[points] = $2 }
file == 4 && FNR > 1 {
  d = absolute($2 - target($1))
  if (d > distance) distance = d
}

# The target curve at a diameter.
function target(value,   i) {
  if (value <= diameter[1]) return fraction[1]
  for (i = 2; i <= points; ++i)
    if (value <= diameter[i])
      return fraction[i - 1] + (fraction[i] - fraction[i - 1]) * (value - diameter[i - 1]) / (diameter[i] - diameter[i - 1])
  return 1
}

# Smallest surface distance of two spheres, or of a sphere and a wall; by trying all pairs.
function smallest_gap(   i, j, axis, gap, least, square) {
  least = length_of[1]
  for (i = 1; i <= n; ++i) {
    for (axis = 1; axis <= 3; ++axis) {
      gap = x[i, axis] - radius[i]
      if (gap < least) least = gap
      gap = length_of[axis] - x[i, axis] - radius[i]
      if (gap < least) least = gap
    }
    for (j = 1; j < i; ++j) {
      square = 0
      for (axis = 1; axis <= 3; ++axis) square += (x[i, axis] - x[j, axis]) ^ 2
      gap = sqrt(square) - radius[i] - radius[j]
      if (gap < least) least = gap
    }
  }
  return least
}

END {
  if (!n || !points || split(wanted["box"], length_of, ",") != 3) {
    print "verdict: the description's box, the spheres or the target are missing" > "/dev/stderr"
    exit 1
  }
  for (i = 1; i <= n; ++i) solid += 4 / 3 * 3.14159265358979 * radius[i] ^ 3
  density = solid / (length_of[1] * length_of[2] * length_of[3])
  full = packing == "full"
  small = full ? "" : "the small packing is another one: " wanted["count"] " grains at " wanted["relative_density"] " were asked for"
  statement("Number of grains", "329", n "", full ? n == 329 : -1, small)
  statement("Relative density", "0.552", sprintf("%.4f", density), full ? absolute(density - 0.552) <= 0.0005 : -1, small)
  gap = smallest_gap()
  statement("No grain touches another or a wall: smallest gap", "> 0", sprintf("%.4f mm", gap), gap > 0, "")
  statement("The sizes follow the target curve: largest distance of the cumulative curves", "follows MCC CP-102", \
            sprintf("%.4f", distance), distance <= 1 / n, \
            "taken as agreement: at most one grain in all, 1/n; the paper's curve is drawn only")
  end_of_verdict()
}
