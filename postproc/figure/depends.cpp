#include "postproc/figure/depends.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/nearest_word.hpp"
#include "common/one_line.hpp"
#include "common/run_stem.hpp"
#include "common/table_reader.hpp"
#include "postproc/figure/named_files.hpp"
#include "postproc/figure/shell_words.hpp"

namespace mpfem {

namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string set_options(const Settings& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += fmt::format(" --set '{}={}'", key, value);
  return text;
}

/// The text that a scenario gives to a key such as "contact.surface"; none where it leaves it out.
std::optional<std::string> own_text(const TomlDocument& scenario, const std::string& key) {
  return scenario.root().at_path(key).value<std::string>();
}

class Rules {
public:
  explicit Rules(const DependsRequest& request) : request_(request) {}

  void add(const Figure& figure) {
    current_ = &figure;
    check_meshes();
    folder_ = fmt::format("{}/{}", request_.results.path, figure.name);
    sources_ = fmt::format("{}", fmt::join(figure.files, " "));
    files_.clear();
    runs_.clear();
    commands_.clear();
    for (const ScriptSpec& script : figure.scripts) add_script(script);
    std::string data = sources_;
    for (const TableSpec& table : figure.tables) {
      add_table(table);
      data += fmt::format(" {}", path_of_table(table, folder_));
    }
    if (!figure.fits.empty()) {
      std::string fitted;
      for (const FitSpec& fit : figure.fits)
        fitted += fmt::format(" {}", path_of_table(figure.table(fit.table, fit.place), folder_));
      rule(folder_ + "/fits.json", sources_ + fitted, "fit_files");
      data += fmt::format(" {}/fits.json", folder_);
    }
    for (const PlotSpec& plot : figure.plots)
      for (const char* format : {"png", "svg"}) {
        const std::string file = fmt::format("{}/{}.{}", folder_, plot.name, format);
        refuse_taken(file, plot.place);
        rule(file, data_of(plot), "plot_files");
        add_spread(plot, file);
      }
    for (const PictureSpec& picture : figure.pictures) add_picture(picture);
    rule(folder_ + "/verdict.json", data, "verdict_files");
    force_missing_files();
    add_runs(graph_, runs_, figure.path);
    const std::string& name = figure.name;
    // The slash keeps these variables apart from all others, whatever the name of a study.
    text_ += fmt::format("files_of/{0} := {1}\nsource_of/{0} := {2}\n.PHONY: {0}\n{0}: $(files_of/{0})\n", name,
                         fmt::join(files_, " "), figure.path);
    lists_["declared_figures"].insert(name);
  }

  std::string text() {
    for (const auto& [folder, run] : graph_)
      if (run.is_packing)
        add_packing_rules(run);
      else if (run.is_made)
        add_run_rules(folder, run);
    force_lost_parents();
    for (const auto& [name, files] : lists_) text_ += fmt::format("{} := {}\n", name, fmt::join(files, " "));
    return "# Written by postproc depends.\n" + text_;
  }

  const RunGraph& graph() const { return graph_; }

private:
  void rule(const std::string& file, const std::string& needed, const std::string& list) {
    text_ += fmt::format("{}: {}\n", file, needed);
    variable(file, "figure", current_->path);
    lists_[list].insert(file);
    files_.push_back(file);
  }

  /// A result that was removed is made again: make would take it for a file on the way to others, which need not exist
  /// where those are new enough (.SECONDARY).
  void force_missing_files() {
    for (const std::string& file : files_)
      if (!std::filesystem::exists(file)) text_ += fmt::format("{}: FORCE\n", file);
  }

  void variable(const std::string& file, const char* name, const std::string& value) {
    text_ += fmt::format("{}: private {} := {}\n", file, name, value);
  }

  void add_table(const TableSpec& table) {
    if (!table.file.empty()) {
      check_file(table);
      return;
    }
    refuse_taken(path_of_table(table, folder_), table.place);
    rule(path_of_table(table, folder_), fmt::format("{} {}", sources_, fmt::join(needs_of(table), " ")), "table_files");
    if (table.spread.empty()) return;
    const std::string file = fmt::format("{}/{}.spread.csv", folder_, table.name);
    variable(file, "figure", current_->path);
    lists_["spread_files"].insert(file);
    if (!std::filesystem::exists(file)) text_ += fmt::format("{}: $(if $(SEEDS),FORCE)\n", file);
  }

