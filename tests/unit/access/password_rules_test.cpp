#include "access/password_hasher.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream::access {
namespace {

void good(const std::string& text) { require_good_password(Secret(std::string_view(text))); }

TEST(PasswordRules, CountCharactersNotBytes) {
  EXPECT_NO_THROW(good("0123456789"));
  EXPECT_NO_THROW(good("\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4"));
  EXPECT_NO_THROW(good(std::string(max_password_bytes, 'x')));
  test::expect_error(ErrorKind::invalid_input, "at least 10 characters", [] { good("012345678"); });
  test::expect_error(ErrorKind::invalid_input, "at least 10 characters",
                     [] { good("\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4"); });
  test::expect_error(ErrorKind::invalid_input, "at most 1000 bytes",
                     [] { good(std::string(max_password_bytes + 1, 'x')); });
}

TEST(PasswordRules, TakeTextOnly) {
  for (const char* broken : {"0123456789\xff", "0123456789\xc3", "0123456789\xe2\x28\xa1", "\x80 0123456789"})
    test::expect_error(ErrorKind::invalid_input, "must be UTF-8", [&] { good(broken); });
}

}  // namespace
}  // namespace ream::access
