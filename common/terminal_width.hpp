#pragma once
// How wide the terminal is.

#include <sys/ioctl.h>

namespace mpfem {

/// Characters in a line of the terminal that this file descriptor leads to; 80 if it leads to none.
inline int terminal_width(int file_descriptor) {
  winsize size{};
  return ioctl(file_descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

} // namespace mpfem
