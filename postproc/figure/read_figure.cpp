// A figure's file and those that it includes.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "common/one_line.hpp"
#include "postproc/figure/check_figure.hpp"
#include "postproc/figure/read_specs.hpp"

namespace mpfem {

namespace {

namespace filesystem = std::filesystem;

/// Reads every table of this name, once for each entry of its `for_each`.
template <class Spec>
void append_each(TableReader& root, const std::string& key, Spec (*read)(Texts&), std::vector<Spec>& specs) {
  for (TableReader& table : root.tables(key)) for_each(table, [&](Texts& t) { specs.push_back(read(t)); });
}

/// Adds the entries of another table. Where both have a key, tables are merged and other values are replaced.
void merge(toml::table& into, const toml::table& other) {
  for (const auto& [key, node] : other) {
    toml::table* ours = into[key].as_table();
    const toml::table* theirs = node.as_table();
    if (ours != nullptr && theirs != nullptr) {
      merge(*ours, *theirs);
    } else {
      into.insert_or_assign(key, node);
    }
  }
}

template <class Item>
void append(std::vector<Item>& items, const std::vector<Item>& others) {
  items.insert(items.end(), others.begin(), others.end());
}

template <class Item>
bool has_name(const std::vector<Item>& items, const std::string& name) {
  return std::any_of(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
}

/// Whether the figure has the fit, or the table with the columns, that a quantity is taken from.
bool has_source_of(const Figure& figure, const QuantitySpec& quantity) {
  if (!quantity.fit.empty()) return has_name(figure.fits, quantity.fit);
  if (quantity.table.empty()) return true; // of other quantities
  const auto table = std::find_if(figure.tables.begin(), figure.tables.end(),
                                  [&](const TableSpec& t) { return t.name == quantity.table; });
  if (table == figure.tables.end()) return false;
  std::vector<std::string> used = {quantity.column, quantity.over, quantity.by};
  for (const Filter& filter : quantity.where) used.push_back(filter.name);
  const std::vector<std::string> columns = table->column_names();
  return std::all_of(used.begin(), used.end(), [&](const std::string& name) {
    return name.empty() || std::find(columns.begin(), columns.end(), name) != columns.end();
  });
}

/// Whether the figure can judge a statement of another one. Statements without a verdict are of that one only.
bool can_judge(const Figure& figure, const StatementSpec& statement) {
  if (!statement.judged || statement.require.empty()) return false;
  return std::all_of(statement.quantities.begin(), statement.quantities.end(),
                     [&](const QuantitySpec& quantity) { return has_source_of(figure, quantity); });
}

/// Reads a file into the figure, after the files that it includes.
class FigureReader {
public:
  FigureReader(Figure& figure, std::string programmes) : figure_(figure), programmes_(std::move(programmes)) {}

  void read(const std::string& path) {
    including_ = {filesystem::path(path).lexically_normal().string()};
    read(path, true);
    finish_powder();
    // Statements of included files follow the figure's own.
    append(figure_.statements, included_statements_);
  }

private:
  void read(const std::string& path, bool main) {
    figure_.files.push_back(path);
    const auto document = std::make_shared<const TomlDocument>(TomlDocument::from_file(path));
    figure_.documents.push_back(document);
    TableReader root(*document);
    for (const std::string& file : included_files(root, path)) include(file);
    if (main)
      read_heading(root);
    else
      for (const char* heading : {"title", "question", "source"}) root.value(heading); // not taken over
    const filesystem::path folder = filesystem::path(path).parent_path();
    if (root.has("powder")) read_powder(root, folder);
    read_runs(root, folder);
    read_tables(root, folder);
    read_plots(root);
    if (root.has("beside")) read_beside(root.table("beside"), folder);
    append_each(root, "statements", read_statement, main ? figure_.statements : included_statements_);
    if (main)
      read_statements_of_others(root, path);
    else
      root.value("statements_of"); // not taken over
    root.finish();
  }

  /// Adds the statements of other figures that this one can judge: it has the columns and fits that they need.
  void read_statements_of_others(TableReader& root, const std::string& path) {
    for (const std::string& other : named_files(root, "statements_of", path)) {
      if (std::find(figure_.files.begin(), figure_.files.end(), other) != figure_.files.end())
        root.fail("statements_of", fmt::format("found '{}', whose statements this file has already, allowed: each file "
                                               "once",
                                               other));
      figure_.files.push_back(other);
      const auto document = std::make_shared<const TomlDocument>(TomlDocument::from_file(other));
      figure_.documents.push_back(document);
      TableReader of_other(*document);
      std::vector<StatementSpec> statements;
      append_each(of_other, "statements", read_statement, statements);
      std::erase_if(statements, [&](const StatementSpec& s) { return !can_judge(figure_, s); });
      if (statements.empty())
        root.fail("statements_of",
                  fmt::format("found '{}', but each of its own statements needs a column or fit that this "
                              "file does not have, allowed: figures that name theirs as this one",
                              other));
      append(figure_.statements, statements);
    }
  }

  /// The files that a key names: beside the file that has it, or in the folder of programmes.
  std::vector<std::string> named_files(TableReader& root, const char* key, const std::string& path) const {
    std::vector<std::string> files;
    for (const std::string& other : root.strings_or(key, {})) {
      const filesystem::path beside = filesystem::path(path).parent_path() / other;
      const bool plain = filesystem::path(other).parent_path().empty() && !filesystem::exists(beside);
      const filesystem::path file = (plain ? filesystem::path(programmes_) / other : beside).lexically_normal();
      if (!filesystem::is_regular_file(file))
        root.fail(key, fmt::format("found '{}', but there is no such file, allowed: a file beside this one, or in "
                                   "the folder '{}'",
                                   other, programmes_));
      files.push_back(file.string());
    }
    return files;
  }

  std::vector<std::string> included_files(TableReader& root, const std::string& path) const {
    std::vector<std::string> files = named_files(root, "include", path);
    for (std::size_t i = 0; i < files.size(); ++i)
      if (std::find(including_.begin(), including_.end(), files[i]) != including_.end())
        root.fail("include", fmt::format("found '{}', which includes this file, allowed: files that do not",
                                         root.strings_or("include", {})[i]));
    return files;
  }

  /// Reads a file, or only its [powder] if it was read before: a later file's powder counts.
  void include(const std::string& path) {
    const auto found = std::find(figure_.files.begin(), figure_.files.end(), path);
    including_.push_back(path);
    if (found == figure_.files.end())
      read(path, false);
    else
      repeat_powder(path, *figure_.documents[static_cast<std::size_t>(found - figure_.files.begin())]);
    including_.pop_back();
  }

  void repeat_powder(const std::string& path, const TomlDocument& document) {
    TableReader root(document);
    for (const std::string& file : included_files(root, path)) include(file);
    if (root.has("powder")) read_powder(root, filesystem::path(path).parent_path());
  }

  void read_heading(TableReader& root) {
    figure_.title = root.string("title");
    figure_.question = root.string_or("question", "");
    figure_.source = root.string_or("source", "");
  }

  /// Adds a file's [powder] to that of the files which were read before: those that it includes.
  void read_powder(TableReader& root, const filesystem::path& folder) {
    last_powder_ = root.table("powder");
    toml::table powder = *root.value("powder")->as_table();
    name_from_anywhere(powder, *last_powder_, "surface_file", folder);
    if (toml::table* sizes = powder["size_distribution"].as_table())
      name_from_anywhere(*sizes, last_powder_->table("size_distribution"), "file", folder);
    merge(powder_, powder);
    figure_.element_size = last_powder_->number_or("element_size", figure_.element_size, Range::positive());
  }

  /// Replaces a name in [powder], as seen from the folder of its file, by one that holds in every folder.
  void name_from_anywhere(toml::table& table, const TableReader& reader, const char* key,
                          const filesystem::path& folder) {
    const auto name = table[key].value<std::string>();
    if (!name) return;
    const filesystem::path file = filesystem::absolute(folder / *name).lexically_normal();
    if (!filesystem::is_regular_file(file))
      reader.fail(
          key, fmt::format("found '{}', but there is no such file, allowed: a file beside this one", one_line(*name)));
    table.insert_or_assign(key, file.string());
    figure_.powder_files.insert(file.string());
  }

  void finish_powder() {
    if (!last_powder_) return;
    if (!powder_.contains("element_size")) last_powder_->number("element_size", Range::positive()); // refuses
    powder_.erase("element_size");
    std::ostringstream text;
    text << powder_ << '\n';
    figure_.powder = text.str();
  }

  void read_runs(TableReader& root, const filesystem::path& folder) {
    if (auto defaults = root.optional_table("defaults"))
      for (const std::string& key : defaults->keys()) figure_.defaults[key] = values_of(*defaults, key).front();
    if (auto follows = root.optional_table("follows")) {
      figure_.follows_place = Place(root, "follows");
      for (const std::string& name : follows->keys()) {
        TableReader of_name = follows->table(name);
        for (const std::string& text : of_name.keys()) {
          TableReader values = of_name.table(text);
          for (const std::string& key : values.keys())
            figure_.follows[name][text][key] = values_of(values, key).front();
        }
      }
    }
    for (TableReader& r : root.tables("packings")) figure_.runs.push_back(read_packing(r));
    for (TableReader& r : root.tables("runs")) figure_.runs.push_back(read_run(r, folder, programmes_));
    append_each(root, "cases", read_case, figure_.cases);
    if (auto metrics = root.optional_table("metrics"))
      for (const std::string& key : metrics->keys())
        figure_.metrics.push_back({checked_name(*metrics, key, key), metrics->string(key), Place(*metrics, key)});
    if (auto columns = root.optional_table("columns"))
      for (const std::string& key : columns->keys()) columns_[key] = columns->strings_or(key, {});
  }

  void read_tables(TableReader& root, const filesystem::path& folder) {
    for (TableReader& table : root.tables("tables"))
      for_each(table, [&](Texts& t) {
        figure_.tables.push_back(t.reader().has("file") ? read_table_of_file(t, folder) : read_table(t, columns_));
      });
    append_each(root, "fits", read_fit, figure_.fits);
  }

  void read_plots(TableReader& root) {
    append_each(root, "plots", read_plot, figure_.plots);
    append_each(root, "pictures", read_picture, figure_.pictures);
    append_each(root, "scripts", read_script, figure_.scripts);
  }

  /// Replaces what the files that this one includes put beside.
  void read_beside(TableReader table, const filesystem::path& folder) {
    figure_.beside.folder = (folder / table.string("results")).lexically_normal().string();
    figure_.beside.title = table.string("title");
    Texts(table, Words()).refuse_names("title", figure_.beside.title);
    figure_.beside.meshes = table.strings_or("meshes", {});
    figure_.beside.place = Place(table, "results");
    table.finish();
  }

  Figure& figure_;
  std::string programmes_;
  std::vector<std::string> including_; ///< the files that are being read, each included by the one before
  std::vector<StatementSpec> included_statements_;
  ColumnLists columns_;
  toml::table powder_;                     ///< of all files
  std::optional<TableReader> last_powder_; ///< of the file read last, for messages
};

/// That of the file, or of the folder for "NAME/figure.toml", also where the path leaves the folder out.
std::string name_of_figure(const filesystem::path& path) {
  const filesystem::path file = filesystem::absolute(path).lexically_normal();
  const std::string folder = file.parent_path().filename().string();
  return file.filename() == "figure.toml" && !folder.empty() ? folder : file.stem().string();
}

} // namespace

Figure read_figure(const std::string& path, const std::string& programmes) {
  Figure figure;
  figure.path = path;
  figure.name = name_of_figure(path);
  FigureReader(figure, programmes).read(path);
  check_names(figure);
  return figure;
}

} // namespace mpfem
