#pragma once
// Pictures written, and read back to check their pixels.

#include <png.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace mpfem::test {

/// A picture of 8-bit RGB pixels.
struct Image {
  unsigned int width = 0, height = 0;
  std::vector<std::uint8_t> bytes; ///< RGB, row by row from the top

  std::array<int, 3> at(unsigned int x, unsigned int y) const {
    const std::uint8_t* pixel = bytes.data() + 3 * (static_cast<std::size_t>(y) * width + x);
    return {pixel[0], pixel[1], pixel[2]};
  }
  /// Share of pixels for which something holds.
  template <class Predicate>
  double share(const Predicate& holds) const {
    std::size_t count = 0;
    for (unsigned int y = 0; y < height; ++y)
      for (unsigned int x = 0; x < width; ++x) count += holds(at(x, y)) ? 1 : 0;
    return static_cast<double>(count) / (static_cast<double>(width) * height);
  }
};

/// The test fails if the file cannot be read.
inline Image read_png(const std::string& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&header, path.c_str()) != 0);
  header.format = PNG_FORMAT_RGB;
  Image image{header.width, header.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(header))};
  REQUIRE(png_image_finish_read(&header, nullptr, image.bytes.data(), 0, nullptr) != 0);
  return image;
}

/// The test fails if the file cannot be written.
inline void write_png(const std::string& path, const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.format = PNG_FORMAT_RGB;
  header.width = image.width;
  header.height = image.height;
  REQUIRE(png_image_write_to_file(&header, path.c_str(), 0, image.bytes.data(), 0, nullptr) != 0);
}

/// Whether a pixel is nearly white, or has a colour (is not grey).
inline bool is_white(const std::array<int, 3>& c) {
  return c[0] > 250 && c[1] > 250 && c[2] > 250;
}
inline bool is_coloured(const std::array<int, 3>& c) {
  return std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) > 30;
}

} // namespace mpfem::test
