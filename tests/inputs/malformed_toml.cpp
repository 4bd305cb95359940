#include "malformed_toml.hpp"

#include <sstream>

#include <fmt/format.h>

namespace mpfem::test {

namespace {

struct Line {
  std::string key, value; ///< empty: no assignment
};

Line parts_of(const std::string& line) {
  const std::size_t equals = line.find(" = ");
  if (equals == std::string::npos) return {};
  return {line.substr(0, equals), line.substr(equals + 3)};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string with_line(std::vector<std::string> lines, std::size_t number, const std::string& line) {
  lines[number] = line;
  std::string text;
  for (const std::string& one : lines) text += one + '\n';
  return text;
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

} // namespace

std::vector<MalformedText> spoilt_documents(const std::string& good) {
  std::vector<MalformedText> documents;
  const std::vector<std::string> lines = lines_of(good);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto [key, value] = parts_of(lines[i]);
    if (key.empty()) continue;
    const std::string line = fmt::format(":{}:", i + 1);
    std::vector<std::string> bad = {"nan", "-inf", "1e308", "-1e308", "{}", "1979-05-27", "[[], 1]"};
    if (!value.starts_with('\'')) bad.push_back("'text'");
    if (value != "true" && value != "false") bad.push_back("true");
    for (const std::string& other : bad)
      documents.push_back(
          {fmt::format("{} = {}", key, other), with_line(lines, i, fmt::format("{} = {}", key, other)), {line, key}});
    if (value.starts_with('['))
      documents.push_back({key + " = [nan]", with_line(lines, i, key + " = [nan]"), {line, key}});
    documents.push_back({key + "x", with_line(lines, i, fmt::format("{}x = {}", key, value)), {key}});
    documents.push_back(
        {key + " twice", with_line(lines, i, lines[i] + '\n' + lines[i]), {fmt::format(":{}:", i + 2)}});
    documents.push_back({key + " without a value", with_line(lines, i, key + " ="), {fmt::format(":{}:", i + 1)}});
  }
  return documents;
}

std::vector<MalformedText> hopeless_documents() {
  const std::string endless(200'000, 'x');
  std::vector<MalformedText> documents = {
      {"nothing", "", {}},
      {"a comment", "# nothing\n", {}},
      {"zero bytes", std::string(1000, '\0'), {":1"}},
      {"bytes that are no text", "\xff\xfe\xfd = 1\n", {":1"}},
      {"half a character", "a = \"\xc3\"\n", {":1"}},
      {"an order to a terminal", "\x1b[2J = 1\n", {":1"}},
      {"another format", "<?xml version=\"1.0\"?><a/>\n", {":1"}},
      {"an open string", "a = 'b\n", {":1"}},
      {"an open long string", "a = '''b\n", {}},
      {"an open bracket", "a = [1, 2\n", {}},
      {"a closed bracket", "a = ]\n", {":1"}},
      {"a long key", endless + " = 1\n", {}},
      {"a long key twice", endless + " = 1\n" + endless + " = 1\n", {":2"}},
      {"a long word", std::string("a = ") + endless + "\n", {":1"}},
      {"a long number", std::string("a = ") + std::string(200'000, '9') + "\n", {":1"}},
      {"a long fraction", std::string("a = 0.") + std::string(200'000, '9') + "x\n", {":1"}},
      {"many keys",
       [] {
         std::string text;
         for (int i = 0; i < 100'000; ++i) text += fmt::format("k{} = {}\n", i, i);
         return text;
       }(),
       {}},
      {"a hexadecimal number", "packing = 0xfffffffffffffffff\n", {":1"}},
      {"a date that is none", "a = 2026-13-45\n", {":1"}},
  };
  for (const int depth : {65, 300, 32'000}) {
    documents.push_back({fmt::format("{} arrays", depth), std::string("a = ") + repeated("[", depth), {":1"}});
    documents.push_back({fmt::format("{} closed arrays", depth),
                         std::string("a = ") + repeated("[", depth) + repeated("]", depth),
                         {":1"}});
    documents.push_back({fmt::format("{} tables", depth), std::string("a = ") + repeated("{a = ", depth), {":1"}});
    documents.push_back(
        {fmt::format("a heading of {} parts", depth), std::string("[a") + repeated(".a", depth) + "]\n", {":1"}});
    documents.push_back({fmt::format("an array's heading of {} parts", depth),
                         std::string("[[a") + repeated(".a", depth) + "]]\n",
                         {":1"}});
    documents.push_back(
        {fmt::format("a key of {} parts", depth), std::string("a") + repeated(".a", depth) + " = 1\n", {":1"}});
    documents.push_back({fmt::format("a quoted key of {} parts", depth),
                         std::string("\"a\"") + repeated(".\"a\"", depth) + " = 1\n",
                         {":1"}});
    documents.push_back(
        {fmt::format("{} tables in arrays", depth), std::string("a = ") + repeated("[{b.c = ", depth), {":1"}});
  }
  return documents;
}

} // namespace mpfem::test
