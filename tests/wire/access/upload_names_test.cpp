// Names of uploaded files may be patients': who sees them.
#include <thread>

#include "wire/contract/access_fixture.hpp"

namespace ream::test {
namespace {

class UploadNamesTest : public AccessTest {};

TEST_F(UploadNamesTest, OnlyTheSenderAndOperatorsSeeThem) {
  options.data_folder = folder.path();
  start();
  const Sent olga = token_of(add_user("olga", access::Role::operator_)),
             ina = token_of(add_user("ina", access::Role::instructor)),
             ian = token_of(add_user("ian", access::Role::instructor));
  const std::string uploads = "/api/v1/uploads", name = "DOE_Jane_19560312.zip";
  const HttpReply begun = request("POST", uploads, ina, json{{"name", name}, {"bytes", 4}}.dump());
  ASSERT_EQ(begun.status, 201) << begun.body;
  const std::string path = begun.headers.at("location");
  const auto is_named = [&](const HttpReply& reply) { return reply.body.find("DOE") != std::string::npos; };
  const auto put = [&](const Sent& as, const std::string& offset, const std::string& piece) {
    return request("PUT", path + "?offset=" + offset, with(as, "Content-Type", "application/octet-stream"),
                   piece);
  };
  EXPECT_TRUE(is_named(begun));
  for (const auto& [as, sees] : {std::pair{olga, true}, {ina, true}, {ian, false}}) {
    const HttpReply list = request("GET", uploads, as), upload = request("GET", path, as);
    expect_as_described("GET", "/api/v1/uploads", 200, list);
    expect_as_described("GET", "/api/v1/uploads/{id}", 200, upload);
    EXPECT_EQ(is_named(list), sees) << list.body;
    EXPECT_EQ(is_named(upload), sees) << upload.body;
  }
  EXPECT_EQ(json::parse(request("GET", path, ian).body).at("name"), "*.zip");
  EXPECT_FALSE(is_named(put(ian, "0", "ab")));
  for (const HttpReply& refused :
       {put(ian, "7", "ab"), put(ian, "2", "abcdef"),
        request("POST", "/api/v1/cases", ian, json{{"upload", json::parse(begun.body).at("id")}}.dump())}) {
    EXPECT_GE(refused.status, 400) << refused.body;
    EXPECT_FALSE(is_named(refused)) << refused.body;
  }
}

TEST_F(UploadNamesTest, WhyAnImportFailedIsForTheSenderAndOperatorsToo) {
  options.data_folder = folder.path();
  start();
  const Sent olga = token_of(add_user("olga", access::Role::operator_)),
             ina = token_of(add_user("ina", access::Role::instructor)),
             ian = token_of(add_user("ian", access::Role::instructor));
  const std::string damaged = "NRRD0004\nDOE Jane\n";
  const HttpReply begun = request("POST", "/api/v1/uploads", ina,
                                  json{{"name", "DOE_Jane.nrrd"}, {"bytes", damaged.size()}}.dump());
  ASSERT_EQ(begun.status, 201) << begun.body;
  ASSERT_EQ(request("PUT", begun.headers.at("location") + "?offset=0",
                    with(ina, "Content-Type", "application/octet-stream"), damaged)
                .status,
            200);
  const HttpReply ordered =
      request("POST", "/api/v1/cases", ina,
              json{{"upload_id", json::parse(begun.body).at("id")}, {"side", "right"}}.dump());
  ASSERT_EQ(ordered.status, 202) << ordered.body;
  const std::string job = ordered.headers.at("location");
  const auto state = [&] { return json::parse(request("GET", job, olga).body).at("state"); };
  while (state() == "waiting" || state() == "running")
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_EQ(state(), "failed");
  for (const auto& [as, sees] : {std::pair{olga, true}, {ina, true}, {ian, false}}) {
    const HttpReply alone = request("GET", job, as), list = request("GET", "/api/v1/jobs", as);
    expect_as_described("GET", "/api/v1/jobs/{id}", 200, alone);
    for (const HttpReply& reply : {alone, list})
      EXPECT_EQ(reply.body.find("DOE") != std::string::npos, sees) << reply.body;
    EXPECT_FALSE(json::parse(alone.body).at("problem").at("detail").get<std::string>().empty());
  }
}

}  // namespace
}  // namespace ream::test
