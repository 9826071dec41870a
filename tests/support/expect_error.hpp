#pragma once
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace ream::test {

/// Expects `action` to throw Error of that kind, with one line that names `mentioned`.
template <typename Action>
void expect_error(ErrorKind kind, const std::string& mentioned, Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.kind(), kind) << message;
    EXPECT_NE(message.find(mentioned), std::string::npos) << message << "\ndoes not name " << mentioned;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return;
  }
  ADD_FAILURE() << "nothing was refused; expected an error about " << mentioned;
}

}  // namespace ream::test
