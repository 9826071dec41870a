#include "support/power_loss.hpp"

#include <signal.h>

#include <cstdlib>
#include <fstream>

#include "core/file.hpp"
#include "ct/phantom/phantom.hpp"
#include "ct/read/write_volume.hpp"
#include "e2e/cli/serve_block_fixture.hpp"
#include "support/full_tests.hpp"
#include "support/places.hpp"
#include "support/seed.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

/// What the program said it did is there after the power went, on a disk that keeps nothing but what was
/// synced (power_loss_preload).
class PowerLoss : public ServeBlock, public testing::WithParamInterface<Lost> {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizer's own library must be the first";
#endif
    ServeBlock::SetUp();
    takes_demo_case_ = false;  // a copy that a test made was never synced
    environment_["LD_PRELOAD"] = build_folder() + "/tests/support/libpower_loss_preload.so";
    environment_[power_loss_variable] = kept();
    begin();
  }

  fs::path kept() const { return printed_.path() / "kept"; }
  /// All that there is has lain on the disk for long.
  void begin() {
    fs::remove_all(kept());
    keep_tree(folder(), kept());
  }
  void serve() {
    begin();
    Serve::serve({"--backend", "cpu", "--realtime", "off"});
    until_ready();
  }
  void lose() { lose_power(folder(), kept(), GetParam()); }
  /// The power goes, and the server is started once more.
  void lose_and_serve() {
    server_->send_signal(SIGKILL);
    EXPECT_EQ(server_->wait(10s), 128 + SIGKILL);
    lose();
    serve();
  }
  /// A command that ended well, and then the power.
  void succeed_and_lose(const Words& words) {
    begin();
    succeed(words);
    lose();
  }
  /// The job as it ended.
  json ended_job(json job) {
    until("the job has ended", [&] {
      job = request(200, "GET", "/api/v1/jobs/" + job.at("id").get<std::string>());
      return job.at("state") != "waiting" && job.at("state") != "running";
    });
    EXPECT_EQ(job.at("state"), "done") << job;
    return job;
  }
  std::string import_phantom() {
    ct::PhantomParams params;
    params.spacing_mm = Vec3::Constant(2.5);
    ct::write_volume_file(ct::make_phantom(params).volume, printed_.path() / "shoulder.nrrd");
    const std::string bytes = printed("shoulder.nrrd"), uploads = "/api/v1/uploads";
    const std::string id =
        request(201, "POST", uploads, json{{"name", "shoulder.nrrd"}, {"bytes", bytes.size()}}.dump())
            .at("id");
    constexpr size_t most = 1'000'000;
    for (size_t at = 0; at < bytes.size(); at += most)
      request(200, "PUT", uploads + "/" + id + "?offset=" + std::to_string(at), bytes.substr(at, most),
              {{"Content-Type", "application/octet-stream"}});
    return ended_job(request(202, "POST", "/api/v1/cases", json{{"upload_id", id}, {"side", "right"}}.dump()))
        .at("case_id");
  }
};

TEST_P(PowerLoss, TakesWhatNobodySynced) {
  begin();
  const std::string made = (folder() / "made").string(), file = made + "/file";
  const auto shell = [&](const std::string& command) {
    const std::string preload = "LD_PRELOAD=" + environment_.at("LD_PRELOAD") + " ";
    ASSERT_EQ(
        std::system(
            (std::string(power_loss_variable) + "=" + kept().string() + " " + preload + command).c_str()),
        0)
        << command;
  };
  fs::create_directory(made);
  std::ofstream(file) << "words";
  lose();
  EXPECT_EQ(fs::exists(made), GetParam() == Lost::bytes);
  if (fs::exists(made)) {
    EXPECT_EQ(fs::file_size(file), 0u);
  }
  fs::create_directories(made);
  std::ofstream(file) << "words";
  shell("sync " + file + " " + made + " " + folder().string());
  std::ofstream(file, std::ios::app) << " and more";
  lose();
  EXPECT_EQ(read_text_file(file), "words");
}

TEST_P(PowerLoss, KeepsASessionThatWasStopped) {
  serve();
  const std::string id = create();
  request(200, "POST", path_of(id) + "/start");
  until("it has run for a while", [&] { return duration_s(id) > 1.5; });
  EXPECT_EQ(request(200, "POST", path_of(id) + "/stop").at("state"), "stopped");
  request(201, "POST", path_of(id) + "/annotations", R"({"words": "well done"})");
  const json before = request(200, "GET", path_of(id) + "/metrics");
  lose_and_serve();
  EXPECT_EQ(request(200, "GET", path_of(id)).at("state"), "stopped");
  EXPECT_EQ(request(200, "GET", path_of(id) + "/metrics"), before);
  EXPECT_EQ(request(200, "GET", path_of(id) + "/annotations").at("annotations").size(), 1u);
  succeed({"replay", id, "--verify"});
}

