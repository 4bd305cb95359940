#include "postproc/figure/report.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/base64.hpp"
#include "postproc/view/view_page.hpp"

namespace mpfem {

namespace {

constexpr const char* style =
    R"(  body { font: 16px/1.45 sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
  table { border-collapse: collapse; margin: 1rem 0; }
  td, th { border: 1px solid #bbb; padding: 0.3rem 0.6rem; text-align: left; vertical-align: top; }
  tr.true td:nth-child(4) { background: #d9f0d9; }
  tr.false td:nth-child(4) { background: #f7d4cf; }
  .pictures { display: flex; flex-wrap: wrap; gap: 1rem; }
  figure { margin: 0; width: 36rem; max-width: 100%; }
  img { width: 100%; }
  .view { width: 100%; height: 56rem; max-height: 95vh; border: 1px solid #ccc; }
  figcaption { font-size: 0.85rem; color: #555; }
)";

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::filesystem::path> files_with(const std::filesystem::path& folder, const std::string& ending) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (entry.path().extension() == ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The statements of a figure. Throws InputError.
nlohmann::json statements_in(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "verdict.json";
  auto list = nlohmann::json::parse(content_of(path), nullptr, false);
  if (!list.is_array()) throw InputError(fmt::format("{}: is not a list of statements", one_line(path.string())));
  return list;
}

/// How many statements of each figure agree, differ and are not judged, with links to them.
std::string summary_table(const std::vector<ReportEntry>& entries, const std::filesystem::path& results) {
  std::string text = "<table class=\"summary\">\n<tr><th>study</th><th>agree</th><th>differ</th><th>not judged</th>"
                     "</tr>\n";
  std::array<int, 3> all{};
  for (const ReportEntry& entry : entries) {
    std::array<int, 3> count{};
    for (const auto& s : statements_in(results / entry.name)) {
      const auto& agrees = s.at("agrees");
      ++count.at(agrees.is_null() ? 2 : agrees.get<bool>() ? 0 : 1);
    }
    for (std::size_t i = 0; i < 3; ++i) all[i] += count[i];
    text += fmt::format("<tr><td><a href=\"#{0}\">{1}</a></td><td>{2}</td><td>{3}</td><td>{4}</td></tr>\n", entry.name,
                        html_text(entry.title), count[0], count[1], count[2]);
  }
  return text +
         fmt::format("<tr><th>all</th><th>{}</th><th>{}</th><th>{}</th></tr>\n</table>\n", all[0], all[1], all[2]);
}

/// The note, and why the statement differs where it does.
std::string note_of(const nlohmann::json& statement) {
  const std::string note = statement.at("note").get<std::string>(), why = statement.value("why", "");
  return why.empty() ? note : fmt::format("{}{}why: {}", note, note.empty() ? "" : "; ", why);
}

std::string statements_table(const std::filesystem::path& folder) {
  const auto list = statements_in(folder);
  std::string text = "<table>\n<tr><th>statement</th><th>paper</th><th>here</th><th>verdict</th><th>note</th></tr>\n";
  for (const auto& s : list) {
    const auto& agrees = s.at("agrees");
    const char* word = agrees.is_null() ? "not judged" : agrees.get<bool>() ? "agrees" : "differs";
    const char* row = agrees.is_null() ? "null" : agrees.get<bool>() ? "true" : "false";
    const auto cell = [&](const char* key) { return html_text(s.at(key).get<std::string>()); };
    text += fmt::format("<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", row,
                        cell("statement"), cell("paper"), cell("ours"), word, html_text(note_of(s)));
  }
  return text + "</table>\n";
}

} // namespace

std::string report_page(const std::vector<ReportEntry>& entries, const std::string& results, const std::string& title,
                        const std::string& view) {
  std::string page = fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                                 "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
                                 html_text(title), style);
  page += "<p>Each table sets what was stated or expected beside what was computed here; the last but one column is "
          "computed from the data.</p>\n";
  page += summary_table(entries, results);
  if (!view.empty())
    page += fmt::format("<iframe class=\"view\" title=\"Grains in three dimensions\" srcdoc=\"{}\"></iframe>\n",
                        html_text(view));
  for (const ReportEntry& entry : entries) {
    const std::filesystem::path folder = std::filesystem::path(results) / entry.name;
    page += fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n<div class=\"pictures\">\n", entry.name,
                        html_text(entry.title), html_text(entry.question));
    for (const auto& picture : files_with(folder, ".png"))
      page +=
          fmt::format("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
                      picture.stem().string(), base64(content_of(picture)), picture.string());
    page += "</div>\n" + statements_table(folder) + "<p>Numbers:";
    for (const auto& table : files_with(folder, ".csv"))
      page += fmt::format(" <a href=\"../{0}/{1}\">{1}</a>", entry.name, table.filename().string());
    page += "</p>\n";
  }
  return page + "</body>\n</html>\n";
}

} // namespace mpfem
