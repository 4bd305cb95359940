#pragma once
// The message of an InputError, held to the rule that it is one line.

#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "common/errors.hpp"

namespace mpfem::test {

/// The message of the InputError that `body` throws; fails the test where there is none or it has control characters.
template <class Body>
std::string input_error(Body body) {
  try {
    body();
  } catch (const InputError& error) {
    const std::string message = error.what();
    CHECK(!message.empty());
    CHECK(std::none_of(message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }));
    return message;
  }
  FAIL("no InputError was thrown");
  return {};
}

} // namespace mpfem::test