  void check_mesh(const std::string& name, const Place& place, const char* key = "meshes") const {
    const auto& known = request_.meshes;
    if (known.empty() || std::ranges::find(known, name) != known.end()) return;
    place.fail(fmt::format("{}: found '{}'{}", key, one_line(name), suggestion(name, known)));
  }

  void check_meshes() const {
    for (const CaseBlock& block : current_->cases)
      for (const std::string& mesh : block.meshes) check_mesh(mesh, block.place);
    for (const StatementSpec& statement : current_->statements)
      for (const std::string& mesh : statement.meshes) check_mesh(mesh, statement.place);
    for (const std::string& mesh : current_->beside.meshes) check_mesh(mesh, current_->beside.place);
    for (const RunTemplate& run : current_->runs) check_mesh_of_run(run);
  }

  /// A run of a mesh that does not exist would leave out every row.
  void check_mesh_of_run(const RunTemplate& run) const {
    if (run.mesh.empty()) return;
    if (run.mesh.find('{') == std::string::npos) check_mesh(run.mesh, run.place, "mesh");
    for (const Case& row : cases_of(*current_, run.series, {}, request_.results.mesh, run.place))
      check_mesh(filled_at(run.place, run.mesh, row.values), run.place, "mesh");
  }

  /// The meshes with which a script makes the file `name` of the results.
  std::vector<std::string> meshes_that_make(const std::string& name) const {
    std::vector<std::string> meshes;
    const auto makes = [&](const ScriptSpec& script, const std::string& mesh) {
      return std::ranges::any_of(cases_of(*current_, script.series, script.where, mesh, script.place),
                                 [&](const Case& row) { return name_of_script_file(script, row.values) == name; });
    };
    for (const std::string& mesh : request_.meshes)
      if (std::ranges::any_of(current_->scripts, [&](const ScriptSpec& script) { return makes(script, mesh); }))
        meshes.push_back(mesh);
    return meshes;
  }

  /// Refuses a file that neither lies next to the figure's file nor is made by a script. Where only cases of other
  /// meshes make it, make says so when it needs the file.
  void check_file(const TableSpec& table) {
    const std::string path = path_of_table(table, folder_);
    if (table.beside || std::ranges::find(files_, path) != files_.end() || std::filesystem::exists(path)) return;
    if (const std::vector<std::string> meshes = meshes_that_make(table.file); !meshes.empty()) {
      variable(path, "figure", current_->path);
      variable(path, "its_meshes", fmt::format("{}", fmt::join(meshes, " ")));
      lists_["files_without_cases"].insert(path);
      lists_["figures_without_cases"].insert(current_->name);
      files_.insert(files_.begin(), path); // make says so first
      return;
    }
    table.place.fail(fmt::format("found '{}', allowed: a file next to {}, or one that [[scripts]] make",
                                 one_line(table.file), current_->path));
  }

  /// With SEEDS set, a plot also shows the spread over packings.
  void add_spread(const PlotSpec& plot, const std::string& file) {
    for (const SeriesSpec& series : plot.series) {
      if (!series.spread) continue;
      lists_["spread_plots"].insert(file);
      text_ += fmt::format("{}: $(if $(SEEDS),{}/{}.spread.csv)\n", file, folder_, series.table);
    }
  }

  std::string data_of(const PlotSpec& plot) const {
    std::set<std::string> needed;
    const std::string beside = folder_beside(*current_, request_.results);
    for (const SeriesSpec& series : plot.series) {
      if (!series.fit.empty()) needed.insert(folder_ + "/fits.json");
      if (series.table.empty()) continue;
      const TableSpec& table = current_->table(series.table, series.place);
      needed.insert(path_of_table(table, folder_));
      const std::string other = path_of_table(table, beside);
      if (!beside.empty() && std::filesystem::exists(other)) needed.insert(other);
    }
    return fmt::format("{} {}", sources_, fmt::join(needed, " "));
  }

  const RunInstance& run_of(const std::string& name, const Case& row, const Place& place) {
    return add_run(runs_, *current_, current_->run(name, place), row);
  }

