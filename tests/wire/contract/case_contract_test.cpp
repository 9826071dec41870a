#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "case/landmarks.hpp"
#include "contract_fixture.hpp"
#include "ct/phantom/phantom.hpp"
#include "ct/read/read_ct.hpp"
#include "ct/read/write_volume.hpp"

namespace ream::test {
namespace {

std::string contents_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A server that reads uploaded CTs, and a phantom's CT as a file.
class CaseContractTest : public ContractTest {
 protected:
  CaseContractTest() {
    options.data_folder = folder.path();
    ct::PhantomParams params;
    params.spacing_mm = Vec3::Constant(2.0);
    phantom = ct::make_phantom(params);
    ct::write_volume_file(phantom.volume, folder.path() / "shoulder.nrrd");
    file = contents_of(folder.path() / "shoulder.nrrd");
  }

  std::string begin_upload(const std::string& name = "shoulder.nrrd") {
    const HttpReply reply = post(uploads, json{{"name", name}, {"bytes", file.size()}}.dump());
    EXPECT_EQ(reply.status, 201) << reply.body;
    return json::parse(reply.body).at("id");
  }
  HttpReply put_piece(const std::string& id, size_t offset, const std::string& bytes) {
    return http_request(server->port(), "PUT", uploads + "/" + id + "?offset=" + std::to_string(offset),
                        bytes, octets);
  }
  std::string whole_upload(const std::string& name = "shoulder.nrrd") {
    const std::string id = begin_upload(name);
    for (size_t at = 0; at < file.size(); at += most)
      EXPECT_EQ(put_piece(id, at, file.substr(at, most)).status, 200);
    return id;
  }
  /// The job of a reply, once it has ended.
  json ended(const HttpReply& reply) {
    EXPECT_EQ(reply.status, 202) << reply.body;
    json job = json::parse(reply.body);
    while (job.at("state") == "waiting" || job.at("state") == "running") {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      job = json::parse(get("/api/v1/jobs/" + job.at("id").get<std::string>()).body);
    }
    return job;
  }

  void uploading() {
    const std::string good = R"({"name": "a.zip", "bytes": 3})";
    expect_repeatable(uploads, uploads, 201, good);
    expect_post(uploads, uploads, 400, "{");
    expect_post(uploads, uploads, 403, good, foreign);
    expect_post(uploads, uploads, 413, R"({"name": "a.zip", "bytes": 1e14})");
    expect_post(uploads, uploads, 415, good, {{"Content-Type", "text/plain"}});
    expect_post(uploads, uploads, 422, R"({"name": "a.exe", "bytes": 3})");
    expect_get(uploads, uploads + "?limit=1&sort=-bytes", 200);
    expect_get(uploads, uploads + "?limit=0", 422);
    const std::string id = begin_upload(), at = uploads + "/" + id;
    expect_get(piece, at, 200);
    expect_get(piece, uploads + "/nothing", 404);
    expect_request("PUT", piece, at + "?offset=0", 200, "abc", octets);
    expect_request("PUT", piece, at, 400, "abc", octets);
    expect_request("PUT", piece, at + "?offset=0", 403, "abc",
                   {{"Content-Type", "application/octet-stream"}, {"Origin", "http://elsewhere.example"}});
    expect_request("PUT", piece, uploads + "/nothing?offset=0", 404, "abc", octets);
    expect_request("PUT", piece, at + "?offset=0", 409, "abc", octets);
    expect_request("PUT", piece, at + "?offset=3", 413, std::string(most + 1, 'a'), octets);
    expect_request("PUT", piece, at + "?offset=3", 415, "abc", {{"Content-Type", "text/plain"}});
    expect_request("DELETE", piece, at, 403, "", foreign);
    expect_request("DELETE", piece, at, 204);
    expect_request("DELETE", piece, at, 404);
  }

