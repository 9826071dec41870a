#include "report/report.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <stack>

#include "unit/report/example_material.hpp"

namespace ream::report {
namespace {

/// Empty when every element is closed in order; else the first that is not.
std::string unbalanced(const std::string& html) {
  static const std::regex tag("<(/?)([a-zA-Z0-9!]+)([^>]*)>");
  static const std::set<std::string> empty_elements = {"meta", "img", "!doctype"};
  std::stack<std::string> open;
  for (std::sregex_iterator it(html.begin(), html.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2], rest = (*it)[3];
    if (empty_elements.contains(name) || rest.ends_with("/")) continue;
    if ((*it)[1] == "/") {
      if (open.empty() || open.top() != name) return name;
      open.pop();
    } else {
      open.push(name);
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
  EXPECT_FALSE(std::regex_search(html, std::regex("(src|href)=\"(?!data:)")));
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
