#pragma once
// What stands above the grains of a picture: title, note and the key of the rods, in lines that fit the picture.

#include <string>
#include <vector>

#include "postproc/picture/view_frame.hpp"

namespace mpfem {

/// The text in lines of at most so many letters, at least one, broken between words; a longer word is cut.
std::vector<std::string> text_lines(const std::string& text, std::size_t letters);

/// Lines from the top of the picture; heights in pixels.
struct Heading {
  std::vector<std::string> title, note;
  std::vector<std::vector<KeyEntry>> key; ///< entries side by side in each line
  double title_height = 0, note_height = 0;

  /// From one line to the next, pixels.
  double title_pitch() const { return 1.3 * title_height; }
  double note_pitch() const { return 1.45 * note_height; }
  /// Of the picture's height, with what is left free above and below.
  double share(const PictureSize& size) const;
};

/// The heading of a picture, which fits its width. Letters of a title of more than three lines are smaller.
Heading heading_of(const PictureScene& scene, const PictureSize& size);

/// About how wide a text in letters of this height is: letters are half as wide as high, or a little more.
double text_width(const std::string& text, double height);

/// Width of an entry of the key: its patch, a gap, its text.
double entry_width(const KeyEntry& entry, double height);

} // namespace mpfem
