// What a plug-in has, in the shape of the rooms that use it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "device/profiles.hpp"
#include "device/registry/device_registry.hpp"
#include "device/vendors/servo_device.hpp"
#include "force/feed_model.hpp"
#include "plugin/floating_point.hpp"
#include "plugin/plugin.hpp"
#include "score/plugin_score.hpp"

namespace ream::plugin {
namespace {

/// What a reamer that does not cut has: no feed that anybody sees, at any thrust.
constexpr double blocked_n_s_mm = 1e7;
/// Beyond any reamer; sums of them stay finite.
constexpr double max_torque_arm_mm = 1000.0, max_tangential_ratio = 100.0;

double not_negative(double value) { return std::isfinite(value) ? std::max(0.0, value) : 0.0; }

/// Calls a plug-in. Error io for what it throws, whatever that is.
template <typename Call>
auto guarded(Call&& call) {
  try {
    return call();
  } catch (...) {
    throw Error(ErrorKind::io, "the plug-in has thrown an exception; its functions must not");
  }
}

class LoadedFeedModel final : public force::FeedModel {
 public:
  LoadedFeedModel(const ream_feed_model& model, const force::FeedSettings& settings) : model_(model) {
    const ream_feed_settings told{sizeof(ream_feed_settings),
                                  settings.spindle_rad_s,
                                  settings.specimen_factor,
                                  settings.cutting.edge_reference_mm,
                                  settings.cutting.edge_threshold_share,
                                  settings.cutting.tangential_ratio};
    const FloatingPoint kept;
    if (model_.create != nullptr) state_ = guarded([&] { return model_.create(&told); });
  }
  ~LoadedFeedModel() override {
    try {
      if (model_.destroy != nullptr) model_.destroy(state_);
    } catch (...) {  // NOLINT(bugprone-empty-catch): nothing that a plug-in throws may end the server
    }
  }
  LoadedFeedModel(const LoadedFeedModel&) = delete;
  LoadedFeedModel& operator=(const LoadedFeedModel&) = delete;

  /// The trial has not met all bone there is: what it gives of another kind stops the reamer, and no more.
  force::CuttingLoad load(const force::EngagedBone& bone, double thrust_n) const noexcept override {
    const ream_engaged_bone told{{bone.share[0], bone.share[1], bone.share[2]},
                                 {bone.density_g_cc[0], bone.density_g_cc[1], bone.density_g_cc[2]},
                                 bone.area_mm2,
                                 bone.edge_mm,
                                 bone.resistance_s_mm,
                                 thrust_n};
    ream_cutting_load load{};
    try {
      model_.load(state_, &told, &load);
    } catch (...) {  // of a plug-in in C++
      load = {};
    }
    const bool may_be = load.resistance_n_s_mm >= min_resistance_n_s_mm;
    return {may_be ? std::min(load.resistance_n_s_mm, blocked_n_s_mm) : blocked_n_s_mm,
            std::min(not_negative(load.torque_arm_mm), max_torque_arm_mm),
            std::min(not_negative(load.tangential_ratio), max_tangential_ratio)};
  }

 private:
  static constexpr double min_resistance_n_s_mm = 1e-3;

