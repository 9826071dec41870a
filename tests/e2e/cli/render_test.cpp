#include "core/file.hpp"
#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

class RenderedPicture : public CommandLine {
 protected:
  std::string picture(const std::string& file) { return read_text_file(folder() / file); }
};

TEST_F(RenderedPicture, IsOfACaseOrOfWhatASessionLeft) {
  simulate_short_demo();
  succeed({"render", "demo", "--out", "case.png"});
  const std::string whole = picture("case.png");
  EXPECT_EQ(whole.substr(1, 3), "PNG");
  EXPECT_EQ(whole.substr(16, 8), std::string("\0\0\5\0\0\0\3\300", 8)) << "1280 x 960";

  succeed({"render", "run", "--out", "session.png"});
  EXPECT_NE(picture("session.png"), whole);
  succeed({"render", "run/recording.ream", "--out", "again.png"});
  EXPECT_EQ(picture("again.png"), picture("session.png"));
}

TEST_F(RenderedPicture, IsRefusedInOneLine) {
  refuse(2, "case.jpg", {"render", "demo", "--out", "case.jpg"});
  refuse(1, "nothing", {"render", "nothing", "--out", "case.png"});
}

}  // namespace
}  // namespace ream::test
