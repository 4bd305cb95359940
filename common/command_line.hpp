#pragma once
// Options of the three programs: numbers with their range and unit, and mistakes in one line.

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/physical_ranges.hpp"
#include "common/range.hpp"

namespace mpfem {

/// Refuses anything but a finite number in the range. `unit` appears in the message and in the help; empty: none.
CLI::Validator finite_number_in(const Range& range, const std::string& unit);
/// The same for whole numbers.
CLI::Validator whole_number_in(const Range& range, const std::string& unit);

/// The value in a variable that may be optional or a list.
template <class T>
struct ValueOf {
  using type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
  using type = T;
};
template <class T>
struct ValueOf<std::vector<T>> {
  using type = T;
};

/// Adds an option that is a number, or a list of numbers. Every such option of the programs is added here, so that no
/// number is accepted that is not finite, is out of its range, or is followed by other text.
template <class Variable>
CLI::Option* add_number(CLI::App& command, const std::string& name, Variable& variable, const Range& range,
                        const std::string& unit, const std::string& help) {
  using Number = typename ValueOf<Variable>::type;
  static_assert(std::is_arithmetic_v<Number>);
  return command.add_option(name, variable, help)
      ->check(std::is_integral_v<Number> ? whole_number_in(range, unit) : finite_number_in(range, unit));
}

/// Makes an option a list in one word, separated by commas: the words after it are no part of the list.
CLI::Option* separated_by_commas(CLI::Option* option);

/// Refuses what is no file that can be read. An empty name passes: it may stand for no file. Such a mistake is reported
/// before options that are missing.
CLI::Validator existing_file();

/// Refuses anything but one of some words, which the help lists.
CLI::Validator one_of(const std::vector<std::string>& words);

/// Adds an option that takes one of some words, each of which stands for a value.
template <class Variable>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Variable& variable,
                        const std::vector<std::pair<std::string, typename ValueOf<Variable>::type>>& choices,
                        const std::string& help) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back(word);
  const auto take = [&variable, choices](const std::string& word) {
    for (const auto& [known, value] : choices)
      if (known == word) variable = value;
  };
  return command.add_option_function<std::string>(name, take, help)->check(one_of(words));
}

/// Adds --set, one KEY=VALUE a time, to be repeated.
CLI::Option* add_assignments(CLI::App& command, std::vector<std::string>& assignments, const std::string& help);

/// Adds an option that is such a list of numbers: of `count`, or of any number for 0.
template <class Number>
CLI::Option* add_numbers(CLI::App& command, const std::string& name, std::vector<Number>& variable, int count,
                         const Range& range, const std::string& unit, const std::string& help) {
  CLI::Option* option = add_number(command, name, variable, range, unit, help);
  if (count > 0) option->expected(count);
  return separated_by_commas(option);
}

/// Largest number that fits in an option's variable, for options without their own limit.
constexpr Range whole_numbers = Range::between(-2147483647.0, 2147483647.0);
/// Numbers of threads.
constexpr Range thread_numbers = Range::between(1, 1024);
/// Seeds of random numbers. Larger whole numbers are not exact in all programs that read them.
constexpr Range seed_numbers = Range::between(0, 9007199254740991.0);

/// Parses the command line. Returns the exit code if nothing is left to do because help or version was printed. Throws
/// InputError for a mistake; its message ends with the command that prints the help. A word that is no subcommand or
/// option is named with the nearest one, or with all.
std::optional<int> parse_command_line(CLI::App& app, const std::string& program, int argc, char** argv);

/// Refuses the words of a subcommand that parse_command_line() would refuse, before its input files exist. Throws
/// InputError.
void check_words(CLI::App& app, const std::string& program, std::vector<std::string> words);

} // namespace mpfem
