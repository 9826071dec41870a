#include <fstream>
#include <future>
#include <thread>

#include "contract_fixture.hpp"
#include "core/error.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

/// A server with sessions that have ended in its data folder, and forms that write a few words.
class DownloadContractTest : public ContractTest {
 protected:
  DownloadContractTest() {
    options.data_folder = folder.path();
    put_session("ended");
    put_session("other");
    folder.write("sessions/bare/session.json",
                 R"({"case": "planned", "script": "demo", "state": "stopped"})");
  }
  ~DownloadContractTest() override { release(); }

  void put_session(const std::string& id) {
    folder.write(
        "sessions/" + id + "/session.json",
        R"({"case": "planned", "script": "demo", "state": "stopped", "ticks": 5000, "trainee": "Anna"})");
    folder.write("sessions/" + id + "/recording.ream", "0123456789");
  }
  void hold() { engine->held = true; }
  void release() { engine->held = false; }

  json job(const std::string& id) { return json::parse(get("/api/v1/jobs/" + id).body); }
  json ended(const HttpReply& reply) {
    json told = json::parse(reply.body);
    while (told.at("state") == "waiting" || told.at("state") == "running") {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      told = job(told.at("id"));
    }
    return told;
  }
  HttpReply part_of(const std::string& path, const std::string& range) {
    return http_request(server->port(), "GET", path, {}, {{"Range", "bytes=" + range}});
  }

  void recording() {
    const std::string pattern = one + "/recording";
    expect_get(pattern, ended_path + "/recording", 200);
    expect_get(pattern, all + "/bare/recording", 404);
    expect_get(pattern, all + "/nobody/recording", 404);
    const HttpReply part = part_of(ended_path + "/recording", "2-4");
    expect_as_described("GET", pattern, 206, part);
    EXPECT_EQ(part.body, "234");
    expect_as_described("GET", pattern, 416, part_of(ended_path + "/recording", "10-"));
    expect_get(one + "/session.json", ended_path + "/session.json", 200);
    expect_get(one + "/session.json", all + "/nobody/session.json", 404);
  }

  void trace() {
    const std::string pattern = one + "/trace", path = ended_path + "/trace";
    expect_get(pattern, path, 200);
    EXPECT_EQ(get(path + "?from_s=1.5&stride=10").body, "csv of ended from 1.5 by 10, standard and ");
    expect_get(pattern, all + "/bare/trace", 404);
    expect_get(pattern, path + "?stride=0", 422);
    put_session("long");
    folder.write("sessions/long/session.json", R"({"case": "planned", "script": "demo", "ticks": 1000002})");
    expect_get(pattern, all + "/long/trace", 422);
    EXPECT_EQ(get(all + "/long/trace?stride=2").status, 200);
    EXPECT_EQ(get(all + "/long/trace?from_s=1").status, 200);
    EXPECT_TRUE(fs::is_empty(folder.path() / "passing"));
  }

  /// Of a live session now, of an ended one by a job.
  void pictures(const std::string& what, const std::string& live) {
    const std::string pattern = one + "/" + what, path = ended_path + "/" + what;
    expect_get(pattern, live + "/" + what, 200);
    expect_get(pattern, all + "/bare/" + what, 404);
    hold();
    const HttpReply first = get(path), second = get(path);
    expect_as_described("GET", pattern, 202, first);
    EXPECT_EQ(json::parse(first.body).at("id"), json::parse(second.body).at("id")) << "made once";
    release();
    EXPECT_EQ(ended(first).at("state"), "done");
    expect_get(pattern, path, 200);
  }

  void exports(const std::string& live) {
    const std::string pattern = one + "/exports", path = ended_path + "/exports";
    const std::string good = R"({"format": "csv", "from_s": 1, "stride": 5})";
    expect_post(pattern, path, 400, "{");
    expect_post(pattern, path, 403, good, foreign);
    expect_post(pattern, all + "/nobody/exports", 404, good);
    expect_post(pattern, live + "/exports", 409, good);
    expect_post(pattern, path, 413, std::string(options.listen.limits.body_bytes + 1, ' '));
    expect_post(pattern, path, 415, good, {{"Content-Type", "text/plain"}});
    expect_post(pattern, path, 422, R"({"format": "docx"})");
    expect_post(pattern, path, 422, R"({"format": "hdf5"})");
    expect_post(pattern, path, 422, R"({"format": "csv", "component_load": true})");
    expect_post(pattern, path, 422, R"({"format": "ply", "stride": 5})");
    const json done = ended(expect_repeatable(pattern, path, 202, good));
    EXPECT_EQ(done.at("session_id"), "ended");
    EXPECT_EQ(done.at("result").at("name"), "ended.csv");
    const std::string result = "/api/v1/jobs/" + done.at("id").get<std::string>() + "/result";
    expect_get(one_job + "/result", result, 200);
    EXPECT_EQ(get(result).body, "csv of ended from 1 by 5, standard and ");
    expect_as_described("GET", one_job + "/result", 206, part_of(result, "0-2"));
    expect_as_described("GET", one_job + "/result", 416, part_of(result, "1000-"));
    expect_get(one_job + "/result", "/api/v1/jobs/nothing/result", 404);
    reports(path);
    for (const char* name : {"ply", "stl", "glb", "png", "zip", "parquet", "causes", "review"}) {
      const json made = ended(post(path, json{{"format", name}}.dump()));
      expect_get(one_job + "/result", "/api/v1/jobs/" + made.at("id").get<std::string>() + "/result", 200);
    }
  }

