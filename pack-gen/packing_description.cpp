#include "pack-gen/packing_description.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/physical_ranges.hpp"
#include "pack-gen/csv_table.hpp"

namespace mpfem {

namespace {

/// A file that a description names, relative to its folder; appended to `files`.
std::string named_file(TableReader& table, const char* key, const std::string& description_file,
                       std::vector<std::string>& files) {
  files.push_back((std::filesystem::path(description_file).parent_path() / table.string(key)).string());
  return files.back();
}

/// Sizes, and for a table their cumulative fractions, from the keys themselves or from a CSV file.
struct Columns {
  std::vector<double> values, cumulative;
};

/// What `make()` returns, or a refusal that names this key: size tables know no description.
template <class Make>
auto made_from(const TableReader& table, const char* key, Make&& make) {
  try {
    return make();
  } catch (const InputError& error) {
    table.fail(key, error.what());
  }
}

Columns read_columns(TableReader& table, const std::string& description_file, bool with_cumulative,
                     std::vector<std::string>& files) {
  if (!table.has("file")) {
    Columns columns{table.numbers("values", positive_length), {}};
    if (with_cumulative) columns.cumulative = table.numbers("cumulative", Range::between(0, 1));
    return columns;
  }
  for (const char* key : {"values", "cumulative"})
    if (table.has(key)) table.fail(key, "cannot be used with key 'file', allowed: one of the two");
  const std::string path = named_file(table, "file", description_file, files);
  std::vector<CsvColumn> names = {{"size", positive_length}};
  if (with_cumulative) names.push_back({"cumulative", Range::between(0, 1), "1"});
  const auto rows = made_from(table, "file", [&] { return read_csv(CsvReader::from_file(path), names); });
  Columns columns;
  for (const auto& row : rows) {
    columns.values.push_back(row[0]);
    if (with_cumulative) columns.cumulative.push_back(row[1]);
  }
  return columns;
}

/// Reads into `description`: the distribution, the diameters of its table, the files that it names.
void read_distribution(TableReader table, const std::string& description_file, PackingDescription& description) {
  const std::string kind = table.choice("kind", {"table", "log_normal", "list"});
  const double to_diameter = table.choice("measure", {"diameter", "radius"}) == "radius" ? 2 : 1;
  const auto weight = [&table] {
    return table.choice("weight", {"number", "volume"}) == "volume" ? SizeWeight::volume : SizeWeight::number;
  };
  if (kind == "log_normal") {
    const double median = to_diameter * table.number("median", positive_length);
    const double deviation = table.number("log_deviation", Range::between(1e-6, 10));
    const double smallest = to_diameter * table.number("smallest", positive_length);
    const double largest = to_diameter * table.number("largest", positive_length);
    const SizeWeight by = weight();
    description.distribution =
        made_from(table, "median", [&] { return log_normal_distribution(median, deviation, by, smallest, largest); });
  } else {
    Columns columns = read_columns(table, description_file, kind == "table", description.files);
    for (double& value : columns.values) value *= to_diameter;
    const SizeWeight by = kind == "table" ? weight() : SizeWeight::number;
    description.distribution = made_from(table, table.has("file") ? "file" : "values", [&] {
      return kind == "table" ? table_distribution(columns.values, columns.cumulative, by)
                             : list_distribution(columns.values);
    });
    if (kind == "table") description.table_diameters = columns.values;
  }
  table.finish();
}

/// A box of three edge lengths, a cylinder of a diameter and a height, or a surface from a file; the keys of the others
/// are refused.
PackingContainer read_container(TableReader& root, const std::string& description_file, bool without_box,
                                PackingDescription& description) {
  const std::string shape = root.choice_or("container", "box", {"box", "cylinder", "surface"});
  const auto refuse = [&](std::initializer_list<const char*> keys, const char* allowed) {
    for (const char* key : keys)
      if (root.has(key)) root.fail(key, fmt::format("cannot be used with a {}, allowed: {}", shape, allowed));
  };
  if (shape == "box") {
    refuse({"diameter", "height"}, "box, or container = \"cylinder\"");
    refuse({"surface_file", "surface_scale"}, "box, or container = \"surface\"");
    return {root.vector3("box", positive_length), ContainerShape::box};
  }
  if (without_box)
    root.value("box");
  else
    refuse({"box"}, shape == "cylinder" ? "diameter and height" : "surface_file and surface_scale");
  if (shape == "surface") {
    refuse({"diameter", "height"}, "surface_file and surface_scale");
    const std::string path = named_file(root, "surface_file", description_file, description.files);
    // No default: STL files do not state their unit.
    const PlacedSurface placed = read_surface(path, "surface_scale", root.number("surface_scale", length_of_unit));
    description.surface_size = placed.size;
    return {placed.lengths, ContainerShape::surface, placed.container};
  }
  refuse({"surface_file", "surface_scale"}, "diameter and height");
  const double diameter = root.number("diameter", positive_length), height = root.number("height", positive_length);
  return {{diameter, diameter, height}, ContainerShape::cylinder};
}

} // namespace

PackingDescription read_packing_description(const TomlDocument& document, bool without_box) {
  PackingDescription description;
  TableReader root(document);
  description.text = document.text();
  description.count = static_cast<int>(root.integer("count", Range::between(1, 1e7)));
  description.relative_density = root.number("relative_density", Range::between(1e-9, 0.74));
  description.container = read_container(root, document.name(), without_box, description);
  description.smallest_gap = root.number("smallest_gap", positive_length);
  description.seed = static_cast<std::uint64_t>(root.integer_or("seed", 1, Range::non_negative()));
  description.size_scale_tolerance = root.number_or("size_scale_tolerance", 0.01, Range::between(0, 1));
  read_distribution(root.table("size_distribution"), document.name(), description);
  description.places = root.places();
  root.finish();
  return description;
}

namespace {

/// Diameters of as many spheres as the description counts.
std::vector<double> sampled(const PackingDescription& description) {
  try {
    return description.distribution->sample(description.count);
  } catch (const InputError& error) { // it knows no file
    throw InputError(fmt::format("{}key 'count': {}", description.places.prefix("count"), error.what()));
  }
}

/// Of a surface: its size, and that which the spheres need; empty for other containers.
std::string surface_beside_need(const PackingDescription& description, double scale) {
  if (description.container.shape != ContainerShape::surface || !description.surface_size) return {};
  Point needed = description.surface_size->length;
  for (double& length : needed) length /= scale;
  return "; " + size_beside(*description.surface_size, "the spheres need", needed);
}

/// "250 spheres or ", where that number could be packed.
std::string other_count(double count) {
  constexpr double most = 1e8;
  return count >= 1 && count <= most ? fmt::format("{:.0f} spheres or ", count) : "";
}

} // namespace

DrawnSizes draw_sizes(const PackingDescription& description) {
  const std::vector<double> diameter = sampled(description);
  const PackingContainer& container = description.container;
  const double volume = container.volume();
  const double scale = size_scale(diameter, description.relative_density, volume);
  if (!(std::abs(scale - 1) <= description.size_scale_tolerance))
    throw InputError(fmt::format(
        "{}key 'count': {} spheres of this size distribution at a relative_density of {:g} in this {} need "
        "sizes scaled by {:.4g}, allowed: {:g} … {:g} (size_scale_tolerance); or take {}a {} of {:.4g} times the {}{}",
        description.places.prefix("count"), description.count, description.relative_density, name_of(container.shape),
        scale, 1 - description.size_scale_tolerance, 1 + description.size_scale_tolerance,
        other_count(description.count * scale * scale * scale), name_of(container.shape), 1 / scale,
        container.shape == ContainerShape::cylinder ? "diameter and height" : "size along each edge",
        surface_beside_need(description, scale)));
  DrawnSizes sizes{{}, scale};
  for (const double d : diameter) sizes.radius.push_back(0.5 * scale * d);
  return sizes;
}

} // namespace mpfem
