#include "report/report.hpp"

#include <gtest/gtest.h>

#include "unit/report/example_material.hpp"

namespace ream::report {
namespace {

TEST(Pdf, IsAWholeFileAndTheSameEveryTime) {
  const Report report = make_report(test::full_material());
  const std::string pdf = pdf_of(report);
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_NE(pdf.rfind("%%EOF"), std::string::npos);
  EXPECT_EQ(pdf, pdf_of(report));
}

TEST(Pdf, OfASessionThatSaysNothingIsWholeToo) {
  EXPECT_TRUE(pdf_of(make_report(test::empty_material())).starts_with("%PDF-"));
}

TEST(Pdf, LongWordsAndManyRemarksFindTheirPages) {
  Material m = test::full_material();
  for (int i = 0; i < 300; ++i)
    m.remarks.push_back({0.01 * i, std::string(400, 'x') + " and more", "somebody"});
  m.session.case_name = std::string(300, 'y');
  EXPECT_TRUE(pdf_of(make_report(m)).starts_with("%PDF-"));
}

}  // namespace
}  // namespace ream::report
