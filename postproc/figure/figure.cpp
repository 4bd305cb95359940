#include "postproc/figure/figure.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

template <class Item>
const Item& by_name(const std::vector<Item>& items, const std::string& name, const char* kind, const Place& place) {
  std::vector<std::string> names;
  for (const Item& item : items) {
    if (item.name == name) return item;
    names.push_back(item.name);
  }
  place.fail(fmt::format("there is no {} '{}'{}", kind, name, suggestion(name, names)));
}

} // namespace

void Place::fail(const std::string& message) const {
  if (!reader_) throw InputError(one_line(message));
  if (key_.empty()) {
    const auto keys = reader_->keys();
    reader_->fail(keys.empty() ? "" : keys.front(), message);
  }
  reader_->fail(key_, message);
}

std::string Place::note(const std::string& message) const {
  try {
    fail(message);
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string filled_at(const Place& place, std::string_view pattern, const Words& words, Unknown unknown) {
  try {
    return filled(pattern, words, unknown);
  } catch (const InputError& error) {
    place.fail(error.what());
  }
}

bool Filter::accepts(const Value& value) const {
  if ((at_least || at_most) && !value.number) return false;
  if (at_least && !(*value.number >= *at_least)) return false;
  if (at_most && !(*value.number <= *at_most)) return false;
  return equal.empty() || std::find(equal.begin(), equal.end(), value) != equal.end();
}

std::vector<std::string> TableSpec::column_names() const {
  std::vector<std::string> names;
  if (!row.empty()) names.emplace_back("name");
  for (const ColumnSpec& column : columns) names.push_back(column.name);
  return names;
}

const RunTemplate& Figure::run(const std::string& wanted, const Place& place) const {
  return by_name(runs, wanted, "run", place);
}

const TableSpec& Figure::table(const std::string& wanted, const Place& place) const {
  return by_name(tables, wanted, "table", place);
}

const FitSpec& Figure::fit(const std::string& wanted, const Place& place) const {
  return by_name(fits, wanted, "fit", place);
}

} // namespace mpfem
