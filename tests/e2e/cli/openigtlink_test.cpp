// A session as 3D Slicer sees it, from a server in a process of its own.
#include <signal.h>

#include <algorithm>
#include <iostream>

#include "e2e/cli/serve_block_fixture.hpp"
#include "geometry/mesh_io.hpp"
#include "support/slicer_client.hpp"

namespace ream::test {
namespace {

class WatchedServe : public ServeBlock {
 protected:
  void serve_watched() {
    serve({"--openigtlink", "0"});
    until_ready();
    watch_port_ = said_.at("openigtlink_port");
  }

  /// The surface that a session left, in RAS, by the coordinates of its triangles' corners.
  static std::vector<std::array<std::array<float, 3>, 3>> corners_of(
      const std::vector<std::array<float, 3>>& points,
      const std::vector<std::array<uint32_t, 3>>& triangles) {
    std::vector<std::array<std::array<float, 3>, 3>> all;
    for (const auto& t : triangles) {
      std::array<std::array<float, 3>, 3> corners{points.at(t[0]), points.at(t[1]), points.at(t[2])};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      all.push_back(corners);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  /// What the program exports of a session that has ended (LPS), turned to RAS.
  std::vector<std::array<std::array<float, 3>, 3>> reamed_in_ras(const std::string& id) {
    succeed({"export", id, "--out", "left.stl"});
    const TriangleMesh mesh = load_mesh(folder() / "left.stl");
    std::vector<std::array<float, 3>> points;
    for (const Vec3f& v : mesh.vertices_mm) points.push_back({-v.x(), -v.y(), v.z()});
    return corners_of(points, mesh.triangles);
  }

  void TearDown() override {
    if (HasFailure()) std::cerr << printed("server.err");
  }

  uint16_t watch_port_ = 0;
};

TEST_F(WatchedServe, ToolMovesAndTheLastSurfaceIsTheReamedOne) {
  serve_watched();
  SlicerClient client(watch_port_);
  EXPECT_EQ(client.hear("Simulator").text, "no session has been started");
  write("data/scripts/press.json",
        R"({"device": "hand", "duration_s": 60, "stiffness_n_mm": 100,
            "hand": {"start_mm": [0, 0, -0.3], "force_profile": [{"t_s": 0, "force_n": 40}]}})");
  const std::string id =
      request(201, "POST", "/api/v1/sessions", R"({"case": "block", "script": "press"})").at("id");
  request(200, "POST", path_of(id) + "/start");
  EXPECT_TRUE(client.hear("Session").text.starts_with(id + ": A block, right, reamer")) << id;
  const IgtlReading intact = client.hear("Bone");
  // The case's block stands in the world as it lies in its grid, and is reamed straight down.
  float first_mm = 0.0f;
  client.hear_until("the tool to have moved", [&](const IgtlReading& reading) {
    if (reading.name != "ReamerToRas") return false;
    EXPECT_NEAR(reading.transform[8], -1.0f, 0.1f);
    EXPECT_NEAR(reading.transform[9], -18.0f, 0.1f);
    EXPECT_NEAR(reading.transform[10], -18.0f, 0.1f);
    if (first_mm == 0.0f) first_mm = reading.transform[11];
    return reading.transform[11] < first_mm - 0.3f;
  });
  client.hear_until("thrust", [](const IgtlReading& reading) {
    return reading.name == "Force" && reading.values.at(0) > 30.0;
  });
  request(200, "POST", path_of(id) + "/stop");
  // The last surface may come before the word of the end, or after it.
  IgtlReading last = intact;
  client.hear_until("the end", [&](const IgtlReading& reading) {
    if (reading.name == "Bone") last = reading;
    return reading.name == "Simulator" && reading.error_name == "stopped";
  });
  const auto left = reamed_in_ras(id);
  if (corners_of(last.points, last.triangles) != left)
    last = client.hear_until("the surface that is left", [&](const IgtlReading& reading) {
      return reading.name == "Bone" && corners_of(reading.points, reading.triangles) == left;
    });
  EXPECT_NE(corners_of(intact.points, intact.triangles), left);
  EXPECT_EQ(last.normals.size(), last.points.size());
  SlicerClient late(watch_port_);
  const IgtlReading of_late = late.hear("Bone");
  EXPECT_EQ(corners_of(of_late.points, of_late.triangles), left);
}

TEST_F(WatchedServe, NobodyWhoWatchesBadlyDisturbsTheSession) {
  serve_watched();
  const std::string id = create();
  request(200, "POST", path_of(id) + "/start");
  SlicerClient never_reads(watch_port_);
  for (int i = 0; i < 20; ++i) SlicerClient(watch_port_).raw(500);
  until("two seconds are simulated", [&] { return duration_s(id) > 2.0; });
  EXPECT_EQ(request(200, "GET", path_of(id)).at("state"), "running");
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait(std::chrono::seconds(20)), 0) << printed("server.err");
  EXPECT_EQ(json_of("data/sessions/" + id + "/session.json").at("state"), "stopped");
}

TEST_F(WatchedServe, PortsAndHostsThatCannotBeAreRefused) {
  serve_watched();
  const auto refused = [&](int code, const std::string& words, const std::string& place,
                           const Words& more = {}) {
    Words command = {"serve", "--port", "0", "--web", "web", "--data", "other", "--openigtlink", place};
    command.insert(command.end(), more.begin(), more.end());
    refuse_beside_others(code, words, command);
  };
  std::filesystem::create_directories(folder() / "other");
  refused(2, "--openigtlink slicer", "slicer");
  refused(2, "--openigtlink 70000", "70000");
  refused(2, "without a login", "0.0.0.0:0");
  refused(2, "without a login", "[::]:0");
}

TEST_F(WatchedServe, APortInUseIsOneClearLine) {
  serve_watched();
  const std::string port = std::to_string(watch_port_);
  const Outcome outcome =
      run({"serve", "--port", "0", "--web", "web", "--data", "other", "--openigtlink", port});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.error.find("port " + port), std::string::npos) << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
}

}  // namespace
}  // namespace ream::test