  /// Bodies that no operation with a JSON body takes.
  void refused_bodies(const std::string& method, const std::string& pattern, const std::string& path,
                      const std::string& good, const std::string& unusable) {
    expect_request(method, pattern, path, 400, "{");
    expect_request(method, pattern, path, 403, good, foreign);
    expect_request(method, pattern, path, 413, std::string(most + 1, ' '));
    expect_request(method, pattern, path, 415, good, {{"Content-Type", "text/plain"}});
    expect_request(method, pattern, path, 422, unusable);
  }

  std::string making() {
    const std::string partial = begin_upload();
    const std::string wanted = json{{"upload_id", whole_upload()}, {"side", "right"}}.dump();
    refused_bodies("POST", cases, cases, wanted, R"({"side": "up"})");
    expect_post(cases, cases, 404, R"({"upload_id": "nothing", "side": "left"})");
    expect_post(cases, cases, 409, json{{"upload_id", partial}, {"side", "left"}}.dump());
    const HttpReply reply = post(cases, wanted);
    expect_as_described("POST", cases, 202, reply);
    const json job = ended(reply);
    EXPECT_EQ(job.at("state"), "done") << job;
    const std::string at = "/api/v1/jobs/" + job.at("id").get<std::string>();
    expect_get("/api/v1/jobs", "/api/v1/jobs", 200);
    expect_get("/api/v1/jobs", "/api/v1/jobs?limit=1&kind=import&state=done", 200);
    expect_get("/api/v1/jobs", "/api/v1/jobs?state=lost", 422);
    expect_get(jobs, at, 200);
    expect_get(jobs, "/api/v1/jobs/nothing", 404);
    expect_request("DELETE", jobs, at, 403, "", foreign);
    expect_request("DELETE", jobs, at, 202);
    expect_request("DELETE", jobs, "/api/v1/jobs/nothing", 404);
    expect_get(cases, cases, 200);
    expect_get(cases, cases + "?limit=1&sort=-name", 200);
    expect_get(cases, cases + "?cursor=abc", 422);
    const std::string made = cases + "/" + job.at("case_id").get<std::string>();
    expect_get(one_case, made, 200);
    expect_get(one_case, cases + "/planned", 200);
    expect_get(one_case, cases + "/nowhere", 404);
    expect_get(one_case, cases + "/broken", 422);
    return made;
  }

  void segmenting(const std::string& made) {
    const std::string pattern = one_case + "/segmentation", slices = "/volume/slices/{axis}/{index}";
    expect_get(one_case + slices, made + "/volume/slices/w/3", 200);
    expect_get(one_case + slices, made + "/volume/slices/w/100000", 404);
    expect_get(one_case + slices, cases + "/planned/volume/slices/w/3", 409);
    whole_volume(made);
    expect_get(one_case + slices, made + "/volume/slices/w/3?of=colours", 422);
    expect_get(one_case + "/mesh", made + "/mesh", 409);
    expect_post(one_case + "/plan/proposal", made + "/plan/proposal", 409, "{}");
    expect_post(
        one_case + "/plan/assessment", made + "/plan/assessment", 409,
        R"({"entry_mm": [0,0,0], "axis_direction": [1,0,0], "depth_mm": 2, "reamer": "sphere 34,9"})");
    expect_get(one_case + "/surroundings", made + "/surroundings", 404);
    expect_get(one_case + "/surroundings", cases + "/planned/surroundings", 404);
    expect_get(one_case + "/mesh", cases + "/nowhere/mesh", 404);
    expect_get(one_case + "/mesh", cases + "/planned/mesh", 200);
    refused_bodies("POST", pattern, made + "/segmentation", "{}", R"({"threshold": 3})");
    expect_post(pattern, cases + "/nowhere/segmentation", 404, "{}");
    expect_post(pattern, cases + "/planned/segmentation", 409, "{}");
    for (int turn = 0; turn < 2; ++turn) {
      const HttpReply reply = post(made + "/segmentation", "{}");
      expect_as_described("POST", pattern, 202, reply);
      const json job = ended(reply);
      ASSERT_EQ(job.at("state"), "done") << job;
    }
    expect_get(one_case + slices, made + "/volume/slices/u/3?of=labels&revision=2", 200);
    expect_get(one_case + slices, made + "/volume/slices/u/3?of=labels&revision=1", 409);
    expect_post(pattern + "/undo", made + "/segmentation/undo", 403, "", foreign);
    expect_post(pattern + "/undo", made + "/segmentation/undo", 200);
    expect_post(pattern + "/undo", made + "/segmentation/undo", 409);
    expect_post(pattern + "/undo", cases + "/nowhere/segmentation/undo", 404);
    expect_get(one_case, made, 200);
  }

