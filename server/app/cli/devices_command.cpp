#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/cli/commands.hpp"
#include "app/device_trial.hpp"
#include "app/handle_reader.hpp"
#include "app/plugin_option.hpp"
#include "app/setup_wizard.hpp"
#include "app/standalone_device_server.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "device/profiles.hpp"
#include "device/registry/device_registry.hpp"

namespace ream::app {
namespace {

struct DevicesOptions {
  std::string test, setup, profile, axes, hand;
  std::optional<double> scale;
  uint16_t port = 0;
  std::vector<std::filesystem::path> plugins;
};

void list_devices(const GlobalOptions& global) {
  nlohmann::json rows = nlohmann::json::array();
  for (const device::DeviceKind& kind : device::device_kinds()) {
    const device::DeviceInfo offer = kind.offer(data_folder(global.data));
    rows.push_back({{"name", offer.name},
                    {"usable", offer.usable},
                    {"reason", offer.reason},
                    {"force_max_n", offer.force_max_n},
                    {"dof", offer.degrees_of_freedom}});
    if (!global.json)
      std::cout << offer.name << '\t' << (offer.usable ? "usable" : offer.reason) << '\t' << offer.about
                << '\n';
  }
  if (global.json) std::cout << rows.dump() << '\n';
}

/// A hand that lets go at first, then presses downwards until it feels the wall, and swings a little.
device::Script trial_script(const std::string& profile) {
  device::Script script;
  script.duration_s = 60.0;
  script.device_profile = profile.empty() ? "touch" : profile;
  script.vibration.source = "off";
  script.hand.start_mm = Vec3::Zero();
  script.hand.arm_damping_n_s_mm = 0.05;
  script.hand.force_profile = {{0.0, 0.0}, {0.5, 0.0}, {1.5, 0.6}};
  return script;
}

constexpr int max_wait_ms = 60'000;

/// Where the handle of a device begins before a person who sits upright: a scripted hand pushes downwards,
/// for others ahead is level.
Pose trial_start(const std::string& name) {
  return {rotation_with_z_along(name == "script" ? Vec3(0, 0, -1) : Vec3(0, 1, 0)), Vec3::Zero()};
}

device::MadeDevice trial_device(const DevicesOptions& options, const std::string& name,
                                const device::Script& script, const GlobalOptions& global) {
  const std::string profile = name == "script" ? "" : options.profile;
  return device::make_device({name, profile, &script, trial_start(name), 1, data_folder(global.data)});
}

/// Where a device that connects itself finds us; nothing for others.
std::optional<StandaloneDeviceServer> open_door(const DevicesOptions& options, const std::string& name,
                                                const device::MadeDevice& made) {
  std::optional<StandaloneDeviceServer> door;
  if (!made.link) return door;
  door.emplace(made.link, name, made.device->traits(), options.port);
  std::cerr << "connect the device to " << door->url() << "  (Ctrl-C ends it)" << std::endl;
  return door;
}

void refuse_browser(const std::string& name, const std::string& what) {
  if (name == "browser")
    throw Error(
        ErrorKind::invalid_input,
        "the device 'browser' is " + what + " in the page of a session; run `ream serve` and open it there");
}

void print_trial(const DeviceTrial& trial) {
  for (const std::string& line : verdict_words(trial)) std::cout << line << '\n';
  if (!trial.connected) return;
  std::cout << trial.pose_rate_hz() << " poses a second, 1 % older than " << trial.age_p99_ms
            << " ms, the oldest " << trial.age_max_ms << " ms\n"
            << "ticks late by " << trial.lateness_us.p50_us << " us (median), " << trial.lateness_us.p99_us
            << " us (99 %), " << trial.lateness_us.max_us << " us at most\n"
            << "moved " << trial.moved_mm.x() << " x " << trial.moved_mm.y() << " x " << trial.moved_mm.z()
            << " mm, at most " << trial.force_max_n << " N were sent, the wall was touched for "
            << trial.wall_s << " s\n";
}

void test_device(const DevicesOptions& options, const GlobalOptions& global) {
  const device::DeviceInfo offer = device::device_kind(options.test).offer(data_folder(global.data));
  refuse_browser(options.test, "tried out");
  if (!offer.usable)
    throw Error(ErrorKind::unavailable, "the device '" + offer.name + "' is not usable: " + offer.reason);
  catch_interrupts();
  const device::Script script = trial_script(options.profile);
  const device::MadeDevice made = trial_device(options, options.test, script, global);
  const auto door = open_door(options, options.test, made);
  std::cerr << "hold the handle loosely; after a second there is a gentle wall 10 mm below it, press against "
               "that; then the force fades\n";
  const DeviceTrial trial = try_out(*made.device, {}, sim::Realtime::attempt);
  if (global.json)
    std::cout << to_json(trial).dump() << '\n';
  else
    print_trial(trial);
  throw_if_interrupted();
  if (!is_usable(trial)) throw Error(ErrorKind::unavailable, verdict_words(trial).front());
}

/// A person at the terminal tells it, or shows it with the device.
device::DeviceSetup shown_setup(const DevicesOptions& options, const device::DeviceSetup& before,
                                const GlobalOptions& global) {
  const device::Script script = trial_script(options.profile);
  const device::MadeDevice made = trial_device(options, options.setup, script, global);
  const auto door = open_door(options, options.setup, made);
  HandleReader reader(*made.device, before, trial_start(options.setup));
  for (int waited_ms = 0; !reader.answers(); waited_ms += 50) {
    throw_if_interrupted();
    if (waited_ms > max_wait_ms)
      throw Error(ErrorKind::unavailable, "no pose came in a minute; check that the device is connected");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const auto wait = [](int ms) {
    throw_if_interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
  };
  return ask_for_setup(
      std::cin, std::cerr, before, [&] { return reader.place_mm(); }, wait);
}

void set_up_device(const DevicesOptions& options, const GlobalOptions& global) {
  device::device_kind(options.setup);
  refuse_browser(options.setup, "steered");
  if (options.setup == "script")
    throw Error(ErrorKind::invalid_input, "the device 'script' has no set-up; its script says where it is");
  const std::filesystem::path data = data_folder(global.data);
  device::DeviceSetup setup = device::load_device_setup(data, options.setup);
  if (options.axes.empty() && options.hand.empty() && !options.scale) {
    if (::isatty(STDIN_FILENO) == 0)
      throw Error(ErrorKind::usage,
                  "the set-up asks questions and needs a terminal; else give --axes, --hand "
                  "or --scale");
    catch_interrupts();
    setup = shown_setup(options, setup, global);
  }
  if (!options.axes.empty()) setup.person_from_device = device::person_from_axes(options.axes);
  if (!options.hand.empty()) setup.hand = options.hand == "left" ? device::Hand::left : device::Hand::right;
  if (options.scale) setup.scale = *options.scale;
  throw_if_interrupted();
  device::save_device_setup(data, options.setup, setup);
  const std::string path = device::device_setup_path(data, options.setup).string();
  if (global.json)
    std::cout << nlohmann::json{{"path", path}, {"setup", device::to_json(setup)}}.dump() << '\n';
  else
    std::cout << path << '\n';
}

}  // namespace

void add_devices_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<DevicesOptions>();
  CLI::App* command = app.add_subcommand("devices", "List the haptic devices, try one out, or set one up");
  CLI::Option* test =
      command->add_option("--test", options->test,
                          "Try this one: no force for a second, a gentle wall, force off; 1 if not usable");
  CLI::Option* setup =
      command->add_option("--setup", options->setup,
                          "Tell how this one stands before you and which hand holds it; asks, unless told");
  command->add_option("--profile", options->profile, "What it can render, by name (with --test)")
      ->check(CLI::IsMember(device::device_profile_names()));
  command->add_option("--port", options->port, "Where a network device connects to; 0 takes any free one");
  command
      ->add_option("--axes", options->axes,
                   "Device axes that go to your right, up and towards you, as in x,y,z or -y,z,-x")
      ->needs(setup);
  command->add_option("--scale", options->scale, "Tool mm for each mm of the handle")
      ->check(CLI::Range(device::DeviceSetup::min_scale, device::DeviceSetup::max_scale))
      ->needs(setup);
  command->add_option("--hand", options->hand, "Hand that holds the tool")
      ->check(CLI::IsMember({"left", "right"}))
      ->needs(setup);
  test->excludes(setup);
  add_plugin_option(*command, options->plugins);
  command->callback([options, &global] {
    use_plugins(options->plugins);
    if (!options->test.empty())
      test_device(*options, global);
    else if (!options->setup.empty())
      set_up_device(*options, global);
    else
      list_devices(global);
  });
}

}  // namespace ream::app
