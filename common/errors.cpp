#include "common/errors.hpp"

#include <exception>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "common/one_line.hpp"

namespace mpfem {

namespace {

int report(const char* program, std::string_view message, ExitCode code) {
  constexpr std::size_t longest = 500; // characters; whoever throws shortens the parts that are long
  fmt::print(stderr, "{}: error: {}\n", program, shortened(message, longest));
  return static_cast<int>(code);
}

} // namespace

int run_program(const char* program, int (*body)(int argc, char** argv), int argc, char** argv) {
  try {
    return body(argc, argv);
  } catch (const InputError& error) {
    return report(program, error.what(), ExitCode::bad_input);
  } catch (const StorageError& error) {
    return report(program, error.what(), ExitCode::storage_failed);
  } catch (const Interrupted& error) {
    return report(program, error.what(), ExitCode::interrupted);
  } catch (const std::filesystem::filesystem_error& error) {
    return report(program, error.what(), ExitCode::storage_failed);
  } catch (const std::bad_alloc&) {
    return report(program, "out of memory", ExitCode::simulation_failed);
  } catch (const std::exception& error) {
    return report(program, error.what(), ExitCode::simulation_failed);
  } catch (...) {
    return report(program, "unknown error", ExitCode::simulation_failed);
  }
}

} // namespace mpfem
