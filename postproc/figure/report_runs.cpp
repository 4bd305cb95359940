#include "postproc/figure/report_runs.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/table_reader.hpp"
#include "postproc/figure/run_graph.hpp"
#include "postproc/metrics/summary.hpp"
#include "postproc/view/view_page.hpp"

namespace mpfem {

namespace {

namespace fs = std::filesystem;
namespace run = schema::run;

/// A path as a URL: characters with a special meaning there are escaped.
std::string address_of(const fs::path& path) {
  std::string address;
  for (const char c : path.generic_string())
    if (c == ' ' || c == '%' || c == '#' || c == '?' || c == '"' || c == '&')
      address += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    else
      address += c;
  return address;
}

/// The main settings of the scenario; a dash for those that the run lacks.
struct RunSettings {
  std::string element = "–", surface = "–", mesh = "–";
};

RunSettings settings_of(const schema::FileReader& file) {
  RunSettings settings;
  try {
    const auto document = TomlDocument::from_text(file.read_scalar(run::provenance_scenario), file.path());
    const auto& root = document.root();
    settings.element = root.at_path("element.type").value_or(settings.element);
    settings.surface = root.at_path("contact.surface").value_or(settings.surface);
    settings.mesh = fs::path(root.at_path("packing").value_or(settings.mesh)).filename().string();
  } catch (const InputError&) { // a scenario of another version
    return {};
  }
  return settings;
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

std::string row_of(const schema::FileReader& file) {
  const Summary s = summarise(file);
  const RunSettings settings = settings_of(file);
  const auto seed = file.read_scalar(run::provenance_seed);
  const std::string cells[] = {settings.mesh,
                               fmt::format("{}", s.tets),
                               settings.element,
                               settings.surface,
                               seed < 0 ? "–" : fmt::format("{}", seed),
                               percent(s.kinetic_over_internal),
                               percent(s.largest_residual),
                               fmt::format("{:.3g} s × {}", s.wall_time, s.threads),
                               s.version,
                               s.warnings.empty() ? s.status
                                                  : fmt::format("{}; {}", s.status, fmt::join(s.warnings, "; "))};
  std::string text;
  for (const std::string& cell : cells) text += fmt::format("<td>{}</td>", html_text(cell));
  return text;
}

std::string links_of(const ReportRun& entry, const fs::path& page_folder) {
  const fs::path folder = fs::path(entry.file).parent_path();
  const std::pair<fs::path, const char*> files[] = {
      {entry.programme, "scenario"}, {folder / "run.settings", "settings"}, {folder / "work" / "log.txt", "log"}};
  std::string text;
  for (const auto& [path, name] : files)
    if (fs::exists(path)) text += fmt::format("{}{}", text.empty() ? "" : " ", link_to(path, page_folder, name));
  return text;
}

} // namespace

std::string link_to(const fs::path& file, const fs::path& page_folder, const std::string& text) {
  const fs::path from = page_folder.empty() ? fs::path(".") : page_folder;
  return fmt::format("<a href=\"{}\">{}</a>",
                     html_text(address_of(fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(from)))),
                     html_text(text));
}

std::vector<ReportRun> runs_of_figure(const Figure& figure, const ResultsFolder& results) {
  RunGraph graph;
  const auto add = [&](const std::vector<std::string>& names, const std::vector<Case>& cases, const Place& place) {
    for (const Case& row : cases)
      for (const std::string& name : names) {
        const RunTemplate& run = figure.run(name, place);
        if (belongs_to(run, row)) add_run(graph, figure, run, row);
      }
  };
  for (const TableSpec& table : figure.tables)
    if (const auto names = runs_of(table); !names.empty())
      add(names, available_cases(figure, table.series, table.where, names, results, table.place), table.place);
  for (const PictureSpec& picture : figure.pictures)
    add({picture.run}, available_cases(figure, picture.series, picture.where, {picture.run}, results, picture.place),
        picture.place);
  for (const ScriptSpec& script : figure.scripts)
    if (!script.run.empty())
      add({script.run}, cases_of(figure, script.series, script.where, results.mesh, script.place), script.place);
  std::vector<ReportRun> runs;
  for (const auto& [folder, instance] : graph)
    if (!instance.is_packing && instance.is_made)
      runs.push_back({folder, file_of(instance, results, ""), instance.programme});
  return runs;
}

std::string runs_table(const std::vector<ReportRun>& runs, const fs::path& page_folder) {
  if (runs.empty()) return "";
  std::string text = fmt::format(
      "<details><summary>Settings and provenance of {} {}</summary>\n<div class=\"wide\"><table class=\"runs\">\n"
      "<tr><th>run</th><th>mesh</th><th>tetrahedra</th><th>element</th><th>contact surface</th><th>seed</th>"
      "<th title=\"largest, while the mean stress is above a tenth of its largest\">kinetic / internal energy</th>"
      "<th title=\"largest energy residual over the external work\">energy residual</th>"
      "<th>wall time × threads</th><th>version</th><th>status</th><th>files</th></tr>\n",
      runs.size(), runs.size() == 1 ? "run" : "runs");
  for (const ReportRun& entry : runs) {
    text += fmt::format("<tr><td>{}</td>", html_text(entry.name));
    try {
      text += fs::exists(entry.file) ? row_of({entry.file, schema::FileKind::run})
                                     : std::string("<td colspan=\"10\">the run file is not here</td>");
    } catch (const InputError& error) {
      text += fmt::format("<td colspan=\"10\">{}</td>", html_text(error.what()));
    }
    text += fmt::format("<td>{}</td></tr>\n", links_of(entry, page_folder));
  }
  return text + "</table></div></details>\n";
}

} // namespace mpfem
