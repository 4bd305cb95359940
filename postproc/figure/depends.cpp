#include "postproc/figure/depends.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "common/one_line.hpp"

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

class Rules {
public:
  explicit Rules(const DependsRequest& request) : request_(request) {}

  void add(const Figure& figure) {
    current_ = &figure;
    const std::string folder = fmt::format("{}/{}", request_.results.path, figure.name);
    const std::string sources = fmt::format("{}", fmt::join(figure.files, " "));
    std::vector<std::string> files, tables;
    RunGraph runs;
    for (const TableSpec& table : figure.tables) {
      const std::string file = fmt::format("{}/{}.csv", folder, table.name);
      const auto needed = needs_of(table, runs);
      rule(file, fmt::format("{} {}", sources, fmt::join(needed, " ")), "table_files");
      tables.push_back(file);
      if (!table.spread.empty()) {
        variable(fmt::format("{}/{}.spread.csv", folder, table.name), "figure", figure.path);
        lists_["spread_files"].insert(fmt::format("{}/{}.spread.csv", folder, table.name));
      }
      files.push_back(file);
    }
    std::string data = fmt::format("{} {}", sources, fmt::join(tables, " "));
    if (!figure.fits.empty()) {
      std::string fitted;
      for (const FitSpec& fit : figure.fits) fitted += fmt::format(" {}/{}.csv", folder, fit.table);
      rule(folder + "/fits.json", sources + fitted, "fit_files");
      files.push_back(folder + "/fits.json");
      data += fmt::format(" {}/fits.json", folder);
    }
    for (const PlotSpec& plot : figure.plots)
      for (const char* format : {"png", "svg"}) {
        const std::string file = fmt::format("{}/{}.{}", folder, plot.name, format);
        rule(file, data_of(plot, figure, folder, sources), "plot_files");
        add_spread(plot, folder, file);
        files.push_back(file);
      }
    for (const PictureSpec& picture : figure.pictures) add_picture(figure, picture, folder, sources, runs, files);
    rule(folder + "/verdict.json", data, "verdict_files");
    files.push_back(folder + "/verdict.json");
    add_runs(graph_, runs, figure.path);
    text_ += fmt::format("{}_files := {}\n", figure.name, fmt::join(files, " "));
    lists_["declared_figures"].insert(figure.name);
    text_ += fmt::format("{}_source := {}\n.PHONY: {}\n{}: $({}_files)\n", figure.name, figure.path, figure.name,
                         figure.name, figure.name);
  }

  std::string text() {
    for (const auto& [folder, run] : graph_) add_run_rules(folder, run);
    for (const auto& [name, files] : lists_) text_ += fmt::format("{} := {}\n", name, fmt::join(files, " "));
    return "# Written by postproc depends.\n" + text_;
  }

private:
  void rule(const std::string& file, const std::string& needed, const std::string& list) {
    text_ += fmt::format("{}: {}\n", file, needed);
    variable(file, "figure", current_->path);
    lists_[list].insert(file);
  }

  void variable(const std::string& file, const char* name, const std::string& value) {
    text_ += fmt::format("{}: private {} := {}\n", file, name, value);
  }

  /// With SEEDS a plot also shows the spread over packings.
  void add_spread(const PlotSpec& plot, const std::string& folder, const std::string& file) {
    for (const SeriesSpec& series : plot.series) {
      if (!series.spread) continue;
      lists_["spread_plots"].insert(file);
      text_ += fmt::format("{}: $(if $(SEEDS),{}/{}.spread.csv)\n", file, folder, series.table);
    }
  }

  static std::string data_of(const PlotSpec& plot, const Figure& figure, const std::string& folder,
                             const std::string& sources) {
    std::set<std::string> needed;
    for (const SeriesSpec& series : plot.series) {
      if (!series.table.empty()) needed.insert(fmt::format("{}/{}.csv", folder, series.table));
      if (!series.fit.empty()) needed.insert(folder + "/fits.json");
    }
    (void)figure;
    return fmt::format("{} {}", sources, fmt::join(needed, " "));
  }

  /// The files that a table is read from; adds the runs that they are measured on.
  std::vector<std::string> needs_of(const TableSpec& table, RunGraph& runs) {
    std::vector<std::string> needed;
    const auto add = [&](const std::string& file) {
      if (std::find(needed.begin(), needed.end(), file) == needed.end()) needed.push_back(file);
    };
    for (const Case& row : cases_of(*current_, table.series, table.where, request_.results.mesh, table.place)) {
      for (const std::string& name : table.curves)
        add(run_file(add_run(runs, *current_, current_->run(name, table.place), row).folder));
      if (const std::size_t slash = table.list.find('/'); slash != std::string::npos)
        add(add_metric(add_run(runs, *current_, current_->run(table.list.substr(0, slash), table.place), row),
                       table.list.substr(slash + 1), row));
      for (const ColumnSpec& column : table.columns)
        if (!column.run.empty())
          add(add_metric(add_run(runs, *current_, current_->run(column.run, table.place), row), column.metric, row));
    }
    return needed;
  }

