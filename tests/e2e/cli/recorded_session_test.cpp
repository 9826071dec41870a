#include <signal.h>

#include <cmath>
#include <thread>

#include "core/file.hpp"
#include "e2e/cli/command_line.hpp"
#include "store/zip_archive.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What can be done with a recording once the run is over.
class RecordedSession : public CommandLine {
 protected:
  void SetUp() override { simulate_short_demo(); }

  void flip_byte(const fs::path& file, double at_share) {
    std::string bytes = read_text_file(file);
    bytes[static_cast<size_t>(at_share * static_cast<double>(bytes.size()))] ^= 0x10;
    write_file_atomically(file, bytes);
  }
};

TEST_F(RecordedSession, IsScoredAgainAsItWas) {
  EXPECT_EQ(answer({"score", "run"}).at("metrics"), json_of("run/metrics.json"));
  EXPECT_EQ(answer({"score", "run/recording.ream"}).at("metrics"), json_of("run/metrics.json"));
  write("rubric.json", R"({"name": "gentle", "version": 2, "criteria": [
      {"metric": "axial_thrust_peak_n", "none": 1000, "full": 0},
      {"metric": "removed_volume_mm3", "none": 1e6, "full": 1e5, "weight": 3}]})");
  const json score = answer({"score", "run", "--rubric", "rubric.json"}).at("score");
  const double peak_n = json_of("run/metrics.json").at("axial_thrust_peak_n");
  const double points = ((100.0 - peak_n / 10.0) + 3 * 100.0) / 4.0;
  EXPECT_NEAR(score.at("points").get<double>(), std::floor(10.0 * points) / 10.0, 1e-9);
  EXPECT_NE(succeed({"score", "run", "--rubric", "rubric.json"}).out.find("gentle, version 2"),
            std::string::npos);
  EXPECT_EQ(answer({"score", "run", "run"}).size(), 2u);
}

TEST_F(RecordedSession, IsExportedAsTheRunWroteIt) {
  succeed({"export", "run", "--out", "again.csv"});
  EXPECT_EQ(text_of("again.csv"), text_of("run/trace.csv"));
}

TEST_F(RecordedSession, IsExportedForOtherToolsWholeOrNotAtAll) {
  succeed({"export", "run", "--out", "trace.parquet"});
  EXPECT_TRUE(text_of("trace.parquet").starts_with("PAR1"));
  EXPECT_TRUE(text_of("trace.parquet").ends_with("PAR1"));
  succeed({"export", "run", "--out", "run.h5"});
  EXPECT_TRUE(text_of("run.h5").starts_with("\x89HDF\r\n\x1a\n"));
  succeed({"export", "run", "--out", "same", "--format", "hdf5"});
  EXPECT_TRUE(text_of("run.h5") == text_of("same"));
  refuse(2, "parquet, hdf5", {"export", "run", "--out", "a.h5", "--format", "hdf"});
  refuse(2, ".h5", {"export", "run", "--out", "a.hdf"});
  refuse(1, "nowhere", {"export", "run", "--out", "a.h5", "--case", "nowhere"});
  refuse(1, "a.h5", {"export", "run", "--out", "nowhere/a.h5"});
  refuse(1, "no session 'nobody'", {"export", "nobody", "--out", "a.parquet"});
}

TEST_F(RecordedSession, GoesToAnotherMachineInOneFile) {
  succeed({"export", "run", "--out", "bundle.zip"});
  const std::string id = answer({"import", "bundle.zip", "--data", "elsewhere"}).at("session");
  EXPECT_EQ(answer({"list", "sessions", "--data", "elsewhere"}).at(0).at("id"), id);
  EXPECT_EQ(answer({"score", id, "--data", "elsewhere"}).at("metrics"), json_of("run/metrics.json"));
  succeed({"export", id, "--out", "there.ply", "--data", "elsewhere"});
  EXPECT_TRUE(text_of("there.ply").starts_with("ply\n"));
  refuse(1, id, {"import", "bundle.zip", "--data", "elsewhere"});
}

TEST_F(RecordedSession, OfABundleOnlyItsFilesAreTakenAndNobodysName) {
  succeed({"export", "run", "--out", "bundle.zip"});
  const fs::path opened = folder() / "opened", session = opened / "session/session.json";
  fs::create_directory(opened);
  store::unpack_zip(folder() / "bundle.zip", opened);
  json labels = {{"id", "run"}, {"title", "First try"}};
  for (const char* key : {"trainee_id", "trainee", "study", "participant"}) labels[key] = "somebody";
  write_json_file(session, labels);
  std::vector<store::ArchiveEntry> entries;
  for (const std::string& name : store::zip_names(folder() / "bundle.zip"))
    entries.push_back({opened / name, name});
  std::erase_if(entries, [](const auto& entry) { return entry.name == "session/session.json"; });
  entries.push_back({session, "session/session.json"});
  for (const char* extra :
       {"session/lock", "session/black-box-x.csv", "session/deep/trace.csv", "case/ct.nrrd", "x.json"})
    entries.push_back({session, extra});
  store::write_zip(folder() / "other.zip", entries);
  const std::string id = answer({"import", "other.zip", "--data", "elsewhere"}).at("session");
  const fs::path taken = folder() / "elsewhere/sessions" / id;
  EXPECT_EQ(json_of(taken.string() + "/session.json"), (json{{"id", "run"}, {"title", "First try"}}));
  for (const char* extra : {"lock", "black-box-x.csv", "deep"})
    EXPECT_FALSE(fs::exists(taken / extra)) << extra;
  EXPECT_FALSE(fs::exists(folder() / "elsewhere/cases/demo/ct.nrrd"));
  EXPECT_TRUE(fs::exists(taken / "recording.ream"));
  answer({"import", "other.zip", "--data", "third", "--keep-labels"});
  EXPECT_EQ(json_of("third/sessions/" + id + "/session.json"), labels);
}

