#pragma once
#include "report/material.hpp"

namespace ream::test {

/// A session that says everything: all metrics have a number.
inline report::Material full_material() {
  report::Material m;
  m.session.id = "s-1";
  m.session.case_name = "J\u00fcrgen's phantom <1>";
  m.session.side = "left";
  m.session.trainee = "Zo\u00eb \u00d6zt\u00fcrk";
  m.session.created_utc = "2026-01-31T09:05:00Z";
  m.session.attempt = 2;
  m.session.state = "finished";
  m.session.force_scale = 26.0;
  m.session.build = "ream 1";
  m.session.scored_by = "ream 2";
  m.session.session_hash = "0123456789abcdef";
  m.plan_words = "2 mm deep";
  m.planned_depth_mm = 2.0;
  m.metrics = nlohmann::json::object();
  for (const score::Metric& metric : score::metric_catalogue()) m.metrics[std::string(metric.key)] = 1.0;
  m.metrics["version_achieved_deg"] = -3.2;
  m.metrics["version_planned_deg"] = -2.0;
  m.metrics["seating_percent"] = 85.0;
  m.metrics["axial_thrust_mean_n"] = 52.0;
  m.metrics["plate_preserved_percent"] = 92.0;
  m.metrics["vault_breach_mm"] = m.metrics["perforated_area_mm2"] = 0.0;
  m.metrics["plan_overlap_percent"] = 92.0;
  m.metrics["depth_planned_mm"] = 2.0;
  m.metrics["depth_error_mm"] = 0.2;
  m.metrics["missing"] = nlohmann::json::object();
  m.rubric = score::standard_rubric();
  m.score = score::apply_rubric(m.rubric, m.metrics);
  m.trace.emplace(3000, Pose{});
  for (uint32_t i = 0; i < 3000; ++i) {
    record::TickReport r;
    r.engaged = r.cutting = i > 500;
    r.thrust_n = 52.0;
    r.feed_rate_mm_s = 0.06;
    m.trace->add(r);
  }
  m.remarks = {{1.5, "Watch the <angle> & the depth", "Instructor"}};
  return m;
}

/// A session that never touched bone, of a case without landmarks and a recording without ticks.
inline report::Material empty_material() {
  report::Material m;
  m.session.case_name = "nothing";
  m.metrics = nlohmann::json::object();
  for (const score::Metric& metric : score::metric_catalogue()) {
    m.metrics[std::string(metric.key)] = nullptr;
    m.metrics["missing"][std::string(metric.key)] = "the reamer never touched bone";
  }
  m.rubric = score::standard_rubric();
  m.score = score::apply_rubric(m.rubric, m.metrics);
  m.trace.emplace(0, Pose{});
  m.why_no_pictures = "The case is not there.";
  return m;
}

}  // namespace ream::test
