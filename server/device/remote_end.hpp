#pragma once
#include <memory>

#include "device/haptic_device.hpp"
#include "device/remote_link.hpp"

namespace ream::device {

/// The haptic thread's end of a link, which every device that connects over the network has: it takes the
/// newest input and says how old it is, and writes what goes back. Wait-free.
class RemoteEnd {
 public:
  /// `clock_ns`: the clock of RemoteLink's times.
  RemoteEnd(std::shared_ptr<RemoteLink> link, int64_t (*clock_ns)())
      : link_(std::move(link)), now_ns_(clock_ns) {}

  /// Forgets what was said before; force may go out.
  void open() noexcept;
  /// Looks for news and takes it into `input`. False: there is none. A new connection makes itself known by
  /// one look without news at which the age is infinite, as its device may be held elsewhere.
  bool take(RemoteInput& input) noexcept;
  /// Of the newest input at the last look; infinite before the first.
  double age_ms() const noexcept { return age_ms_; }
  int64_t now_ns() const noexcept { return now_ns_(); }

  /// `output` goes to the connection whose input was taken last.
  void write(const DeviceOutput& output) noexcept;
  /// From any thread: no force goes out any more until open().
  void take_force_away() noexcept { link_->force_taken_away.store(true, std::memory_order_release); }

 private:
  const std::shared_ptr<RemoteLink> link_;
  int64_t (*const now_ns_)();
  RemoteInput newest_;
  uint64_t answered_ = 0;  ///< connection whose input was taken last
  bool broken_ = false;    ///< the newest input is the first of its connection and has not been taken
  double age_ms_ = 0.0;
};

}  // namespace ream::device
