# awk -f ../common/verdict.awk -f tables.awk -v table=NAME points.csv [values.csv references.csv]: tables of the page,
# in Markdown.
#
#   advice      what to choose for an error of the mean stress of 329 grains
#   choice      cheapest settings for 10, 3 and 1 % of error, scene by scene: each element at default settings, and of
#               all cases
#   meshes      error of all elements over meshes, scene by scene
#   levers      what each lever does to error and work, against the default of the same mesh
#   surface     contact by facets and by the smooth surface, over meshes
#   equal       at which mesh and work the other elements have the error of plain tets
#   locking     values of the sphere over meshes, and what they tend to
#   packing     values of the packings, likewise
#   partial-slip, die-column   error of each quantity of the scene and what it costs

BEGIN {
  FS = ","
  elements = split("tet4 tet4-anp tet4-patch", type, " ")
}
FNR == 1 { ++file; split("", column); read_header(); next }
file == 1 {
  group = $need("scene") SUBSEP $need("measure")
  if (!(group in cases)) group_of[++groups] = group
  i = ++cases[group]
  name[group, i] = $1
  lever[group, i] = $need("lever")
  element[group, i] = $need("element")
  fineness[group, i] = $need("fineness")
  penalty[group, i] = $need("penalty_factor")
  speed[group, i] = $need("speed_factor")
  mass[group, i] = $need("mass_factor")
  tets[group, i] = $need("tets")
  work[group, i] = work_of[$1] = $need("work")
  spent_of[$1] = $need("processor_time")
  error[group, i] = $need("error")
  bias[group, i] = $need("bias")
  doubt[group] = $need("uncertainty")
  scene_of[$1] = $need("scene")
  tets_of[$1] = $need("tets")
  fineness_of[$1] = $need("fineness")
  element_of[$1] = $need("element")
  lever_of[$1] = $need("lever")
  if ($need("on_front")) front[group, i] = 1
  next
}
file == 2 { value[$1, $2] = $3; next }
file == 3 {
  quantity[++quantities] = $1 SUBSEP $2
  reference[$1, $2] = $3
  unsure[$1, $2] = $4
  source[$1, $2] = $5
  tends[$1, $2] = $6
  tends_unsure[$1, $2] = $7
}

function title(scene, measure) {
  if (scene == "hertz") return "elastic sphere on planes: force"
  if (scene == "flattened") return "sphere flattened between planes: force"
  if (scene == "confined") return "sphere in a die: axial stress"
  if (scene == "pair") return "two plastic hemispheres: force"
  if (scene == "pull-off") return "bonded elastic hemispheres: force and pull-off"
  if (scene == "partial-slip") return "two caps that slip: " (measure == "loss" ? "loss per cycle" : "shear force")
  if (scene == "die-column") return "column that rubs in a die: transmission"
  return (scene == "small" ? "25 grains: " : "329 grains: ") \
         (measure == "mean-stress" ? "mean stress" : measure == "recovery" ? "elastic recovery" : "E_p")
}
function unit(scene) {
  if (scene == "small" || scene == "full") return "h = %s mm"
  if (scene == "pair" || scene == "pull-off" || scene == "partial-slip") return "%s elements in the contact radius"
  return "R/h = %s"
}
function percent(x) { return sprintf(absolute(x) < 0.0995 ? "%.1f %%" : "%.0f %%", 100 * x) }
function signed(x) { return (x < 0 ? "−" : "+") percent(absolute(x)) }
function ratio(x) { return sprintf(x < 9.95 ? "%.1f" : "%.0f", x) }
function seconds(x) {
  return x < 9.95 ? sprintf("%.2g s", x) : x < 600 ? sprintf("%.0f s", x) : sprintf("%.0f min", x / 60)
}
function thousands(n) { return n < 1000 ? n "" : thousands(int(n / 1000)) sprintf(",%03d", n % 1000) }
# What of penalty, speed and mass is not the default's.
function moved(group, i) {
  return (penalty[group, i] != 10 ? ", K = " penalty[group, i] " E/h" : "") \
         (speed[group, i] != 1 ? ", " speed[group, i] " × speed" : "") \
         (mass[group, i] != 1 ? ", " mass[group, i] " × mass" : "")
}
function settings(group, i,   text, part) {
  split(group, part, SUBSEP)
  text = "`" element[group, i] "`, " sprintf(unit(part[1]), fineness[group, i])
  text = text moved(group, i)
  if (lever[group, i] == "pace") text = text ", `quasi_static`"
  if (lever[group, i] == "precision") text = text ", mixed precision"
  if (lever[group, i] == "surface") text = text ", smooth surface"
  return text " (" thousands(tets[group, i]) " tets, " seconds(work[group, i]) ")"
}

