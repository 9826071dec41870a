#include <sys/stat.h>

#include <filesystem>

#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

/// What minisign 0.11 and sha256sum made of two files; its keys were for this test alone.
constexpr const char* release_key = "RWQpvAd68kZ5wkUSwu/lIp1FIWbr9ENQIt5fh7EF2wNHJbqhwd1FZZIA";
constexpr const char* other_key = "RWQ6rtPzp3vcU53kODLFxX7plE/BOTCIpfWrfMSlxbUOztoLwepvWypo";
constexpr const char* key_of_files =
    "untrusted comment: minisign public key C27946F27A07BC29\n"
    "RWQpvAd68kZ5wkUSwu/lIp1FIWbr9ENQIt5fh7EF2wNHJbqhwd1FZZIA\n";
const std::string sums =
    "2c8b08da5ce60398e1f19af0e5dccc744df274b826abe585eaba68c525434806  one.txt\n"
    "27dd8ed44a83ff94d557f9fd0412ed5a8cbca69ea04922d88c01184a07300a5a  two.txt\n";
const std::string signature =
    "untrusted comment: signature from minisign secret key\n"
    "RUQpvAd68kZ5wjVqIbI7wR1KyfYb1DYLSBKReLU0GeSFfqCMH8A9ZgjHCAASWRFFryCV3KskqaSMn9tyGmG6kJr+xwNzhuamFwU=\n"
    "trusted comment: ream 0.1.0, commit 0123456789ab\n"
    "DDOo9RrmigBOdzuwXGnv8RhHDR1t1nJDr856eEhJEEnn63rPfGKME7y0A05DJX43KWiFkofKOaH6B5bdEarLDA==\n";
/// The same sums, signed in minisign's older way, which hashes nothing first.
const std::string older_signature =
    "untrusted comment: signature from minisign secret key\n"
    "RWQpvAd68kZ5wtzQrfiOGnWHoOQbsKmv+/BZQfsPiQfseVYzQ0pDhWR4w/r2vDp+yEeFN8joBosCBPZ/a6WtOqjhSN+0bhF/wA8=\n"
    "trusted comment: old\n"
    "ZQOzvMu5py6s6ZEWSV7VdNF2SSLOg/3Gge59N3CWynI0ox/ckdGy2AdAPzUvMEcjGxSBjuQ98gQ83DG6XlqLBg==\n";

class VerifyRelease : public CommandLine {
 protected:
  void SetUp() override {
    fs::create_directory(folder() / "release");
    write("release/one.txt", "one\n");
    write("release/two.txt", "two\n");
    write("release/SHA256SUMS", sums);
    write("release/SHA256SUMS.minisig", signature);
  }
  void refuse_release(const std::string& mentioned, const std::string& key = release_key) {
    refuse(1, mentioned, {"verify-release", "release", "--key", key});
  }
  /// `text` with its first `from` as `to`.
  static std::string changed(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  }
};

TEST_F(VerifyRelease, NamesTheFilesTheKeyAndWhatWasSaid) {
  const auto said = answer({"verify-release", "release", "--key", release_key});
  EXPECT_EQ(said.at("files"), nlohmann::json({"one.txt", "two.txt"}));
  EXPECT_EQ(said.at("key"), "C27946F27A07BC29") << "as minisign names it";
  EXPECT_EQ(said.at("comment"), "ream 0.1.0, commit 0123456789ab");
  write("key.pub", key_of_files);
  EXPECT_NE(succeed({"verify-release", "release", "--key", "key.pub"}).out.find("2 files"),
            std::string::npos);
}

TEST_F(VerifyRelease, AFileThatWasChangedOrIsGoneIsNamed) {
  write("release/two.txt", "twO\n");
  refuse_release("two.txt was changed; do not install it");
  fs::remove(folder() / "release/two.txt");
  refuse_release("two.txt is not there");
  ASSERT_EQ(::mkfifo((folder() / "release/two.txt").c_str(), 0600), 0) << "nobody writes to it";
  refuse_release("two.txt is not there");
}

TEST_F(VerifyRelease, AFileThatWasAddedIsNamed) {
  write("release/three.txt", "");
  refuse_release("three.txt is not of the release");
}

TEST_F(VerifyRelease, AListThatWasChangedIsRefusedBeforeAnyFileIsRead) {
  write("release/two.txt", "twO\n");
  write("release/SHA256SUMS", changed(sums, "27dd", "27de"));
  refuse_release("SHA256SUMS is not what was signed");
}

TEST_F(VerifyRelease, TheCommentIsSigned) {
  write("release/SHA256SUMS.minisig", changed(signature, "0.1.0", "9.1.0"));
  refuse_release("is not what was signed");
}

TEST_F(VerifyRelease, AnotherKeyIsNamed) {
  refuse_release("signed with the key C27946F27A07BC29, not with 53DC7BA7F3D3AE3A", other_key);
  // Another key under the name of the right one.
  const std::string other = other_key, name_and_a_half = std::string(release_key).substr(0, 16);
  refuse_release("is not what was signed", name_and_a_half + other.substr(16));
}

TEST_F(VerifyRelease, WhatIsNoSignatureKeyOrListIsRefusedInOneLine) {
  for (const std::string& none :
       {std::string(), std::string("\n\n\n\n"), older_signature, changed(signature, "RUQp", "####"),
        changed(signature, "FwU=\n", "FwU\n"), signature + "more\n",
        changed(signature, "trusted comment: ream", "ream")}) {
    write("release/SHA256SUMS.minisig", none);
    refuse_release("no signature of minisign");
  }
  write("release/SHA256SUMS.minisig", std::string(1 << 17, 'x'));
  refuse_release("larger than 64 kB");
  fs::remove(folder() / "release/SHA256SUMS.minisig");
  refuse_release("SHA256SUMS.minisig is not there");
  fs::remove(folder() / "release/SHA256SUMS");
  refuse_release("SHA256SUMS is not there");
  write("key.pub", "untrusted comment: none\nAAAA\n");
  refuse_release("key.pub holds no public key", "key.pub");
  refuse_release("nowhere.pub is not there", "nowhere.pub");
}

}  // namespace
}  // namespace ream::test
