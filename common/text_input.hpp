#pragma once
// Text files that a user names.

#include <cstddef>
#include <string>

namespace mpfem {

/// The content of a regular file. Throws InputError where there is none, where it is a folder, a pipe or a device,
/// where it cannot be read, or where it has more than `most_bytes`.
std::string read_text_file(const std::string& path, std::size_t most_bytes);

/// Throws InputError where the path names no regular file: to open a pipe may wait for ever.
void refuse_irregular_file(const std::string& path);

} // namespace mpfem
