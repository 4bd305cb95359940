#include "postproc/run_data/measurement.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/one_line.hpp"

namespace mpfem {

void note_unfinished(Measurement& m, const schema::FileReader& run) {
  const std::string status = run.read_scalar(schema::run::provenance_status);
  if (status != "complete")
    m.notes.push_back(fmt::format("the run is not complete ({}): its last stage may end early", one_line(status)));
}

namespace {

nlohmann::ordered_json text_or_null(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
}

nlohmann::ordered_json window_json(const Measurement& m) {
  if (m.snapshot)
    return {{"snapshot", m.snapshot->number},
            {"relative_density", m.snapshot->relative_density},
            {"mean_stress_MPa", m.snapshot->mean_stress},
            {"stage", m.snapshot->stage},
            {"stage_type", text_or_null(m.snapshot->stage_type)}};
  const Window& w = m.window;
  return {{"stage", w.stage},         {"stage_type", text_or_null(w.stage_type)},
          {"first_row", w.first_row}, {"last_row", w.last_row},
          {w.strain_name, w.strain},  {fmt::format("{}_MPa", w.stress_name), w.stress}};
}

std::string window_text(const Measurement& m) {
  if (m.snapshot) return fmt::format("stage {}, snapshot {}", m.snapshot->stage, m.snapshot->number);
  return fmt::format("{}rows {} … {}", m.window.stage < 0 ? "" : fmt::format("stage {}, ", m.window.stage),
                     m.window.first_row, m.window.last_row);
}

} // namespace

nlohmann::ordered_json number_or_null(const std::optional<double>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

nlohmann::ordered_json to_json(const Measurement& m) {
  nlohmann::ordered_json json = {{"metric", m.metric},
                                 {"value", m.value},
                                 {"unit", m.unit},
                                 {"uncertainty", m.uncertainty},
                                 {"uncertainty_meaning", m.uncertainty_meaning},
                                 {"method", m.method}};
  json["window"] = window_json(m);
  for (const auto& [name, value] : m.details.items()) json[name] = value;
  json["notes"] = m.notes;
  return json;
}

std::string plus_minus(double uncertainty) {
  return std::isnan(uncertainty) ? "" : fmt::format(" ± {:.2g}", uncertainty);
}

std::string to_text(const Measurement& m) {
  if (std::isnan(m.value)) return fmt::format("{}: none\n", m.metric);
  return fmt::format("{}: {:.5g}{}{}{}{} ({})\n", m.metric, m.value, plus_minus(m.uncertainty),
                     m.unit == "1" ? "" : fmt::format(" {}", m.unit), m.brief.empty() ? "" : "; ", m.brief,
                     window_text(m));
}

std::array<double, 2> range_of(const std::vector<double>& values, std::size_t first, std::size_t last) {
  const auto [low, high] = std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(first),
                                               values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  return {*low, *high};
}

} // namespace mpfem
