#include "twin/twin_player.hpp"

#include <utility>

#include "collide/removal/removal_schedule.hpp"
#include "twin/cause_parts.hpp"

namespace ream::twin {

TwinPlayer::Outcome TwinPlayer::take(std::span<const std::byte> part) {
  if (outcome_ != Outcome::agrees) return outcome_;
  if (part.empty() || ended_) return outcome_ = Outcome::damaged;
  const auto bytes = part.subspan(1);
  switch (static_cast<PartCode>(part.front())) {
    case PartCode::start: return outcome_ = take_start(bytes);
    case PartCode::segment: return outcome_ = take_segment(bytes);
    case PartCode::ticks: return outcome_ = take_ticks(bytes);
    case PartCode::density: return outcome_ = take_density(bytes);
    case PartCode::end: return outcome_ = take_end(bytes);
  }
  return outcome_ = Outcome::damaged;
}

TwinPlayer::Outcome TwinPlayer::take_start(std::span<const std::byte> bytes) {
  if (twin_) return Outcome::damaged;
  auto bone = read_start(bytes);
  if (!bone) return Outcome::damaged;
  twin_.emplace(*std::move(bone));
  return Outcome::agrees;
}

TwinPlayer::Outcome TwinPlayer::take_density(std::span<const std::byte> bytes) {
  if (!twin_ || has_segment_) return Outcome::damaged;
  auto density = read_density(bytes, twin_->bone().grid);
  if (!density) return Outcome::damaged;
  twin_->tell_density(std::move(density->codes), density->cortical_threshold_g_cc);
  return Outcome::agrees;
}

/// A table with less room around the body than removal leans on would be read beyond its border.
TwinPlayer::Outcome TwinPlayer::take_segment(std::span<const std::byte> bytes) {
  auto segment = read_segment(bytes);
  if (!segment || !twin_ || segment->first_tick != agreed_ticks_ ||
      segment->profile.margin_mm < collide::RemovalSchedule::needed_margin_mm(twin_->bone().grid))
    return Outcome::damaged;
  twin_->begin_segment(std::move(segment->profile));
  has_segment_ = true;
  return Outcome::agrees;
}

TwinPlayer::Outcome TwinPlayer::take_ticks(std::span<const std::byte> bytes) {
  const auto part = read_ticks(bytes);
  if (!part || !has_segment_ || part->ticks.front().tick != agreed_ticks_) return Outcome::damaged;
  for (const CauseTick& tick : part->ticks) twin_->step(tick);
  if (twin_->session_hash() != part->session_hash) return Outcome::differs;
  agreed_ticks_ += static_cast<uint32_t>(part->ticks.size());
  return Outcome::agrees;
}

TwinPlayer::Outcome TwinPlayer::take_end(std::span<const std::byte> bytes) {
  const auto end = read_end(bytes);
  if (!end || !twin_ || end->ticks != agreed_ticks_) return Outcome::damaged;
  ended_ = true;
  recorded_ticks_ = end->recorded_ticks;
  return twin_->bone().coverage_hash() == end->coverage_hash ? Outcome::agrees : Outcome::differs;
}

std::optional<size_t> TwinPlayer::keep_snapshot() {
  if (!twin_ || outcome_ != Outcome::agrees || ended_) return std::nullopt;
  const size_t snapshot = twin_->keep_snapshot();
  if (snapshot == snapshots_.size()) snapshots_.push_back({agreed_ticks_, has_segment_});
  return snapshot;
}

bool TwinPlayer::go_to(size_t snapshot) {
  if (snapshot >= snapshots_.size()) return false;
  twin_->go_to(snapshot);
  agreed_ticks_ = snapshots_[snapshot].agreed_ticks;
  has_segment_ = snapshots_[snapshot].has_segment;
  ended_ = false;
  outcome_ = Outcome::agrees;
  return true;
}

}  // namespace ream::twin