# Cheapest case of a group with an error of at most `most`: of one element at default settings, finer ones included (an
# error that is small by chance and grows again does not count), or of all cases (element "").
function cheapest(group, which, most,   i, j, found, good) {
  found = 0
  for (i = 1; i <= cases[group]; ++i) {
    if (error[group, i] > most || (which != "" && (element[group, i] != which || lever[group, i] != "mesh"))) continue
    good = 1
    if (which != "")
      for (j = 1; j <= cases[group]; ++j)
        if (element[group, j] == which && lever[group, j] == "mesh" && tets[group, j] > tets[group, i] && \
            error[group, j] > most) good = 0
    if (good && (!found || work[group, i] < work[group, found])) found = i
  }
  return found
}
# The head of a table: what stands first, a heading for each element from number `from` on, what stands last.
function heads(first, from, each, last,   e, line) {
  line = first
  for (e = from; e <= elements; ++e) line = line " | `" type[e] "`" each
  line = line last " |"
  print line
  gsub(/[^|]+/, "---", line)
  print line
}
# A mesh with its tets and work, as a cell of the table.
function mesh_and_work(group, i,   part) {
  split(group, part, SUBSEP)
  return sprintf(unit(part[1]), fineness[group, i]) ", " thousands(tets[group, i]) " tets, " seconds(work[group, i])
}
function choice(   g, t, i, cell, mark, marks, e, first) {
  heads("| scene and measure | error", 1, ", default", " | cheapest of all cases")
  marks = split("0.10 0.03 0.01", mark, " ")
  for (g = 1; g <= groups; ++g) {
    split(group_of[g], part, SUBSEP)
    for (t = 1; t <= marks; ++t) {
      cell = ""
      first = t == 1 ? title(part[1], part[2]) : ""
      if (mark[t] < doubt[group_of[g]]) {
        printf "| %s | %d %% | uncertainty of the reference: %s | | | |\n", first, 100 * mark[t] + 0.5, \
               percent(doubt[group_of[g]])
        break
      }
      for (e = 1; e <= elements; ++e) {
        i = cheapest(group_of[g], type[e], mark[t])
        cell = cell " | " (i ? mesh_and_work(group_of[g], i) : "none")
      }
      i = cheapest(group_of[g], "", mark[t])
      printf "| %s | %d %%%s | %s |\n", first, 100 * mark[t] + 0.5, cell, i ? settings(group_of[g], i) : "none"
    }
  }
}

# Errors to expect and cases are chosen by hand; what these cases gave follows from the tables.
function advised(expect, case, words,   group, i) {
  group = "full" SUBSEP "mean-stress"
  for (i = 1; i < cases[group] && name[group, i] != case; ++i) continue
  printf "| %s | %s | %s, %s | %s |\n", expect, words, signed(error_of(case, "mean-stress-0.8")), \
         signed(error_of(case, "mean-stress-0.92")), seconds(work[group, i])
}
function error_of(case, what) { return value[case, what] / reference["full", what] - 1 }
function advice() {
  print "| error of the mean stress to expect | element and contact surface | element size h | walls" \
        " | measured at 0.80 and 0.92 | work to compact 329 grains to 0.92 |"
  print "|---|---|---|---|---|---|"
  advised("10 %", "full-tet4-anp-0.05-smooth-speed-2", "`tet4-anp`, smooth | R/1.4 (0.05 mm) | 8 m/s")
  advised("3 %", "full-tet4-anp-0.05-smooth", "`tet4-anp`, smooth | R/1.4 (0.05 mm) | 4 m/s")
  advised("for comparison: the paper's mesh", "full-tet4-0.015", "`tet4`, facets | R/4.7 (0.015 mm) | 4 m/s")
}

