#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/advice.hpp"
#include "report/chart.hpp"
#include "report/material.hpp"

namespace ream::report {

struct Fact {
  std::string name, value;
};

/// What stands in the column of results; `none`: without limits.
enum class Mark { none, pass, warn, fail, missing };

/// One metric as it is printed; texts are empty where there is nothing to say.
struct MetricLine {
  std::string name, planned, value, pass, warn, points;
  Mark mark = Mark::none;
  bool critical = false;
  int source = 0;  ///< number of its footnote, from 1
};

struct MetricTable {
  std::string title;
  std::vector<MetricLine> lines;
};

/// A component under load as it is printed: on a page of its own.
struct LoadSection {
  std::string words, assumptions;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;  ///< the first cell names what is measured
  std::optional<Picture> map;
};

/// A report in words, numbers and pictures, before it is laid out: the same for HTML and PDF.
struct Report {
  std::string title, subtitle;
  std::vector<Fact> facts;
  std::optional<score::Outcome> outcome;
  std::string verdict;    ///< "Passed", "Not passed", "Not decided", "Not judged"
  std::string points;     ///< "82.0 of 100 points"; empty without any
  std::string judged_by;  ///< the rubric, and theatre mode
  std::vector<std::string> reasons;
  std::vector<Advice> advice;  ///< what to do better next time, most important first
  std::vector<Picture> pictures;
  std::string why_no_pictures;
  bool has_maps = false;  ///< a legend of deviations is needed
  std::vector<MetricTable> tables;
  std::vector<Fact> missing;   ///< metrics and the reason why they have no value
  std::vector<Fact> meanings;  ///< metrics with unit: definition, confidence and source
  std::vector<Chart> charts;
  std::string why_no_charts;
  std::vector<Remark> remarks;
  std::optional<LoadSection> load;
  std::vector<Chart> learning_charts;
  std::string learning_words;
  std::string benchmark_words;
  std::vector<Fact> benchmark;       ///< metric, and value against mean
  std::vector<std::string> sources;  ///< footnotes, the first is 1
  std::vector<Fact> provenance;
  std::string created_utc;  ///< of the session, ISO; may be empty
};

/// Says what a session says, and what it does not; never a number that is not there.
Report make_report(const Material& material);
LoadSection load_section(const LoadMaterial& material);

/// "pass", "warn", "fail", "not said", and a sign that is told apart without colour.
std::string mark_word(Mark mark);
std::string mark_sign(Mark mark);

/// One page that holds everything in itself (pictures, charts, style) and runs no scripts; to be read on a
/// screen or printed.
std::string html_of(const Report& report);

/// The bytes of a PDF file: A4, fonts embedded, pages numbered. The same report gives the same bytes on the
/// same machine. Error unavailable when no page can be drawn.
std::string pdf_of(const Report& report);

}  // namespace ream::report
