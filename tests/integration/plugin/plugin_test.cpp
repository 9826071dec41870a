#include "plugin/plugin.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"
#include "device/profiles.hpp"
#include "device/registry/device_registry.hpp"
#include "force/edge_load.hpp"
#include "score/plugin_score.hpp"
#include "support/expect_error.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"

namespace ream::plugin {
namespace {

namespace fs = std::filesystem;

fs::path built(const std::string& name) {
  return fs::path(test::build_folder()) / "tests/support/plugins" / (name + ".so");
}

struct Fault {
  const char *name, *words;
};
class Faulty : public testing::TestWithParam<Fault> {};

TEST_P(Faulty, IsRefusedInOneLineThatSaysWhy) {
  const fs::path file = built(std::string("faulty_") + GetParam().name);
  try {
    load_plugin(file);
    FAIL() << "it is loaded";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input) << message;
    EXPECT_TRUE(message.starts_with("plug-in " + file.string() + ": ")) << message;
    EXPECT_NE(message.find(GetParam().words), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Plugins, Faulty,
    testing::Values(Fault{"allocates", "allocates memory (malloc) in a tick"},
                    Fault{"frees", "frees memory (free) in a tick"},
                    Fault{"locks", "takes a lock (pthread_mutex_lock) in a tick"},
                    Fault{"sleeps", "sleeps (clock_nanosleep) in a tick"},
                    Fault{"loops", "does not come back"}, Fault{"writes", "opens a file (openat) in a tick"},
                    Fault{"connects", "opens a socket (socket) in a tick"}, Fault{"slow", "is too slow"},
                    Fault{"nan_value", "a value that is not finite"}, Fault{"negative", "a negative value"},
                    Fault{"remembers", "something else for the same bone"},
                    Fault{"reads_clock", "something else for the same bone"},
                    Fault{"crashes", "crashes: Segmentation fault"}, Fault{"aborts", "crashes: Aborted"},
                    Fault{"other_abi", "made for interface 99"}, Fault{"short_struct", "struct_size"},
                    Fault{"bad_name", "needs a name"}, Fault{"empty_one", "neither feed model nor score"},
                    Fault{"hangs_at_start", "while it is loaded and tried: CPU time limit exceeded"}),
    [](const auto& fault) { return std::string(fault.param.name); });

/// A copy that the test may spoil.
class PluginFile : public testing::Test {
 protected:
  PluginFile() { fs::copy_file(built("faulty_nothing"), file_); }

  const test::TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "plugin.so";
};

TEST_F(PluginFile, IsLoadedWithWhatTheTrialSaw) {
  const Plugin plugin = load_plugin(file_);
  EXPECT_EQ(plugin.identity.name, "faulty");
  EXPECT_EQ(plugin.identity.version, "0.1");
  EXPECT_EQ(plugin.identity.sha256.size(), 64u);
  EXPECT_EQ(plugin.trial.at("feed").at("ticks"), trial_ticks);
  EXPECT_LE(plugin.trial.at("feed").at("p99_us").get<double>(), feed_budget_us);
  EXPECT_NE(in_words(plugin).find("faulty 0.1 (sha256 " + plugin.identity.sha256.substr(0, 16)),
            std::string::npos);
}

TEST_F(PluginFile, MayBeWrittenByItsOwnerAlone) {
  for (const mode_t mode : {0666, 0775}) {
    ::chmod(file_.c_str(), mode);
    test::expect_error(ErrorKind::invalid_input, "can be written by others", [&] { load_plugin(file_); });
  }
  ::chmod(file_.c_str(), 0755);
  EXPECT_NO_THROW(load_plugin(file_));
}

TEST_F(PluginFile, LiesWhereOthersCannotReplaceIt) {
  const fs::path open = folder_.path() / "open", inner = open / "inner", file = inner / "own.so";
  fs::create_directories(inner);
  fs::copy_file(file_, file);
  fs::create_directory_symlink(inner, folder_.path() / "link");
  EXPECT_NO_THROW(load_plugin(file));
  for (const mode_t mode : {0757, 0775}) {
    ::chmod(open.c_str(), mode);
    for (const fs::path& path : {file, folder_.path() / "link/own.so"})
      test::expect_error(ErrorKind::invalid_input,
                         "its folder " + open.string() + " can be written by others",
                         [&] { load_plugin(path); });
  }
  // Nobody takes away what is another's.
  ::chmod(open.c_str(), 01777);
  EXPECT_NO_THROW(load_plugin(file));
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder to another user";
  ASSERT_EQ(::chown(open.c_str(), 12345, 12345), 0);
  test::expect_error(ErrorKind::invalid_input, "its folder " + open.string() + " belongs to another user",
                     [&] { load_plugin(file); });
}

TEST_F(PluginFile, BelongsToWhoRunsItOrToRoot) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
  ASSERT_EQ(::chown(file_.c_str(), 12345, 12345), 0);
  test::expect_error(ErrorKind::invalid_input, "belongs to another user", [&] { load_plugin(file_); });
}

TEST_F(PluginFile, IsASharedObject) {
  test::expect_error(ErrorKind::not_found, "No such file", [&] { load_plugin(folder_.path() / "none.so"); });
  test::expect_error(ErrorKind::invalid_input, "no regular file", [&] { load_plugin(folder_.path()); });
  const fs::path text = folder_.write("text.so", "not a program\n");
  test::expect_error(ErrorKind::invalid_input, "no shared object that can be loaded here",
                     [&] { load_plugin(text); });
  const fs::path other = test::build_folder() + "/tests/support/libfake_dhd.so";
  test::expect_error(ErrorKind::invalid_input, "exports no constant `ream_plugin`",
                     [&] { load_plugin(other); });
}

TEST(FeedTemplate, HasTheLawOfEdgeToTheBit) {
  const Plugin plugin = load_plugin(built("feed_model"));
  force::FeedSettings settings;
  settings.spindle_rad_s *= 0.7;
  settings.specimen_factor = 1.07;
  settings.cutting.edge_threshold_share = 0.3;
  const force::EdgeFeedModel edge(settings, {});
  settings.plugin = plugin.identity;
  const force::Lip no_lip{};
  test::expect_error(ErrorKind::conflict, "was made with plug-in edge-law 1.0 (sha256 ",
                     [&] { force::make_feed_model(settings, no_lip); });
  offer(plugin);
  const auto model = force::make_feed_model(settings, no_lip);
  for (int i = 1; i < 500; ++i) {
    force::EngagedBone bone{{0.5, 0.5, 0.0}, {0.4, 1.5, 0.0}, 3.0 * i, 0.31 * i, 0.7 + 0.01 * i};
    const auto ours = edge.load(bone, 0.9 * i - 20.0), theirs = model->load(bone, 0.9 * i - 20.0);
    ASSERT_EQ(ours.resistance_n_s_mm, theirs.resistance_n_s_mm) << i;
    ASSERT_EQ(ours.torque_arm_mm, theirs.torque_arm_mm);
    ASSERT_EQ(ours.tangential_ratio, theirs.tangential_ratio);
  }
  settings.plugin->sha256[0] = settings.plugin->sha256[0] == '0' ? '1' : '0';
  test::expect_error(ErrorKind::conflict, "the one that was given is plug-in edge-law 1.0",
                     [&] { force::make_feed_model(settings, no_lip); });
  test::expect_error(ErrorKind::conflict, "both have a feed model", [&] { offer(plugin); });
}

TEST(ScoreTemplate, JudgesMetricsAndSaysWhatIsMissing) {
  const Plugin plugin = load_plugin(built("score"));
  offer(plugin);
  const auto score = score::plugin_score_json({{"depth_error_mm", -0.5}, {"axial_thrust_peak_n", 150.0}});
  EXPECT_EQ(score.at("plugin").at("sha256"), plugin.identity.sha256);
  EXPECT_EQ(score.at("points"), 80.0);
  EXPECT_EQ(score.at("outcome"), "pass");
  EXPECT_EQ(score.at("lines"),
            nlohmann::json({"0.5 mm beside the planned depth", "push less: 150 N at most"}));
  const auto nothing = score::plugin_score_json({{"depth_error_mm", nullptr}});
  EXPECT_EQ(nothing.at("outcome"), "undecided");

  nlohmann::json kept = {{"plugin_score", score}};
  EXPECT_NO_THROW(score::require_same_plugin(kept));
  EXPECT_NO_THROW(score::require_same_plugin({{"points", 3}}));
  kept["plugin_score"]["plugin"]["version"] = "0.9";
  test::expect_error(ErrorKind::conflict, "depth-alone 0.9", [&] { score::require_same_plugin(kept); });
}

TEST(DeviceTemplate, IsListedWithItsLimitsAndFeelsForce) {
  const Plugin plugin = load_plugin(built("device"));
  offer(plugin);
  const device::DeviceInfo offer_info = device::device_kind("steady-hand").offer({});
  EXPECT_TRUE(offer_info.usable);
  EXPECT_EQ(offer_info.force_max_n, 3.3);
  EXPECT_EQ(device::device_profile("steady-hand").stiffness_max_n_mm, 0.4);
  test::expect_error(ErrorKind::conflict, "steady-hand", [&] { offer(plugin); });
}

}  // namespace
}  // namespace ream::plugin
