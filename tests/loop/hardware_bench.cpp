#include "loop/hardware_bench.hpp"

#include <dlfcn.h>

#include <stdexcept>

#include "core/file.hpp"
#include "device/device_setup.hpp"
#include "device/vendors/force_dimension_servo.hpp"
#include "device/vendors/open_haptics_servo.hpp"
#include "support/fake_haply.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

/// From the last good pose: 10 ms until it counts as old, 20 ms of fading, and a tick, a turn and a half
/// beside.
constexpr double faded_ms = 35.0;
/// With answers of 15 ms the last good pose is as old when it comes, and the next force as late.
constexpr double faded_slowly_ms = 65.0;

class HaplyBench final : public HardwareBench {
 public:
  std::string device() const override { return "haply"; }
  nlohmann::json connection() const override {
    return {{"port", fake_.port()}, {"events_port", fake_.events_port()}};
  }
  FakeHardware& hardware() override { return fake_.hardware(); }
  std::array<double, 3> away() const override { return {0, 1, 0}; }
  double force_max_n() const override { return 5.0; }
  double stated_ms(HardwareFault fault) const override {
    const bool forgets = fault == HardwareFault::absent || fault == HardwareFault::silent;
    if (forgets) return FakeHaply::force_lives_ms + 2.0;
    return fault == HardwareFault::slow ? faded_slowly_ms : faded_ms;
  }
  void make(HardwareFault fault) override {
    HardwareBench::make(fault);
    if (fault == HardwareFault::absent) fake_.die();
  }
  void mend() override {
    HardwareBench::mend();
    fake_.revive();
  }

 private:
  FakeHaply fake_;
};

/// A maker's library that is none, loaded by the driver and by the test.
class LibraryBench : public HardwareBench {
 public:
  explicit LibraryBench(const std::string& name)
      : path_(build_folder() + "/tests/support/libfake_" + name + ".so"),
        library_(::dlopen(path_.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (library_ == nullptr) throw std::runtime_error(::dlerror());
    const auto find = reinterpret_cast<FakeHardware* (*)()>(::dlsym(library_, "fake_hardware"));
    hardware_ = find();
    hardware_->forget();
  }
  nlohmann::json connection() const override { return {{"library", path_}}; }
  FakeHardware& hardware() override { return *hardware_; }

 private:
  const std::string path_;
  void* const library_;
  FakeHardware* hardware_ = nullptr;
};

class ForceDimensionBench final : public LibraryBench {
 public:
  ForceDimensionBench() : LibraryBench("dhd") {}
  std::string device() const override { return "forcedimension"; }
  std::array<double, 3> away() const override { return {-1, 0, 0}; }
  double force_max_n() const override { return 12.0; }
  double stated_ms(HardwareFault fault) const override {
    if (fault == HardwareFault::absent) return 5.0;
    if (fault == HardwareFault::silent) return device::watchdog_ms + 5.0;
    return fault == HardwareFault::slow ? faded_slowly_ms : faded_ms;
  }
};

class OpenHapticsBench final : public LibraryBench {
 public:
  OpenHapticsBench() : LibraryBench("hd") {}
  std::string device() const override { return "openhaptics"; }
  std::array<double, 3> away() const override { return {0, 0, -1}; }
  double force_max_n() const override { return 3.3; }
  double stated_ms(HardwareFault fault) const override {
    if (fault == HardwareFault::absent) return 5.0;
    if (fault == HardwareFault::silent) return device::servo_loop_timeout_ms + 10.0;
    // Its poses are new when they come, however seldom: the force falls and comes back between them.
    return fault == HardwareFault::slow ? std::numeric_limits<double>::infinity() : faded_ms;
  }
};

}  // namespace

void HardwareBench::set_up(const std::filesystem::path& data) const {
  nlohmann::json json = device::to_json(device::default_device_setup(device()));
  json["connection"] = connection();
  make_writable_folder(data / "devices");
  write_file_atomically(device::device_setup_path(data, device()), json.dump());
}

std::vector<std::string> bench_devices() { return {"haply", "forcedimension", "openhaptics"}; }

std::unique_ptr<HardwareBench> make_bench(const std::string& device) {
  if (device == "haply") return std::make_unique<HaplyBench>();
  if (device == "forcedimension") return std::make_unique<ForceDimensionBench>();
  if (device == "openhaptics") return std::make_unique<OpenHapticsBench>();
  throw std::runtime_error("no fake of " + device);
}

}  // namespace ream::test
