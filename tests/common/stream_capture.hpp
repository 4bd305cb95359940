#pragma once
// What a function writes to a stream, as text.

#include <cstdio>
#include <functional>
#include <string>

#include <unistd.h>

namespace mpfem::test {

inline std::string content_of(std::FILE* file) {
  std::fflush(file);
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

/// A file that is gone when closed; no terminal.
class TemporaryStream {
public:
  TemporaryStream() : file_(std::tmpfile()) {}
  ~TemporaryStream() { std::fclose(file_); }
  TemporaryStream(const TemporaryStream&) = delete;
  TemporaryStream& operator=(const TemporaryStream&) = delete;
  std::FILE* get() const { return file_; }
  std::string text() const { return content_of(file_); }

private:
  std::FILE* file_;
};

/// Runs `body` with standard error going to a file, and returns what arrived there.
inline std::string standard_error_of(const std::function<void()>& body) {
  const TemporaryStream stream;
  std::fflush(stderr);
  const int saved = dup(STDERR_FILENO);
  dup2(fileno(stream.get()), STDERR_FILENO);
  body();
  std::fflush(stderr);
  dup2(saved, STDERR_FILENO);
  close(saved);
  return stream.text();
}

} // namespace mpfem::test
