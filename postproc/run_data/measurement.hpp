#pragma once
// A number read from a run: what it is, its uncertainty, the rows it comes from and the rule.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "results-schema/file.hpp"

namespace mpfem {

/// The rows that a number was read from. Ranges are lowest and highest value of these rows.
struct Window {
  int stage = 0;                            ///< as in the scenario
  std::string stage_type;                   ///< empty where it is not known
  std::size_t first_row = 0, last_row = 0;  ///< rows of the history, both included
  std::string strain_name = "axial_strain"; ///< which strain; `method` says where it is counted from
  std::array<double, 2> strain{};           ///< 1
  std::string stress_name = "axial_stress"; ///< which stress
  std::array<double, 2> stress{};           ///< MPa
};

/// The snapshot that a number was read from, for numbers that do not come from rows of the history.
struct SnapshotWindow {
  int number = 0;                               ///< from 0
  double relative_density = 0, mean_stress = 0; ///< 1, MPa
  int stage = 0;                                ///< as in the scenario, of the history's row nearest in time
  std::string stage_type;                       ///< empty where it is not known
};

/// A number read from a run, with everything that is needed to judge it.
struct Measurement {
  std::string metric;
  double value = 0; ///< NaN (null in the file) where the run has no such number; a note says why
  std::string unit = "1";
  /// In the value's unit; 0 where the value is exact, NaN (null in the file) where it is not known how far it is off.
  double uncertainty = std::numeric_limits<double>::quiet_NaN();
  std::string uncertainty_meaning; ///< what it covers
  Window window;
  std::optional<SnapshotWindow> snapshot; ///< instead of `window`
  std::string method;                     ///< the rule in words, with the figures used
  std::string brief;                      ///< further numbers in words, for the line on the terminal
  nlohmann::ordered_json details;         ///< further numbers by name
  std::vector<std::string> notes;         ///< what a reader must know before using the number
};

/// Adds a note where the run is not complete, which its history alone does not show.
void note_unfinished(Measurement& measurement, const schema::FileReader& run);

/// The number, or null where it is empty.
nlohmann::ordered_json number_or_null(const std::optional<double>& number);

/// The content of the JSON file of a metric.
nlohmann::ordered_json to_json(const Measurement& measurement);

/// " ± 56"; empty where the uncertainty is not known (NaN).
std::string plus_minus(double uncertainty);

/// One line: "modulus: 1234 ± 56 MPa; BRIEF (stage 2, rows 401 … 433)", or "… (stage 2, snapshot 3)".
std::string to_text(const Measurement& measurement);

/// Lowest and highest of the values first … last, both included.
std::array<double, 2> range_of(const std::vector<double>& values, std::size_t first, std::size_t last);

} // namespace mpfem
