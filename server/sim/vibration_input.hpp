#pragma once
#include "force/vibration_player.hpp"
#include "record/tick_report.hpp"
#include "sim/model.hpp"

namespace ream::sim {

/// What a tick says about vibration, as the tick itself plays it and as its sound is made from the report.
inline force::VibrationInput vibration_input(const Model& model, const record::TickReport& report) noexcept {
  return {report.spindle_on,
          model.settings.feed.spindle_rad_s,
          report.cutting,
          {report.share[0], report.share[1], report.share[2]},
          report.paused};
}

}  // namespace ream::sim