TEST_P(PowerLoss, KeepsMostOfASessionThatRuns) {
  constexpr double longest_loss_s = 3.0;
  serve();
  const std::string id = create();
  request(200, "POST", path_of(id) + "/start");
  double seen_s = 0.0;
  until("it has run for a while", [&] { return (seen_s = duration_s(id)) > longest_loss_s + 1.0; });
  lose_and_serve();
  const json session = request(200, "GET", path_of(id));
  EXPECT_EQ(session.at("state"), "interrupted");
  EXPECT_GE(session.at("duration_s").get<double>(), seen_s - longest_loss_s);
  request(200, "POST", path_of(id) + "/resume");
  request(200, "POST", path_of(id) + "/stop");
  succeed({"replay", id, "--verify"});
}

TEST_P(PowerLoss, KeepsWhatTheDatabaseWasGiven) {
  serve();
  const std::string study =
      request(201, "POST", "/api/v1/studies", R"({"name": "First year", "cases": ["block"]})").at("id");
  lose_and_serve();
  EXPECT_EQ(request(200, "GET", "/api/v1/studies/" + study).at("name"), "First year");
}

TEST_P(PowerLoss, KeepsACaseThatWasImported) {
  serve();
  const std::string made = "/api/v1/cases/" + import_phantom();
  const json before = request(200, "GET", made);
  lose_and_serve();
  EXPECT_EQ(request(200, "GET", made), before);
  const HttpReply volume = http_request(port_, "GET", made + "/volume");
  EXPECT_EQ(volume.status, 200) << volume.body.substr(0, 300);
}

TEST_P(PowerLoss, DoesNotBringBackWhatWasRemoved) {
  serve();
  const std::string id = create(), made = import_phantom();
  request(200, "POST", path_of(id) + "/start");
  request(200, "POST", path_of(id) + "/stop");
  request(204, "DELETE", path_of(id));
  request(204, "DELETE", "/api/v1/cases/" + made);
  lose_and_serve();
  request(404, "GET", path_of(id));
  request(404, "GET", "/api/v1/cases/" + made);
}

TEST_P(PowerLoss, AnUploadIsWholeOrNotThere) {
  serve();
  const std::string uploads = "/api/v1/uploads";
  const std::string id = request(201, "POST", uploads, R"({"name": "a.nrrd", "bytes": 4})").at("id");
  request(200, "PUT", uploads + "/" + id + "?offset=0", "NRRD",
          {{"Content-Type", "application/octet-stream"}});
  lose_and_serve();
  request(404, "GET", uploads + "/" + id);  // an upload lasts as long as its server; its sender begins again
  EXPECT_EQ(request(200, "GET", uploads).at("uploads").size(), 0u);
}

TEST_P(PowerLoss, KeepsABackupAndWhatItRestored) {
  succeed({"simulate", "--case", "block", "--script", short_script(), "--backend", "cpu", "--out",
           "data/sessions/one"});
  succeed_and_lose({"backup", "kept.zip"});
  succeed_and_lose({"restore", "kept.zip", "--data", "second"});
  const json sessions = answer({"list", "sessions", "--data", "second"});
  ASSERT_EQ(sessions.size(), 1u) << sessions;
  EXPECT_EQ(sessions.at(0).at("state"), "finished");
  EXPECT_EQ(sessions, answer({"list", "sessions"}));
}

TEST_P(PowerLoss, KeepsWhatCommandsMade) {
  succeed_and_lose({"phantom", "--out", "made/ct", "--spacing-mm", "2.5", "--format", "dicom"});
  succeed_and_lose({"import", "made/ct", "--out", "made/case", "--side", "right"});
  succeed({"plan", "made/case", "--landmarks", "made/ct/landmarks.json"});
  succeed_and_lose({"simulate", "--case", "block", "--script", short_script(), "--backend", "cpu", "--out",
                    "made/session"});
  succeed({"replay", "made/session", "--verify"});
}

/// In full tests both, else one of them.
std::vector<Lost> losses() {
  if (full_tests()) return {Lost::names, Lost::bytes};
  return {seed() % 2 == 0 ? Lost::names : Lost::bytes};
}

INSTANTIATE_TEST_SUITE_P(Of, PowerLoss, testing::ValuesIn(losses()), [](const auto& one) {
  return one.param == Lost::names ? std::string("NamesAndBytes") : std::string("Bytes");
});

}  // namespace
}  // namespace ream::test