  /// Refuses texts of a table's cells that name what the case has no value of.
  static void check_patterns(const TableSpec& table, const Case& row) {
    Words values = row.values;
    if (!table.curves.empty()) values["run"] = {"run", {}};
    for (const ColumnSpec& column : table.columns) filled_at(table.place, column.pattern, values);
    filled_at(table.place, table.row, values);
  }

  /// Refuses cases whose rows the spread over packings could not tell apart. Rows of lists are known only later.
  static void check_same_rows(const TableSpec& table, const std::vector<Case>& cases) {
    if (table.spread.empty() || table.distinct || !table.list.empty()) return;
    std::set<std::string> rows;
    for (const Case& row : cases) {
      std::string cells = filled_at(table.place, table.row, row.values);
      for (const ColumnSpec& column : table.columns)
        if (column.run.empty())
          cells += (cells.empty() ? "" : " ") + filled_at(table.place, column.pattern, row.values);
      if (!rows.insert(cells).second) refuse_same_rows(table, cells);
    }
  }

  /// The files from which a table is read. Adds the runs on which they are measured.
  std::vector<std::string> needs_of(const TableSpec& table) {
    std::vector<std::string> needed;
    const auto add = [&](const std::string& file) {
      if (std::find(needed.begin(), needed.end(), file) == needed.end()) needed.push_back(file);
    };
    const auto belongs = [&](const std::string& name, const Case& row) {
      return belongs_to(current_->run(name, table.place), row);
    };
    const auto cases =
        available_cases(*current_, table.series, table.where, runs_of(table), request_.results, table.place);
    check_same_rows(table, cases);
    for (const Case& row : cases) {
      check_patterns(table, row);
      for (const std::string& name : table.curves)
        if (belongs(name, row)) add(file_of_run(run_of(name, row, table.place)));
      if (const std::size_t slash = table.list.find('/'); slash != std::string::npos)
        add(add_metric(run_of(table.list.substr(0, slash), row, table.place), table.list.substr(slash + 1), row,
                       table.place));
      for (const ColumnSpec& column : table.columns)
        if (!column.run.empty() && belongs(column.run, row))
          add(add_metric(run_of(column.run, row, table.place), filled_at(table.place, column.metric, row.values), row,
                         table.place));
    }
    return needed;
  }

  std::string file_of_run(const RunInstance& run) const { return file_of(run, request_.results, request_.packing); }

  /// The meshed packing at which a run's chain began; `runs` holds it.
  std::string packing_of(const RunInstance& run, const RunGraph& runs) const {
    return run.packing.empty() ? request_.packing : file_of_run(runs.at(run.packing));
  }

  /// The metric as [metrics] declares it, otherwise one whose name is its command.
  MetricSpec metric_of(const std::string& name, const Place& place) const {
    const auto declared = std::find_if(current_->metrics.rbegin(), current_->metrics.rend(),
                                       [&](const MetricSpec& metric) { return metric.name == name; });
    return declared == current_->metrics.rend() ? MetricSpec{name, name, place} : *declared;
  }

  /// The command of a metric: of pack-gen where it says so, otherwise of postproc.
  std::string command_of(const std::string& metric, const Place& place) const {
    std::string command = metric_of(metric, place).command;
    if (command.starts_with("pack-gen ")) return command;
    const std::string name = command.substr(0, command.find(' '));
    const auto& known = request_.commands;
    if (!known.empty() && std::find(known.begin(), known.end(), name) == known.end()) {
      const auto nearest = nearest_word(name, known);
      place.fail(fmt::format("metric '{}': found '{}', {}", one_line(metric), one_line(name),
                             nearest ? fmt::format("did you mean '{}'?", *nearest) : "allowed: a command of postproc"));
    }
    return fmt::format("postproc {}", command);
  }

  /// Refuses words that postproc would refuse; `what` stands before the message.
  void check_words(const std::string& command, const std::string& what, const Place& place) {
    if (!request_.check_words || !checked_commands_.insert(command).second) return;
    try {
      if (const auto words = shell_words(command)) request_.check_words(*words);
    } catch (const InputError& error) {
      place.fail(what + error.what());
    }
  }

