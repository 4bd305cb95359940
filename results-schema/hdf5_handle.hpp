#pragma once
// HDF5 identifiers that close themselves, and the few calls shared by writer, reader and validator.

#include <string>
#include <string_view>
#include <utility>

#include <hdf5.h>

#include "results-schema/dataset.hpp"

namespace mpfem::schema {

/// An open HDF5 object; a negative identifier means none.
class Handle {
public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, -1);
      close_ = other.close_;
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { reset(); }

  /// Closes; false where closing failed (data not flushed).
  bool reset() {
    const hid_t id = std::exchange(id_, -1);
    return id < 0 || close_(id) >= 0;
  }
  operator hid_t() const { return id_; } // NOLINT: made to be passed to HDF5's functions
  explicit operator bool() const { return id_ >= 0; }

private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Must be called before any other function of HDF5. Turns off HDF5's messages on standard error (errors are reported
/// as exceptions) and its cleanup at the end of the program.
void prepare_hdf5();

/// Type in memory, and in the file (little endian). Strings are UTF-8 of variable length.
Handle memory_type(ElementType type);
/// The same type as it is stored in the file.
Handle file_type(ElementType type);

/// "/snapshots/*/node", "0003" -> "/snapshots/0003/node".
std::string path_of(const DatasetDescription& dataset, std::string_view snapshot);

/// True if every link of an absolute path exists.
bool path_exists(hid_t file, const std::string& path);

/// A scalar string attribute; empty where there is none.
std::string read_text_attribute(hid_t object, const char* name);
/// Returns a negative number on failure.
herr_t write_text_attribute(hid_t object, const char* name, std::string_view value);

} // namespace mpfem::schema
