# For verdicts: reads a fits.json among their files. fit_of(MODEL, X, Y, N) is the number of the Nth fit of these columns, 0 if
# there is none; then fit_value, fit_low, fit_high[NUMBER, COEFFICIENT], fit_r2[NUMBER] and fit_points[NUMBER].
FILENAME ~ /fits\.json$/ {
  if (/^    "model":/) { fit_model[++fits] = json_value(); fit_axis = "" }
  else if (/^    "r_squared":/) fit_r2[fits] = json_value() + 0
  else if (/^    "points":/) fit_points[fits] = json_value()
  else if (/^    "(x|y|z)": [{]/) fit_axis = substr($0, 6, 1)
  else if (/^      "column":/) fit_column[fits, fit_axis] = json_value()
  else if (/^      "[A-Za-z_0-9]+": [{]/ && fit_axis == "") { split($0, fit_word, "\""); fit_name = fit_word[2] }
  else if (/^        "value":/ && fit_axis == "") fit_value[fits, fit_name] = json_value() + 0
  else if (/^        "low":/ && fit_axis == "") fit_low[fits, fit_name] = json_value() + 0
  else if (/^        "high":/ && fit_axis == "") fit_high[fits, fit_name] = json_value() + 0
  next
}
function json_value(   text) {
  text = $0
  sub(/^[^:]*: */, "", text)
  gsub(/[",]/, "", text)
  return text
}
function fit_of(model, x, y, n,   i) {
  for (i = 1; i <= fits; ++i) if (fit_model[i] == model && fit_column[i, "x"] == x && fit_column[i, "y"] == y && --n <= 0) return i
  return 0
}
function interval(number, name, format) {
  if (!((number, name) in fit_value)) return "not determined by the points"
  return sprintf(format " [" format ", " format "]", fit_value[number, name], fit_low[number, name], fit_high[number, name])
}
function percent(x) { return sprintf("%.2g %%", 100 * x) }

# Tables: rows with an empty field count as what could not be measured.
FNR == 1 { ++table; split("", column); read_header(); next }

# Of quality.csv, for the statement that follows from it.
FILENAME ~ /quality\.csv$/ {
  if ($need("kinetic_over_internal") > largest_kinetic) { largest_kinetic = $need("kinetic_over_internal"); kinetic_name = $1 }
  if ($need("residual_over_work") > largest_residual) { largest_residual = $need("residual_over_work"); residual_name = $1 }
  if ($need("imbalance") != "" && $need("imbalance") > largest_imbalance) { largest_imbalance = $need("imbalance"); imbalance_name = $1 }
  next
}
function quality_statements() {
  statement("The loading is quasi-static: largest kinetic over internal energy while it is measured", "quasi-static", \
            percent(largest_kinetic) " (" kinetic_name ")", largest_kinetic <= 0.02, "taken as quasi-static: at most 2 %")
  statement("Opposite z walls bear the same: mean difference over the axial stress", "quasi-static", \
            percent(largest_imbalance) " (" imbalance_name ")", largest_imbalance <= 0.05, "own requirement: at most 5 %")
  statement("The energy balance closes: largest residual over the work of the walls since the branch began", "not stated", \
            percent(largest_residual) " (" residual_name ")", largest_residual <= 0.01, "own requirement: at most 1 %")
}
