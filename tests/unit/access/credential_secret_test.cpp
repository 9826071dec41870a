#include "access/secret.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ream::access {
namespace {

Secret secret(std::string_view text) { return Secret(text); }

TEST(CredentialSecret, HoldsItsIdAndIsNeverTheSameTwice) {
  std::set<std::string> ids, texts, hashes;
  for (int i = 0; i < 200; ++i) {
    const CredentialSecret made = make_credential_secret();
    EXPECT_EQ(id_inside(made.text), made.id);
    EXPECT_EQ(made.text.reveal().rfind("ream_" + made.id + "_", 0), 0u);
    EXPECT_EQ(made.text.reveal().size(), 5u + 10u + 1u + 43u);
    EXPECT_EQ(made.text.reveal().find_first_not_of(
                  "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-"),
              std::string::npos);
    EXPECT_TRUE(ids.insert(made.id).second);
    EXPECT_TRUE(texts.insert(made.text.reveal()).second);
    EXPECT_TRUE(hashes.insert(made.hash).second);
  }
}

TEST(CredentialSecret, IsKnownByItsHashOnly) {
  const CredentialSecret made = make_credential_secret();
  EXPECT_EQ(made.hash.find(made.text.reveal().substr(16)), std::string::npos);
  EXPECT_TRUE(has_hash(made.text, made.hash));
  for (size_t at = 0; at < made.text.reveal().size(); ++at) {
    std::string changed = made.text.reveal();
    changed[at] = changed[at] == 'x' ? 'y' : 'x';
    EXPECT_FALSE(has_hash(Secret(std::string_view(changed)), made.hash)) << at;
  }
  EXPECT_FALSE(has_hash(made.text, ""));
  EXPECT_FALSE(has_hash(secret(""), made.hash));
}

TEST(CredentialSecret, OtherTextsHaveNoIdInside) {
  const std::string good = make_credential_secret().text.reveal();
  for (const std::string& text :
       {std::string(), std::string("ream_"), good + "x", good.substr(1), "xeam_" + good.substr(5),
        "ream_ABCDEFGHIJ_" + good.substr(16), "ream_../../../_" + good.substr(15),
        good.substr(0, 15) + "-" + good.substr(16), std::string(59, '\0')})
    EXPECT_EQ(id_inside(secret(text)), "") << text;
}

TEST(CredentialSecret, TheTokenAgainstForgeryTellsNothing) {
  const CredentialSecret one = make_credential_secret(), two = make_credential_secret();
  EXPECT_EQ(csrf_token_of(one.text), csrf_token_of(one.text));
  EXPECT_NE(csrf_token_of(one.text), csrf_token_of(two.text));
  EXPECT_NE(csrf_token_of(one.text), one.hash);
}

}  // namespace
}  // namespace ream::access
