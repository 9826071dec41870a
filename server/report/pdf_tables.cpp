#include <algorithm>
#include <array>

#include "report/pdf_pages.hpp"

namespace ream::report {
namespace {

constexpr Stroke hair{0.4, grey(0.8), false};
constexpr double text_size = 7.8;

struct Column {
  const char* head;
  double width;
};

constexpr std::array<Column, 7> columns = {{{"Metric", 126.0},
                                            {"Planned", 92.0},
                                            {"Achieved", 92.0},
                                            {"Passes", 62.0},
                                            {"Warns", 44.0},
                                            {"Result", 54.0},
                                            {"Points \u00d7 weight", 41.0}}};

std::string result_in_words(const MetricLine& line) {
  if (line.mark == Mark::none) return "";
  const bool decides = line.critical && line.mark == Mark::fail;
  return mark_sign(line.mark) + " " + mark_word(line.mark) + (decides ? ", decides" : "");
}

}  // namespace

void PdfPages::metrics() {
  heading("Metrics", 80.0);
  for (const MetricTable& each : report_.tables) table(each);
  if (report_.missing.empty()) return;
  small_heading("What cannot be said", 20.0);
  facts(report_.missing, 1, 250.0);
}

void PdfPages::table(const MetricTable& table) {
  small_heading(table.title, 50.0);
  table_heads();
  for (const MetricLine& line : table.lines) table_line(line);
  y_ += 4.0;
}

void PdfPages::table_heads() {
  double x = margin, height = 0.0;
  for (const Column& column : columns) {
    height = std::max(height, sheet_.paragraph(x, y_, column.width - 4.0, column.head,
                                               {7.2, grey(0.35), true, Anchor::left}));
    x += column.width;
  }
  y_ += height + 2.0;
  sheet_.straight({margin, y_}, {PdfSheet::page_width - margin, y_}, {0.9, grey(0.2), false});
  y_ += 2.5;
}

void PdfPages::table_line(const MetricLine& line) {
  const std::array<std::string, 7> cells = {line.name, line.planned,          line.value, line.pass,
                                            line.warn, result_in_words(line), line.points};
  const bool emphasized = line.mark == Mark::fail || line.mark == Mark::warn;
  const auto type = [&](size_t column) {
    return Type{text_size, line.mark == Mark::missing ? grey(0.4) : grey(0.12), column == 5 && emphasized,
                Anchor::left};
  };
  const double note_width = 12.0;
  double height = 0.0;
  for (size_t i = 0; i < cells.size(); ++i)
    height =
        std::max(height, sheet_.height_of(columns[i].width - (i == 0 ? note_width : 4.0), cells[i], type(i)));
  if (y_ + height + 4.0 > PdfSheet::page_height - foot) {
    need(height + 4.0);
    table_heads();
  }
  double x = margin;
  for (size_t i = 0; i < cells.size(); ++i) {
    sheet_.paragraph(x, y_, columns[i].width - (i == 0 ? note_width : 4.0), cells[i], type(i));
    x += columns[i].width;
  }
  sheet_.paragraph(margin + columns[0].width - note_width, y_, note_width - 3.0, std::to_string(line.source),
                   {5.6, grey(0.45), false, Anchor::left});
  y_ += height + 1.0;
  sheet_.straight({margin, y_}, {PdfSheet::page_width - margin, y_}, hair);
  y_ += 1.5;
}

}  // namespace ream::report
