# awk -f runs.awk -v work=FOLDER -v cases='CASE ...' cases.csv [kept.csv]: a row for every case that is run or kept: its
# settings, tets, steps, processor seconds, and how quasi-static it was. 'all' stands for the run with what goes on from
# it (unloading and reloading).

BEGIN {
  FS = ","
  OFS = ","
  many = split(cases, list, " ")
  for (i = 1; i <= many; ++i) requested[list[i]] = 1
  print "case,scene,lever,element,fineness,penalty_factor,speed_factor,mass_factor,tets,steps,steps_all," \
        "processor_time [s],processor_time_all [s],kinetic_over_internal,penetration_over_h"
}

/^#/ || FNR == 1 { if (FNR == 1) ++file; next }
file == 1 { row[++n] = $1; settings[$1] = $1 OFS $2 OFS $3 OFS $4 OFS $5 OFS $6 OFS $7 OFS $8; next }
file == 2 { kept[$1] = 1; number[$1, $2] = $3 }

# Of a summary, a line a number; empty where the file is not there.
function value_of(file, key,   found, line, part) {
  found = ""
  while ((getline line < file) > 0)
    if (split(line, part, ",") == 2 && part[1] == key) found = part[2]
  close(file)
  return found
}
function sum_of(file,   line, sum) {
  while ((getline line < file) > 0) sum += line
  close(file)
  return sum
}

END {
  for (i = 1; i <= n; ++i) {
    name = row[i]
    file = work "/" name ".summary.csv"
    later = work "/" name ".recovery.summary.csv"
    if (name in requested) {
      steps = value_of(file, "steps")
      all = value_of(later, "steps") # goes on counting
      seconds = sum_of(work "/" name ".seconds")
      print settings[name], value_of(file, "tets"), steps, (all == "" ? steps : all), seconds, \
            seconds + (all == "" ? 0 : sum_of(work "/" name ".recovery.seconds")), \
            value_of(file, "largest_kinetic_over_internal_under_load"), value_of(file, "largest_penetration_over_h")
    } else if (name in kept)
      print settings[name], number[name, "tets"], number[name, "steps"], number[name, "steps_all"], \
            number[name, "processor_time"], "", "", ""
  }
}
