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

  std::optional<std::size_t> first_line_beyond_ascii() {
    while (at_ < text_.size()) {
      if (static_cast<unsigned char>(text_[at_]) > 127) return line_;
      step();
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
      if (!string_may_begin()) break;
      skip_string(c);
      before_ = c;
      return;
    case '\n':
      end_line();
      break;
    case '[':
    case '{':
      if (before_ == '\n' && open_.empty() && c == '[')
        begin_heading();
      else
        open(c);
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
      in_value_ = !open_.empty() && open_.back().bracket == '[';
      break;
    case '=':
      in_value_ = true;
      break;
    default:
      break;
    }
    if (c != ' ' && c != '\t' && c != '\r') before_ = c;
    ++at_;
  }

  /// Strings are keys, parts of dotted keys and values. A quote anywhere else is an error that the parser describes by
  /// reading on: what follows it is not within a string.
  bool string_may_begin() const {
    return before_ == '.' ? !in_value_ : std::string_view("\n=,[{").find(before_) != std::string_view::npos;
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
    in_value_ = !open_.empty();
    dots_ = 0;
    ++line_;
  }

  void begin_heading() {
    in_heading_ = true;
    header_ = 0;
    if (text_.substr(at_).starts_with("[[")) ++at_;
  }

  void open(char bracket) {
    open_.push_back({bracket, dots_ + 1});
    enclosing_ += open_.back().levels;
    dots_ = 0;
    in_value_ = bracket == '[';
  }

  void close() {
    if (in_heading_ || open_.empty()) return;
    enclosing_ -= open_.back().levels;
    open_.pop_back();
    dots_ = 0;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  std::size_t header_ = 0, enclosing_ = 0, dots_ = 0; ///< levels of the last heading, open brackets, the key at hand
  struct Bracket {
    char bracket;
    std::size_t levels; ///< of nesting that it adds: its own and those of the dotted key before it
  };
  std::vector<Bracket> open_;
  char before_ = '\n'; ///< the last letter that is not blank; at the beginning of a line, its end
  bool in_heading_ = false, in_value_ = false;
};

} // namespace

std::optional<std::size_t> line_nested_too_deep(std::string_view toml, std::size_t deepest) {
  return TomlScan(toml).first_line_deeper_than(deepest);
}

std::optional<std::size_t> line_beyond_ascii(std::string_view toml) {
  return TomlScan(toml).first_line_beyond_ascii();
}

} // namespace mpfem
