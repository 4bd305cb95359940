#pragma once
// A run file that is already there when a run begins afresh: it is kept as RUN.h5~, as `cp --backup=simple` does. What
// is not a run file is never replaced.

#include <string>

namespace mpfem {

/// Refuses an output in whose place, or in the place of whose backup, something else than a run file is. Empty files do
/// not count. Throws InputError.
void refuse_other_files(const std::string& output);

/// Whether a run file is there that does not say of itself that it is complete.
bool is_unfinished(const std::string& output);

/// Renames the run file that is there to its backup, which replaces an earlier backup, and returns what to say about
/// it; empty if there is none or an empty file. For a symbolic link, this is done with the file to which it leads.
/// `resume`: whether the run was to be continued. Throws InputError as refuse_other_files(), and StorageError.
std::string keep_earlier_run(const std::string& output, bool resume);

/// Disk space (bytes) that is not free because the earlier run is kept; negative if an earlier backup was larger.
double space_of_kept_run(const std::string& output);

} // namespace mpfem