TEST_F(RecordedSession, WhatAKilledImportLeavesIsInNoBackupAndIsRemoved) {
  succeed({"export", "run", "--out", "bundle.zip"});
  const fs::path data = folder() / "elsewhere";
  const auto passing = [&data] {
    std::error_code gone;
    std::vector<std::string> names;
    for (fs::directory_iterator next(data, gone), end; !gone && next != end; next.increment(gone))
      if (const std::string name = next->path().filename();
          next->is_directory(gone) && name != "sessions" && name != "cases")
        names.push_back(name);
    return names;
  };
  for (int attempt = 0; attempt < 20 && passing().empty(); ++attempt) {
    fs::remove_all(data);
    const auto import = start({"import", "bundle.zip", "--data", "elsewhere"}, "import");
    while (!import->ended() && passing().empty()) std::this_thread::yield();
    import->send_signal(SIGKILL);
    import->wait(std::chrono::seconds(10));
  }
  const std::vector<std::string> left = passing();
  ASSERT_FALSE(left.empty());
  answer({"backup", "all.zip", "--data", "elsewhere"});
  for (const std::string& name : store::zip_names(folder() / "all.zip"))
    for (const std::string& folder : left) EXPECT_EQ(name.find(folder), std::string::npos) << name;
  for (const std::string& name : left) EXPECT_FALSE(fs::exists(data / name)) << name;
}

TEST_F(RecordedSession, ADamagedBundleLeavesNothing) {
  succeed({"export", "run", "--out", "bundle.zip"});
  fs::create_directories(folder() / "elsewhere/sessions");
  fs::create_directories(folder() / "elsewhere/cases");
  flip_byte(folder() / "bundle.zip", 0.4);
  refuse(1, "damaged", {"import", "bundle.zip", "--data", "elsewhere"});
}

TEST_F(RecordedSession, AChangedCaseIsNotTakenForTheRecordings) {
  succeed({"export", "run", "--out", "bundle.zip"});
  const fs::path coverage = folder() / "data/cases/demo/coverage.zst";
  const fs::path density = folder() / "data/cases/demo/density.zst";
  write_file_atomically(coverage, read_text_file(density));
  fs::create_directories(folder() / "data/sessions");
  refuse(1, "case 'demo' is not what was recorded", {"export", "run", "--out", "a.ply"});
  refuse(1, "another case 'demo'", {"import", "bundle.zip"});
}

TEST_F(RecordedSession, DamageIsSaidAndWhatCameBeforeIsScored) {
  const json whole = json_of("run/metrics.json");
  flip_byte(folder() / "run/recording.ream", 0.7);
  const Outcome scored = run({"score", "run", "--json"});
  EXPECT_EQ(scored.exit_code, 0);
  EXPECT_NE(scored.error.find("damage"), std::string::npos) << scored.error;
  const json metrics = json::parse(scored.out).at("metrics");
  EXPECT_LT(metrics.at("duration_s").get<double>(), whole.at("duration_s").get<double>());
  EXPECT_GT(metrics.at("duration_s").get<double>(), 0.0);
  const Outcome proof = run({"replay", "run", "--verify", "--json"});
  EXPECT_EQ(proof.exit_code, 1);
  EXPECT_EQ(json::parse(proof.out).at("verified"), false) << "of a part";
}

TEST_F(RecordedSession, WrongInputIsNamed) {
  refuse(1, "no session 'nobody'", {"score", "nobody"});
  refuse(1, "holds no recording.ream", {"score", "data"});
  refuse(1, "nowhere.json", {"score", "run", "--rubric", "nowhere.json"});
  refuse(2, ".csv", {"export", "run", "--out", "a.doc"});
  refuse(1, "not a recording", {"score", "run/trace.csv"});
  write("bad.json",
        R"({"name": "x", "version": 1, "criteria": [{"metric": "depth", "none": 0, "full": 1}]})");
  refuse(1, "no metric 'depth'", {"score", "run", "--rubric", "bad.json"});
}

}  // namespace
}  // namespace ream::test