function meshes(   g, i, j, e, n, part, rows, seen, at) {
  heads("| scene and measure | mesh | tets", 1, ": error | work", "")
  for (g = 1; g <= groups; ++g) {
    split(group_of[g], part, SUBSEP)
    rows = 0
    split("", seen)
    split("", at)
    for (i = 1; i <= cases[group_of[g]]; ++i) {
      if (lever[group_of[g], i] != "mesh") continue
      n = fineness[group_of[g], i]
      if (!(n in seen)) {
        seen[n] = 1
        mesh[++rows] = n
        count[rows] = tets[group_of[g], i]
      }
      at[n, element[group_of[g], i]] = i
    }
    for (j = 1; j <= rows; ++j) {
      printf "| %s | %s | %s", j == 1 ? title(part[1], part[2]) : "", sprintf(unit(part[1]), mesh[j]), \
             thousands(count[j])
      for (e = 1; e <= elements; ++e) {
        i = at[mesh[j], type[e]]
        printf " | %s | %s", i ? signed(bias[group_of[g], i]) : "", i ? seconds(work[group_of[g], i]) : ""
      }
      print " |"
    }
  }
}

function default_of(group, i,   j) {
  for (j = 1; j <= cases[group]; ++j)
    if (lever[group, j] == "mesh" && element[group, j] == element[group, i] && \
        fineness[group, j] == fineness[group, i]) return j
  return 0
}
# LEVER:VALUE of a case: the column of its cell.
function lever_and_value(group, i,   at) {
  at = ""
  if (lever[group, i] == "penalty") at = penalty[group, i]
  if (lever[group, i] == "speed") at = speed[group, i]
  if (lever[group, i] == "mass") at = mass[group, i]
  if (lever[group, i] == "precision") at = "mixed"
  return lever[group, i] ":" at
}
function levers(   g, i, d, part, key, k, many, what) {
  print "| scene and measure | mesh, element | default | K = 1 | 3 | 30 | 100 E/h | ½ × speed | 2 × | 4 ×" \
        " | `quasi_static` | 4 × mass | 16 × | mixed precision |"
  print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  many = split("penalty:1 penalty:3 penalty:30 penalty:100 speed:0.5 speed:2 speed:4 pace: mass:4 mass:16 " \
               "precision:mixed", what, " ")
  for (g = 1; g <= groups; ++g) {
    split(group_of[g], part, SUBSEP)
    split("", cell)
    split("", seen)
    rows = 0
    for (i = 1; i <= cases[group_of[g]]; ++i) {
      if (lever[group_of[g], i] == "mesh" || lever[group_of[g], i] == "surface") continue
      d = default_of(group_of[g], i)
      if (!d) continue
      if (!(d in seen)) { seen[d] = 1; at[++rows] = d }
      key = lever_and_value(group_of[g], i)
      cell[d, key] = signed(bias[group_of[g], i]) sprintf(" (%.2g)", work[group_of[g], i] / work[group_of[g], d])
    }
    for (k = 1; k <= rows; ++k) {
      d = at[k]
      printf "| %s | %s, `%s` | %s", k == 1 ? title(part[1], part[2]) : "", \
             sprintf(unit(part[1]), fineness[group_of[g], d]), element[group_of[g], d], signed(bias[group_of[g], d])
      for (i = 1; i <= many; ++i) printf " | %s", cell[d, what[i]]
      print " |"
    }
  }
}

