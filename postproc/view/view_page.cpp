#include "postproc/view/view_page.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/drawing/field_display.hpp"
#include "postproc/files/base64.hpp"
#include "postproc/view/view_data.hpp"
#include "postproc/view/view_page_text.hpp" // generated from view_page.html

namespace mpfem {

namespace {

template <class Whole>
void append(std::string& bytes, const std::vector<Whole>& values) {
  const auto raw = std::as_bytes(std::span(values));
  bytes.append(reinterpret_cast<const char*>(raw.data()), raw.size()); // little endian, as the page expects
}

std::string binary_part(const ViewData& data) {
  std::string bytes;
  append(bytes, data.facet);
  append(bytes, data.tet);
  append(bytes, data.grain);
  for (const ViewState& state : data.states) {
    append(bytes, state.position);
    for (const auto& values : state.value) append(bytes, values);
    append(bytes, state.tool_position);
    append(bytes, state.tool_normal);
    append(bytes, state.rod_end);
    append(bytes, state.rod_kind);
    append(bytes, state.rod_width);
  }
  return bytes;
}

/// Compresses to the zlib format (RFC 1950), which browsers call "deflate".
std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), 9) != Z_OK)
    throw SimulationError("the grains cannot be compressed: there is not enough memory");
  result.resize(size);
  return result;
}

nlohmann::json head_of(const ViewData& data) {
  nlohmann::json head{{"nodes", data.nodes()},
                      {"facets", data.facet.size() / 3},
                      {"tets", data.tet.size() / 4},
                      {"low", data.low},
                      {"high", data.high},
                      {"widest_rod", data.widest_rod},
                      {"tool_low", data.tool_low},
                      {"tool_high", data.tool_high},
                      {"fields", nlohmann::json::array()},
                      {"states", nlohmann::json::array()}};
  for (const QuantisedField& field : data.fields)
    head["fields"].push_back({{"label", with_unit(field_label(field.name), field.unit)},
                              {"range", {field.range.first, field.range.second}},
                              {"sparse", field.sparse},
                              {"ends", field.ends}});
  for (const ViewState& state : data.states)
    head["states"].push_back({{"relative_density", state.relative_density},
                              {"mean_stress", state.mean_stress},
                              {"tool_corners", state.tool_position.size() / 3},
                              {"rods", state.rod_kind.size()},
                              {"box_low", state.box_low},
                              {"box_high", state.box_high}});
  const auto densest = std::max_element(data.states.begin(), data.states.end(),
                                        [](const auto& a, const auto& b) { return a.mean_stress < b.mean_stress; });
  head["start"] = densest - data.states.begin();
  return head;
}

void replace(std::string& text, const std::string& mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

} // namespace

std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

std::string view_page(const ViewData& data, const std::string& title) {
  std::string page(view_page_text);
  replace(page, "@HEAD@", head_of(data).dump());
  replace(page, "@TITLE@", html_text(one_line(title)));
  replace(page, "@DATA@", base64(compressed(binary_part(data))));
  return page;
}

std::string view_page_of_run(const schema::FileReader& file, int most, const std::string& title) {
  const std::vector<Snapshot> snapshots = spread_snapshots(file, most);
  return view_page(view_data(snapshots, rods_of(file, snapshots)), title);
}

std::vector<Snapshot> spread_snapshots(const schema::FileReader& file, int most) {
  const int count = static_cast<int>(file.snapshots().size());
  if (count == 0) throw InputError(fmt::format("{}: the run has no snapshots", one_line(file.path())));
  const int shown = std::min(count, most);
  std::vector<Snapshot> snapshots;
  for (int i = 0; i < shown; ++i)
    snapshots.push_back(read_snapshot(file, shown == 1 ? count - 1 : i * (count - 1) / (shown - 1)));
  return snapshots;
}

} // namespace mpfem
