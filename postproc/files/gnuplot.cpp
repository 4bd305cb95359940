#include "postproc/files/gnuplot.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

/// The text in single quotes, every quote inside replaced.
std::string in_single_quotes(const std::string& text, std::string_view inner_quote) {
  std::string result = "'";
  for (const char c : one_line(text)) {
    if (c == '\'')
      result += inner_quote;
    else
      result += c;
  }
  return result + "'";
}

} // namespace

TemporaryFile::TemporaryFile(const std::string& content) {
  path_ = (std::filesystem::temp_directory_path() / "mpfem-section-XXXXXX").string();
  const int descriptor = mkstemp(path_.data());
  if (descriptor < 0) throw StorageError(fmt::format("{}: cannot be made", path_));
  std::FILE* file = fdopen(descriptor, "wb");
  if (!file) close(descriptor);
  const bool good = file && std::fwrite(content.data(), 1, content.size(), file) == content.size();
  if (!file || std::fclose(file) != 0 || !good) {
    std::remove(path_.c_str());
    throw StorageError(fmt::format("{}: cannot be written", path_));
  }
}

TemporaryFile::~TemporaryFile() {
  std::remove(path_.c_str());
}

std::string TemporaryFile::content() const {
  std::ifstream file(path_, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string gnuplot_string(const std::string& text) {
  return in_single_quotes(text, "''");
}

std::string with_points_as_in_png(std::string svg) {
  // The terminal defines each point once, at a fixed ratio to the font. Triangles and pentagons are larger than others,
  // and the diamond is a square on its corner.
  constexpr std::pair<const char*, const char*> changes[] = {
      {R"( id='gpPt(7|13)' stroke-width='[0-9.]+')",
       R"( id='gpPt$1' transform='scale(0.3)' vector-effect='non-scaling-stroke')"},
      {R"( id='gpPt([0-9]+)' stroke-width='[0-9.]+')",
       R"( id='gpPt$1' transform='scale(0.4)' vector-effect='non-scaling-stroke')"},
      {R"('rotate\(45\)'/>)", R"('rotate(45) scale(0.7)'/>)"}};
  const std::size_t end = std::min(svg.find("</defs>"), svg.size());
  std::string definitions = svg.substr(0, end);
  for (const auto& [found, wanted] : changes) definitions = std::regex_replace(definitions, std::regex(found), wanted);
  return svg.replace(0, end, definitions);
}

void run_gnuplot(const std::string& script) {
  const TemporaryFile file(script);
  std::FILE* pipe = popen(fmt::format("gnuplot -d {} 2>&1", in_single_quotes(file.path(), "'\\''")).c_str(), "r");
  if (!pipe) throw SimulationError("cannot start gnuplot");
  std::string message;
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe)) message += buffer;
  const int status = pclose(pipe);
  if (status == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw SimulationError("gnuplot is not installed; pictures need it");
  throw SimulationError(fmt::format("gnuplot failed: {}", one_line(message.substr(0, 300))));
}

} // namespace mpfem
