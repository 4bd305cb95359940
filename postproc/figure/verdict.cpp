#include "postproc/figure/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

using Json = nlohmann::ordered_json;
using Quantities = std::map<std::string, Quantity>;

/// A value of a column, with its row.
struct Entry {
  double value;
  std::size_t row;
};

/// The value in `column` of the row, over that in column `over` if given.
std::optional<double> cell(const TextTable& table, std::size_t row, std::size_t column, std::optional<std::size_t> over,
                           const Place& place) {
  const auto value = table.number(row, column, place);
  if (!value || !over) return value;
  const auto divisor = table.number(row, *over, place);
  if (!divisor || *divisor == 0) return {};
  return *value / *divisor;
}

/// The values of a quantity's column; rows in which it is empty are left out.
std::vector<Entry> entries_of(const QuantitySpec& q, const TextTable& table) {
  const std::size_t column = table.column(q.column, q.place);
  std::optional<std::size_t> over;
  if (!q.over.empty()) over = table.column(q.over, q.place);
  std::vector<Entry> entries;
  for (const std::size_t row : table.rows_of(q.where, q.place))
    if (const auto value = cell(table, row, column, over, q.place)) entries.push_back({*value, row});
  if (q.relative_to.empty()) return entries;
  const std::size_t by = table.column(q.by, q.place);
  const auto others = table.rows_of(q.relative_to, q.place);
  std::vector<Entry> relative;
  for (const Entry& entry : entries)
    for (const std::size_t other : others) {
      const auto divisor = cell(table, other, column, over, q.place);
      if (table.rows[other][by] == table.rows[entry.row][by] && divisor && *divisor != 0)
        relative.push_back({entry.value / *divisor, entry.row});
    }
  return relative;
}

Quantity taken(const QuantitySpec& q, const TextTable& table, const std::vector<Entry>& entries) {
  const auto by_value = [](const Entry& a, const Entry& b) { return a.value < b.value; };
  const auto of = [&](const Entry& entry) {
    return Quantity{Value::of(entry.value), {}, table.rows[entry.row].front().text};
  };
  double sum = 0;
  for (const Entry& entry : entries) sum += entry.value;
  if (q.take == "count") return {Value::of(static_cast<double>(entries.size())), {}, {}};
  if (entries.empty()) return q.otherwise ? Quantity{Value::of(*q.otherwise), {}, {}} : Quantity{};
  if (q.take == "before_last") return entries.size() > 1 ? of(entries[entries.size() - 2]) : Quantity{};
  if (q.take == "first") return of(entries.front());
  if (q.take == "last") return of(entries.back());
  if (q.take == "smallest") return of(*std::min_element(entries.begin(), entries.end(), by_value));
  if (q.take == "largest") return of(*std::max_element(entries.begin(), entries.end(), by_value));
  if (q.take == "sum") return {Value::of(sum), {}, {}};
  if (q.take == "mean") return {Value::of(sum / static_cast<double>(entries.size())), {}, {}};
  if (q.take == "spread") {
    const auto [low, high] = std::minmax_element(entries.begin(), entries.end(), by_value);
    return low->value > 0 ? Quantity{Value::of(high->value / low->value), {}, {}} : Quantity{};
  }
  if (q.take == "list") {
    std::vector<std::string> items;
    for (const Entry& entry : entries) {
      Words words = table.words(entry.row);
      words["value"] = Value::of(entry.value);
      items.push_back(filled_at(q.place, q.item, words));
    }
    return {{fmt::format("{}", fmt::join(items, ", ")), {}}, {}, {}};
  }
  if (entries.size() > 1)
    q.place.fail(fmt::format("quantity '{}': {} rows of table '{}' match, allowed: one, or 'take' with first, last, "
                             "before_last, smallest, largest, mean, sum, count, spread or list",
                             q.name, entries.size(), q.table));
  return of(entries.front());
}

Quantity of_fit(const QuantitySpec& q, const Json& fit) {
  if (fit.contains("refused")) return {};
  if (!q.measure.empty()) {
    const Json& value = fit.at(q.measure);
    return value.is_number() ? Quantity{Value::of(value.get<double>()), {}, {}} : Quantity{};
  }
  std::vector<std::string> names;
  for (const char* list : {"coefficients", "derived"})
    if (fit.contains(list))
      for (const auto& [name, c] : fit.at(list).items()) {
        names.push_back(name);
        if (name != q.coefficient) continue;
        if (!c.at("value").is_number() || !c.at("low").is_number() || !c.at("high").is_number()) return {};
        return {Value::of(c.at("value").get<double>()),
                std::array{c.at("low").get<double>(), c.at("high").get<double>()},
                {}};
      }
  q.place.fail(fmt::format("quantity '{}': the model '{}' has no coefficient '{}', allowed: {}", q.name,
                           fit.value("model", ""), q.coefficient, fmt::join(names, ", ")));
}

