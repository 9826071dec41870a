#pragma once
#include "case/case.hpp"
#include "case/landmarks.hpp"
#include "record/tick_report.hpp"
#include "score/metrics.hpp"
#include "shell/tool.hpp"
#include "sim/loop_health.hpp"
#include "stream/messages.hpp"
#include "stream/telemetry.hpp"

namespace ream::session {

/// What viewers are told of a case, its plan and the tool in the hand; who sends it fills in the rest.
stream::HelloInfo make_hello(const case_::Case& c, const case_::Plan& plan, const shell::Tool& tool,
                             const case_::Anatomy& anatomy);

/// What viewers are told of one tick. Where the bone is, is left out where it has not moved.
void update_sample(const record::TickReport& report, stream::TelemetrySample& sample);
/// The same of a session so far; `depth_mm` as LiveScore has it.
/// Of a bone that is to be told by hand: what it is made of stays out of the sample.
void hide_material(stream::TelemetrySample& sample);
void update_sample(const score::MetricsAccumulator& metrics, double depth_mm, const sim::LoopHealth& health,
                   stream::TelemetrySample& sample);

}  // namespace ream::session