  std::string add_metric(const RunInstance& run, const std::string& metric, const Case& row, const Place& place) {
    const std::string command = command_of(metric, place);
    const std::string folder = request_.results.of(run.folder), file = fmt::format("{}/{}.json", folder, metric);
    const std::size_t end = command.find(' ', command.find(' ') + 1); // after the program and its subcommand
    Words words = row.values;
    words["packing"] = {packing_of(run, runs_), {}};
    words["description"] = {request_.description, {}};
    words["folder"] = {folder, {}};
    words["here"] = {folder_of_file(current_->path), {}};
    const std::string full = fmt::format("{} {}{}", command.substr(0, end), file_of_run(run),
                                         end == std::string::npos ? "" : filled(command.substr(end), words));
    if (command.starts_with("postproc ")) {
      words["folder"] = {"folder", {}}; // the same words for all runs
      check_words(fmt::format("{} run.h5{} --quiet -o metric.json", command.substr(9, end - 9),
                              end == std::string::npos ? "" : filled(command.substr(end), words)),
                  fmt::format("metric '{}': ", one_line(metric)), metric_of(metric, place).place);
    }
    const auto [known, added] = metrics_.try_emplace(file, full);
    if (!added && known->second != full)
      throw InputError(fmt::format("{}: metric '{}' is '{}' here, but '{}' in another figure", current_->path, metric,
                                   full, known->second));
    if (!added) return file;
    add_metric_rules(file, file_of_run(run) + files_in_command(full, request_.results.path), full);
    return file;
  }

  /// A metric is measured again when its run or a file in its command is new, or its command, with the case's values in
  /// it, is another one.
  void add_metric_rules(const std::string& file, const std::string& needed, const std::string& measure) {
    const std::string command_file = file.substr(0, file.size() - 4) + "command";
    text_ += fmt::format("{}: {} {}\n", file, needed, command_file);
    variable(file, "measure", measure);
    std::string settings = measure;
    std::erase(settings, '\''); // as make writes it to the file
    stamp(command_file, settings);
    lists_["metric_commands"].insert(command_file);
    lists_["metric_files"].insert(file);
  }

  /// A settings file. Where the file on disk has other settings, it depends on FORCE, so that what depends on it is
  /// made again.
  void stamp(const std::string& file, const std::string& settings) {
    variable(file, "settings", settings);
    if (content_of(file) != settings + "\n") text_ += fmt::format("{}: FORCE\n", file);
  }

  /// One rule for each file. Cases may share a picture only where they would draw the same.
  void add_picture(const PictureSpec& picture) {
    const auto cases =
        available_cases(*current_, picture.series, picture.where, {picture.run}, request_.results, picture.place);
    for (const Case& row : cases) {
      const std::string run = file_of_run(run_of(picture.run, row, picture.place));
      Words words = row.values;
      words["run"] = {run, {}};
      words["here"] = {folder_of_file(current_->path), {}};
      words["folder"] = {folder_, {}};
      const std::string file = fmt::format("{}/{}", folder_, filled_at(picture.place, picture.name, words));
      const std::string command = filled_at(picture.place, picture.command, words);
      const auto [known, added] = commands_.try_emplace(file, command);
      if (!added && known->second != command)
        picture.place.fail(
            fmt::format("found the name '{}' for different pictures, allowed: a name with a setting that differs, "
                        "e.g. 'density-{{pressure}}.png'",
                        one_line(picture.name)));
      if (!added) continue;
      if (is_made_otherwise(file.substr(folder_.size() + 1))) refuse_name(picture.name, picture.place);
      refuse_taken(file, picture.place);
      check_words(fmt::format("{} -o picture.png", command), "command: ", picture.place);
      const std::string_view program = std::string_view(command).substr(0, command.find(' '));
      const bool draws = program == "section" || program == "density-map" || program == "picture";
      if (draws && !file.ends_with(".png"))
        picture.place.fail(fmt::format("name: found '{}', but postproc {} draws PNG, allowed: a name that ends in .png",
                                       one_line(picture.name), program));
      text_ += fmt::format("{}: {} {}\n", file, sources_, run);
      variable(file, "picture", command);
      lists_["picture_files"].insert(file);
      files_.push_back(file);
      if (!file.ends_with(".png")) continue;
      const std::string svg = file.substr(0, file.size() - 3) + "svg";
      refuse_taken(svg, picture.place);
      lists_["traced_files"].insert(svg);
      files_.push_back(svg);
    }
  }

