// Statements of a figure's file: their quantities and conditions.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "postproc/figure/read_specs.hpp"

namespace mpfem {

namespace {

QuantitySpec read_quantity(TableReader reader, const std::string& name, const Words& words) {
  Texts t(reader, words);
  QuantitySpec q;
  q.name = name;
  q.place = Place(reader, "");
  if (reader.has("fit")) {
    q.fit = t.required("fit");
    if (reader.has("coefficient")) {
      q.coefficient = t.required("coefficient");
    } else {
      q.measure = reader.choice("measure", {"r_squared", "r_squared_of_y", "scatter", "points"});
    }
  } else if (reader.has("of")) {
    q.of = t.required("of");
    q.divided_by = t.optional("over");
    q.minus = t.optional("minus");
  } else {
    q.table = t.required("table");
    q.column = t.required("column");
    q.over = t.optional("over");
    q.take = reader.choice_or(
        "take", "only",
        {"only", "first", "last", "smallest", "largest", "mean", "sum", "count", "spread", "list", "before_last"});
    q.otherwise = reader.optional_number("otherwise");
    q.item = t.optional("item", "{value:.3g}");
    q.where = t.filters("where");
    q.relative_to = t.filters("relative_to");
    if (!q.relative_to.empty()) q.by = t.required("by");
  }
  reader.finish();
  return q;
}

std::vector<Operand> operands_of(TableReader& reader, const std::string& key, const Words& words) {
  std::vector<Operand> operands;
  for (const Value& value : values_of(reader, key))
    operands.push_back({value.number, value.number ? "" : filled(value.text, words, Unknown::kept)});
  return operands;
}

const std::vector<std::string>& predicates() {
  static const std::vector<std::string> list = {"near",
                                                "at_least",
                                                "at_most",
                                                "above",
                                                "below",
                                                "between",
                                                "rises",
                                                "falls",
                                                "ordered",
                                                "interval_includes",
                                                "interval_excludes",
                                                "interval_width_at_most",
                                                "either"};
  return list;
}

ConditionSpec read_condition(TableReader reader, const Words& words) {
  Texts t(reader, words);
  ConditionSpec c;
  c.place = Place(reader, "");
  for (const std::string& predicate : predicates()) {
    if (!reader.has(predicate)) continue;
    if (!c.predicate.empty())
      reader.fail(predicate, fmt::format("cannot be used with '{}', allowed: one predicate", c.predicate));
    c.predicate = predicate;
  }
  if (c.predicate.empty())
    reader.fail("quantity", fmt::format("no predicate, allowed: one of {}", fmt::join(predicates(), ", ")));
  if (c.predicate == "either") {
    for (TableReader& one : reader.tables("either")) c.either.push_back(read_condition(one, words));
    reader.finish();
    return c;
  }
  if (c.predicate != "ordered") c.quantity = t.required("quantity");
  if (c.predicate == "rises" || c.predicate == "falls") {
    if (!reader.boolean_or(c.predicate, true)) reader.fail(c.predicate, "found false, allowed: true");
    c.absolute = reader.has("tolerance_absolute");
    c.tolerance = c.absolute ? reader.number("tolerance_absolute", Range::positive())
                             : reader.number_or("tolerance", 0, Range::between(0, 1));
    c.along = t.optional("along");
    c.each = t.optional("each");
  } else {
    c.operands = operands_of(reader, c.predicate, words);
    const std::size_t least = c.predicate == "between" || c.predicate == "ordered" ? 2 : 1;
    if (c.operands.size() < least || (c.predicate != "ordered" && c.operands.size() > least))
      reader.fail(c.predicate, fmt::format("found {} values, allowed: {}", c.operands.size(), least));
    if (c.predicate == "between" && c.operands[0].number && c.operands[1].number &&
        *c.operands[0].number > *c.operands[1].number)
      reader.fail(c.predicate, fmt::format("found {:g} before {:g}, allowed: the smaller one first",
                                           *c.operands[0].number, *c.operands[1].number));
  }
  if (c.predicate == "near") {
    c.absolute = reader.has("within_absolute");
    c.within =
        c.absolute ? reader.number("within_absolute", Range::positive()) : reader.number("within", Range::positive());
  }
  reader.finish();
  return c;
}

} // namespace

StatementSpec read_statement(Texts& t) {
  TableReader& r = t.reader();
  StatementSpec s;
  s.place = Place(r, "ours");
  t.refuse_names("text", s.text = t.required("text"));
  t.refuse_names("paper", s.paper = t.required("paper"));
  s.source = t.shown("source");
  s.ours = t.required("ours");
  s.note = t.optional("note");
  if (auto unjudged = r.optional_table("unjudged")) {
    Texts texts(*unjudged, t.words());
    s.ours_unjudged = texts.required("ours");
    s.note_unjudged = texts.optional("note", s.note);
    unjudged->finish();
  }
  s.why = t.optional("why");
  const std::vector<Filter> judged_where = t.filters("verdict_where");
  for (const Filter& filter : judged_where) {
    const auto word = t.words().find(filter.name);
    if (word == t.words().end()) s.place.fail(fmt::format("verdict_where: for_each has no '{}'", filter.name));
    s.judged = s.judged && filter.accepts(word->second);
  }
  s.only_refutes = r.boolean_or("only_refutes", false);
  s.only_if_judged = r.boolean_or("only_if_judged", false);
  s.meshes = t.list("meshes");
  TableReader quantities = r.table("quantities");
  for (const std::string& key : quantities.keys())
    s.quantities.push_back(read_quantity(quantities.table(key), key, t.words()));
  for (TableReader& condition : r.tables("require")) s.require.push_back(read_condition(condition, t.words()));
  if (r.has("require") && s.require.empty())
    r.fail("require", "found no condition, allowed: one or more; without 'require' a statement is not judged");
  for (TableReader& condition : r.tables("judged_if")) s.judged_if.push_back(read_condition(condition, t.words()));
  return s;
}

} // namespace mpfem