function with_sign(group, i) { return percent(error[group, i]) " (" signed(bias[group, i]) ")" }
function surface(   g, i, d, part, rows) {
  print "| scene and measure | mesh, element | facets: error, with sign | smooth surface |"
  print "|---|---|---|---|"
  for (g = 1; g <= groups; ++g) {
    split(group_of[g], part, SUBSEP)
    rows = 0
    for (i = 1; i <= cases[group_of[g]]; ++i) {
      if (lever[group_of[g], i] != "surface") continue
      d = moved(group_of[g], i) == "" ? default_of(group_of[g], i) : 0
      printf "| %s | %s, `%s`%s | %s | %s |\n", rows++ ? "" : title(part[1], part[2]), \
             sprintf(unit(part[1]), fineness[group_of[g], i]), element[group_of[g], i], moved(group_of[g], i), \
             d ? with_sign(group_of[g], d) : "", with_sign(group_of[g], i)
    }
  }
}

# Work and tets at which an element, at default settings, has a given error: log-log between its meshes, and a little
# beyond the finest. Sets equal_tets, equal_work, and equal_mark: '<' where its coarsest mesh is better already, '~'
# beyond its finest, '>' where that would be more than 1.5 times as fine.
function equal_at(group, which, wish,   i, n, at, t, low, high) {
  n = 0
  for (i = 1; i <= cases[group]; ++i) # from coarse to fine, as cases.csv has them
    if (lever[group, i] == "mesh" && element[group, i] == which) at[++n] = i
  equal_mark = n < 2 ? ">" : ""
  if (n < 2) return
  if (error[group, at[1]] <= wish) {
    equal_mark = "<"
    equal_tets = tets[group, at[1]]
    equal_work = work[group, at[1]]
    return
  }
  for (i = 2; i < n && error[group, at[i]] > wish; ++i) continue
  low = at[i - 1]
  high = at[i]
  if (error[group, low] <= error[group, high]) { equal_mark = ">"; return }
  t = log(wish / error[group, low]) / log(error[group, high] / error[group, low])
  equal_tets = exp(log(tets[group, low]) + t * log(tets[group, high] / tets[group, low]))
  equal_work = exp(log(work[group, low]) + t * log(work[group, high] / work[group, low]))
  if (t > 1) equal_mark = equal_tets > 1.5 * tets[group, high] ? ">" : "~"
}
# Whether this is a finer mesh of plain tets that has no smaller error than the coarsest: it shows nothing about meshes.
function gains_nothing(group, i,   j) {
  for (j = 1; lever[group, j] != "mesh" || element[group, j] != "tet4"; ++j) continue
  return j < i && error[group, j] <= error[group, i]
}
function equal(   g, i, e, part, first, cell, any, less) {
  heads("| scene and measure | `tet4`: mesh | tets | work | error", 2, ": tets | work | times less work", "")
  for (g = 1; g <= groups; ++g) {
    split(group_of[g], part, SUBSEP)
    first = 1
    for (i = 1; i <= cases[group_of[g]]; ++i) {
      if (lever[group_of[g], i] != "mesh" || element[group_of[g], i] != "tet4" || \
          error[group_of[g], i] < doubt[group_of[g]] || gains_nothing(group_of[g], i)) continue
      cell = ""
      any = 0
      for (e = 2; e <= elements; ++e) {
        equal_at(group_of[g], type[e], error[group_of[g], i])
        if (equal_mark == ">") {
          cell = cell " | | |"
          continue
        }
        any = 1
        less = equal_mark == "<"
        cell = cell sprintf(" | %s%s | %s%s | %s%s", less ? "fewer than " : equal_mark == "~" ? "about " : "", \
                            thousands(int(equal_tets + 0.5)), less ? "less than " : "", seconds(equal_work), \
                            less ? "> " : "", ratio(work[group_of[g], i] / equal_work))
      }
      if (!any) continue
      printf "| %s | %s | %s | %s | %s%s |\n", first ? title(part[1], part[2]) : "", \
             sprintf(unit(part[1]), fineness[group_of[g], i]), thousands(tets[group_of[g], i]), \
             seconds(work[group_of[g], i]), percent(error[group_of[g], i]), cell
      first = 0
    }
  }
}

