#include "common/command_line.hpp"

#include <algorithm>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/number_text.hpp"
#include "common/one_line.hpp"
#include "common/text_input.hpp"

namespace mpfem {

namespace {

constexpr std::size_t longest_word = 40; // of what was found
constexpr const char* file_check = "existing file";

template <class Parse>
CLI::Validator validator(const Range& range, const std::string& unit, const char* kind, Parse parse) {
  return {[range, unit, kind, parse](std::string& text) {
            const auto value = parse(text);
            if (value && range.contains(static_cast<double>(*value))) return std::string();
            return fmt::format("found '{}', allowed: {}", shortened(text, longest_word),
                               allowed_number(kind, range, unit));
          },
          // The help does not print the limits of the type.
          range.low == whole_numbers.low ? std::string() : allowed_number("", range, unit)};
}

/// The words, or the first of them and "…" where all would make a message too long.
std::string list_of(const std::vector<std::string>& words) {
  constexpr std::size_t longest = 160;
  std::string list;
  for (const std::string& word : words) {
    if (list.size() + word.size() > longest) return list + ", …";
    list += list.empty() ? word : ", " + word;
  }
  return list;
}

/// "found 'WORD'" and the nearest of `known`, or all of them.
std::string unknown_word(const std::string& word, const std::vector<std::string>& known) {
  const auto near = nearest_word(word, known);
  return fmt::format("found '{}'{}", shortened(word, longest_word),
                     near ? fmt::format("; did you mean '{}'?", *near) : ", allowed: " + list_of(known));
}

std::vector<std::string> names_of_subcommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> long_names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The first word that a command did not take; empty if it took all of them.
std::string fault_of_words(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  if (words.empty()) return "";
  const std::string& word = words.front();
  if (word.starts_with('-')) return unknown_word(word.substr(0, word.find('=')), long_names_of_options(command));
  const std::vector<std::string> subcommands = names_of_subcommands(command);
  if (!subcommands.empty()) return unknown_word(word, subcommands);
  return fmt::format("found one more word, '{}', allowed: options", shortened(word, longest_word));
}

/// The same for all that were given.
std::string fault_of_all_words(const CLI::App& app) {
  std::string fault = fault_of_words(app);
  for (const CLI::App* parsed : app.get_subcommands())
    if (fault.empty()) fault = fault_of_words(*parsed);
  return fault;
}

/// CLI11's message in the form of the others; as it is where it has another form.
std::string in_own_form(const std::string& message) {
  constexpr std::size_t longest = 240;
  // A long word does not belong into a regular expression: it takes the stack.
  const std::string text = shortened(message, longest);
  std::smatch part;
  if (std::regex_match(text, part, std::regex("(.+): [0-9]+ required (.+) missing")))
    return fmt::format("{}: found no value, allowed: {}", part.str(1), part.str(2));
  if (std::regex_match(text, part, std::regex("(.+): At (?:[Ll]east|[Mm]ost) ([0-9]+) required but received ([0-9]+)")))
    return fmt::format("{}: found {} values, allowed: {}", part.str(1), part.str(3), part.str(2));
  if (std::regex_match(text, part, std::regex("Could not convert: (.+) = (.*)")))
    return fmt::format("{}: found '{}', allowed: the option without a value", part.str(1), part.str(2));
  return text;
}

/// What is wrong with a command line. A word that nothing took comes before an option that is missing: it may be the
/// same one, mistyped.
std::string fault_of(const CLI::App& app, const CLI::ParseError& error) {
  const int code = error.get_exit_code();
  if (code != static_cast<int>(CLI::ExitCodes::RequiredError) && code != static_cast<int>(CLI::ExitCodes::ExtrasError))
    return in_own_form(error.what());
  if (const std::string fault = fault_of_all_words(app); !fault.empty()) return fault;
  const std::vector<std::string> subcommands = names_of_subcommands(app);
  if (!subcommands.empty() && app.get_subcommands().empty())
    return "found no subcommand, allowed: " + list_of(subcommands);
  return in_own_form(error.what());
}

void accept_missing_files(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) try {
      option->get_validator(file_check)->active(false);
    } catch (const CLI::OptionNotFound&) { // it takes no file
    }
}

} // namespace

CLI::Validator finite_number_in(const Range& range, const std::string& unit) {
  return validator(range, unit, "a number", finite_number);
}

CLI::Validator whole_number_in(const Range& range, const std::string& unit) {
  return validator(range, unit, "a whole number", whole_number);
}

CLI::Validator existing_file() {
  return {[](std::string& path) { return path.empty() ? std::string() : fault_of_input_file(path); }, "FILE",
          file_check};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return {[words](std::string& text) {
            if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
            return fmt::format("found '{}', allowed: {}", shortened(text, longest_word), fmt::join(words, ", "));
          },
          fmt::format("{{{}}}", fmt::join(words, ","))};
}

CLI::Option* separated_by_commas(CLI::Option* option) {
  return option->delimiter(',')->allow_extra_args(false);
}

CLI::Option* add_assignments(CLI::App& command, std::vector<std::string>& assignments, const std::string& help) {
  return command.add_option("--set", assignments, help)->take_all()->allow_extra_args(false);
}

std::optional<int> parse_command_line(CLI::App& app, const std::string& program, int argc, char** argv) {
  const auto refuse = [&](const std::string& fault) {
    std::string command = program;
    for (const CLI::App* parsed : app.get_subcommands()) command += " " + parsed->get_name();
    throw InputError(fmt::format("{} (see {} --help)", fault, command));
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) { // help or version
    if (const std::string fault = fault_of_all_words(app); !fault.empty()) refuse(fault);
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    refuse(fault_of(app, error));
  }
  return std::nullopt;
}

void check_words(CLI::App& app, const std::string& program, std::vector<std::string> words) {
  for (CLI::App* command : app.get_subcommands({})) accept_missing_files(*command);
  words.insert(words.begin(), program);
  std::vector<char*> pointers;
  pointers.reserve(words.size());
  for (std::string& word : words) pointers.push_back(word.data());
  parse_command_line(app, program, static_cast<int>(pointers.size()), pointers.data());
}

} // namespace mpfem