  std::string run_file(const std::string& folder) const {
    return fmt::format("{}/{}/run.h5", request_.results.path, folder);
  }

  std::string add_metric(const RunInstance& run, const std::string& metric, const Case& row) {
    std::string command = metric;
    for (const auto& [name, words] : current_->metrics)
      if (name == metric) command = words;
    const std::string file = fmt::format("{}/{}/{}.json", request_.results.path, run.folder, metric);
    const std::size_t blank = command.find(' ');
    Words words = row.values;
    words["packing"] = {request_.packing, {}};
    words["folder"] = {fmt::format("{}/{}", request_.results.path, run.folder), {}};
    const std::string full = fmt::format("{} {}{}", command.substr(0, blank), run_file(run.folder),
                                         blank == std::string::npos ? "" : filled(command.substr(blank), words));
    const auto [known, added] = metrics_.try_emplace(file, full);
    if (!added && known->second != full)
      throw InputError(fmt::format("{}: metric '{}' is '{}' here, but '{}' in another figure", current_->path, metric,
                                   full, known->second));
    if (!added) return file;
    const std::string settings = fmt::format("{}/metrics/{}.settings", request_.results.path, metric);
    text_ += fmt::format("{}: {} {}\n", file, run_file(run.folder), settings);
    variable(file, "measure", full);
    if (lists_["metric_settings"].insert(settings).second) {
      variable(settings, "settings", command);
      if (content_of(settings) != command + "\n") text_ += fmt::format("{}: FORCE\n", settings);
    }
    lists_["metric_files"].insert(file);
    return file;
  }

  void add_picture(const Figure& figure, const PictureSpec& picture, const std::string& folder,
                   const std::string& sources, RunGraph& runs, std::vector<std::string>& files) {
    for (const Case& row : cases_of(figure, picture.series, picture.where, request_.results.mesh, picture.place)) {
      const RunInstance& run = add_run(runs, figure, figure.run(picture.run, picture.place), row);
      Words words = row.values;
      words["run"] = {run_file(run.folder), {}};
      const std::string name = filled_at(picture.place, picture.name, words);
      const std::string file = fmt::format("{}/{}", folder, name);
      if (std::find(files.begin(), files.end(), file) != files.end()) continue;
      text_ += fmt::format("{}: {} {}\n", file, sources, run_file(run.folder));
      variable(file, "picture", filled_at(picture.place, picture.command, words));
      lists_["picture_files"].insert(file);
      files.push_back(file);
      if (file.ends_with(".png")) {
        const std::string svg = file.substr(0, file.size() - 3) + "svg";
        lists_["traced_files"].insert(svg);
        files.push_back(svg);
      }
    }
  }

  void add_run_rules(const std::string& folder, const RunInstance& run) {
    const std::string file = run_file(folder), settings_file = file.substr(0, file.size() - 2) + "settings";
    Settings settings = run.common_settings ? request_.common_settings : Settings{};
    settings.insert(settings.end(), run.settings.begin(), run.settings.end());
    std::string options, parent;
    if (!run.parent.empty()) {
      parent = run_file(run.parent);
      options =
          fmt::format(" --from {}/{}/work/run.{}.checkpoint.h5", request_.results.path, run.parent, run.checkpoint);
    }
    if (!run.densities.empty()) {
      std::vector<std::string> densities;
      for (const double density : run.densities) densities.push_back(fmt::format("{:.3f}", density));
      settings.emplace_back("output.checkpoint_relative_densities", fmt::format("[{}]", fmt::join(densities, ",")));
    }
    options += set_options(settings);
    // Of the values, not of the file: another comment makes no run old.
    const std::string stamp =
        fmt::format("{} {}{}", run.programme, hash_text(hash_string(TomlDocument::from_file(run.programme).text())), options);
    std::string quoted = stamp; // as it stands in the file
    std::erase(quoted, '\'');
    text_ += fmt::format("{}: {} {}\n", file, parent.empty() ? request_.packing : parent, settings_file);
    variable(file, "programme", run.programme);
    variable(file, "options", options);
    variable(settings_file, "settings", quoted);
    lists_["declared_runs"].insert(file);
    if (content_of(settings_file) != quoted + "\n") text_ += fmt::format("{}: FORCE\n", settings_file);
  }

  const DependsRequest& request_;
  const Figure* current_ = nullptr;
  RunGraph graph_;
  std::map<std::string, std::string> metrics_;
  std::map<std::string, std::set<std::string>> lists_;
  std::string text_;
};

} // namespace

std::string make_rules(const std::vector<Figure>& figures, const DependsRequest& request) {
  Rules rules(request);
  for (const Figure& figure : figures) rules.add(figure);
  return rules.text();
}

} // namespace mpfem
