#include "report/pdf.hpp"

#include "report/pdf_pages.hpp"

namespace ream::report {

std::string pdf_of(const Report& report) {
  PdfSheet trial;
  const int pages = PdfPages(trial, report, 0).lay_out();
  PdfSheet sheet(report.title + " \u2013 " + report.subtitle, report.created_utc);
  PdfPages(sheet, report, pages).lay_out();
  return sheet.bytes();
}

}  // namespace ream::report