  const ream_feed_model& model_;
  void* state_ = nullptr;
};

void offer_feed(const Plugin& plugin) {
  if (const auto other = force::offered_feed_model())
    throw Error(ErrorKind::conflict, other->in_words() + " and " + plugin.identity.in_words() +
                                         " both have a feed model; give one of them");
  force::offer_feed_model(
      {plugin.identity, [&model = *plugin.description->feed](const force::FeedSettings& settings) {
         return std::make_unique<LoadedFeedModel>(model, settings);
       }});
}

/// What is none becomes U+FFFD.
std::string as_utf8(const std::string& text) {
  return parse_json(nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

score::PluginScore scored(const ream_score_model& model, const nlohmann::json& metrics) {
  static std::mutex one_at_a_time;
  std::vector<ream_metric> told;
  for (const auto& [name, value] : metrics.items())
    if (value.is_number() || value.is_null())
      told.push_back(
          {name.c_str(), value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>()});
  const auto given = std::make_unique<ream_score>();
  {
    const std::lock_guard lock(one_at_a_time);
    guarded([&] { model.score(told.data(), told.size(), given.get()); });
  }
  if (!(given->points >= 0.0 && given->points <= 100.0))
    throw Error(ErrorKind::invalid_input, "the plug-in's score gives points that are not 0 to 100");
  score::PluginScore score;
  score.points = given->points;
  if (given->outcome >= 0) score.passed = given->outcome > 0;
  for (uint32_t i = 0; i < std::min<uint32_t>(given->line_count, REAM_SCORE_LINES); ++i) {
    const std::span<const char> line(given->lines[i]);
    score.lines.push_back(
        as_utf8(one_line({line.begin(), std::find(line.begin(), line.end(), '\0')}, line.size())));
  }
  return score;
}

void offer_score(const Plugin& plugin) {
  if (const auto other = score::offered_plugin_score())
    throw Error(ErrorKind::conflict, other->in_words() + " and " + plugin.identity.in_words() +
                                         " both have a score; give one of them");
  score::offer_plugin_score(plugin.identity,
                            [&model = *plugin.description->score](const nlohmann::json& metrics) {
                              return scored(model, metrics);
                            });
}

/// A plug-in's device behind the guards that every driver has: ServoEnd cuts its forces, ServoDevice has it
/// on a thread of its own.
class LoadedServo final : public device::Servo {
 public:
  explicit LoadedServo(const ream_device& device) : device_(device) {}

  void open(device::ServoEnd& end) override {
    std::array<char, 200> why{};
    handle_ = guarded([&] { return device_.open(why.data(), why.size() - 1); });
    if (handle_ == nullptr)
      throw Error(ErrorKind::unavailable,
                  why[0] == '\0' ? "the plug-in's device cannot be opened" : why.data());
    turn(end);
  }

  void turn(device::ServoEnd& end) override {
    const int64_t asked_ns = end.now_ns();
    ream_handle_state told{};
    require(guarded([&] { return device_.read(handle_, &told); }), "tells no position");
    device::ServoState state;
    for (int row = 0; row < 3; ++row) {
      state.device_from_handle.translation_mm[row] = told.place_mm[row];
      for (int column = 0; column < 3; ++column)
        state.device_from_handle.rotation(row, column) = told.rotation[3 * row + column];
    }
    state.spindle_on = told.spindle_on != 0;
    state.paused = told.paused != 0;
    state.clutch = told.clutch != 0;
    state.deadman = told.deadman != 0;
    end.report(state, asked_ns);
    render(end.force());
  }

  void close() noexcept override {
    if (handle_ == nullptr) return;
    void* handle = std::exchange(handle_, nullptr);
    try {
      const ream_handle_force none{};
      device_.write(handle, &none);
      device_.close(handle);
    } catch (...) {  // NOLINT(bugprone-empty-catch): nothing that a plug-in throws may end the server
    }
  }

  bool takes_force_elsewhere() const noexcept override { return false; }

 private:
  static void require(int answer, const char* what) {
    if (answer == REAM_DEVICE_OK) return;
    throw Error(answer == REAM_DEVICE_GONE ? ErrorKind::unavailable : ErrorKind::io,
                std::string("the plug-in's device ") + what);
  }

  void render(const device::ServoForce& force) const {
    const ream_handle_force told{{force.force_n.x(), force.force_n.y(), force.force_n.z()},
                                 {force.torque_n_mm.x(), force.torque_n_mm.y(), force.torque_n_mm.z()}};
    require(guarded([&] { return device_.write(handle_, &told); }), "takes no force");
  }

  const ream_device& device_;
  void* handle_ = nullptr;
};

void offer_device(const Plugin& plugin) {
  const ream_device& device = *plugin.description->device;
  device::DeviceTraits traits;
  traits.name = device.name;
  traits.force_max_n = device.force_max_n;
  traits.torque_max_n_mm = device.torque_max_n_mm;
  traits.stiffness_max_n_mm = device.stiffness_max_n_mm;
  traits.damping_max_n_s_mm = device.damping_max_n_s_mm;
  traits.workspace_radius_mm = device.workspace_radius_mm;
  traits.handle_mass_kg = device.handle_mass_kg;
  traits.degrees_of_freedom = static_cast<int>(device.degrees_of_freedom);
  device::add_device_profile(traits);
  const std::string name = device.name, about = one_line(device.about, 100);
  device::add_device_kind({name,
                           name,
                           [=](const std::filesystem::path&) { return device::offer_of(name, about, name); },
                           [=, &device](const device::DeviceRequest& request) {
                             auto servo = std::make_unique<LoadedServo>(device);
                             return device::MadeDevice{
                                 device::mapped(request, std::make_unique<device::ServoDevice>(
                                                             device::device_profile(name), std::move(servo))),
                                 nullptr};
                           },
                           {name}});
}

}  // namespace

void offer(const Plugin& plugin) {
  if (plugin.description->feed != nullptr) offer_feed(plugin);
  if (plugin.description->score != nullptr) offer_score(plugin);
  if (plugin.description->device != nullptr) offer_device(plugin);
}

}  // namespace ream::plugin