const Quantity& known(const Quantities& quantities, const std::string& name, const Place& place) {
  const auto found = quantities.find(name);
  if (found != quantities.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [key, value] : quantities) names.push_back(key);
  place.fail(fmt::format("there is no quantity '{}' here or above{}", name, suggestion(name, names)));
}

Quantity of_others(const QuantitySpec& q, const Quantities& quantities) {
  const Quantity& first = known(quantities, q.of, q.place);
  auto value = first.value.number;
  if (!value) return {};
  if (!q.divided_by.empty()) {
    const auto divisor = known(quantities, q.divided_by, q.place).value.number;
    if (!divisor || *divisor == 0) return {};
    value = *value / *divisor;
  }
  if (!q.minus.empty()) {
    const auto other = known(quantities, q.minus, q.place).value.number;
    if (!other) return {};
    value = *value - *other;
  }
  return {Value::of(*value), {}, {}};
}

const QuantitySpec& spec_of(const StatementSpec& statement, const ConditionSpec& condition) {
  for (const QuantitySpec& q : statement.quantities)
    if (q.name == condition.quantity) return q;
  condition.place.fail(fmt::format("there is no quantity '{}'", condition.quantity));
}

/// The entries in the order of the column `along`; rows in which that is empty are left out.
std::vector<Entry> sorted_along(const std::vector<Entry>& entries, const TextTable& table, const ConditionSpec& c) {
  const std::size_t along = table.column(c.along, c.place);
  std::vector<Entry> sorted;
  for (const Entry& entry : entries) {
    if (table.number(entry.row, along, c.place)) sorted.push_back(entry);
  }
  const auto at = [&](const Entry& entry) { return *table.rows[entry.row][along].number; };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Entry& a, const Entry& b) { return at(a) < at(b); });
  return sorted;
}

/// True if the column rises (sign 1) or falls (-1) from every row to every later one. A change against it within the
/// tolerance does not count; with tolerance 0 equal values break it. Empty where there are no two rows to compare.
std::optional<bool> monotonic(const QuantitySpec& q, const TextTable& table, const ConditionSpec& c, double sign) {
  std::vector<Entry> entries = entries_of(q, table);
  if (!c.along.empty()) entries = sorted_along(entries, table, c);
  std::optional<std::size_t> each;
  if (!c.each.empty()) each = table.column(c.each, c.place);
  std::optional<bool> result;
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t k = i + 1; k < entries.size(); ++k) {
      if (each && !(table.rows[entries[i].row][*each] == table.rows[entries[k].row][*each])) continue;
      const double change = sign * (entries[k].value - entries[i].value);
      if (c.tolerance > 0 ? change < -c.tolerance * (c.absolute ? 1 : std::abs(entries[i].value)) : !(change > 0))
        return false;
      result = true;
    }
  return result;
}

/// What a text says of `monotonic`.
const char* words_of(std::optional<bool> is_monotonic) {
  if (!is_monotonic) return "not known";
  return *is_monotonic ? "from each to the next" : "not from each to the next";
}

std::optional<double> operand(const Operand& o, const Quantities& quantities, const Place& place) {
  return o.number ? o.number : known(quantities, o.name, place).value.number;
}

/// Adds a quantity's words for the texts: NAME, NAME.row, for a fit NAME.low and NAME.high, for a column NAME.rises and
/// NAME.falls (see words_of).
/// `trend` says whether the column rises (sign 1) or falls (-1).
template <class Trend>
void add_words(Words& words, const QuantitySpec& q, const Quantity& quantity, const Trend& trend) {
  words[q.name] = quantity.value;
  words[q.name + ".row"] = {quantity.row, {}};
  if (!q.fit.empty()) {
    words[q.name + ".low"] = quantity.interval ? Value::of((*quantity.interval)[0]) : Value{};
    words[q.name + ".high"] = quantity.interval ? Value::of((*quantity.interval)[1]) : Value{};
  }
  if (q.table.empty()) return;
  for (const auto& [name, sign] : {std::pair(".rises", 1.0), std::pair(".falls", -1.0)})
    words[q.name + name] = {words_of(trend(sign)), {}};
}

} // namespace

const TextTable& FigureData::table(const std::string& name) {
  const auto found = tables_.find(name);
  if (found != tables_.end()) return found->second;
  return tables_.emplace(name, read_text_table(path_of_table(figure_.table(name, {}), folder_))).first->second;
}

bool FigureData::has_table(const std::string& name) const {
  return std::filesystem::exists(path_of_table(figure_.table(name, {}), folder_));
}

const Json& FigureData::fit(const std::string& name) {
  if (!fits_) {
    const std::string path = folder_ + "/fits.json";
    std::ifstream file(path);
    if (!file) throw InputError(fmt::format("{}: no such file", one_line(path)));
    fits_ = Json::parse(file, nullptr, false);
    if (!fits_->is_array())
      throw InputError(fmt::format("{}: found no list of fits; run postproc fits again", one_line(path)));
  }
  return fit_by_name(*fits_, name);
}

