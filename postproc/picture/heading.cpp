#include "postproc/picture/heading.hpp"

#include <algorithm>
#include <sstream>

#include "common/one_line.hpp"

namespace mpfem {

namespace {

constexpr double widest = 0.96;        ///< line, as a share of the picture's width
constexpr double letter_width = 0.56;  ///< as a share of the height
constexpr std::size_t most_lines = 3;  ///< of a title in letters of full height
constexpr double smallest_title = 0.4; ///< of the full height

bool begins_letter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; // not a later byte of UTF-8
}

std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_letter));
}

/// The first `count` letters.
std::string beginning_of(const std::string& text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t letters = 0; end < text.size(); ++end)
    if (begins_letter(text[end]) && letters++ == count) break;
  return text.substr(0, end);
}

std::size_t letters_in(double width, double height) {
  return static_cast<std::size_t>(std::max(1.0, widest * width / (letter_width * height)));
}

void set_title(Heading& heading, const std::string& title, const PictureSize& size) {
  const double full = heading.title_height;
  for (double factor = 1; factor >= smallest_title; factor -= 0.1) {
    heading.title_height = factor * full;
    heading.title = text_lines(title, letters_in(size.width, heading.title_height));
    if (heading.title.size() <= most_lines) return;
  }
  heading.title.resize(most_lines);
  const std::string& last = heading.title.back();
  heading.title.back() = beginning_of(last, letters_of(last) - 1) + "…";
}

std::vector<std::vector<KeyEntry>> key_lines(const std::vector<KeyEntry>& key, double height, double width) {
  std::vector<std::vector<KeyEntry>> lines;
  double used = 0;
  for (const KeyEntry& entry : key) {
    const double needed = entry_width(entry, height) + height;
    if (lines.empty() || used + needed > widest * width) {
      lines.emplace_back();
      used = 0;
    }
    lines.back().push_back(entry);
    used += needed;
  }
  return lines;
}

} // namespace

std::vector<std::string> text_lines(const std::string& text, std::size_t letters) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && letters_of(lines.back()) + 1 + letters_of(word) > letters) lines.emplace_back();
    for (; letters_of(word) > letters; lines.emplace_back()) {
      lines.back() = beginning_of(word, letters);
      word.erase(0, lines.back().size());
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

double text_width(const std::string& text, double height) {
  return letter_width * height * static_cast<double>(letters_of(text));
}

double entry_width(const KeyEntry& entry, double height) {
  return 2 * height + text_width(entry.text, height);
}

double Heading::share(const PictureSize& size) const {
  const auto lines = static_cast<double>(note.size() + key.size());
  return 0.02 + (static_cast<double>(title.size()) * title_pitch() + (lines + 1) * note_pitch()) / size.height;
}

Heading heading_of(const PictureScene& scene, const PictureSize& size) {
  Heading heading;
  heading.title_height = 0.03 * size.height;
  heading.note_height = 0.0216 * size.height;
  set_title(heading, one_line(scene.title), size);
  heading.note = text_lines(scene.note, letters_in(size.width, heading.note_height));
  heading.key = key_lines(scene.key, heading.note_height, size.width);
  return heading;
}

} // namespace mpfem
