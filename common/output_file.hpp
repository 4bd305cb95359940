#pragma once
// Outputs: what may exist under the name of one, and how a complete file is put in its place.

#include <string>
#include <string_view>
#include <vector>

namespace mpfem {

/// Text may also go to a device or a pipe; a binary file (HDF5, PNG) is a regular file.
enum class OutputKind { text, binary };

/// Refuses what cannot become this output: a folder, a socket, a block device, a name that ends with '/', and for
/// binary outputs also a character device and a FIFO. `option` begins the message ("--output"). Symbolic links are
/// followed. Throws InputError. A path that does not exist is fine.
void refuse_special_file(std::string_view option, const std::string& path, OutputKind kind);

/// Whether a regular file begins as HDF5 files do.
bool is_hdf5(const std::string& path);

/// The same, and the folder must exist. To be called before hours of work. An empty path is refused, a TOML file in its
/// place, and an HDF5 file in the place of a text.
void check_output_path(std::string_view option, const std::string& path, OutputKind kind);

/// Refuses an output whose name has none of these endings (".png"). A ".partial" after them, as scripts of a study
/// write it, does not count. Throws InputError.
void refuse_other_endings(std::string_view option, const std::string& path, const std::vector<std::string>& endings);

/// Refuses an output whose name ends as files of another format do (a table in "run.png"). `endings`: those of what is
/// written. A name without an ending, or with one that no known format has, is fine. Throws InputError.
void refuse_ending_of_other_format(std::string_view option, const std::string& path,
                                   const std::vector<std::string>& endings);

/// Writes an empty file next to an output and removes it. To be called before hours of work. Throws StorageError. A
/// device, a FIFO and the file that standard output goes to are not tried.
void try_output(const std::string& path);

/// Whether two paths lead to the same file, which need not exist yet. A device, a FIFO and an empty path are none.
bool same_file(const std::string& a, const std::string& b);

/// Refuses an output that would replace what is read, itself or by its partial file. `option` begins the message
/// ("--output"). Throws InputError.
void refuse_overwriting(std::string_view option, const std::string& output, const std::string& input);

/// An output of a program, and the option that names it. An empty path is an output that is not wanted.
struct NamedOutput {
  std::string option, path;
};

/// Refuses two outputs of which one would replace the other. Throws InputError that names both options.
void refuse_shared_names(const std::vector<NamedOutput>& outputs);

/// Where an output is written: the path itself or, if that is a symbolic link, the target of the link.
std::string output_target(const std::string& path);

/// Removes what a killed program left under the name of a partial file. Throws StorageError if that is a folder.
void remove_stale_partial(const std::string& partial);

/// Puts a complete file in its place: its content reaches the disk before its name does (fsync, rename, fsync of the
/// folder). Throws StorageError; then the partial file is left.
void replace_file(const std::string& partial, const std::string& path);

/// A text file that appears under its name when it is complete. A character device or a FIFO, or the file that standard
/// output goes to, is written to directly. Throws StorageError.
class TextFile {
public:
  explicit TextFile(const std::string& path);
  ~TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  void write(std::string_view text);
  void complete();

private:
  [[noreturn]] void fail() const;
  std::string path_;    ///< as named, for messages
  std::string target_;  ///< where it goes
  std::string partial_; ///< empty if it is written directly
  int file_ = -1;
  bool complete_ = false;
};

/// Writes a whole TextFile. Binary content (a picture) is written as it is.
void write_file(const std::string& path, std::string_view content);

} // namespace mpfem