Quantities quantities_of(const StatementSpec& statement, FigureData& data) {
  Quantities quantities;
  for (const QuantitySpec& q : statement.quantities) {
    if (!q.fit.empty())
      quantities[q.name] = of_fit(q, data.fit(q.fit));
    else if (!q.of.empty())
      quantities[q.name] = of_others(q, quantities);
    else
      quantities[q.name] = taken(q, data.table(q.table), entries_of(q, data.table(q.table)));
  }
  return quantities;
}

void check_texts(const StatementSpec& statement) {
  Words words;
  for (const QuantitySpec& q : statement.quantities) {
    const Value value = q.take == "list" ? Value{"list", {}} : Value::of(1);
    add_words(words, q, {value, std::array{1.0, 1.0}, "row"}, [](double) { return true; });
  }
  for (const std::string& text :
       {statement.ours, statement.note, statement.why, statement.ours_unjudged, statement.note_unjudged})
    filled_at(statement.place, text, words);
}

std::optional<bool> holds(const ConditionSpec& c, const StatementSpec& statement, const Quantities& quantities,
                          FigureData& data) {
  if (c.predicate == "either") {
    std::optional<bool> any = false;
    for (const ConditionSpec& one : c.either) {
      const auto result = holds(one, statement, quantities, data);
      if (result.value_or(false)) return true;
      if (!result) any.reset();
    }
    return any;
  }
  if (c.predicate == "rises" || c.predicate == "falls") {
    const QuantitySpec& q = spec_of(statement, c);
    return monotonic(q, data.table(q.table), c, c.predicate == "rises" ? 1 : -1);
  }
  std::vector<double> operands;
  for (const Operand& o : c.operands) {
    const auto value = operand(o, quantities, c.place);
    if (!value) return {};
    operands.push_back(*value);
  }
  if (c.predicate == "ordered") return std::is_sorted(operands.begin(), operands.end(), std::less_equal<>());
  const Quantity& quantity = known(quantities, c.quantity, c.place);
  const auto value = quantity.value.number;
  if (!value) return {};
  if (c.predicate.starts_with("interval")) {
    const auto [low, high] = quantity.interval.value(); // check_names() has found that it is a coefficient
    if (c.predicate == "interval_width_at_most") return high - low <= operands[0];
    const bool includes = low <= operands[0] && operands[0] <= high;
    return includes == (c.predicate == "interval_includes");
  }
  if (c.predicate == "near")
    return std::abs(*value - operands[0]) <= (c.absolute ? c.within : c.within * std::abs(operands[0]));
  if (c.predicate == "at_least") return *value >= operands[0];
  if (c.predicate == "at_most") return *value <= operands[0];
  if (c.predicate == "above") return *value > operands[0];
  if (c.predicate == "below") return *value < operands[0];
  if (c.predicate == "between") return *value >= operands[0] && *value <= operands[1];
  throw std::logic_error("a predicate of statements without a rule: " + c.predicate);
}

Json judge(const StatementSpec& statement, FigureData& data) {
  const Quantities quantities = quantities_of(statement, data);
  Json agrees = true;
  for (const ConditionSpec& condition : statement.require) {
    const auto result = holds(condition, statement, quantities, data);
    if (result && *result) continue;
    if (result) {
      agrees = false;
      break;
    }
    agrees = nullptr;
  }
  for (const ConditionSpec& condition : statement.judged_if)
    if (!holds(condition, statement, quantities, data).value_or(false)) agrees = nullptr;
  if (statement.require.empty() || !statement.judged || (statement.only_refutes && agrees == true)) agrees = nullptr;
  Words words;
  for (const QuantitySpec& q : statement.quantities)
    add_words(words, q, quantities.at(q.name),
              [&](double sign) { return monotonic(q, data.table(q.table), {}, sign); });
  const bool unjudged = agrees.is_null() && !statement.ours_unjudged.empty();
  const auto text = [&](const std::string& usual, const std::string& otherwise) {
    return filled_at(statement.place, unjudged ? otherwise : usual, words);
  };
  std::string note = text(statement.note, statement.note_unjudged);
  if (!statement.judged) note += note.empty() ? "no verdict is given" : "; no verdict is given";
  Json judged = {{"statement", statement.text},
                 {"paper", statement.paper},
                 {"ours", text(statement.ours, statement.ours_unjudged)},
                 {"agrees", agrees},
                 {"note", note}};
  if (agrees == false && !statement.why.empty()) judged["why"] = filled_at(statement.place, statement.why, words);
  return judged;
}

std::string verdict_text(FigureData& data, const std::string& mesh) {
  std::string text;
  for (const StatementSpec& statement : data.figure().statements) {
    const auto& meshes = statement.meshes;
    if (!meshes.empty() && std::find(meshes.begin(), meshes.end(), mesh) == meshes.end()) continue;
    const Json judged = judge(statement, data);
    if (statement.only_if_judged && judged.at("agrees").is_null()) continue;
    text += (text.empty() ? "[\n  " : ",\n  ") + judged.dump();
  }
  return text.empty() ? "[]\n" : text + "\n]\n";
}

} // namespace mpfem
