#include "postproc/figure/report.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/figure/run_graph.hpp"
#include "postproc/files/base64.hpp"
#include "postproc/view/view_page.hpp"

namespace mpfem {

namespace {

constexpr const char* style =
    R"(  body { font: 16px/1.45 sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
  h2 { border-top: 1px solid #ccc; margin-top: 2.5rem; padding-top: 1rem; }
  table { border-collapse: collapse; margin: 1rem 0; }
  td, th { border: 1px solid #bbb; padding: 0.3rem 0.6rem; text-align: left; vertical-align: top; }
  th { background: #f3f4f6; }
  .summary td + td, .summary th + th { text-align: right; font-variant-numeric: tabular-nums; }
  .top { display: flex; flex-wrap: wrap; gap: 0 2.5rem; }
  .top section { flex: 1 1 30rem; min-width: 0; }
  h3 { font-size: 1.05rem; margin: 0.5rem 0 0; }
  .wide { overflow-x: auto; }
  .runs { font-size: 0.8rem; }
  summary { cursor: pointer; }
  .statements td:nth-child(4) { white-space: nowrap; }
  tr.true td:nth-child(4) { background: #dbe9f6; }
  tr.false td:nth-child(4) { background: #fde0c5; font-weight: bold; }
  .pictures { display: flex; flex-wrap: wrap; gap: 1rem; }
  figure { margin: 0; width: 36rem; max-width: 100%; }
  figure:has(:checked) { width: 100%; }
  img { width: 100%; display: block; }
  .picture { display: block; position: relative; overflow-x: auto; cursor: zoom-in; }
  .picture input { position: absolute; opacity: 0; }
  .picture :focus-visible + img { outline: 2px solid #0072b2; outline-offset: -2px; }
  .picture :checked + img { width: max(48rem, min(100%, 120vh)); cursor: zoom-out; }
  .view { width: 100%; height: 56rem; max-height: 95vh; border: 1px solid #ccc; }
  figcaption { font-size: 0.9rem; color: #333; margin-top: 0.3rem; }
  sup, sub { line-height: 0; }
  .files { white-space: nowrap; font-size: 0.85em; }
  @media (max-width: 48rem) { /* small margins, links for thumbs, and a statement's cells below each other */
    body { margin: 1rem auto; padding: 0 0.6rem; }
    h1 { font-size: 1.5rem; }
    h2 { font-size: 1.25rem; margin-top: 1.5rem; }
    td, th { padding: 0.3rem 0.4rem; }
    .summary th { font-size: 0.85rem; }
    .stacked tr:first-child { display: none; }
    .stacked tr { display: block; border: 1px solid #bbb; margin-bottom: 0.7rem; padding: 0.2rem 0; }
    .stacked td { display: block; border: 0; padding: 0.1rem 0.6rem; }
    .stacked td:first-child { font-weight: bold; }
    .stacked td::before { content: attr(data-heading) ": "; color: #555; font-weight: normal; }
    .runs { min-width: 75rem; } /* it scrolls: narrower, every row would be tall */
    .view { height: calc(86vw + 30.5rem); max-height: none; } /* grains and all controls, without scrolling in it */
    .files a, .runs a { display: inline-block; padding: 0.3rem 0.4rem; }
    .summary a { display: block; }
    summary { padding: 0.4rem 0; }
    .statements tr:first-child { display: none; }
    .statements tr { display: block; border: 1px solid #bbb; margin-bottom: 0.7rem; padding: 0.2rem 0; }
    .statements td { display: block; border: 0; padding: 0.1rem 0.6rem; }
    .statements td:empty { display: none; }
    .statements td:nth-child(1) { font-weight: bold; }
    .statements td:nth-child(2)::before { content: "paper: "; color: #555; }
    .statements td:nth-child(3)::before { content: "here: "; color: #555; }
  }
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

/// The statements of a figure. Throws InputError where verdict.json is missing or not a list.
nlohmann::json statements_in(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "verdict.json";
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("{}: no such file; postproc verdict writes it", one_line(path.string())));
  auto list = nlohmann::json::parse(content_of(path), nullptr, false);
  if (!list.is_array()) throw InputError(fmt::format("{}: is not a list of statements", one_line(path.string())));
  return list;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_word(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
}

/// True if the text ends in a symbol of one letter, Latin or Greek, rather than in a word.
bool ends_in_symbol(const std::string& text) {
  const std::size_t size = text.size();
  if (size >= 2 && (text[size - 2] == '\xCE' || text[size - 2] == '\xCF')) return true;
  return size >= 1 && is_letter(text[size - 1]) && (size == 1 || !is_word(text[size - 2]));
}

/// End of an exponent or index that begins at `at`: "{…}", or a number or letters, with a sign; `at` if there is none.
std::size_t end_of_script(const std::string& text, std::size_t at) {
  if (at < text.size() && text[at] == '{') return std::min(text.find('}', at), text.size() - 1) + 1;
  std::size_t end = at;
  if (text.compare(end, 1, "-") == 0) ++end;
  if (text.compare(end, 3, "−") == 0) end += 3;
  const std::size_t first = end;
  while (end < text.size() && (is_word(text[end]) || text[end] == '.')) ++end;
  while (end > first && text[end - 1] == '.') --end; // end of the sentence
  return end > first ? end : at;
}

/// HTML of a text: exponents ("G^c", "10^{-3}") are raised and indices of symbols ("D_r", not "run_1") lowered; `code`
/// of Markdown becomes an element and is otherwise unchanged.
std::string formatted(const std::string& plain) {
  const std::string text = html_text(plain);
  std::string page;
  bool code = false;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '`') {
      page += (code = !code) ? "<code>" : "</code>";
      ++at;
      continue;
    }
    const bool raised = !code && text[at] == '^' && at > 0, lowered = !code && text[at] == '_' && ends_in_symbol(page);
    const std::size_t end = raised || lowered ? end_of_script(text, at + 1) : 0;
    if (end <= at + 1) {
      page += text[at++];
      continue;
    }
    const bool braces = text[at + 1] == '{';
    page += fmt::format("<{0}>{1}</{0}>", raised ? "sup" : "sub",
                        text.substr(at + 1 + (braces ? 1 : 0), end - at - 1 - (braces ? 2 : 0)));
    at = end;
  }
  return page;
}

/// Numbers of statements of each figure that agree, differ and are not judged, with links to the figures. Empty where
/// no figure has statements.
std::string summary_table(const std::vector<ReportEntry>& entries, const std::filesystem::path& results) {
  std::string text = "<div class=\"wide\"><table "
                     "class=\"summary\">\n<tr><th>study</th><th>agree</th><th>differ</th><th>not judged</th>"
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
  if (all == std::array<int, 3>{}) return {};
  return text + fmt::format("<tr><th>all</th><th>{}</th><th>{}</th><th>{}</th></tr>\n</table></div>\n", all[0], all[1],
                            all[2]);
}

/// The note, and the reason for a difference where there is one.
std::string note_of(const nlohmann::json& statement) {
  const std::string note = statement.at("note").get<std::string>(), why = statement.value("why", "");
  return why.empty() ? note : fmt::format("{}{}why: {}", note, note.empty() ? "" : "; ", why);
}

/// Empty for a figure without statements.
std::string statements_table(const std::filesystem::path& folder) {
  const auto list = statements_in(folder);
  if (list.empty()) return {};
  std::string text =
      "<div class=\"wide\"><table "
      "class=\"statements\">\n<tr><th>statement</th><th>paper</th><th>here</th><th>verdict</th><th>note</th></tr>\n";
  for (const auto& s : list) {
    const auto& agrees = s.at("agrees");
    const char* word = agrees.is_null() ? "not judged" : agrees.get<bool>() ? "✓ agrees" : "✗ differs";
    const char* row = agrees.is_null() ? "null" : agrees.get<bool>() ? "true" : "false";
    const auto cell = [&](const char* key) { return formatted(s.at(key).get<std::string>()); };
    text += fmt::format("<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", row,
                        cell("statement"), cell("paper"), cell("ours"), word, formatted(note_of(s)));
  }
  return text + "</table></div>\n";
}

/// The cells of a Markdown row "| a | b |".
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t at = 1, end = 0; (end = line.find('|', at)) != std::string::npos; at = end + 1) {
    const std::size_t first = line.find_first_not_of(' ', at), last = line.find_last_not_of(' ', end - 1);
    cells.push_back(first < end ? line.substr(first, last - first + 1) : std::string());
  }
  return cells;
}

/// A row of a table. On a narrow page its cells lie below each other, each with its heading. Without headings it is
/// their row.
std::string row_of(const std::vector<std::string>& cells, const std::vector<std::string>& headings) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i)
    row += headings.empty() ? fmt::format("<th>{}</th>", formatted(cells[i]))
                            : fmt::format("<td data-heading=\"{}\">{}</td>",
                                          i < headings.size() ? html_text(headings[i]) : "", formatted(cells[i]));
  return "<tr>" + row + "</tr>\n";
}

/// The title and the first table of a Markdown page, with a link to it.
std::string table_of_page(const ReportRequest& request) {
  std::istringstream lines(content_of(request.beside));
  std::string line, title, rows;
  std::vector<std::string> headings;
  while (std::getline(lines, line)) {
    if (line.starts_with("# ") && title.empty()) title = line.substr(2);
    if (!line.starts_with('|') && !rows.empty()) break;
    if (!line.starts_with('|') || line.starts_with("|-")) continue;
    const std::vector<std::string> cells = cells_of(line);
    rows += row_of(cells, headings);
    if (!headings.empty()) continue;
    headings = cells;
    for (std::string& heading : headings) std::erase(heading, '`'); // an attribute has no code
  }
  if (rows.empty()) throw InputError(fmt::format("{}: found no table, allowed: Markdown", one_line(request.beside)));
  return fmt::format(
      "<section><h3>{}</h3>\n<div class=\"wide\"><table class=\"stacked\">\n{}</table></div>\n<p>{}</p></section>\n",
      html_text(title), rows, link_to(request.beside, request.page_folder, "all tables and conditions"));
}

/// The file's name with spaces for hyphens, without its ending.
std::string words_of(const std::filesystem::path& file) {
  std::string words = file.stem().string();
  std::replace(words.begin(), words.end(), '-', ' ');
  return words;
}

/// The PNG files of a figure with their captions: those with a caption in its file, in its order, then the others.
std::vector<CaptionedPicture> pictures_in(const std::filesystem::path& folder, const ReportEntry& entry) {
  std::vector<CaptionedPicture> pictures;
  for (const CaptionedPicture& picture : entry.captions)
    if (std::filesystem::exists(folder / picture.file)) pictures.push_back(picture);
  for (const auto& file : files_with(folder, ".png")) {
    const auto has_caption = [&](const CaptionedPicture& p) { return p.file == file.filename(); };
    if (std::none_of(entry.captions.begin(), entry.captions.end(), has_caption))
      pictures.push_back({file.filename().string(), words_of(file)});
  }
  return pictures;
}

/// A picture, which a click enlarges, with links to its files.
std::string picture_of(const std::filesystem::path& picture, const std::string& caption,
                       const std::filesystem::path& page_folder) {
  std::filesystem::path vector = picture;
  vector.replace_extension(".svg");
  std::string links = link_to(picture, page_folder, "PNG");
  if (std::filesystem::exists(vector)) links += fmt::format(" {}", link_to(vector, page_folder, "SVG"));
  return fmt::format("<figure><label class=\"picture\"><input type=\"checkbox\" aria-label=\"large\"><img "
                     "alt=\"{0}\" src=\"data:image/png;base64,{1}\"></label><figcaption>{2} <span "
                     "class=\"files\">{3}</span></figcaption></figure>\n",
                     html_text(words_of(picture)), base64(content_of(picture)), formatted(caption), links);
}

/// Links to the files of tables and verdicts.
std::string links_of(const ReportEntry& entry, const std::filesystem::path& folder,
                     const std::filesystem::path& page_folder) {
  std::string text;
  for (const char* ending : {".csv", ".json"})
    for (const auto& file : files_with(folder, ending))
      text += fmt::format(" {}", link_to(file, page_folder, file.filename().string()));
  if (!entry.source.empty()) text += fmt::format(" · made from {}", link_to(entry.source, page_folder, "figure.toml"));
  return text;
}

} // namespace

std::vector<CaptionedPicture> captions_of_figure(const Figure& figure, const ResultsFolder& results) {
  std::vector<CaptionedPicture> captions;
  for (const PlotSpec& plot : figure.plots)
    if (!plot.caption.empty()) captions.push_back({plot.name + ".png", plot.caption});
  std::vector<CommandSpec> commands(figure.pictures.begin(), figure.pictures.end());
  commands.insert(commands.end(), figure.scripts.begin(), figure.scripts.end());
  for (const CommandSpec& command : commands) {
    if (command.caption.empty()) continue;
    for (const Case& row : cases_of(figure, command.series, command.where, results.mesh, command.place)) {
      const std::string file = filled_at(command.place, command.name, row.values);
      if (std::none_of(captions.begin(), captions.end(), [&](const auto& c) { return c.file == file; }))
        captions.push_back({file, filled_at(command.place, command.caption, row.values)});
    }
  }
  return captions;
}

std::vector<std::string> files_on_page(const ReportEntry& entry, const std::string& folder) {
  std::vector<std::string> files;
  for (const CaptionedPicture& picture : pictures_in(folder, entry)) {
    const std::filesystem::path path = std::filesystem::path(folder) / picture.file;
    files.push_back(path.string());
    files.push_back(std::filesystem::path(path).replace_extension(".svg").string());
  }
  for (const char* ending : {".csv", ".json"})
    for (const auto& file : files_with(folder, ending)) files.push_back(file.string());
  return files;
}

std::string report_page(const std::vector<ReportEntry>& entries, const ReportRequest& request) {
  std::string page =
      fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
                  "content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n"
                  "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
                  html_text(request.title), style);
  const std::string summary = summary_table(entries, request.results);
  const bool judged = !summary.empty();
  page += "<p>";
  if (judged)
    page += "The tables compare what was stated or expected with the results computed here. Verdicts follow from the "
            "data. ";
  page += "A click on a picture enlarges it.</p>\n<div class=\"top\">\n";
  if (judged) page += "<section><h3 id=\"verdicts\">Verdicts</h3>\n" + summary + "</section>\n";
  if (!request.beside.empty()) page += table_of_page(request);
  page += "</div>\n";
  if (request.view)
    page += fmt::format("<iframe class=\"view\" title=\"Grains in three dimensions\" srcdoc=\"{}\"></iframe>\n",
                        html_text(request.view()));
  for (const ReportEntry& entry : entries) {
    const std::filesystem::path folder = std::filesystem::path(request.results) / entry.name;
    page += fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n<div class=\"pictures\">\n", entry.name,
                        html_text(entry.title), formatted(entry.question));
    for (const CaptionedPicture& picture : pictures_in(folder, entry))
      page += picture_of(folder / picture.file, picture.caption, request.page_folder);
    page += "</div>\n" + statements_table(folder) +
            fmt::format("<p>Numbers:{}{}</p>\n", links_of(entry, folder, request.page_folder),
                        judged ? " · <a href=\"#verdicts\">all verdicts</a>" : "") +
            runs_table(entry.runs, request.page_folder);
  }
  return page + "</body>\n</html>\n";
}

} // namespace mpfem