  /// One rule for each file; where several cases make the same file, it depends on the inputs of all of them.
  void add_script(const ScriptSpec& script) {
    for (const Case& row : cases_of(*current_, script.series, script.where, request_.results.mesh, script.place)) {
      Words words = row.values;
      words["here"] = {folder_of_file(current_->path), {}};
      words["folder"] = {folder_, {}};
      words["mpfem"] = {"$(BIN)/mpfem", {}};
      words["postproc"] = {"$(BIN)/postproc", {}};
      std::string needed;
      if (!script.run.empty()) {
        const std::string run = file_of_run(run_of(script.run, row, script.place));
        needed = fmt::format(" {}", run);
        words["run"] = {run, {}};
      }
      for (const std::string& need : script.needs) needed += fmt::format(" {}", filled_at(script.place, need, words));
      const std::string file = fmt::format("{}/{}", folder_, name_of_script_file(script, words));
      words["file"] = {"$@.partial", {}};
      const std::string command = filled_at(script.place, script.command, words);
      const auto [known, added] = commands_.try_emplace(file, command);
      if (!added && known->second != command)
        script.place.fail(fmt::format("two commands make {}: '{}' and '{}'", file, known->second, command));
      text_ += fmt::format("{}: {}{}\n", file, added ? sources_ : "", needed);
      if (!added) continue;
      text_ += fmt::format("{}: private script = {}\n", file, command);
      lists_["script_files"].insert(file);
      files_.push_back(file);
    }
  }

  /// True for files in a figure's folder that neither plots, pictures nor scripts make.
  bool is_made_otherwise(const std::string& name) const {
    const auto of_table = [&](const TableSpec& table) {
      return table.file.empty() && (name == table.name + ".csv" || name == table.name + ".spread.csv");
    };
    constexpr std::array others = {"index.html", "verdict.json", "fits.json", "study.mk", "study.path", "powder.toml"};
    return std::ranges::any_of(current_->tables, of_table) || std::ranges::find(others, name) != others.end();
  }

  [[noreturn]] static void refuse_name(const std::string& name, const Place& place) {
    place.fail(fmt::format("name: found '{}', which is made in another way, allowed: another name", one_line(name)));
  }

  /// Refuses a second rule for a file of the figure.
  void refuse_taken(const std::string& file, const Place& place) const {
    if (std::ranges::find(files_, file) != files_.end()) refuse_name(file.substr(folder_.size() + 1), place);
  }

  /// Refuses a file that is outside the figure's folder, or that another rule makes.
  std::string name_of_script_file(const ScriptSpec& script, const Words& words) const {
    const std::filesystem::path name = filled_at(script.place, script.name, words);
    const auto is_up = [](const std::filesystem::path& part) { return part == ".."; };
    if (name.empty() || name.is_absolute() || std::ranges::any_of(name, is_up))
      script.place.fail(fmt::format("name: found '{}', allowed: a file in the figure's folder", name.string()));
    const std::string own = name.string();
    if (is_made_otherwise(own)) refuse_name(own, script.place);
    if (script.command.find("{file}") == std::string::npos)
      script.place.fail("command: found no {file}, allowed: a command that writes it");
    return own;
  }

  /// Packings given by an element size have their rule in rules.mk; those with their own command have a settings
  /// file.
  void add_packing_rules(const RunInstance& packing) {
    if (packing.command.empty()) return;
    const std::string file = file_of_run(packing), settings = file.substr(0, file.size() - 2) + "settings";
    text_ += fmt::format("{}: {}{}\n", file, settings, files_in_command(packing.command, request_.results.path));
    variable(file, "command", packing.command);
    stamp(settings, packing.command);
    lists_["declared_packings"].insert(file);
  }

