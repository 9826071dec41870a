#include "access/password_hasher.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream::access {
namespace {

void good(const std::string& text, const std::string& name = {}) {
  require_good_password(Secret(std::string_view(text)), name);
}

TEST(PasswordRules, CountCharactersNotBytes) {
  EXPECT_NO_THROW(good("7h4-qm2xkd"));
  EXPECT_NO_THROW(good("\u00e4\u00f6\u00fc\u00df\u00e9\u00e4\u00f6\u00e8\u00ea\u00e4"));
  std::string longest;
  while (longest.size() < max_password_bytes) longest += "a good sentence, ";
  longest.resize(max_password_bytes);
  EXPECT_NO_THROW(good(longest));
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

TEST(PasswordRules, RefuseWhatIsTriedFirst) {
  const auto refused = [](const std::string& words, const std::vector<std::string>& passwords,
                          const std::string& name = {}) {
    for (const std::string& password : passwords) {
      SCOPED_TRACE(password);
      test::expect_error(ErrorKind::invalid_input, words, [&] { good(password, name); });
    }
  };
  refused("repeats itself", {"aaaaaaaaaa", "abababababab", "aAaAaAaAaA", "passpasspass", "123412341234",
                             "\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4"});
  refused("row of keys", {"1234567890", "0987654321", "abcdefghij", "qwertyuiop", "QWERTZuiop",
                          "1qaz2wsx3edc", "qwerty12345", "asdfghjkl1", "abc123def456", "poiuytrewq"});
  refused("common", {"password123", "Password2026!", "P@ssw0rd123", "welcome2024", "!!Letmein!!1",
                     "iloveyou99", "pass word 77", "administrator", "Winter2026!!", "helloworld"});
  refused("the user's name", {"Weak3Weak3x", "xx-weak3-weak3"}, "weak3");
}

TEST(PasswordRules, TakeSentencesAndWhatChanceMade) {
  for (const char* password :
       {"correct horse battery", "password of anna", "a good password", "wrong donkey accumulator",
        "7h4-qm2xkd", "another good one", "summer rain on tin roofs", "kZ8#rT2!pQ"})
    EXPECT_NO_THROW(good(password, "anna")) << password;
}

}  // namespace
}  // namespace ream::access
