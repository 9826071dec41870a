#include "score/contact_passes.hpp"

#include "score/breakthrough.hpp"

namespace ream::score {

void ContactPasses::add(const record::TickReport& report) {
  if (!report.engaged || report.thrust_n <= pressing_n) {
    ++ticks_since_;
    return;
  }
  if (ticks_since_ > gap_ticks) ++count_;
  ticks_since_ = 0;
}

}  // namespace ream::score