  /// What was imported comes out again.
  void whole_volume(const std::string& made) {
    expect_get(one_case + "/volume", made + "/volume", 200);
    expect_get(one_case + "/volume", cases + "/planned/volume", 409);
    expect_get(one_case + "/volume", cases + "/nowhere/volume", 404);
    const std::filesystem::path copy = folder.path() / "copy.nrrd";
    std::ofstream(copy, std::ios::binary) << get(made + "/volume").body;
    const ct::HuVolume volume = ct::read_volume_file(copy);
    EXPECT_EQ(volume.hu, phantom.volume.hu);
    EXPECT_TRUE(volume.spacing_mm.isApprox(phantom.volume.spacing_mm));
    const auto corner = [](const ct::HuVolume& of) { return of.world_of_centre(Vec3i::Zero()); };
    EXPECT_LT((corner(volume) - corner(phantom.volume)).norm(), 1e-6);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "passing"));
  }

  void planning(const std::string& made) {
    const std::string good = case_::to_json(phantom.truth.landmarks).dump();
    const std::string landmarks = one_case + "/landmarks", plan = one_case + "/plan";
    EXPECT_EQ(ended(post(made + "/build", "{}")).at("problem").at("status"), 409);
    refused_bodies("PUT", landmarks, made + "/landmarks", good, R"({"nose_mm": [1, 2, 3]})");
    expect_request("PUT", landmarks, cases + "/nowhere/landmarks", 404, good);
    expect_get(landmarks, made + "/landmarks", 200);
    expect_get(landmarks, cases + "/nowhere/landmarks", 404);
    expect_request("PUT", landmarks, made + "/landmarks", 200, good);
    EXPECT_EQ(json::parse(get(made + "/landmarks").body), json::parse(good));
    expect_get(one_case + "/measures", made + "/measures", 200);
    expect_get(one_case + "/measures", cases + "/nowhere/measures", 404);
    refused_bodies("POST", plan + "/proposal", made + "/plan/proposal", "{}", R"({"depth_mm": -1})");
    expect_post(plan + "/proposal", cases + "/nowhere/plan/proposal", 404, "{}");
    const HttpReply proposed = post(made + "/plan/proposal", R"({"version_deg": 0})");
    expect_as_described("POST", plan + "/proposal", 200, proposed);
    json wanted = json::parse(proposed.body).at("plan");
    std::erase_if(wanted.get_ref<json::object_t&>(),
                  [](const auto& entry) { return entry.second.is_null(); });
    refused_bodies("POST", plan + "/assessment", made + "/plan/assessment", wanted.dump(), "{}");
    expect_post(plan + "/assessment", cases + "/nowhere/plan/assessment", 404, wanted.dump());
    const HttpReply assessed = post(made + "/plan/assessment", wanted.dump());
    expect_as_described("POST", plan + "/assessment", 200, assessed);
    EXPECT_GT(json::parse(assessed.body).at("outcome").at("footprint_area_mm2").get<double>(), 0.0)
        << assessed.body;
    refused_bodies("PUT", plan, made + "/plan", wanted.dump(), "{}");
    expect_get(plan, made + "/plan", 404);
    expect_request("PUT", plan, cases + "/nowhere/plan", 404, wanted.dump());
    expect_request("PUT", plan, made + "/plan", 200, wanted.dump());
    expect_get(plan, made + "/plan", 200);
    EXPECT_EQ(json::parse(get(made + "/plan").body).at("entry_mm"), wanted.at("entry_mm"));
    const HttpReply steep = post(made + "/plan/proposal", R"({"version_deg": -30})");
    json refused = json::parse(steep.body).at("plan");
    std::erase_if(refused.get_ref<json::object_t&>(),
                  [](const auto& entry) { return entry.second.is_null(); });
    expect_request("PUT", plan, made + "/plan", 409, refused.dump());
    expect_get("/api/v1/reamers", "/api/v1/reamers", 200);
  }

