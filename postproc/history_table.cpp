#include "postproc/history_table.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "common/stage_energy.hpp"

namespace mpfem {

namespace {

template <class T, int Rank>
std::vector<double> as_double(const schema::FileReader& file, const schema::DatasetDescription& line) {
  const auto values = file.read(schema::Dataset<T, Rank>{line});
  return {values.begin(), values.end()};
}

std::vector<double> read_numbers(const schema::FileReader& file, const schema::DatasetDescription& line) {
  switch (line.type) {
  case schema::ElementType::float64:
    return line.rank == 1 ? as_double<double, 1>(file, line) : as_double<double, 2>(file, line);
  case schema::ElementType::float32:
    return line.rank == 1 ? as_double<float, 1>(file, line) : as_double<float, 2>(file, line);
  case schema::ElementType::int32:
    return line.rank == 1 ? as_double<std::int32_t, 1>(file, line) : as_double<std::int32_t, 2>(file, line);
  case schema::ElementType::int64:
    return line.rank == 1 ? as_double<std::int64_t, 1>(file, line) : as_double<std::int64_t, 2>(file, line);
  case schema::ElementType::string:
    break;
  }
  throw InputError(fmt::format("{}: dataset {} holds no numbers", one_line(file.path()), line.path));
}

} // namespace

HistoryTable::HistoryTable(const schema::FileReader& file) : path_(one_line(file.path())) {
  constexpr std::string_view group = "/history/";
  for (const schema::DatasetDescription& line : schema::run::all) {
    if (!line.path.starts_with(group) || (!line.required && !file.has(line))) continue;
    const std::string name(line.path.substr(group.size()));
    const std::vector<double> values = read_numbers(file, line);
    const std::size_t width = line.rank == 1 ? 1 : line.extent[1].fixed;
    for (std::size_t c = 0; c < width; ++c) {
      Column column{width == 1 ? name : fmt::format("{}_{}", name, c), std::string(line.unit), {}};
      for (std::size_t i = c; i < values.size(); i += width) column.values.push_back(values[i]);
      columns_.push_back(std::move(column));
    }
  }
  if (rows() == 0) throw InputError(fmt::format("{}: the history has no rows", path_));
}

bool HistoryTable::has(std::string_view name) const {
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
}

const Column& HistoryTable::column(std::string_view name) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
  if (found != columns_.end()) return *found;
  std::vector<std::string> names;
  for (const Column& c : columns_) names.push_back(c.name);
  const auto near = nearest_word(name, names);
  throw InputError(fmt::format("{}: no column '{}'; {}", path_, one_line(name),
                               near ? fmt::format("did you mean '{}'?", *near)
                                    : fmt::format("allowed: {}", fmt::join(names, ", "))));
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
    if (selected.size() == before) selected.push_back(&column(name));
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
