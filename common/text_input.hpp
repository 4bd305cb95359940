#pragma once
// Text files that a user names.

#include <cstddef>
#include <string>

namespace mpfem {

/// The content of a regular file. Throws InputError if there is none, if it is a folder, a pipe or a device, if it
/// cannot be read, or if it has more than `most_bytes`.
std::string read_text_file(const std::string& path, std::size_t most_bytes);

/// Why a path is no regular file, or no text: "PATH: no such file". Opening a pipe may wait without end.
std::string fault_of_input_file(const std::string& path);

/// Throws InputError with this fault.
void refuse_irregular_file(const std::string& path);

} // namespace mpfem
