#include "postproc/measurement.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/one_line.hpp"

namespace mpfem {

void note_unfinished(Measurement& m, const schema::FileReader& run) {
  const std::string status = run.read_scalar(schema::run::provenance_status);
  if (status != "complete")
    m.notes.push_back(fmt::format("the run is not complete ({}): its last stage may end early", one_line(status)));
}

nlohmann::ordered_json to_json(const Measurement& m) {
  nlohmann::ordered_json json = {{"metric", m.metric},
                                 {"value", m.value},
                                 {"unit", m.unit},
                                 {"uncertainty", m.uncertainty},
                                 {"uncertainty_meaning", m.uncertainty_meaning},
                                 {"method", m.method}};
  const Window& w = m.window;
  json["window"] = {
      {"stage", w.stage},
      {"stage_type", w.stage_type.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(w.stage_type)},
      {"first_row", w.first_row},
      {"last_row", w.last_row},
      {w.strain_name, w.strain},
      {fmt::format("{}_MPa", w.stress_name), w.stress}};
  for (const auto& [name, value] : m.details.items()) json[name] = value;
  json["notes"] = m.notes;
  return json;
}

std::string to_text(const Measurement& m) {
  return fmt::format("{}: {:.5g} ± {:.2g}{}{}{} ({}rows {} … {})\n", m.metric, m.value, m.uncertainty,
                     m.unit == "1" ? "" : fmt::format(" {}", m.unit), m.brief.empty() ? "" : "; ", m.brief,
                     m.window.stage < 0 ? "" : fmt::format("stage {}, ", m.window.stage), m.window.first_row,
                     m.window.last_row);
}

std::array<double, 2> range_of(const std::vector<double>& values, std::size_t first, std::size_t last) {
  const auto [low, high] = std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(first),
                                               values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  return {*low, *high};
}

} // namespace mpfem
