#include "app/cli/doctor.hpp"

#include <sys/statvfs.h>
#include <sys/timex.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <thread>

#include "app/numbers.hpp"
#include "app/open_database.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file_lock.hpp"
#include "core/page_folder.hpp"
#include "gpu/device.hpp"
#include "isolation/isolated_job.hpp"
#include "isolation/sandbox.hpp"
#include "net/listener.hpp"
#include "net/router.hpp"
#include "render/snapshot.hpp"
#include "sim/realtime.hpp"
#include "store/database_url.hpp"
#include "store/migrations.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;
using State = Finding::State;

constexpr double bytes_of_gb = 1e9;
/// A session of ten minutes, with its case and what an upload needs meanwhile, fits into the first; a day of
/// sessions into the second.
constexpr double least_free_gb = 1.0, enough_free_gb = 10.0;
constexpr size_t timer_ticks = 1000;
/// Half of a tick: later wake-ups delay forces that a hand can feel.
constexpr double late_us = 500.0;

Finding examine_page(const DoctorRequest& request) {
  const fs::path folder = page_folder(request.web);
  if (folder.empty())
    return {"page", State::remark, "The page is not built; only the API would be served.", "scripts/build"};
  return {"page", State::good, "The page is in " + folder.string() + ".", ""};
}

/// A fault where the program is not there; `where` is what comes before its path.
std::optional<Finding> missing_helper(const char* subject, const char* name, const std::string& where) {
  const fs::path program = isolation::helper_program(name);
  if (::access(program.c_str(), X_OK) == 0) return std::nullopt;
  return Finding{subject, State::fault, where + program.string() + ".",
                 "install ream again, or run scripts/build"};
}

Finding examine_reader(const DoctorRequest& /*request*/) {
  if (auto missing = missing_helper("reader", isolation::reader_name,
                                    "The program that reads files from outside is not at "))
    return *missing;
  const isolation::SandboxSupport support = isolation::sandbox_support();
  if (support.landlock > 0 && support.seccomp)
    return {"reader", State::good, "Files from outside are read in a closed process.", ""};
  return {
      "reader", State::remark, isolation::sandbox_in_words(support),
      "use a kernel of 5.13 or newer, with landlock among its security modules (lsm=landlock,... at boot)"};
}

Finding examine_pictures(const DoctorRequest& /*request*/) {
  if (auto missing =
          missing_helper("pictures", isolation::renderer_name, "The program that draws pictures is not at "))
    return *missing;
  // A triangle before the camera: only for one the driver compiles what it draws with.
  const TriangleMesh triangle{{Vec3f(1, -1, -1), Vec3f(1, 1, -1), Vec3f(1, 0, 2)}, {{0, 1, 2}}, {}};
  const auto middle = [](const std::vector<render::Layer>& layers) {
    const render::Image image = render::draw(layers, {}, 3, 3);
    return std::vector<uint8_t>(image.rgba.begin() + 4 * 4, image.rgba.begin() + 4 * 5);
  };
  try {
    if (middle({{&triangle, {}, {0, 0, 0}, 1.0f, nullptr}}) != middle({}))
      return {"pictures", State::good, "Pictures for reports can be drawn.", ""};
    return {"pictures", State::remark, "Pictures for reports come out empty.",
            "try another version of libosmesa6"};
  } catch (const Error& e) {
    return {"pictures", State::remark, std::string("Reports have no pictures: ") + e.what() + ".",
            "see that temporary files can be written, and that nothing forbids programs to run code that "
            "they make"};
  }
}

