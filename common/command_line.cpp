#include "common/command_line.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/number_text.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

template <class Parse>
CLI::Validator validator(const Range& range, const std::string& unit, const char* kind, Parse parse) {
  return {[range, unit, kind, parse](std::string& text) {
            const auto value = parse(text);
            if (value && range.contains(static_cast<double>(*value))) return std::string();
            return fmt::format("found '{}', allowed: {}", shortened(text, 40), allowed_number(kind, range, unit));
          },
          // The help does not print the limits of the type.
          range.low == whole_numbers.low ? std::string() : allowed_number("", range, unit)};
}

} // namespace

CLI::Validator finite_number_in(const Range& range, const std::string& unit) {
  return validator(range, unit, "a number", finite_number);
}

CLI::Validator whole_number_in(const Range& range, const std::string& unit) {
  return validator(range, unit, "a whole number", whole_number);
}

CLI::Option* separated_by_commas(CLI::Option* option) {
  return option->delimiter(',')->allow_extra_args(false);
}

CLI::Option* add_assignments(CLI::App& command, std::vector<std::string>& assignments, const std::string& help) {
  return command.add_option("--set", assignments, help)->take_all()->allow_extra_args(false);
}

std::optional<int> parse_command_line(CLI::App& app, const std::string& program, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) { // help or version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    constexpr std::size_t longest = 240;
    std::string command = program;
    for (const CLI::App* parsed : app.get_subcommands()) command += " " + parsed->get_name();
    throw InputError(fmt::format("{} (see {} --help)", shortened(error.what(), longest), command));
  }
  return std::nullopt;
}

} // namespace mpfem
