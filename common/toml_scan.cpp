#include "common/toml_scan.hpp"

#include <algorithm>
#include <vector>

namespace mpfem {

namespace {

/// Walks over a TOML text, past strings and comments. It need not refuse invalid TOML: the parser does.
class TomlScan {
public:
  explicit TomlScan(std::string_view text) : text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3; // byte order mark
  }

  std::optional<std::size_t> first_line_deeper_than(std::size_t deepest) {
    while (at_ < text_.size()) {
      step();
      if (header_ + enclosing_ + dots_ > deepest) return line_;
    }
    return std::nullopt;
  }

private:
  void step() {
    const char c = text_[at_];
    switch (c) {
    case '#':
      at_ = std::min(text_.find('\n', at_), text_.size());
      return;
    case '"':
    case '\'':
      skip_string(c);
      blank_so_far_ = false;
      return;
    case '\n':
      end_line();
      break;
    case '[':
    case '{':
      if (blank_so_far_ && open_.empty() && c == '[')
        begin_heading();
      else
        open();
      break;
    case ']':
    case '}':
      close();
      break;
    case '.':
      ++dots_;
      break;
    case ',':
      dots_ = 0;
      break;
    default:
      break;
    }
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') blank_so_far_ = false;
    ++at_;
  }

  void skip_string(char quote) {
    const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
    const bool several_lines = text_.substr(at_).starts_with(three);
    at_ += several_lines ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') {
        if (!several_lines) return;
        ++line_;
      } else if (text_[at_] == '\\' && quote == '"') {
        if (++at_ < text_.size() && text_[at_] == '\n') ++line_;
      } else if (several_lines ? text_.substr(at_).starts_with(three) : text_[at_] == quote) {
        at_ += several_lines ? 3 : 1;
        // Up to two quotes may stand before the three that end a string of several lines.
        for (int i = 0; several_lines && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i) ++at_;
        return;
      }
    }
  }

  void end_line() {
    if (in_heading_) header_ = dots_;
    in_heading_ = false;
    blank_so_far_ = true;
    dots_ = 0;
    ++line_;
  }

  void begin_heading() {
    in_heading_ = true;
    header_ = 0;
    if (text_.substr(at_).starts_with("[[")) ++at_;
  }

  void open() {
    open_.push_back(dots_ + 1);
    enclosing_ += open_.back();
    dots_ = 0;
  }

  void close() {
    if (in_heading_ || open_.empty()) return;
    enclosing_ -= open_.back();
    open_.pop_back();
    dots_ = 0;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  std::size_t header_ = 0, enclosing_ = 0, dots_ = 0; ///< levels of the last heading, open brackets, the key at hand
  std::vector<std::size_t> open_;
  bool blank_so_far_ = true, in_heading_ = false;
};

} // namespace

std::optional<std::size_t> line_nested_too_deep(std::string_view toml, std::size_t deepest) {
  return TomlScan(toml).first_line_deeper_than(deepest);
}

} // namespace mpfem
