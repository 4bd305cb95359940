#include "common/errors.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "common/one_line.hpp"

namespace mpfem {

namespace {

/// Makes a write beyond the file size limit, or to a pipe that nobody reads, fail instead of ending the program.
void let_writes_fail() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

/// Opens closed standard streams to nowhere. Otherwise the next file that is opened takes the number of one of them,
/// and messages are written into it.
void keep_standard_streams_open() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) // open() takes the lowest number that is free
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDWR) < 0) return;
}

bool is_of_storage(const std::error_code& code) {
  const int number = code.value();
  return code.category() == std::generic_category() &&
         (number == EPIPE || number == EFBIG || number == ENOSPC || number == EIO || number == EDQUOT);
}

/// A failed output, by the number and the text of the system's error. A reader that has seen enough, such as head,
/// closes the pipe.
Failure failed_output(int number, const std::string& text) {
  return {number == EPIPE ? "the output was cut short: the program that reads it has closed the pipe"
                          : fmt::format("an output could not be written: {}", text),
          ExitCode::storage_failed};
}

/// The exit code of a body that has ended, or storage_failed if its last output could not be written.
int after_output(const char* program, int code) {
  const bool flushed = std::fflush(stdout) == 0;
  const int number = flushed ? EIO : errno; // of an earlier failure it is not known
  if (flushed && std::ferror(stdout) == 0) return code;
  std::clearerr(stdout); // it is reported once
  return code != 0 ? code : report(program, failed_output(number, std::strerror(number)));
}

} // namespace

Failure present_failure() {
  try {
    throw;
  } catch (const InputError& error) {
    return {error.what(), ExitCode::bad_input};
  } catch (const StorageError& error) {
    return {error.what(), ExitCode::storage_failed};
  } catch (const Interrupted& error) {
    return {error.what(), ExitCode::interrupted};
  } catch (const std::filesystem::filesystem_error& error) {
    return {error.what(), ExitCode::storage_failed};
  } catch (const std::system_error& error) {
    if (is_of_storage(error.code())) return failed_output(error.code().value(), error.what());
    return {error.what(), ExitCode::simulation_failed};
  } catch (const std::bad_alloc&) {
    return {"out of memory", ExitCode::simulation_failed};
  } catch (const std::exception& error) {
    return {error.what(), ExitCode::simulation_failed};
  } catch (...) {
    return {"unknown error", ExitCode::simulation_failed};
  }
}

int report(const char* program, const Failure& failure) {
  constexpr std::size_t longest = 500; // characters; code that throws shortens long parts itself
  const std::string line = fmt::format("{}: error: {}\n", program, shortened(failure.message, longest));
  std::fputs(line.c_str(), stderr); // nobody may be there to read it
  return static_cast<int>(failure.code);
}

int run_program(const char* program, int (*body)(int argc, char** argv), int argc, char** argv) {
  keep_standard_streams_open();
  let_writes_fail();
  try {
    return after_output(program, body(argc, argv));
  } catch (...) {
    return report(program, present_failure());
  }
}

} // namespace mpfem
