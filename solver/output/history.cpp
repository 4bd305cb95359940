#include "solver/output/history.hpp"

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "results-schema/descriptors.hpp"

namespace mpfem {

namespace {

static_assert(std::is_trivially_copyable_v<HistoryRow> && sizeof(HistoryRow) % sizeof(double) == 0);
constexpr std::size_t row_values = sizeof(HistoryRow) / sizeof(double);

using Rows = std::vector<HistoryRow>;

template <class T>
void write_column(schema::FileWriter& file, const Rows& rows, const schema::Dataset<T, 1>& dataset,
                  double HistoryRow::*member) {
  std::vector<T> values;
  for (const HistoryRow& row : rows) values.push_back(static_cast<T>(row.*member));
  file.write(dataset, std::span<const T>(values), rows.size());
}

template <std::size_t N>
void write_column(schema::FileWriter& file, const Rows& rows, const schema::Dataset<double, 2>& dataset,
                  std::array<double, N> HistoryRow::*member) {
  std::vector<double> values;
  for (const HistoryRow& row : rows) values.insert(values.end(), (row.*member).begin(), (row.*member).end());
  file.write(dataset, std::span<const double>(values), rows.size());
}

bool is_wanted(const schema::DatasetDescription& column, const OptionalColumns& optional) {
  if (column.path == schema::run::history_friction_energy.path ||
      column.path == schema::run::history_friction_dissipation.path)
    return optional.friction;
  return column.path != schema::run::history_section_share.path || optional.container;
}

} // namespace

void write_history(schema::FileWriter& file, const Rows& rows, const OptionalColumns& optional) {
  HistoryRow::for_each_column([&](const auto& dataset, auto member) {
    if (is_wanted(dataset, optional)) write_column(file, rows, dataset, member);
  });
}

std::vector<double> flatten(const Rows& rows) {
  std::vector<double> values(rows.size() * row_values);
  if (!rows.empty()) std::memcpy(values.data(), rows.data(), values.size() * sizeof(double));
  return values;
}

Rows unflatten(const std::vector<double>& values) {
  if (values.size() % row_values != 0) throw std::length_error("not whole rows");
  Rows rows(values.size() / row_values);
  if (!rows.empty()) std::memcpy(rows.data(), values.data(), rows.size() * sizeof(HistoryRow));
  return rows;
}

} // namespace mpfem
