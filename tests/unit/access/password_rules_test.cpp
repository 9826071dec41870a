#include "access/password_hasher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

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
                             "admin1admin1", "\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4"});
  refused("row of keys", {"1234567890", "0987654321", "abcdefghij", "qwertyuiop", "QWERTZuiop",
                          "1qaz2wsx3edc", "qwerty12345", "asdfghjkl1", "abc123def456", "poiuytrewq"});
  refused("common", {"password123", "Password2026!", "P@ssw0rd123", "welcome2024", "!!Letmein!!1",
                     "iloveyou99", "pass word 77", "administrator", "Winter2026!!", "helloworld"});
  refused("row of keys",
          {"1q2w3e4r5t", "q1w2e3r4t5", "147258369a", "7894561230!", "qazwsxedc1", "a1s2d3f4g5h6"});
  refused("common", {"Sommer2024!", "Fussball123", "Fu\u00dfball123", "mypassword1", "charlie123",
                     "killer1234", "operator123", "AdminAdmin1", "2024sommer!", "Pr1nc3ss12", "L1verp00l!",
                     "SchatzSchatzi1", "Instructor1", "ReamTrainee9", "M\u00dcnchen2024", "$unsh1ne2024"});
  refused("common", {"AnnaLena-Password1", "anna.lena.2024.sommer"}, "anna.lena");
  refused("the user's name", {"Weak3Weak3x", "xx-weak3-weak3"}, "weak3");
}

TEST(PasswordRules, TakeSentencesAndWhatChanceMade) {
  for (const char* password :
       {"correct horse battery", "password of anna", "a good password", "wrong donkey accumulator",
        "7h4-qm2xkd", "another good one", "summer rain on tin roofs", "kZ8#rT2!pQ"})
    EXPECT_NO_THROW(good(password, "anna")) << password;
}

/// Of four words that are no two of the list: a sentence is good, also of common words.
/// Among random passwords are some that chance has made of a common word and digits.
TEST(PasswordRules, TakeSentencesOfCommonWordsAndAlmostAnyRandomPassword) {
  std::mt19937 random(test::seed());
  const std::vector<std::string> words{"summer", "dragon",   "password", "michael",  "charlie",
                                       "killer", "football", "monkey",   "secret",   "hospital",
                                       "reamer", "admin",    "berlin",   "shadow",   "freedom",
                                       "schatz", "sommer",   "winter",   "computer", "orange"};
  const std::string characters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+!$";
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::string> some = words;
    std::shuffle(some.begin(), some.end(), random);
    const std::string sentence = some[0] + " " + some[1] + " " + some[2] + " " + some[3];
    EXPECT_NO_THROW(good(sentence, "michael")) << sentence;
    std::string text;
    while (text.size() < 12) text += characters[random() % characters.size()];
    try {
      good(text, "michael");
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_LE(refused, 1);
}

}  // namespace
}  // namespace ream::access
