// What a review file holds; that it opens in browsers is tests/e2e/review_file.spec.ts.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "session/export/cause_export.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_reaming.hpp"
#include "support/twin/killed_recording.hpp"
#include "support/twin/review_parts.hpp"

namespace ream::test {
namespace {

enum Code : char { facts = 1, hello = 2, telemetry = 3, tool = 4, map = 5 };

class ReviewFile : public testing::Test {
 protected:
  ReviewFile() {
    std::filesystem::create_directory(page_);
    write_file_atomically(page_ / "index.html", std::string_view("<p>page</p>"));
    write_file_atomically(page_ / "review_file.html",
                          std::string_view("<i>before</i><!--ream:session--><i>after</i>"));
  }

  std::string exported(const std::filesystem::path& recording) {
    session::ExportRequest request;
    request.recording = recording;
    request.data = reaming_.data();
    request.page = page_;
    request.labels = labels_;
    const auto out = reaming_.folder().path() / "review.html";
    session::write_review_file(request, out, no_progress);
    return read_text_file(out);
  }

  static std::vector<std::string> of(const std::vector<std::string>& parts, Code code) {
    std::vector<std::string> found;
    for (const std::string& part : parts)
      if (part.at(0) == code) found.push_back(part.substr(1));
    return found;
  }

  RecordedReaming reaming_;
  const std::filesystem::path page_ = reaming_.folder().path() / "page";
  session::SessionRequest labels_;
};

TEST_F(ReviewFile, HoldsTheWholeCourseInThePlaceThatThePageHasForIt) {
  const nlohmann::json script = RecordedReaming::push("omega.6", 1.5);
  const auto recording = reaming_.record(script);
  reaming_.go_on(recording, script, "sphere 10,6");
  const std::string page = exported(recording);
  EXPECT_EQ(page.find("<i>before</i><script"), 0u);
  EXPECT_TRUE(page.ends_with("</script>\n<i>after</i>"));
  const auto parts = parts_in(held_by(page, "ream-review"), "reamview");
  ASSERT_EQ(of(parts, facts).size(), 1u);
  const auto said = nlohmann::json::parse(of(parts, facts)[0]);
  const uint32_t ticks = record::Recording(recording).tick_count();
  EXPECT_EQ(said.at("ticks"), ticks);
  EXPECT_EQ(said.at("warning"), "");
  EXPECT_TRUE(said.at("score").contains("metrics"));
  EXPECT_EQ(said.at("trace").get<std::string>().find("t_s,thrust_n,spindle_on\n0,"), 0u);
  EXPECT_EQ(of(parts, hello).size(), 1u);
  EXPECT_EQ(of(parts, tool).size(), 1u) << "the second reamer";
  EXPECT_EQ(of(parts, telemetry).size(), (ticks + 19) / 20 + 1)
      << "each 20 ms, the first and the last moment";
  EXPECT_EQ(parts_in(held_by(page, "ream-causes"), "reamtwin").front().at(0), 1);
}

TEST_F(ReviewFile, KnowsWhoTakesPartInAStudyByTheCodeAlone) {
  const auto recording = reaming_.record(RecordedReaming::push("ideal", 0.6));
  labels_.trainee = "Tom Zqtrainee";
  labels_.title = "Second try";
  const auto known =
      nlohmann::json::parse(of(parts_in(held_by(exported(recording), "ream-review"), "reamview"), facts)[0]);
  EXPECT_EQ(known.at("session").at("trainee"), "Tom Zqtrainee");
  EXPECT_EQ(known.at("session").at("title"), "Second try");
  labels_.participant = "P-07";
  const std::string page = exported(recording);
  const std::string review = held_by(page, "ream-review");
  const auto said = nlohmann::json::parse(of(parts_in(review, "reamview"), facts)[0]);
  EXPECT_EQ(said.at("session").at("participant"), "P-07");
  for (const std::string& all : {page, review, held_by(page, "ream-causes")})
    EXPECT_EQ(all.find("Zqtrainee"), std::string::npos);
}

TEST_F(ReviewFile, OfAKilledSessionEndsWithItsBoneAndSaysSo) {
  const auto recording = reaming_.record(RecordedReaming::push("ideal"));
  const auto cut = killed_recording(recording, reaming_.folder().path() / "killed.ream", 1500);
  const uint32_t ticks = record::Recording(cut).last_checkpoint()->tick + 1;
  const auto parts = parts_in(held_by(exported(cut), "ream-review"), "reamview");
  const auto said = nlohmann::json::parse(of(parts, facts)[0]);
  EXPECT_EQ(said.at("ticks"), ticks);
  EXPECT_NE(said.at("warning").get<std::string>().find("no bone was saved"), std::string::npos);
  EXPECT_EQ(of(parts, telemetry).size(), (ticks + 19) / 20 + 1);
  EXPECT_TRUE(of(parts, map).empty());
}

TEST_F(ReviewFile, WithoutAPageIsRefused) {
  const auto recording = reaming_.record(RecordedReaming::push("ideal", 0.3));
  write_file_atomically(page_ / "review_file.html", std::string_view("<p>of another version</p>"));
  expect_error(ErrorKind::invalid_input, "has no place for a session", [&] { exported(recording); });
  std::filesystem::remove(page_ / "review_file.html");
  expect_error(ErrorKind::not_found, "scripts/build", [&] { exported(recording); });
}

}  // namespace
}  // namespace ream::test
