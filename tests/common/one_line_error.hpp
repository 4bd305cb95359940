#pragma once
// The message of an error, held to the rule that it is one line.

#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "common/errors.hpp"

namespace mpfem::test {

/// The message of the `Error` that `body` throws; fails the test where there is none or it has control characters.
template <class Error, class Body>
std::string one_line_error(Body body) {
  try {
    body();
  } catch (const Error& error) {
    const std::string message = error.what();
    CHECK(!message.empty());
    CHECK(std::none_of(message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }));
    return message;
  }
  FAIL("no error of the expected kind was thrown");
  return {};
}

template <class Body>
std::string input_error(Body body) {
  return one_line_error<InputError>(body);
}

} // namespace mpfem::test