/// The nearest folder above that is there.
fs::path existing_part(fs::path folder) {
  std::error_code failed;
  folder = fs::absolute(folder, failed);
  while (!fs::exists(folder, failed) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

Finding examine_data(const DoctorRequest& request) {
  std::error_code failed;
  const bool is_there = fs::exists(request.data, failed);
  const fs::path there = existing_part(request.data);
  const std::string name = request.data.string();
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    return {"data folder", State::fault, "This user cannot write to " + there.string() + ".",
            "run as the user of the server, or choose another folder with --data"};
  if (const std::string open = data_folder_warning(request.data); !open.empty())
    return {"data folder", State::remark, "Other users of this machine can look into " + name + ".",
            "chmod 700 " + name};
  if (FileLock::held(serving_lock(request.data)))
    return {"data folder", State::good, "A server runs on " + name + ".", ""};
  return {"data folder", State::good,
          name + (is_there ? " can be written to." : " is made when the server starts."), ""};
}

Finding examine_space(const DoctorRequest& request) {
  struct statvfs system {};
  const fs::path there = existing_part(request.data);
  if (::statvfs(there.c_str(), &system) != 0)
    return {"disk", State::remark, "The free space of " + there.string() + " cannot be told.",
            "df " + there.string()};
  const double free_gb =
      static_cast<double>(system.f_bavail) * static_cast<double>(system.f_frsize) / bytes_of_gb;
  const State state = free_gb < least_free_gb    ? State::fault
                      : free_gb < enough_free_gb ? State::remark
                                                 : State::good;
  return {"disk", state, rounded(free_gb, 1) + " GB are free for " + request.data.string() + ".",
          state == State::good ? "" : "free some space, or choose another folder with --data"};
}

Finding examine_database(const DoctorRequest& request) {
  const std::string url = database_url(request.db, request.data);
  const store::DatabaseUrl parsed = store::parse_database_url(url);
  if (!store::is_there(parsed))
    return {"database", State::good, parsed.shown + " is made when the server starts.", ""};
  const size_t missing = store::missing_migrations(url);
  if (missing > 0)
    return {"database", State::remark,
            parsed.shown + " is of an older version; the server brings it up to date when it starts.",
            "ream backup FILE, before you start the server"};
  return {"database", State::good, parsed.shown + " answers.", ""};
}

/// To open a database brings its tables up to date, so that one of an older version is not asked.
bool may_have_users(const DoctorRequest& request) {
  const size_t missing = store::missing_migrations(database_url(request.db, request.data));
  if (missing == store::migrations().size()) return false;
  return missing > 0 || has_users(request.db, request.data);
}

/// Binds where the server would, unless it does so already.
Finding examine_address(const DoctorRequest& request) {
  const net::ListenOptions options = listen_options(request.address, may_have_users(request));
  const std::string url = server_url(request.address, request.address.port);
  if (!FileLock::held(serving_lock(request.data))) {
    const net::Router router;
    const net::Listener listener(router, options);
  }
  if (options.tls)
    if (const std::string soon = net::TlsContext(*options.tls).warning(); !soon.empty())
      return {"address", State::remark, soon + ".", "get a new certificate"};
  return {"address", State::good, "The server's address is " + url + ".", ""};
}

Finding examine_opencl(const DoctorRequest& /*request*/) {
  const std::vector<gpu::Device> devices = gpu::list_devices();
  if (devices.empty())
    return {"OpenCL", State::remark, "No OpenCL device; the processor computes, with the same results.",
            "apt install pocl-opencl-icd, or the OpenCL driver of your graphics card"};
  std::string names;
  for (const gpu::Device& device : devices)
    if (names.find(device.name) == std::string::npos) names += (names.empty() ? "" : ", ") + device.name;
  return {"OpenCL", State::good, "OpenCL has " + names + ".", ""};
}

Finding examine_processors(const DoctorRequest& /*request*/) {
  const unsigned count = std::thread::hardware_concurrency();
  if (count < 2)
    return {"processor", State::remark, "One processor only: sessions miss ticks while anything else runs.",
            "give this machine two processors or more"};
  return {"processor", State::good, std::to_string(count) + " processors.", ""};
}

/// Lateness of wake-ups at 1 kHz, in us, as the haptic loop asks for them; nothing when the kernel refuses.
struct TimerTrial {
  sim::RealtimeGrant grant;
  double median_us = 0, p99_us = 0;
};

TimerTrial try_timer() {
  TimerTrial trial;
  std::vector<double> late;
  late.reserve(timer_ticks);
  std::thread loop([&] {
    trial.grant = sim::ask_for_realtime(sim::Realtime::attempt, -1);
    sim::TickClock clock;
    for (size_t i = 0; i < timer_ticks; ++i) late.push_back(clock.wait());
  });
  loop.join();
  std::sort(late.begin(), late.end());
  trial.median_us = late[late.size() / 2];
  trial.p99_us = late[late.size() * 99 / 100];
  return trial;
}

Finding examine_realtime(const DoctorRequest& /*request*/) {
  const TimerTrial trial = try_timer();
  const std::string measured = "1,000 ticks of 1 ms were " + rounded(trial.median_us, 0) +
                               " us late in the median, " + rounded(trial.p99_us, 0) +
                               " us in the 99th percentile.";
  if (!trial.grant.fifo || !trial.grant.locked)
    return {
        "real time", State::remark,
        std::string("No right to ") + (trial.grant.fifo ? "lock memory. " : "real-time priority. ") +
            measured,
        "LimitRTPRIO=95 and LimitMEMLOCK=infinity in the service, or 'USER - rtprio 95' and 'USER - memlock "
        "unlimited' in /etc/security/limits.d/ream.conf"};
  if (trial.p99_us > late_us)
    return {
        "real time", State::remark, measured,
        "run nothing else on this machine, and set its processors to performance: cpupower frequency-set -g "
        "performance"};
  return {"real time", State::good, measured, ""};
}

Finding examine_clock(const DoctorRequest& /*request*/) {
  struct timex state {};
  if (::adjtimex(&state) != TIME_ERROR && (state.status & STA_UNSYNC) == 0)
    return {"clock", State::good, "The clock is synchronised.", ""};
  return {"clock", State::remark,
          "The clock is not synchronised; the times of sessions and of the audit log need it.",
          "timedatectl set-ntp true"};
}

/// What an examination could not find out is a fault with the error's words.
Finding examined(const char* subject, const std::function<Finding(const DoctorRequest&)>& examine,
                 const DoctorRequest& request) {
  try {
    return examine(request);
  } catch (const std::exception& e) {
    return {subject, State::fault, e.what(), ""};
  }
}

}  // namespace

std::vector<Finding> examine_machine(const DoctorRequest& request) {
  return {examined("page", examine_page, request),
          examined("reader", examine_reader, request),
          examined("pictures", examine_pictures, request),
          examined("data folder", examine_data, request),
          examined("disk", examine_space, request),
          examined("database", examine_database, request),
          examined("address", examine_address, request),
          examined("OpenCL", examine_opencl, request),
          examined("processor", examine_processors, request),
          examined("real time", examine_realtime, request),
          examined("clock", examine_clock, request)};
}

}  // namespace ream::app