  void wrong_landmarks(const std::string& made) {
    http_request(server->port(), "PUT", made + "/landmarks",
                 R"({"glenoid_centre_mm": [0,0,0], "trigonum_mm": [1,0,0], "inferior_angle_mm": [2,0,0],
                     "superior_rim_mm": [0,0,0], "inferior_rim_mm": [0,0,0], "anterior_rim_mm": [0,0,0],
                     "posterior_rim_mm": [0,0,0]})");
    expect_get(one_case + "/measures", made + "/measures", 422);
  }

  void building(const std::string& made) {
    const std::string pattern = one_case + "/build";
    refused_bodies("POST", pattern, made + "/build", "{}", R"({"upsample": 17})");
    expect_post(pattern, cases + "/nowhere/build", 404, "{}");
    expect_post(pattern, cases + "/planned/build", 409, "{}");
    const HttpReply reply = post(
        made + "/build",
        R"({"upsample": 2, "calibration": {"intercept_mg_cc": 5, "slope_mg_cc_per_hu": 0.7, "scanner": "A"}})");
    expect_as_described("POST", pattern, 202, reply);
    const json job = ended(reply);
    ASSERT_EQ(job.at("state"), "done") << job;
    expect_get(one_case, made, 200);
    expect_get(one_case + "/mesh", made + "/mesh", 200);
    expect_get(one_case + "/surroundings", made + "/surroundings", 200);
    for (const char* surface : {"/mesh", "/surroundings"})
      EXPECT_NE(get(made + surface).body.find("\ncomment millimetres, LPS, right shoulder\n"),
                std::string::npos);
  }

  void deleting(const std::string& made) {
    create();
    expect_request("DELETE", one_case, cases + "/planned", 409);
    expect_request("DELETE", one_case, made, 403, "", foreign);
    expect_request("DELETE", one_case, made, 204);
    expect_request("DELETE", one_case, made, 404);
  }

  ct::Phantom phantom;
  std::string file;
  const size_t most = options.listen.limits.body_bytes;
  const std::string uploads = "/api/v1/uploads", piece = "/api/v1/uploads/{id}", jobs = "/api/v1/jobs/{id}",
                    cases = "/api/v1/cases", one_case = "/api/v1/cases/{id}";
  const std::map<std::string, std::string> octets = {{"Content-Type", "application/octet-stream"}};
};

TEST_F(CaseContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  start();
  uploading();
  const std::string made = making();
  segmenting(made);
  planning(made);
  building(made);
  wrong_landmarks(made);
  deleting(made);
  // While the first of two requests with one key is under way: IdempotencyTest.
  // While other files are made: as of a session's trace, DownloadContractTest.
  expect_all_given({"uploads", "jobs", "cases"},
                   {{"POST " + uploads, 409}, {"GET " + one_case + "/volume", 503}});
}

