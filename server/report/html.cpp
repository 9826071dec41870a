#include "report/report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <report_style.hpp>

#include "core/text.hpp"
#include "report/canvas.hpp"
#include "report/chart.hpp"
#include "report/deviation_scale.hpp"
#include "report/number_text.hpp"

namespace ream::report {
namespace {

constexpr double chart_width = 720.0, chart_height = 170.0, learning_width = 360.0;

std::string element(const std::string& tag, const std::string& content, const std::string& classes = "") {
  return "<" + tag + (classes.empty() ? "" : " class=\"" + classes + "\"") + ">" + content + "</" +
         tag.substr(0, tag.find(' ')) + ">\n";
}

std::string text_element(const std::string& tag, const std::string& text, const std::string& classes = "") {
  return text.empty() ? "" : element(tag, escaped(text), classes);
}

std::string facts(const std::vector<Fact>& list, const std::string& classes = "facts") {
  std::string rows;
  for (const Fact& fact : list)
    rows += element("div", text_element("dt", fact.name) + text_element("dd", fact.value));
  return list.empty() ? "" : element("dl", rows, classes);
}

std::string result_class(const std::optional<score::Outcome>& outcome) {
  return outcome ? std::string(score::to_text(*outcome)) : "undecided";
}

std::string head(const Report& report) {
  std::string reasons;
  for (const std::string& reason : report.reasons) reasons += text_element("li", reason);
  const std::string titles =
      text_element("h1", report.title) + text_element("p", report.subtitle, "subtitle");
  const std::string result = text_element("p", report.verdict, "verdict") +
                             text_element("p", report.points, "score") +
                             text_element("p", report.judged_by, "by");
  return element("header",
                 element("div", titles) + element("div", result, "result " + result_class(report.outcome))) +
         (reasons.empty() ? "" : element("ul", reasons, "reasons")) + facts(report.facts);
}

std::string advice(const Report& report) {
  std::string lines;
  for (const Advice& each : report.advice) lines += text_element("li", each.words);
  return lines.empty() ? ""
                       : element("section", text_element("h2", "Next time") + element("ol", lines, "advice"));
}

std::string figure(const Picture& picture) {
  std::string labels;
  for (const PictureLabel& label : picture.labels) {
    std::array<char, 80> style{};
    std::snprintf(style.data(), style.size(), "span style=\"left:%.1f%%;top:%.1f%%\"", 100.0 * label.x,
                  100.0 * label.y);
    labels += element(style.data(), escaped(label.words));
  }
  const std::string image = "<img alt=\"" + escaped(picture.title + ". " + picture.caption) +
                            "\" src=\"data:image/png;base64," + base64(render::png_of(picture.image)) + "\">";
  return element("figure",
                 element("div", image + labels, "frame") +
                     element("figcaption", text_element("b", picture.title) + escaped(picture.caption)));
}

std::string legend() {
  std::string entries;
  for (const DeviationClass& each : deviation_classes()) {
    std::array<char, 160> style{};
    const auto [red, green, blue, hatch] = each.colour;
    if (hatch)
      std::snprintf(
          style.data(), style.size(),
          "i style=\"background:repeating-linear-gradient(-45deg,rgb(%d %d %d) 0 4px,#333 4px 6px)\"", red,
          green, blue);
    else
      std::snprintf(style.data(), style.size(), "i style=\"background:rgb(%d %d %d)\"", red, green, blue);
    entries += element("li", element(style.data(), "") + escaped(each.words));
  }
  return element("ul", entries, "legend");
}

std::string pictures(const Report& report) {
  std::string content = text_element("p", report.why_no_pictures);
  std::string figures;
  const auto last_map = std::find_if(report.pictures.rbegin(), report.pictures.rend(),
                                     [](const Picture& picture) { return picture.is_map; });
  for (const Picture& picture : report.pictures) {
    figures += figure(picture);
    if (last_map != report.pictures.rend() && &picture == &*last_map) figures += legend();
  }
  if (!figures.empty()) content += element("div", figures, "pictures");
  return element("section", text_element("h2", "Pictures") + content);
}

std::string cell(const std::string& text) { return element("td", escaped(text), "n"); }

std::string mark_cell(const MetricLine& line) {
  if (line.mark == Mark::none) return "<td></td>\n";
  const std::string critical = line.critical && line.mark == Mark::fail ? ", decides" : "";
  const std::string word = mark_word(line.mark);
  return element("td", escaped(mark_sign(line.mark) + " " + word + critical),
                 "mark mark-" + (line.mark == Mark::missing ? std::string("missing") : word));
}

std::string table(const MetricTable& table) {
  std::string rows;
  for (const MetricLine& line : table.lines)
    rows +=
        element("tr", element("td", escaped(line.name) + "<sup> " + std::to_string(line.source) + "</sup>") +
                          cell(line.planned) + cell(line.value) + cell(line.pass) + cell(line.warn) +
                          mark_cell(line) + cell(line.points));
  const std::string heads =
      "<tr><th>Metric</th><th>Planned</th><th>Achieved</th><th>Passes</th><th>Warns</th><th>Result</th>"
      "<th>Points \u00d7 weight</th></tr>";
  return text_element("h3", table.title) +
         element("div", element("table", element("thead", heads) + element("tbody", rows), "metrics"),
                 "scroll");
}

std::string metrics(const Report& report) {
  std::string content = text_element("h2", "Metrics");
  for (const MetricTable& each : report.tables) content += table(each);
  if (!report.missing.empty())
    content += text_element("h3", "Not available") + facts(report.missing, "facts wide");
  return element("section", content);
}

std::string chart(const Chart& chart, double width, double height) {
  SvgCanvas canvas;
  draw_chart(chart, canvas, {}, width, height);
  return element("figure", text_element("h3", chart.title) + canvas.svg(width, height, chart.alt_text));
}

std::string course(const Report& report) {
  std::string content = text_element("h2", "Course") + text_element("p", report.why_no_charts);
  for (const Chart& each : report.charts) content += chart(each, chart_width, chart_height);
  if (!report.remarks.empty()) {
    std::string rows;
    for (size_t i = 0; i < report.remarks.size(); ++i) {
      const Remark& remark = report.remarks[i];
      rows += element("tr", cell(std::to_string(i + 1)) + cell(duration_text(remark.at_s)) +
                                element("td", escaped(remark.words)) + cell(remark.author));
    }
    content += text_element("h3", "Comments") +
               element("table",
                       "<thead><tr><th>No.</th><th>At</th><th>Comment</th><th>By</th></tr></thead>" +
                           element("tbody", rows),
                       "remarks");
  }
  return element("section", content, "charts");
}

std::string load(const Report& report) {
  if (!report.load) return "";
  const LoadSection& section = *report.load;
  std::string heads, rows;
  for (const std::string& head : section.heads) heads += element("th", escaped(head));
  for (const std::vector<std::string>& row : section.rows) {
    std::string cells;
    for (const std::string& text : row) cells += element("td", escaped(text));
    rows += element("tr", cells);
  }
  std::string content = text_element("h2", "Component under load") + text_element("p", section.words);
  content += element(
      "div", element("table", element("thead", element("tr", heads)) + element("tbody", rows), "load"),
      "scroll");
  if (section.map) content += element("div", figure(*section.map), "pictures");
  return element("section", content + text_element("p", section.assumptions, "note"));
}

std::string learning(const Report& report) {
  if (report.learning_words.empty() && report.benchmark.empty()) return "";
  std::string content = text_element("h2", "Learning") + text_element("p", report.learning_words);
  std::string charts;
  for (const Chart& each : report.learning_charts) charts += chart(each, learning_width, chart_height);
  if (!charts.empty()) content += element("div", charts, "pictures");
  if (!report.benchmark.empty())
    content += text_element("h3", report.benchmark_words) + facts(report.benchmark, "facts wide");
  return element("section", content, "charts");
}

std::string notes(const Report& report) {
  std::string entries;
  for (const std::string& source : report.sources) entries += text_element("li", source);
  return element("section",
                 text_element("h2", "What the metrics mean") + facts(report.meanings, "facts meanings")) +
         element("section", text_element("h2", "Sources of definitions and limits") +
                                element("ol", entries, "sources") + text_element("h2", "Provenance") +
                                facts(report.provenance));
}

}  // namespace

std::string html_of(const Report& report) {
  const std::string style(embedded::report_style::find("report.css"));
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
         "'unsafe-inline'; "
         "img-src data:\">\n" +
         text_element("title", report.title + " \u2013 " + report.subtitle) + "<style>\n" + style +
         "</style>\n</head>\n<body>\n" +
         element("main", head(report) + advice(report) + pictures(report) + metrics(report) + load(report) +
                             course(report) + learning(report) + notes(report)) +
         "</body>\n</html>\n";
}

}  // namespace ream::report
