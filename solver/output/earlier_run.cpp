#include "solver/output/earlier_run.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/output_file.hpp"
#include "results-schema/file.hpp"
#include "solver/output/run_file.hpp"

namespace mpfem {

namespace {

namespace fs = std::filesystem;

std::string backup_of(const std::string& file) {
  return file + "~";
}

/// Bytes; 0 if there is no such file.
double size_of(const std::string& file) {
  std::error_code failed;
  const auto size = fs::file_size(file, failed);
  return failed ? 0 : static_cast<double>(size);
}

bool may_be_replaced(const std::string& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return true;
  return fs::is_regular_file(file, ignored) && (size_of(file) == 0 || schema::states_kind(file, schema::FileKind::run));
}

/// What the run in a file says of its end; empty if that cannot be read.
std::string status_of(const std::string& run_file) {
  try {
    return read_run_summary(run_file).status;
  } catch (const InputError&) {
    return {};
  }
}

} // namespace

void refuse_other_files(const std::string& output) {
  const std::string file = output_target(output), backup = backup_of(file);
  if (!may_be_replaced(file))
    throw InputError(fmt::format("--output {}: would be replaced, which is not a run file, allowed: another --output",
                                 one_line(output)));
  if (size_of(file) > 0 && !may_be_replaced(backup))
    throw InputError(
        fmt::format("--output {}: {} would be replaced, which is not a run file, allowed: another --output",
                    one_line(output), one_line(backup)));
}

bool is_unfinished(const std::string& output) {
  return size_of(output) > 0 && status_of(output) != "complete";
}

std::string keep_earlier_run(const std::string& output, bool resume) {
  refuse_other_files(output);
  const std::string file = output_target(output), backup = backup_of(file);
  if (size_of(file) == 0) return {};
  const bool interrupted = status_of(file) == "interrupted";
  std::error_code failed;
  fs::rename(file, backup, failed);
  if (failed)
    throw StorageError(
        fmt::format("{}: cannot be renamed to {}: {}", one_line(file), one_line(backup), failed.message()));
  const char* more = resume        ? "; no checkpoint of this run was found, so it starts again"
                     : interrupted ? "; it was interrupted, and --resume would have continued it"
                                   : "";
  return fmt::format("{}: the earlier run is kept as {}{}", one_line(output), one_line(backup), more);
}

double space_of_kept_run(const std::string& output) {
  const std::string file = output_target(output);
  return size_of(file) > 0 ? size_of(file) - size_of(backup_of(file)) : 0;
}

} // namespace mpfem