  /// They are judged by a rubric and compared with a benchmark, which only they are.
  void reports(const std::string& path) {
    const std::string pattern = one + "/exports";
    expect_post(pattern, path, 404, R"({"format": "pdf", "rubric": "nothing"})");
    expect_post(pattern, path, 422, R"({"format": "pdf", "rubric": "../house"})");
    expect_post(pattern, path, 422, R"({"format": "pdf", "benchmark": "/etc/passwd"})");
    expect_post(pattern, path, 422, R"({"format": "csv", "rubric": "house"})");
    expect_post(pattern, path, 422, R"({"format": "pdf", "stride": 5})");
    const json made = ended(post(path, R"({"format": "pdf", "rubric": "house@3", "benchmark": "experts"})"));
    EXPECT_EQ(get("/api/v1/jobs/" + made.at("id").get<std::string>() + "/result").body,
              "pdf of ended from 0 by 1, house@3 and experts");
    const json surface = ended(post(path, R"({"format": "surface"})"));
    EXPECT_EQ(surface.at("result").at("name"), "ended.ply");
  }

  /// While others have all the threads and places that there are for such work.
  void too_much() {
    hold();
    const HttpReply first = post(ended_path + "/exports", R"({"format": "zip"})");
    expect_get(one_job + "/result",
               "/api/v1/jobs/" + json::parse(first.body).at("id").get<std::string>() + "/result", 409);
    int status = 202;
    while (status == 202) status = post(ended_path + "/exports", R"({"format": "zip"})").status;
    expect_post(one + "/exports", ended_path + "/exports", 503, R"({"format": "zip"})");
    expect_get(one + "/mesh", all + "/other/mesh", 503);
    expect_get(one + "/snapshot", all + "/other/snapshot", 503);
    std::vector<std::future<HttpReply>> replies;
    for (int i = 0; i < 3; ++i)
      replies.push_back(std::async(std::launch::async, [this] { return get(ended_path + "/trace"); }));
    const auto answered = [](const auto& reply) {
      return reply.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    };
    while (std::none_of(replies.begin(), replies.end(), answered)) std::this_thread::yield();
    release();
    for (auto& each : replies)
      if (const HttpReply reply = each.get(); reply.status != 200)
        expect_as_described("GET", one + "/trace", 503, reply);
  }

  const std::string ended_path = all + "/ended", one_job = "/api/v1/jobs/{id}";
};

TEST_F(DownloadContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  start();
  const std::string live = all + "/" + create();
  recording();
  trace();
  pictures("mesh", live);
  pictures("snapshot", live);
  expect_get(one + "/mesh", live + "/mesh?stride=3", 422);
  EXPECT_EQ(get(live + "/mesh?stride=2").body.substr(0, 3), "ply");
  exports(live);
  too_much();
  expect_all_given({"downloads"});
}

TEST_F(DownloadContractTest, AnExportCanBeCancelled) {
  start();
  hold();
  const json running = json::parse(post(ended_path + "/exports", R"({"format": "zip"})").body);
  const json waiting = json::parse(post(ended_path + "/exports", R"({"format": "zip"})").body);
  const std::string at = "/api/v1/jobs/" + waiting.at("id").get<std::string>();
  EXPECT_EQ(json::parse(http_request(server->port(), "DELETE", at).body).at("state"), "cancelled");
  release();
  EXPECT_EQ(get(at + "/result").status, 404);
  const json list = json::parse(get("/api/v1/jobs?session_id=ended&state=cancelled").body);
  EXPECT_EQ(list.at("total"), 1);
  EXPECT_EQ(list.at("jobs").at(0).at("id"), waiting.at("id"));
}

}  // namespace
}  // namespace ream::test