  void add_run_rules(const std::string& folder, const RunInstance& run) {
    const std::string file = file_of_run(run), settings_file = file.substr(0, file.size() - 2) + "settings";
    const std::string packing = packing_of(run, graph_);
    Settings settings = {{"packing", packing}};
    const TomlDocument scenario = TomlDocument::from_file(run.programme);
    if (run.common_settings) {
      settings.insert(settings.end(), request_.common_settings.begin(), request_.common_settings.end());
      note_replaced(run, scenario);
    }
    settings.insert(settings.end(), run.settings.begin(), run.settings.end());
    std::string options;
    if (!run.parent.empty()) options = fmt::format(" --from {}", checkpoint_of(run));
    if (!run.densities.empty()) {
      std::vector<std::string> densities;
      for (const double density : run.densities) densities.push_back(fmt::format("{:.3f}", density));
      settings.emplace_back("output.checkpoint_relative_densities", fmt::format("[{}]", fmt::join(densities, ",")));
    }
    options += set_options(settings);
    // Hash of the values, not of the file, so that a changed comment does not make a run outdated.
    std::string settings_text = fmt::format("{} {}{}", run.programme, hash_text(hash_string(scenario.text())), options);
    std::erase(settings_text, '\''); // as make writes it to the file
    const std::string parent = run.parent.empty() ? packing : request_.results.of(run.parent) + "/run.h5";
    // A branch reads the packing, too. A new one makes its parent again, so it need not be newer for the branch.
    text_ += fmt::format("{}: {} {}{}{}\n", file, parent, settings_file, surfaces_of_tools(run, scenario),
                         run.parent.empty() ? "" : " | " + packing);
    variable(file, "programme", run.programme);
    variable(file, "options", options);
    stamp(settings_file, settings_text);
    lists_["declared_runs"].insert(file);
    if (!std::filesystem::exists(file) || content_of(settings_file) != settings_text + "\n")
      outstanding_.insert(folder);
  }

  /// Says once which values of a study's own scenario a common setting replaces, unless the run sets them itself.
  void note_replaced(const RunInstance& run, const TomlDocument& scenario) {
    const std::filesystem::path folder = folder_of_file(run.programme);
    const std::filesystem::path usual = std::filesystem::path(request_.programmes) / ""; // with one slash at its end
    if (!request_.note || folder / "" == usual.lexically_normal()) return;
    for (const auto& [key, value] : request_.common_settings) {
      const std::optional<std::string> own = own_text(scenario, key);
      const auto sets = [&key = key](const auto& setting) { return setting.first == key; };
      if (!own || *own == value || std::ranges::any_of(run.settings, sets)) continue;
      if (noted_.insert(run.programme + " " + key).second)
        request_.note(fmt::format("{}: {} = {} of make replaces \"{}\"; common_settings = false in [[runs]] keeps it",
                                  one_line(run.programme), key, value, one_line(*own)));
    }
  }

  std::string checkpoint_of(const RunInstance& run) const {
    return name_of_kept_checkpoint(request_.results.of(run.parent) + "/work/run.h5", run.checkpoint);
  }

  /// For every branch that is to be made, a parent run whose checkpoint is missing is made again, and so are the
  /// parents that this needs.
  void force_lost_parents() {
    std::set<std::string> forced;
    while (!outstanding_.empty()) {
      const RunInstance& run = graph_.at(*outstanding_.begin());
      outstanding_.erase(outstanding_.begin());
      if (run.parent.empty() || forced.contains(run.parent) || std::filesystem::exists(checkpoint_of(run))) continue;
      const std::string parent = request_.results.of(run.parent) + "/run.h5";
      lists_["parents_to_make"].insert(parent);
      if (!std::filesystem::exists(parent)) continue; // is made anyway
      text_ += fmt::format("{}: FORCE\n", parent);
      forced.insert(run.parent);
      outstanding_.insert(run.parent);
    }
  }

  const DependsRequest& request_;
  const Figure* current_ = nullptr; ///< the next members belong to it: folder, sources, files made, runs
  std::string folder_, sources_;
  std::vector<std::string> files_;
  std::map<std::string, std::string> commands_; ///< of the current figure's pictures and scripts, by file
  RunGraph runs_;
  RunGraph graph_;                    ///< runs of all figures
  std::set<std::string> outstanding_; ///< folders of runs that are to be made
  std::map<std::string, std::string> metrics_;
  std::set<std::string> checked_commands_;
  std::set<std::string> noted_; ///< scenarios with the keys of which a note was given
  std::map<std::string, std::set<std::string>> lists_;
  std::string text_;
};

} // namespace

std::string make_rules(const std::vector<Figure>& figures, const DependsRequest& request) {
  Rules rules(request);
  for (const Figure& figure : figures) rules.add(figure);
  return rules.text();
}

RunGraph runs_of(const Figure& figure, const DependsRequest& request) {
  Rules rules(request);
  rules.add(figure);
  return rules.graph();
}

} // namespace mpfem
