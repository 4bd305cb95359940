#include "postproc/run_data/history_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "common/stage_energy.hpp"

namespace mpfem {

namespace {

template <class T>
std::vector<double> as_double(const schema::FileReader& file, const schema::DatasetDescription& line,
                              const std::string& tool) {
  const auto values =
      line.rank == 1 ? file.read(schema::Dataset<T, 1>{line}, tool) : file.read(schema::Dataset<T, 2>{line}, tool);
  return {values.begin(), values.end()};
}

std::vector<double> read_numbers(const schema::FileReader& file, const schema::DatasetDescription& line,
                                 const std::string& tool) {
  switch (line.type) {
  case schema::ElementType::float64:
    return as_double<double>(file, line, tool);
  case schema::ElementType::float32:
    return as_double<float>(file, line, tool);
  case schema::ElementType::int32:
    return as_double<std::int32_t>(file, line, tool);
  case schema::ElementType::int64:
    return as_double<std::int64_t>(file, line, tool);
  case schema::ElementType::string:
    break;
  }
  throw InputError(fmt::format("{}: dataset {} has no numbers", one_line(file.path()), line.path));
}

} // namespace

HistoryTable::HistoryTable(const schema::FileReader& file, NotFinite not_finite) : path_(one_line(file.path())) {
  constexpr std::string_view group = "/history/";
  for (const schema::DatasetDescription& line : schema::run::all) {
    if (!line.path.starts_with(group)) continue;
    for (const std::string& tool : file.members(line)) add_columns(file, line, tool);
  }
  if (rows() == 0) throw InputError(fmt::format("{}: the history has no rows", path_));
  if (not_finite == NotFinite::refused && !not_finite_.empty())
    throw InputError(fmt::format("{}, allowed: finite numbers; postproc curve shows the rows", not_finite_));
}

void HistoryTable::add_columns(const schema::FileReader& file, const schema::DatasetDescription& line,
                               const std::string& tool) {
  if (!line.required && !file.has(line, tool)) return;
  std::string name(line.path.substr(line.path.find('/', 1) + 1));
  if (line.of_member()) name.replace(name.find('*'), 1, tool);
  const std::vector<double> values = read_numbers(file, line, tool);
  const std::size_t width = line.rank == 1 ? 1 : line.extent[1].fixed;
  if (!columns_.empty() && values.size() != width * rows())
    throw InputError(fmt::format("{}: dataset /history/{}: found {} rows, allowed: {}, as many as the history has",
                                 path_, one_line(name), values.size() / width, rows()));
  const auto bad = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (bad != values.end() && not_finite_.empty())
    not_finite_ = fmt::format("{}: dataset /history/{}, row {}: found {}", path_, one_line(name),
                              static_cast<std::size_t>(bad - values.begin()) / width, *bad);
  for (std::size_t c = 0; c < width; ++c) {
    Column column{width == 1 ? name : fmt::format("{}_{}", name, c), std::string(line.unit), {}};
    for (std::size_t i = c; i < values.size(); i += width) column.values.push_back(values[i]);
    columns_.push_back(std::move(column));
  }
}

double HistoryTable::section(std::size_t row) const {
  const double share = has("section_share") ? (*this)["section_share"][row] : 1.0;
  return (*this)["box_lengths_0"][row] * (*this)["box_lengths_1"][row] * share;
}

double HistoryTable::container_volume(std::size_t row) const {
  return section(row) * (*this)["box_lengths_2"][row];
}

bool HistoryTable::has(std::string_view name) const {
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
}

const Column& HistoryTable::column(std::string_view name) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
  if (found != columns_.end()) return *found;
  throw InputError(fmt::format("{}: {}", path_, unknown_column(name)));
}

std::string HistoryTable::unknown_column(std::string_view name) const {
  std::vector<std::string> names;
  for (const Column& c : columns_) names.push_back(c.name);
  return fmt::format("found no column '{}'{}", one_line(name), suggestion(name, names));
}

std::vector<const Column*> HistoryTable::select(const std::vector<std::string>& names) const {
  std::vector<const Column*> selected;
  for (const std::string& name : names) {
    const std::size_t before = selected.size();
    for (int component = 0;; ++component) {
      const std::string full = fmt::format("{}_{}", name, component);
      const auto found =
          std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == full; });
      if (found == columns_.end()) break;
      selected.push_back(&*found);
    }
    if (selected.size() > before) continue;
    if (!has(name)) throw InputError(fmt::format("{}: --columns: {}", path_, unknown_column(name)));
    selected.push_back(&column(name));
  }
  return selected;
}

std::vector<double> internal_energy(const HistoryTable& history) {
  const bool friction = history.has("friction_energy");
  std::vector<StageEnergyRow> rows;
  for (std::size_t row = 0; row < history.rows(); ++row) {
    rows.push_back({history["stage"][row],
                    history["elastic_energy"][row] + history["bond_energy"][row] + history["contact_energy"][row],
                    history["plastic_dissipation"][row] + history["damage_dissipation"][row]});
    if (!friction) continue;
    rows.back().stored += history["friction_energy"][row];
    rows.back().dissipated += history["friction_dissipation"][row];
  }
  return stage_internal_energy(rows);
}

} // namespace mpfem
