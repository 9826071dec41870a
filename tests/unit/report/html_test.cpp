#include "report/report.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <stack>

#include "unit/report/example_material.hpp"

namespace ream::report {
namespace {

/// Empty when every element is closed in order; else the first that is not. Pictures make tags of megabytes,
/// in which std::regex goes down its stack for each byte.
std::string unbalanced(const std::string& html) {
  static const std::set<std::string> empty_elements = {"meta", "img", "!doctype"};
  std::stack<std::string> open;
  for (size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const bool closes = html[at + 1] == '/';
    const size_t begin = at + (closes ? 2 : 1), end = html.find('>', begin);
    if (end == std::string::npos) return "an open tag";
    const size_t name_end = html.find_first_of(" \t\n/>", begin);
    const std::string name = html.substr(begin, name_end - begin);
    if (empty_elements.contains(name) || html[end - 1] == '/') continue;
    if (!closes) {
      open.push(name);
    } else {
      if (open.empty() || open.top() != name) return name;
      open.pop();
    }
  }
  return open.empty() ? "" : open.top();
}

Report with_picture() {
  Material m = test::full_material();
  Picture picture;
  picture.title = "Map";
  picture.image = {2, 1, {255, 0, 0, 255, 0, 0, 255, 255}};
  picture.labels = {{0.25, 0.75, "inferior"}};
  picture.is_map = true;
  m.pictures.push_back(picture);
  return make_report(m);
}

TEST(Html, HoldsEverythingInItselfAndRunsNothing) {
  const std::string html = html_of(with_picture());
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  for (const char* link : {"src=\"", "href=\""})
    for (size_t at = html.find(link); at != std::string::npos; at = html.find(link, at + 1))
      EXPECT_EQ(html.compare(html.find('"', at) + 1, 5, "data:"), 0) << html.substr(at, 40);
  EXPECT_FALSE(std::regex_search(html, std::regex(" on[a-z]+=")));
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_NE(html.find("Content-Security-Policy"), std::string::npos);
  EXPECT_NE(html.find("src=\"data:image/png;base64,iVBOR"), std::string::npos);
  EXPECT_NE(html.find("left:25.0%;top:75.0%\">inferior</span>"), std::string::npos);
}

TEST(Html, WordsOfPeopleAreNoMarkup) {
  const std::string html = html_of(make_report(test::full_material()));
  EXPECT_NE(html.find("J\u00fcrgen&#39;s phantom &lt;1&gt;"), std::string::npos);
  EXPECT_NE(html.find("Watch the &lt;angle&gt; &amp; the depth"), std::string::npos);
  EXPECT_EQ(html.find("<angle>"), std::string::npos);
}

TEST(Html, ResultsAreWordsNotOnlyColours) {
  const std::string html = html_of(make_report(test::full_material()));
  EXPECT_NE(html.find("! warn</td>"), std::string::npos);
  EXPECT_NE(html.find("\u2713 pass</td>"), std::string::npos);
  EXPECT_NE(html.find("aria-label=\"Thrust over"), std::string::npos);
}

TEST(Html, OfASessionThatSaysNothingIsWholeToo) {
  const std::string html = html_of(make_report(test::empty_material()));
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_NE(html.find("The case is not there."), std::string::npos);
  EXPECT_NE(html.find("the reamer never touched bone"), std::string::npos);
  for (const char* word : {">nan", "NaN", ">inf ", "null"})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace ream::report
