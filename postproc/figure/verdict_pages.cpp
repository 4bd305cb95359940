#include "postproc/figure/verdict_pages.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

namespace filesystem = std::filesystem;

struct Statement {
  std::string text, paper, ours, why;
  int agrees = 2; ///< 0 agrees, 1 differs, 2 not judged
};

using Verdicts = std::map<std::string, std::vector<Statement>>; ///< by figure

std::vector<Statement> read_statements(const filesystem::path& path) {
  std::ifstream file(path);
  const auto list = nlohmann::json::parse(file, nullptr, false);
  const auto refuse = [&] {
    throw InputError(fmt::format("{}: is not a list of statements", one_line(path.string())));
  };
  if (!list.is_array()) refuse();
  std::vector<Statement> statements;
  for (const auto& s : list) {
    if (!s.is_object() || !s.contains("agrees")) refuse();
    const auto& agrees = s["agrees"];
    statements.push_back({s.value("statement", ""), s.value("paper", ""), s.value("ours", ""), s.value("why", ""),
                          agrees.is_boolean() ? (agrees.get<bool>() ? 0 : 1) : 2});
  }
  return statements;
}

Verdicts read_verdicts(const std::string& folder) {
  Verdicts verdicts;
  for (const filesystem::path path : verdict_files(folder))
    verdicts[path.parent_path().filename().string()] = read_statements(path);
  return verdicts;
}

/// The text of a Markdown cell.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? "\\|" : std::string(1, c);
  return result;
}

/// "agrees / differs / not judged"; empty if all are 0.
std::string tally(const std::array<int, 3>& count) {
  return count == std::array<int, 3>{} ? "" : fmt::format("{} / {} / {}", count[0], count[1], count[2]);
}

const Statement* find(const std::vector<Statement>& statements, const std::string& text) {
  const auto found =
      std::find_if(statements.begin(), statements.end(), [&](const Statement& s) { return s.text == text; });
  return found == statements.end() ? nullptr : &*found;
}

/// The statements of all meshes, in order of first appearance.
std::vector<Statement> all_statements(const std::vector<Verdicts>& meshes, const std::string& figure) {
  std::vector<Statement> all;
  for (const Verdicts& mesh : meshes)
    if (const auto at = mesh.find(figure); at != mesh.end())
      for (const Statement& s : at->second)
        if (find(all, s.text) == nullptr) all.push_back(s);
  return all;
}

/// Why a statement differs: the first mesh's reason, since all meshes share the figure's file.
std::string reason(const std::vector<Verdicts>& meshes, const std::string& figure, const std::string& text) {
  for (const Verdicts& mesh : meshes)
    if (const auto at = mesh.find(figure); at != mesh.end())
      if (const Statement* found = find(at->second, text); found != nullptr && !found->why.empty()) return found->why;
  return {};
}

std::string tallies(const std::vector<Verdicts>& meshes, const std::set<std::string>& figures) {
  std::string text;
  std::vector<std::array<int, 3>> sums(meshes.size());
  for (const std::string& figure : figures) {
    text += fmt::format("| [{0}](#{0}) |", figure);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      std::array<int, 3> count{};
      if (const auto at = meshes[m].find(figure); at != meshes[m].end())
        for (const Statement& s : at->second) {
          ++count.at(static_cast<std::size_t>(s.agrees));
          ++sums[m].at(static_cast<std::size_t>(s.agrees));
        }
      text += fmt::format(" {} |", tally(count));
    }
    text += '\n';
  }
  text += "| **all** |";
  for (const auto& sum : sums) text += fmt::format(" {} |", tally(sum));
  return text + "\n";
}

/// The rows of a figure's table: the result of each mesh, then the reason for a difference.
std::string rows_of_figure(const std::vector<Verdicts>& meshes, const std::string& figure) {
  static constexpr std::array words = {"agrees", "**differs**", "not judged"};
  std::string text;
  for (const Statement& statement : all_statements(meshes, figure)) {
    text += fmt::format("| {} | {} |", cell(statement.text), cell(statement.paper));
    for (const Verdicts& mesh : meshes) {
      const auto at = mesh.find(figure);
      const Statement* found = at == mesh.end() ? nullptr : find(at->second, statement.text);
      text += found == nullptr
                  ? "  |"
                  : fmt::format(" {}: {} |", words.at(static_cast<std::size_t>(found->agrees)), cell(found->ours));
    }
    text += fmt::format(" {} |\n", cell(reason(meshes, figure, statement.text)));
  }
  return text;
}

} // namespace

std::vector<std::string> verdict_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : filesystem::directory_iterator(folder, error))
    if (const auto path = entry.path() / "verdict.json"; filesystem::exists(path)) files.push_back(path.string());
  if (error)
    throw InputError(fmt::format("{}: cannot be read as a folder ({}), allowed: a folder of results, with a "
                                 "verdict.json for each figure",
                                 one_line(folder), error.message()));
  return files;
}

std::string verdicts_of_mesh(const MeshVerdicts& mesh) {
  static constexpr std::array words = {"agrees", "differs", "not judged"};
  std::string text;
  for (const auto& [figure, statements] : read_verdicts(mesh.folder)) {
    text += fmt::format("\n## {}\n\n| statement | {} | here | verdict |\n|---|---|---|---|\n", figure,
                        figure.starts_with("fig") ? "paper" : "expected");
    for (const Statement& s : statements)
      text += fmt::format("| {} | {} | {} | {} |\n", cell(s.text), cell(s.paper), cell(s.ours),
                          words.at(static_cast<std::size_t>(s.agrees)));
  }
  return text;
}

std::string verdicts_of_meshes(const std::vector<MeshVerdicts>& meshes) {
  std::vector<Verdicts> verdicts;
  std::set<std::string> figures;
  std::string head, rule;
  for (const MeshVerdicts& mesh : meshes) {
    head += fmt::format(" {} |", mesh.mesh);
    rule += "---|";
    verdicts.push_back(read_verdicts(mesh.folder));
    for (const auto& [figure, statements] : verdicts.back())
      if (figure.starts_with("fig")) figures.insert(figure);
  }
  std::string text = fmt::format("Statements that agree / differ / are not judged:\n\n| study |{}\n|---|{}\n{}", head,
                                 rule, tallies(verdicts, figures));
  for (const std::string& figure : figures)
    text += fmt::format("\n## {0}\n\n[How it is made and judged](../studies/{0}/README.md)\n\n"
                        "| statement | paper |{1} why it differs |\n|---|---|{2}---|\n{3}",
                        figure, head, rule, rows_of_figure(verdicts, figure));
  return text;
}

} // namespace mpfem
