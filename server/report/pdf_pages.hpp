#pragma once
#include <string>

#include "report/pdf_sheet.hpp"
#include "report/report.hpp"

namespace ream::report {

/// Puts the parts of a report below each other and begins a new page where one is full.
class PdfPages {
 public:
  static constexpr double margin = 42.0, foot = 46.0;
  static constexpr double text_width = PdfSheet::page_width - 2.0 * margin;

  /// `of_pages`: how many there will be, for their numbers; 0: not known yet.
  PdfPages(PdfSheet& sheet, const Report& report, int of_pages);

  /// Lays everything out; returns the number of pages.
  int lay_out();

 private:
  void head();
  double result_box(double left, double top, double width);
  void facts(const std::vector<Fact>& list, int columns, double name_width);
  void pictures();
  void picture(const Picture& picture, double left, double width);
  void legend();
  void metrics();
  void table(const MetricTable& table);
  void table_heads();
  void table_line(const MetricLine& line);
  void course();
  void chart(const Chart& chart, double left, double width, double height);
  void remarks();
  void learning();
  void notes();

  void heading(const std::string& words, double with_at_least);
  void small_heading(const std::string& words, double with_at_least);
  void words(const std::string& words, const Type& type);
  /// Makes sure that so much fits below, on a new page if need be.
  void need(double height);
  void foot_line();

  PdfSheet& sheet_;
  const Report& report_;
  int of_pages_, page_ = 1;
  double y_ = margin;
};

}  // namespace ream::report