# Errors of a scene, a row for each mesh and element.
function errors(wanted,   q, k, i, c, part, line, rule) {
  line = "| mesh | tets | element"
  rule = "|---|---|---"
  k = 0
  for (q = 1; q <= quantities; ++q) {
    split(quantity[q], part, SUBSEP)
    if (part[1] != wanted) continue
    shown[++k] = part[2]
    line = line " | " heading(wanted, part[2])
    rule = rule "|---"
  }
  print line " | work | processor time |"
  print rule "|---|---|"
  for (i = 1; i <= many_names; ++i) {
    c = names[i]
    if (scene_of[c] != wanted) continue
    printf "| %s | %s | `%s`", sprintf(unit(wanted), fineness_of[c]), thousands(tets_of[c]), element_of[c]
    for (q = 1; q <= k; ++q) printf " | %s", signed(value[c, shown[q]] / reference[wanted, shown[q]] - 1)
    printf " | %s | %s |\n", seconds(work_of[c]), seconds(spent_of[c])
  }
  printf "| the reference is known to | | "
  for (q = 1; q <= k; ++q) printf "| %.2g %% ", 100 * unsure[wanted, shown[q]] / reference[wanted, shown[q]]
  print "| | |"
}

# Values of scenes, a row for each mesh and element.
function values(scenes, factors,   many, s, i, q, k, c, part, list, f, format) {
  many = split(scenes, list, " ")
  for (s = 1; s <= many; ++s) {
    line = "| mesh | tets | element"
    rule = "|---|---|---"
    k = 0
    for (q = 1; q <= quantities; ++q) {
      split(quantity[q], part, SUBSEP)
      if (part[1] != list[s]) continue
      shown[++k] = part[2]
      line = line " | " heading(part[1], part[2])
      rule = rule "|---"
    }
    print line " |"
    print rule "|"
    for (i = 1; i <= many_names; ++i) {
      c = names[i]
      if (scene_of[c] != list[s] || lever_of[c] != "mesh") continue
      printf "| %s | %s | `%s`", sprintf(unit(list[s]), fineness_of[c]), thousands(tets_of[c]), element_of[c]
      for (q = 1; q <= k; ++q)
        printf " | %s", (c, shown[q]) in value ? shown_value(list[s], shown[q], value[c, shown[q]]) : ""
      print " |"
    }
    printf "| reference | | "
    for (q = 1; q <= k; ++q)
      printf "| %s ± %s ", shown_value(list[s], shown[q], reference[list[s], shown[q]]), \
             shown_value(list[s], shown[q], unsure[list[s], shown[q]])
    print "|"
    print ""
  }
}
function heading(scene, q,   at) {
  at = q
  sub(/.*-/, "", at)
  if (q ~ /^force/) return "100 F/(E R²) at " at " R"
  if (q ~ /^axial-stress/) return "σ_z at D_r = " at " / MPa"
  if (q ~ /^mean-stress/) return "p at D_r = " at " / MPa"
  if (q ~ /^shear-force/) return at
  if (q == "loss") return "loss per cycle"
  if (q ~ /^transmission/) return "ν = " (at == "0.1" ? "0.3" : "0.4") ", μ = " at
  return q == "recovery" ? "R_E / %" : "E_p / MPa"
}
function shown_value(scene, q, x) {
  if (q ~ /^force/ || q == "recovery") return sprintf("%.3f", 100 * x)
  return sprintf(q == "modulus" ? "%.0f" : x < 9.95 ? "%.2f" : "%.1f", x)
}

END {
  if (failed) exit 1
  for (g = 1; g <= groups; ++g)
    for (i = 1; i <= cases[group_of[g]]; ++i)
      if (!(name[group_of[g], i] in met)) {
        met[name[group_of[g], i]] = 1
        names[++many_names] = name[group_of[g], i]
      }
  if (table == "advice") advice()
  if (table == "choice") choice()
  if (table == "meshes") meshes()
  if (table == "levers") levers()
  if (table == "surface") surface()
  if (table == "equal") equal()
  if (table == "locking") values("flattened confined")
  if (table == "packing") values("small full")
  if (table == "partial-slip" || table == "die-column") errors(table)
}
