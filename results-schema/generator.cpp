// Generates the C++ descriptors and the documentation page from schema.toml.
// Usage: results-schema-generator schema.toml descriptors.hpp results-schema.md

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/toml.hpp"

namespace {

struct Line {
  std::string path, type, unit, description, indexes, partitions;
  std::vector<std::string> shape; ///< names and numbers
  bool required = false;
};

struct Kind {
  std::string name, description;
  std::vector<Line> lines;
};

struct Attribute {
  std::string name, description;
};

struct Schema {
  std::string version;
  std::vector<std::string> conventions, integrity;
  std::vector<Attribute> root_attributes, dataset_attributes;
  std::vector<Kind> kinds;
};

[[noreturn]] void fail(const toml::node& at, const std::string& message) {
  throw std::runtime_error(fmt::format("schema.toml:{}: {}", at.source().begin.line, message));
}

std::string text(const toml::table& table, std::string_view key, bool required) {
  const toml::node* node = table.get(key);
  if (!node) {
    if (required) fail(table, fmt::format("key '{}' is missing", key));
    return {};
  }
  const auto value = node->value<std::string>();
  if (!value || value->empty()) fail(*node, fmt::format("key '{}' must be a text", key));
  return *value;
}

bool is_number(const std::string& extent) {
  return extent.find_first_not_of("0123456789") == std::string::npos;
}

std::vector<std::string> read_shape(const toml::table& table) {
  const toml::array* shape = table["shape"].as_array();
  if (!shape || shape->size() > 2) fail(table, "key 'shape' must be an array of at most two extents");
  std::vector<std::string> extents;
  for (const toml::node& extent : *shape) {
    if (const auto number = extent.value_exact<std::int64_t>(); number && *number > 0)
      extents.push_back(std::to_string(*number));
    else if (const auto name = extent.value_exact<std::string>(); name && !name->empty() && !is_number(*name))
      extents.push_back(*name);
    else
      fail(extent, "an extent is a name or a number > 0");
  }
  return extents;
}

Line read_line(const toml::table& table) {
  static const std::set<std::string_view> known = {"path",     "type",        "shape",   "unit",
                                                   "required", "description", "indexes", "partitions"};
  for (const auto& [key, value] : table)
    if (!known.contains(key.str())) fail(value, fmt::format("unknown key '{}'", key.str()));

  Line line;
  line.path = text(table, "path", true);
  line.type = text(table, "type", true);
  line.unit = text(table, "unit", true);
  line.description = text(table, "description", true);
  line.indexes = text(table, "indexes", false);
  line.partitions = text(table, "partitions", false);
  line.shape = read_shape(table);
  const auto required = table["required"].value<bool>();
  if (!required) fail(table, "key 'required' must be true or false");
  line.required = *required;

  if (line.path.front() != '/') fail(table, "a path begins with '/'");
  if (std::count(line.path.begin(), line.path.end(), '*') > 1) fail(table, "a path has at most one '*'");
  static const std::set<std::string> types = {"float64", "float32", "int32", "int64", "string"};
  if (!types.contains(line.type)) fail(table, fmt::format("unknown type '{}'", line.type));
  if (!(line.indexes + line.partitions).empty() && line.type != "int32" && line.type != "int64")
    fail(table, "'indexes' and 'partitions' need an integer type");
  return line;
}

/// "/snapshots/*/node" -> "snapshots_node".
std::string cpp_name(const std::string& path) {
  std::string name;
  for (const char c : path) {
    if (c == '*') continue;
    if (c == '/' && (name.empty() || name.back() == '_')) continue;
    name += c == '/' ? '_' : c;
  }
  return name;
}

std::vector<std::string> texts(const toml::table& table, std::string_view key) {
  std::vector<std::string> lines;
  if (const toml::array* array = table[key].as_array())
    for (const toml::node& line : *array) lines.push_back(line.value_or(std::string()));
  return lines;
}

/// Reads attributes in the order of the file.
std::vector<Attribute> read_attributes(const toml::table& root, std::string_view key) {
  const toml::table* table = root[key].as_table();
  if (!table) fail(root, fmt::format("key '{}' must be a table", key));
  std::vector<std::pair<std::uint32_t, Attribute>> attributes;
  for (const auto& [name, value] : *table)
    attributes.emplace_back(value.source().begin.line, Attribute{std::string(name.str()), text(*table, name, true)});
  std::sort(attributes.begin(), attributes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Attribute> sorted;
  for (auto& [line, attribute] : attributes) sorted.push_back(std::move(attribute));
  return sorted;
}

/// Kinds in the order of the file (toml++ keeps tables in alphabetical order).
Schema read_schema(const std::string& path) {
  const toml::table root = toml::parse_file(path);
  Schema schema;
  schema.version = text(root, "version", true);
  schema.conventions = texts(root, "conventions");
  schema.integrity = texts(root, "integrity");
  schema.root_attributes = read_attributes(root, "attributes");
  schema.dataset_attributes = read_attributes(root, "dataset_attributes");

  std::vector<std::pair<std::uint32_t, Kind>> kinds;
  for (const auto& [key, value] : root) {
    if (key.str().ends_with("attributes") || !value.is_table()) continue;
    const toml::table& table = *value.as_table();
    Kind kind{std::string(key.str()), text(table, "description", true), {}};
    const toml::array* datasets = table["datasets"].as_array();
    if (!datasets) fail(table, "key 'datasets' must be an array of tables");
    std::set<std::string> names;
    for (const toml::node& node : *datasets) {
      if (!node.is_table()) fail(node, "a dataset is a table");
      kind.lines.push_back(read_line(*node.as_table()));
      if (!names.insert(cpp_name(kind.lines.back().path)).second)
        fail(node, fmt::format("two datasets would be named '{}'", cpp_name(kind.lines.back().path)));
    }
    kinds.emplace_back(table.source().begin.line, std::move(kind));
  }
  std::sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [line, kind] : kinds) schema.kinds.push_back(std::move(kind));
  return schema;
}

std::string quoted(const std::string& value) {
  std::string result = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string cpp_type(const std::string& type) {
  if (type == "float64") return "double";
  if (type == "float32") return "float";
  return "std::" + type + (type == "string" ? "" : "_t");
}

std::string shape_text(const Line& line) {
  if (line.shape.empty()) return "scalar";
  return fmt::format("[{}]", fmt::join(line.shape, ", "));
}

std::string cpp_extents(const Line& line) {
  std::vector<std::string> extents;
  for (const std::string& extent : line.shape)
    extents.push_back(is_number(extent) ? fmt::format("Extent{{\"\", {}}}", extent)
                                        : fmt::format("Extent{{{}, 0}}", quoted(extent)));
  return fmt::format("{{{}}}", fmt::join(extents, ", "));
}

/// A struct of doubles for one row of the columns /history/NAME of a kind; empty where it has no history. Columns of
/// tools are not included, because their number depends on the run.
std::string history_row(const Kind& kind) {
  const std::string folder = "/history/";
  std::string members, visits;
  for (const Line& line : kind.lines) {
    if (!line.path.starts_with(folder) || line.path.find('*') != std::string::npos) continue;
    const std::string name = line.path.substr(folder.size());
    members +=
        fmt::format("  /// {} ({})\n  {} {};\n", line.description, line.unit,
                    line.shape.size() == 1 ? "double" : fmt::format("std::array<double, {}>", line.shape[1]), name);
    visits += fmt::format("    visit({}, &HistoryRow::{});\n", cpp_name(line.path), name);
  }
  if (members.empty()) return {};
  return fmt::format("\n/// One row of the history.\nstruct HistoryRow {{\n{}\n"
                     "  /// Calls visit(dataset, member) for every column, in the order of the members.\n"
                     "  template <class Visitor>\n  static void for_each_column(Visitor&& visit) {{\n{}  }}\n}};\n",
                     members, visits);
}

std::string descriptors(const Schema& schema) {
  std::string out = "#pragma once\n// Generated from results-schema/schema.toml; do not edit.\n\n"
                    "#include \"results-schema/dataset.hpp\"\n\nnamespace mpfem::schema {\n\n";
  out += fmt::format("inline constexpr std::string_view schema_version = {};\n\n", quoted(schema.version));
  out += "/// Names of the attributes, all of them texts.\nnamespace attribute {\n";
  for (const auto* attributes : {&schema.root_attributes, &schema.dataset_attributes})
    for (const Attribute& attribute : *attributes)
      out += fmt::format("/// {}\ninline constexpr const char* {} = {};\n", attribute.description, attribute.name,
                         quoted(attribute.name));
  out += "} // namespace attribute\n\n";
  std::vector<std::string> names;
  for (const Kind& kind : schema.kinds) names.push_back(kind.name);
  out += fmt::format("enum class FileKind {{ {} }};\n\n", fmt::join(names, ", "));
  for (const Kind& kind : schema.kinds) {
    out += fmt::format("/// {}\nnamespace {} {{\n", kind.description, kind.name);
    for (const Line& line : kind.lines)
      out += fmt::format("/// {} ({})\ninline constexpr Dataset<{}, {}> {}{{{{{}, ElementType::{}, {}, {}, {}, {}, {}, "
                         "{}, {}, {}}}}};\n",
                         line.description, line.unit, cpp_type(line.type), line.shape.size(), cpp_name(line.path),
                         quoted(line.path), line.type, line.shape.size(), cpp_extents(line), quoted(line.unit),
                         quoted(shape_text(line)), quoted(line.description), line.required, quoted(line.indexes),
                         quoted(line.partitions));
    out += "\ninline constexpr DatasetDescription all[] = {";
    std::vector<std::string> all;
    for (const Line& line : kind.lines) all.push_back(cpp_name(line.path));
    out += fmt::format("{}}};\n{}}} // namespace {}\n\n", fmt::join(all, ", "), history_row(kind), kind.name);
  }
  out += "/// In the order of FileKind.\ninline constexpr KindDescription kinds[] = {\n";
  for (const Kind& kind : schema.kinds)
    out += fmt::format("    {{{}, {}, {}::all}},\n", quoted(kind.name), quoted(kind.description), kind.name);
  return out + "};\n\n} // namespace mpfem::schema\n";
}

std::string attribute_table(const std::string& heading, const std::vector<Attribute>& attributes) {
  std::string out = fmt::format("\n| {} | meaning |\n|---|---|\n", heading);
  for (const Attribute& attribute : attributes)
    out += fmt::format("| `{}` | {} |\n", attribute.name, attribute.description);
  return out;
}

std::string markdown(const Schema& schema) {
  std::string out = fmt::format("# Results schema, version {}\n\n"
                                "Generated from `results-schema/schema.toml` (build target `results_schema_docs`); do "
                                "not edit.\n\nEvery file is HDF5. All attributes are texts.\n",
                                schema.version);
  out += attribute_table("root attribute", schema.root_attributes);
  out += attribute_table("attribute of a dataset", schema.dataset_attributes);
  out += "\n## Conventions\n\n";
  for (const std::string& line : schema.conventions) out += fmt::format("- {}\n", line);
  out +=
      "- A name in a shape is a free extent; the same name has the same value everywhere in one file (with a leading "
      "`*`: in one snapshot). `NAME_plus_1` is one more than `NAME`.\n"
      "- `*` in a path stands for a name: of a snapshot (`0000`, `0001`, …), of a rigid tool (`upper`, `lower`, …).\n"
      "\n## How files are checked\n\n";
  for (const std::string& line : schema.integrity) out += line + "\n";
  for (const Kind& kind : schema.kinds) {
    out +=
        fmt::format("\n## {}\n\n{}\n\n| path | type | shape | unit | required | meaning |\n|---|---|---|---|---|---|\n",
                    kind.name, kind.description);
    for (const Line& line : kind.lines) {
      std::string meaning = line.description;
      if (!line.indexes.empty()) meaning += fmt::format(" Indices below {}.", line.indexes);
      if (!line.partitions.empty()) meaning += fmt::format(" Never falls, from 0 to {}.", line.partitions);
      out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", line.path, line.type, shape_text(line), line.unit,
                         line.required ? "yes" : "no", meaning);
    }
  }
  return out;
}

void write_text(const char* path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write {}", path));
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: results-schema-generator schema.toml descriptors.hpp results-schema.md\n");
    return 2;
  }
  try {
    const Schema schema = read_schema(argv[1]);
    write_text(argv[2], descriptors(schema));
    write_text(argv[3], markdown(schema));
  } catch (const toml::parse_error& error) {
    fmt::print(stderr, "schema.toml:{}: {}\n", error.source().begin.line, error.description());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "results-schema-generator: {}\n", error.what());
    return 2;
  }
  return 0;
}
