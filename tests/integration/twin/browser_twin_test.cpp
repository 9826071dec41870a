// The twin as browsers run it, in Node's engine (that of Chromium): the same bits as the program.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "support/child_process.hpp"
#include "support/places.hpp"
#include "support/twin/cause_file.hpp"
#include "support/twin/reamed_parts.hpp"
#include "twin/twin_player.hpp"

namespace ream::test {
namespace {

using Outcome = twin::TwinPlayer::Outcome;

/// FNV-1a, as run_twin.mjs adds it up.
class SurfaceHash {
 public:
  template <typename T>
  void add(const std::vector<T>& values) {
    for (const std::byte byte : std::as_bytes(std::span(values)))
      hash_ = (hash_ ^ std::to_integer<uint64_t>(byte)) * 1099511628211ull;
  }
  std::string text() const { return to_hex(hash_); }

 private:
  uint64_t hash_ = 14695981039346656037ull;
};

nlohmann::json in_browsers_engine(const std::filesystem::path& causes, const TemporaryFolder& folder,
                                  const std::string& option = "--hash") {
  const auto out = folder.path() / "twin.json", error = folder.path() / "twin.error";
  ChildProcess node({{"/usr/bin/env", "node", source_folder() + "/tests/support/twin/run_twin.mjs",
                      build_folder() + "/twin/ream-twin.wasm", causes.string(), option},
                     {{"PATH", std::getenv("PATH")}},
                     folder.path(),
                     out,
                     error});
  if (const int code = node.wait(std::chrono::seconds(120)); code != 0) {
    ADD_FAILURE() << "node ended with " << code << ": " << read_text_file(error);
    return {};
  }
  return nlohmann::json::parse(read_text_file(out));
}

/// The last picture as the program itself makes it of the same parts.
void expect_same_bits(const nlohmann::json& browsers, const std::filesystem::path& causes) {
  twin::TwinPlayer player;
  for (const twin::Bytes& part : parts_of(causes)) ASSERT_EQ(player.take(part), Outcome::agrees);
  EXPECT_EQ(browsers.at("outcome"), "agrees");
  EXPECT_EQ(browsers.at("ended"), true);
  EXPECT_EQ(browsers.at("agreed_ticks"), player.agreed_ticks());
  EXPECT_EQ(browsers.at("coverage_hash"), to_hex(player.twin()->bone().coverage_hash()));
  SurfaceHash surface;
  size_t triangles = 0;
  for (const uint32_t block : player.twin()->take_changed_blocks()) {
    const surface::BlockMesh mesh = player.twin()->surface_of(block).mesh;
    surface.add(mesh.vertices);
    surface.add(mesh.indices);
    triangles += mesh.indices.size() / 3;
  }
  EXPECT_EQ(browsers.at("triangles"), triangles);
  EXPECT_EQ(browsers.at("surface"), surface.text());
}

TEST(BrowserTwin, HasTheSameBitsAsTheProgram) {
  for (const char* profile : {"touch", "ideal-admittance"}) {
    SCOPED_TRACE(profile);
    RecordedReaming reaming;
    const auto causes = causes_of(reaming, reaming.record(RecordedReaming::push(profile)));
    expect_same_bits(in_browsers_engine(causes, reaming.folder()), causes);
  }
}

TEST(BrowserTwin, HasThemWithASecondReamer) {
  RecordedReaming reaming;
  const nlohmann::json script = RecordedReaming::push("omega.6", 1.5);
  const auto recording = reaming.record(script);
  reaming.go_on(recording, script, "sphere 10,6");
  const auto causes = causes_of(reaming, recording);
  expect_same_bits(in_browsers_engine(causes, reaming.folder()), causes);
}

std::filesystem::path file_of(const std::vector<twin::Bytes>& parts, const TemporaryFolder& folder) {
  twin::PartFileWriter writer(twin::cause_file_magic, twin::cause_file_revision);
  for (const twin::Bytes& part : parts) writer.add(part);
  auto path = folder.path() / "parts.causes";
  write_file_atomically(path, writer.finish());
  return path;
}

/// Sums of three squares and products of matrices have no order of their own.
TEST(BrowserTwin, HasThemWhereVoxelsAreNoCubes) {
  const TemporaryFolder folder;
  for (const Vec3& spacing_mm : {Vec3(0.25, 0.28, 0.22), Vec3(0.31, 0.1, 0.47), Vec3(0.123, 0.2, 0.301)}) {
    const auto causes = file_of(reamed_parts({64, 64, 48}, spacing_mm, 600), folder);
    expect_same_bits(in_browsers_engine(causes, folder), causes);
  }
}

/// A size there has 32 bits.
TEST(BrowserTwin, HasThemInAGridOfMoreThan16MillionVoxels) {
  const TemporaryFolder folder;
  const auto causes = file_of(reamed_parts({512, 512, 72}, {0.2, 0.2, 0.2}, 400), folder);
  expect_same_bits(in_browsers_engine(causes, folder), causes);
}

/// And writes to nowhere else.
TEST(BrowserTwin, EndsWhereMemoryDoes) {
  const TemporaryFolder folder;
  const auto causes = file_of(reamed_parts({64, 64, 48}, {0.2, 0.2, 0.2}, 10), folder);
  EXPECT_EQ(in_browsers_engine(causes, folder, "--exhaust").at("outcome"), "trapped");
}

TEST(BrowserTwin, FindsADifference) {
  RecordedReaming reaming;
  const auto good = causes_of(reaming, reaming.record(RecordedReaming::push("ideal")));
  std::vector<twin::Bytes> parts = parts_of(good);
  for (twin::Bytes& part : parts)
    if (code_of(part) == twin::PartCode::ticks && part[1] == std::byte{250 * 3 % 256} &&
        part[2] == std::byte{2})
      part[9] ^= std::byte{1};  // of the hash after tick 999
  const auto forged = file_of(parts, reaming.folder());
  const nlohmann::json found = in_browsers_engine(forged, reaming.folder());
  EXPECT_EQ(found.at("outcome"), "differs");
  EXPECT_EQ(found.at("agreed_ticks"), 750);
}

}  // namespace
}  // namespace ream::test
