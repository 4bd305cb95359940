#include "postproc/files/text_file.hpp"

#include <fmt/format.h>

namespace mpfem {

std::string csv_text(const std::vector<const Column*>& columns) {
  std::string text;
  const auto end_cell = [&](std::size_t i) { text += i + 1 < columns.size() ? ',' : '\n'; };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    text += fmt::format("{} [{}]", columns[i]->name, columns[i]->unit);
    end_cell(i);
  }
  for (std::size_t row = 0; !columns.empty() && row < columns.front()->values.size(); ++row)
    for (std::size_t i = 0; i < columns.size(); ++i) {
      text += fmt::format("{}", columns[i]->values[row]); // the shortest text that reads back to the same number
      end_cell(i);
    }
  return text;
}

std::string csv_text(const std::vector<Column>& columns) {
  std::vector<const Column*> pointers;
  for (const Column& column : columns) pointers.push_back(&column);
  return csv_text(pointers);
}

std::string name_with_unit(const std::string& name, const std::string& unit) {
  return unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

} // namespace mpfem
