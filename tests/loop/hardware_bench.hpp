#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/fake_hardware.hpp"

namespace ream::test {

/// One kind of haptic device with its fake, for tests of whole sessions.
class HardwareBench {
 public:
  virtual ~HardwareBench() = default;
  virtual std::string device() const = 0;
  /// For `connection` in its set-up.
  virtual nlohmann::json connection() const = 0;
  virtual FakeHardware& hardware() = 0;
  /// Away from the person, device frame.
  virtual std::array<double, 3> away() const = 0;
  /// Of the profile that sessions take.
  virtual double force_max_n() const = 0;
  /// Within which a force is zero after this fault, ms, as server/device/GUIDE.md states it.
  virtual double stated_ms(HardwareFault fault) const = 0;
  virtual void make(HardwareFault fault) { hardware().fault = fault; }
  virtual void mend() { hardware().fault = HardwareFault::none; }

  /// The hand is at rest and does not push; nothing has happened yet.
  void begin() {
    hardware().forget();
    FakeHand hand;
    hand.axis = away();
    hardware().set_hand(hand);
  }
  /// Writes the set-up into a data folder.
  void set_up(const std::filesystem::path& data) const;
};

std::unique_ptr<HardwareBench> make_bench(const std::string& device);
std::vector<std::string> bench_devices();

}  // namespace ream::test