TEST_F(CaseContractTest, TheOtherShoulderIsMadeOfTheSameCt) {
  start();
  const json first = ended(post(cases, json{{"upload_id", whole_upload()}, {"side", "right"}}.dump()));
  ASSERT_EQ(first.at("state"), "done") << first;
  const json second = ended(post(cases, json{{"copy_of", first.at("case_id")}, {"side", "left"}}.dump()));
  ASSERT_EQ(second.at("state"), "done") << second;
  const std::string of = "/volume/slices/v/5";
  const std::string a = get(cases + "/" + first.at("case_id").get<std::string>() + of).body;
  const std::string b = get(cases + "/" + second.at("case_id").get<std::string>() + of).body;
  EXPECT_FALSE(a.empty());
  EXPECT_EQ(a, b);
  const json copy = json::parse(get(cases + "/" + second.at("case_id").get<std::string>()).body);
  EXPECT_EQ(copy.at("side"), "left");
  EXPECT_EQ(copy.at("stage"), "ct");
}

TEST_F(CaseContractTest, AnUnreadableFileFailsItsJobWithTheReasonAndLeavesNothing) {
  start();
  file = "this is no volume";
  const json job = ended(post(cases, json{{"upload_id", whole_upload()}, {"side", "right"}}.dump()));
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_EQ(job.at("problem").at("status"), 422);
  const std::string detail = job.at("problem").at("detail");
  EXPECT_EQ(detail.find("shoulder.nrrd"), 0u) << detail;
  EXPECT_EQ(get(cases + "/" + job.at("case_id").get<std::string>()).status, 404);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "uploads"));
}

TEST_F(CaseContractTest, MalformedFilesFailTheirJobsInOneLineAndTheServerLives) {
  start();
  const std::string whole = file;
  const auto header = [](const std::string& sizes, const std::string& voxel) {
    return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: " + sizes +
           "\nspace directions: (" + voxel + ",0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n" +
           "encoding: raw\nendian: little\n\n" + std::string(250, '\0');
  };
  for (const std::string& bad :
       {whole.substr(0, whole.size() / 2), header("512 512 1000000000", "1"), header("-5 5 5", "1"),
        header("5 5 5", "nan"), header("5 5 5", "0"), header("50 50 50", "1"), header("5 5 1", "1"),
        std::string(5000, '\0'), std::string("NRRD0004\n")}) {
    file = bad;
    const json job = ended(post(cases, json{{"upload_id", whole_upload()}, {"side", "right"}}.dump()));
    EXPECT_EQ(job.at("state"), "failed") << bad.substr(0, 120);
    const std::string detail = job.at("problem").at("detail");
    EXPECT_EQ(detail.find("shoulder.nrrd"), 0u) << detail;
    EXPECT_EQ(detail.find('\n'), std::string::npos) << detail;
  }
  EXPECT_EQ(get("/healthz").status, 200);
  file = whole;
  EXPECT_EQ(ended(post(cases, json{{"upload_id", whole_upload()}, {"side", "right"}}.dump())).at("state"),
            "done");
}

TEST_F(CaseContractTest, AReamerIsNamedAndNeverAPath) {
  start();
  const std::string body = R"({"entry_mm": [4, 4, 6], "axis_direction": [0, 0, -1], "depth_mm": 1,
                               "reamer": "/etc/passwd"})";
  const HttpReply reply = http_request(server->port(), "PUT", cases + "/planned/plan", body);
  EXPECT_EQ(reply.status, 422) << reply.body;
  EXPECT_EQ(reply.body.find("root"), std::string::npos);
}

TEST_F(CaseContractTest, NoNameOfAFileBecomesTheCases) {
  start();
  const std::string upload = whole_upload("DOE_Jane_19560312.nrrd");
  const json job = ended(post(cases, json{{"upload_id", upload}, {"side", "right"}}.dump()));
  EXPECT_EQ(job.at("state"), "done") << job;
  for (const std::string& text : {job.dump(), get(cases).body, get("/api/v1/jobs").body,
                                  get(cases + "/" + job.at("case_id").get<std::string>()).body})
    for (const char* part : {"DOE", "doe", "Jane", "jane", "1956"})
      EXPECT_EQ(text.find(part), std::string::npos) << text;
}

}  // namespace
}  // namespace ream::test
