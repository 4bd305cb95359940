#pragma once
// Commands as the shell divides them into words.

#include <optional>
#include <string>
#include <vector>

namespace mpfem {

/// The words of a command. Empty where only make or the shell knows them: variables, pipes, several commands. Throws
/// InputError for a quotation mark that is not closed.
std::optional<std::vector<std::string>> shell_words(const std::string& command);

} // namespace mpfem
