#include "report/report.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "report/chart.hpp"
#include "report/deviation_scale.hpp"
#include "report/number_text.hpp"
#include "report/pdf_sheet.hpp"

namespace ream::report {
namespace {

constexpr Type body{8.5, grey(0.12), false, Anchor::left}, soft{8.0, grey(0.38), false, Anchor::left};
constexpr Type small{7.2, grey(0.3), false, Anchor::left};
constexpr Stroke hair{0.4, grey(0.8), false};
constexpr double picture_gap = 14.0, pdf_chart_height = 128.0;

constexpr double text_size = 7.8;

struct Column {
  const char* head;
  double width;
};

constexpr std::array<Column, 7> metric_columns = {{{"Metric", 126.0},
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
  void advice();
  void pictures();
  void picture(const Picture& picture, double left, double width);
  /// With its words.
  static double height_of(const Picture& picture, double width) {
    return width * picture.image.height / picture.image.width + 38.0;
  }
  void legend();
  void metrics();
  void table(const MetricTable& table);
  void table_heads();
  void table_line(const MetricLine& line);
  void load();
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

PdfPages::PdfPages(PdfSheet& sheet, const Report& report, int of_pages)
    : sheet_(sheet), report_(report), of_pages_(of_pages) {}

int PdfPages::lay_out() {
  head();
  advice();
  pictures();
  metrics();
  load();
  course();
  learning();
  notes();
  foot_line();
  return page_;
}

void PdfPages::foot_line() {
  const double y = PdfSheet::page_height - foot + 14.0;
  sheet_.straight({margin, y}, {PdfSheet::page_width - margin, y}, hair);
  std::string who = report_.title + " \u2013 " + report_.subtitle;
  for (const Fact& fact : report_.facts)
    if (fact.name == "Trainee" || fact.name == "Participant" || fact.name == "Date")
      who += " \u2013 " + fact.value;
  sheet_.paragraph(margin, y + 5.0, text_width - 90.0, who, {7.0, grey(0.4), false, Anchor::left});
  sheet_.paragraph(PdfSheet::page_width - margin - 90.0, y + 5.0, 90.0,
                   "Page " + std::to_string(page_) + " of " + std::to_string(of_pages_),
                   {7.0, grey(0.4), false, Anchor::right});
}

void PdfPages::need(double height) {
  if (y_ + height <= PdfSheet::page_height - foot || y_ <= margin) return;
  foot_line();
  sheet_.next_page();
  ++page_;
  y_ = margin;
}

void PdfPages::heading(const std::string& words, double with_at_least) {
  need(30.0 + with_at_least);
  if (y_ > margin) {
    y_ += 12.0;
    sheet_.straight({margin, y_}, {PdfSheet::page_width - margin, y_}, {0.6, grey(0.7), false});
    y_ += 7.0;
  }
  y_ += sheet_.paragraph(margin, y_, text_width, words, {12.5, grey(0.1), true, Anchor::left}) + 5.0;
}

void PdfPages::small_heading(const std::string& words, double with_at_least) {
  need(18.0 + with_at_least);
  y_ += 6.0;
  y_ += sheet_.paragraph(margin, y_, text_width, words, {9.5, grey(0.1), true, Anchor::left}) + 3.0;
}

void PdfPages::words(const std::string& words, const Type& type) {
  if (words.empty()) return;
  need(sheet_.height_of(text_width, words, type));
  y_ += sheet_.paragraph(margin, y_, text_width, words, type) + 3.0;
}

double PdfPages::result_box(double left, double top, double width) {
  const double inner = width - 20.0;
  double y = top + 9.0;
  y += sheet_.paragraph(left + 10.0, y, inner, report_.verdict, {16.0, grey(0.05), true, Anchor::left});
  if (!report_.points.empty())
    y += sheet_.paragraph(left + 10.0, y + 1.0, inner, report_.points,
                          {11.0, grey(0.1), false, Anchor::left}) +
         1.0;
  y += sheet_.paragraph(left + 10.0, y + 3.0, inner, report_.judged_by,
                        {7.5, grey(0.35), false, Anchor::left}) +
       3.0;
  const bool decided = report_.outcome == score::Outcome::pass || report_.outcome == score::Outcome::fail;
  sheet_.box(left, top, width, y + 8.0 - top, {decided ? 1.4 : 0.9, grey(0.1), !decided});
  return y + 8.0 - top;
}

void PdfPages::head() {
  constexpr double box_width = 190.0;
  const double top = y_, left_width = text_width - box_width - 20.0;
  const double box = result_box(PdfSheet::page_width - margin - box_width, top, box_width);
  y_ += sheet_.paragraph(margin, y_, left_width, report_.title, {22.0, grey(0.05), true, Anchor::left}) + 2.0;
  y_ += sheet_.paragraph(margin, y_, left_width, report_.subtitle, {11.0, grey(0.35), false, Anchor::left}) +
        6.0;
  for (const std::string& reason : report_.reasons) {
    sheet_.paragraph(margin, y_, 10.0, "\u2022", body);
    y_ += sheet_.paragraph(margin + 10.0, y_, left_width - 10.0, reason, body) + 2.0;
  }
  y_ = std::max(y_, top + box) + 12.0;
  facts(report_.facts, 2, 68.0);
}

void PdfPages::advice() {
  if (report_.advice.empty()) return;
  small_heading("Next time", 14.0);
  int number = 0;
  for (const Advice& each : report_.advice) {
    need(sheet_.height_of(text_width - 14.0, each.words, body));
    sheet_.paragraph(margin, y_, 12.0, std::to_string(++number) + ".", body);
    y_ += sheet_.paragraph(margin + 14.0, y_, text_width - 14.0, each.words, body) + 2.0;
  }
}

void PdfPages::facts(const std::vector<Fact>& list, int columns, double name_width) {
  const double gap = 16.0, width = (text_width - (columns - 1) * gap) / columns;
  for (size_t first = 0; first < list.size(); first += static_cast<size_t>(columns)) {
    const size_t last = std::min(list.size(), first + static_cast<size_t>(columns));
    double height = 0.0;
    for (size_t i = first; i < last; ++i)
      height = std::max({height, sheet_.height_of(name_width - 6.0, list[i].name, soft),
                         sheet_.height_of(width - name_width, list[i].value, body)});
    need(height + 5.0);
    for (size_t i = first; i < last; ++i) {
      const double left = margin + static_cast<double>(i - first) * (width + gap);
      sheet_.paragraph(left, y_, name_width - 6.0, list[i].name, soft);
      sheet_.paragraph(left + name_width, y_, width - name_width, list[i].value, body);
      sheet_.straight({left, y_ + height + 2.0}, {left + width, y_ + height + 2.0}, hair);
    }
    y_ += height + 5.0;
  }
}

void PdfPages::picture(const Picture& picture, double left, double width) {
  const double height = width * picture.image.height / picture.image.width;
  sheet_.image(picture.image, left, y_, width, height);
  sheet_.box(left, y_, width, height, hair);
  for (const PictureLabel& label : picture.labels) {
    const double x = left + label.x * width, y = y_ + label.y * height;
    const double half = 0.5 * 3.6 * static_cast<double>(label.words.size()) + 2.0;
    sheet_.fill_box({x - half, y - 5.0}, {x + half, y + 4.5}, grey(0.98));
    sheet_.text({x, y + 2.2}, label.words, {7.0, grey(0.2), Anchor::middle, false, false});
  }
  const double title =
      sheet_.paragraph(left, y_ + height + 4.0, width, picture.title, {8.5, grey(0.1), true, Anchor::left});
  sheet_.paragraph(left, y_ + height + 4.0 + title, width, picture.caption, small);
}

void PdfPages::pictures() {
  const double width = 0.5 * (text_width - picture_gap);
  if (report_.pictures.empty()) {
    heading("Pictures", 20.0);
    return words(report_.why_no_pictures, body);
  }
  for (size_t i = 0; i < report_.pictures.size(); i += 2) {
    const Picture& left = report_.pictures[i];
    const double height = height_of(left, width);
    if (i == 0)
      heading("Pictures", height);
    else
      need(height);
    picture(left, margin, width);
    if (i + 1 < report_.pictures.size())
      picture(report_.pictures[i + 1], margin + width + picture_gap, width);
    y_ += height;
    const bool last_map =
        left.is_map && (i + 2 >= report_.pictures.size() || !report_.pictures[i + 2].is_map);
    if (last_map) legend();
  }
}

void PdfPages::legend() {
  const auto& classes = deviation_classes();
  const double width = text_width / static_cast<double>(classes.size());
  need(30.0);
  for (size_t i = 0; i < classes.size(); ++i) {
    const double left = margin + static_cast<double>(i) * width;
    const auto [red, green, blue, hatched] = classes[i].colour;
    sheet_.fill_box({left, y_}, {left + width - 6.0, y_ + 9.0}, {red / 255.0, green / 255.0, blue / 255.0});
    if (hatched) sheet_.hatch(left, y_, width - 6.0, 9.0);
    sheet_.box(left, y_, width - 6.0, 9.0, {0.4, grey(0.4), false});
    sheet_.paragraph(left, y_ + 11.0, width - 6.0, classes[i].words, {6.4, grey(0.3), false, Anchor::left});
  }
  y_ += 32.0;
}

void PdfPages::chart(const Chart& chart, double left, double width, double height) {
  const double title = sheet_.paragraph(left, y_, width, chart.title, {9.0, grey(0.1), true, Anchor::left});
  draw_chart(chart, sheet_, {left, y_ + title}, width, height - title);
}

void PdfPages::course() {
  heading("Course", report_.charts.empty() ? 14.0 : pdf_chart_height);
  words(report_.why_no_charts, body);
  for (const Chart& each : report_.charts) {
    need(pdf_chart_height);
    chart(each, margin, text_width, pdf_chart_height);
    y_ += pdf_chart_height + 4.0;
  }
  remarks();
}

void PdfPages::load() {
  if (!report_.load) return;
  const LoadSection& section = *report_.load;
  const double first = 210.0;
  const double rest =
      (text_width - first) / static_cast<double>(std::max<size_t>(1, section.heads.size() - 1));
  const auto row = [&](const std::vector<std::string>& cells, const Type& type) {
    double height = 0.0;
    for (size_t i = 0; i < cells.size(); ++i)
      height = std::max(height, sheet_.height_of((i == 0 ? first : rest) - 6.0, cells[i], type));
    need(height + 4.0);
    for (size_t i = 0; i < cells.size(); ++i)
      sheet_.paragraph(margin + (i == 0 ? 0.0 : first + rest * static_cast<double>(i - 1)), y_,
                       (i == 0 ? first : rest) - 6.0, cells[i], type);
    y_ += height + 1.5;
    sheet_.straight({margin, y_}, {PdfSheet::page_width - margin, y_}, hair);
    y_ += 2.0;
  };
  heading("Component under load", 120.0);
  words(section.words, body);
  y_ += 4.0;
  row(section.heads, {7.2, grey(0.35), true, Anchor::left});
  for (const std::vector<std::string>& cells : section.rows) row(cells, body);
  y_ += 4.0;
  if (section.map) {
    const double width = 0.62 * text_width;
    need(height_of(*section.map, width));
    picture(*section.map, margin, width);
    y_ += height_of(*section.map, width);
  }
  words(section.assumptions, soft);
}

void PdfPages::remarks() {
  if (report_.remarks.empty()) return;
  small_heading("Comments", 14.0);
  for (size_t i = 0; i < report_.remarks.size(); ++i) {
    const Remark& remark = report_.remarks[i];
    const std::string said = remark.words + (remark.author.empty() ? "" : " (" + remark.author + ")");
    const double height = sheet_.height_of(text_width - 84.0, said, body);
    need(height + 3.0);
    sheet_.paragraph(margin, y_, 20.0, std::to_string(i + 1), {8.5, grey(0.12), true, Anchor::left});
    sheet_.paragraph(margin + 20.0, y_, 64.0, duration_text(remark.at_s), soft);
    y_ += sheet_.paragraph(margin + 84.0, y_, text_width - 84.0, said, body) + 3.0;
  }
}

void PdfPages::learning() {
  if (report_.learning_words.empty() && report_.benchmark.empty()) return;
  heading("Learning", 40.0);
  words(report_.learning_words, body);
  if (!report_.learning_charts.empty()) {
    need(pdf_chart_height);
    const double width = 0.5 * (text_width - picture_gap);
    for (size_t i = 0; i < report_.learning_charts.size(); ++i)
      chart(report_.learning_charts[i], margin + static_cast<double>(i) * (width + picture_gap), width,
            pdf_chart_height);
    y_ += pdf_chart_height + 4.0;
  }
  if (report_.benchmark.empty()) return;
  small_heading(report_.benchmark_words, 20.0);
  facts(report_.benchmark, 2, 110.0);
}

void PdfPages::notes() {
  heading("What the metrics mean", 30.0);
  facts(report_.meanings, 1, 130.0);
  heading("Sources of definitions and limits", 20.0);
  for (size_t i = 0; i < report_.sources.size(); ++i) {
    const double height = sheet_.height_of(text_width - 18.0, report_.sources[i], small);
    need(height + 1.5);
    sheet_.paragraph(margin, y_, 18.0, std::to_string(i + 1), small);
    y_ += sheet_.paragraph(margin + 18.0, y_, text_width - 18.0, report_.sources[i], small) + 1.5;
  }
  heading("Provenance", 40.0);
  facts(report_.provenance, 2, 80.0);
}

void PdfPages::metrics() {
  heading("Metrics", 80.0);
  for (const MetricTable& each : report_.tables) table(each);
  if (report_.missing.empty()) return;
  small_heading("Not available", 20.0);
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
  for (const Column& column : metric_columns) {
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
    height = std::max(
        height, sheet_.height_of(metric_columns[i].width - (i == 0 ? note_width : 4.0), cells[i], type(i)));
  if (y_ + height + 4.0 > PdfSheet::page_height - foot) {
    need(height + 4.0);
    table_heads();
  }
  double x = margin;
  for (size_t i = 0; i < cells.size(); ++i) {
    sheet_.paragraph(x, y_, metric_columns[i].width - (i == 0 ? note_width : 4.0), cells[i], type(i));
    x += metric_columns[i].width;
  }
  sheet_.paragraph(margin + metric_columns[0].width - note_width, y_, note_width - 3.0,
                   std::to_string(line.source), {5.6, grey(0.45), false, Anchor::left});
  y_ += height + 1.0;
  sheet_.straight({margin, y_}, {PdfSheet::page_width - margin, y_}, hair);
  y_ += 1.5;
}

}  // namespace

std::string pdf_of(const Report& report) {
  PdfSheet trial;
  const int pages = PdfPages(trial, report, 0).lay_out();
  PdfSheet sheet(report.title + " \u2013 " + report.subtitle, report.created_utc);
  PdfPages(sheet, report, pages).lay_out();
  return sheet.bytes();
}

}  // namespace ream::report
