#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <thread>

#include "bench/bench.hpp"
#include "bench/hostile/hostile_files.hpp"
#include "bench/machine_rows.hpp"
#include "bench/served_reaming.hpp"
#include "bench/side_process.hpp"
#include "core/error.hpp"
#include "ct/read/read_ct.hpp"
#include "isolation/sandbox.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

namespace fs = std::filesystem;

constexpr double hostile_turn_s = 5.0;
constexpr int fewest_turns = 10;
constexpr uint64_t hostile_goal = 1000;
constexpr double tick_ratio_goal = 1.1, more_server_memory_goal_mb = 64.0;
constexpr size_t longest_refusal = 1200;
constexpr uint64_t max_volume_bytes = 48 << 20;  // as the server takes of a file of 1 MB

/// How files ended. Plain data that goes through a pipe.
struct Outcomes {
  uint64_t files = 0, read = 0, refused = 0;
  uint64_t odd = 0;     ///< neither read nor refused in one line that names the file
  uint64_t leaked = 0;  ///< gave back values of a file that no reader may open

  double share_of(uint64_t part) const {
    return files > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(files) : 0.0;
  }
};

bool is_one_line_about(const std::string& words, const fs::path& file) {
  return !words.empty() && words.size() < longest_refusal && words.find('\n') == std::string::npos &&
         words.find(file.filename().string()) != std::string::npos;
}

/// As the server reads an upload.
void read_hostile(const fs::path& file, const fs::path& scratch, Outcomes& outcomes) {
  ct::ReadOptions options;
  options.max_bytes = max_volume_bytes;
  options.scratch = scratch;
  ++outcomes.files;
  try {
    const ct::HuVolume volume = ct::read_ct(file, options);
    ++outcomes.read;
    if (HostileFiles::holds_forbidden(volume.hu)) ++outcomes.leaked;
  } catch (const Error& error) {
    ++outcomes.refused;
    const bool kind = error.kind() == ErrorKind::invalid_input || error.kind() == ErrorKind::not_found;
    if (kind && is_one_line_about(error.what(), file)) return;
    ++outcomes.odd;
    std::cerr << "hostile: " << error.what() << '\n';
  } catch (const std::exception& error) {
    ++outcomes.odd;
    std::cerr << "hostile: " << file << ": " << error.what() << '\n';
  }
}

/// Feeds damaged files one after another while it lives.
class Feeder {
 public:
  Feeder(HostileFiles& files, const fs::path& scratch, Outcomes& outcomes)
      : thread_([this, &files, scratch, &outcomes] {
          while (!over_) read_hostile(files.next_damaged(), scratch, outcomes);
        }) {}
  ~Feeder() {
    over_ = true;
    thread_.join();
  }
  Feeder(const Feeder&) = delete;
  Feeder& operator=(const Feeder&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

struct Turns {
  std::vector<double> p99_us;
  double peak_memory_mb = 0.0;

  void add(const ServedTurn& turn) {
    p99_us.push_back(turn.loop.tick_us.p99_us);
    peak_memory_mb = std::max(peak_memory_mb, turn.peak_memory_mb);
  }
  double median_us() const {
    std::vector<double> values = p99_us;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }
};

/// What large claims cost: memory of the process that asks (as the server does), and of the reader.
struct BombFigures {
  Outcomes bombs, thieves;
  double asking_mb = 0.0;  ///< more than before, at the most
  double reader_mb = 0.0, free_mb = 0.0;
  bool untouched = false;
};

double status_mb(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key)) return std::stod(line.substr(key.size())) / 1024.0;
  return 0.0;
}

BombFigures throw_bombs() {
  BombFigures figures;
  const test::TemporaryFolder folder;
  const HostileFiles files(folder.path());
  fs::create_directory(folder.path() / "scratch");
  const auto bombs = files.bombs(), thieves = files.thieves();
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak counts from here
  const double before_mb = status_mb("/proc/self/status", "VmRSS:");
  figures.free_mb = status_mb("/proc/meminfo", "MemAvailable:");
  for (const fs::path& file : bombs) read_hostile(file, folder.path() / "scratch", figures.bombs);
  for (const fs::path& file : thieves) read_hostile(file, folder.path() / "scratch", figures.thieves);
  figures.asking_mb = status_mb("/proc/self/status", "VmHWM:") - before_mb;
  rusage readers{};
  ::getrusage(RUSAGE_CHILDREN, &readers);
  figures.reader_mb = static_cast<double>(readers.ru_maxrss) / 1024.0;
  figures.untouched = files.forbidden_is_untouched() && fs::is_empty(folder.path() / "scratch");
  return figures;
}

void serve_bombs(int in, int out) {
  for (int order = 0; ::read(in, &order, sizeof order) == sizeof order;) {
    const BombFigures figures = throw_bombs();
    if (::write(out, &figures, sizeof figures) != sizeof figures) return;
  }
}

void add_bomb_rows(const BombFigures& found, std::vector<Row>& rows) {
  constexpr auto at_least = Goal::at_least;
  const Outcomes& bombs = found.bombs;
  const Outcomes& thieves = found.thieves;
  rows.push_back(
      {"hostile", "files of 1 MB that unpack to or claim gigabytes", double(bombs.files), 0.0, ""});
  rows.push_back({"hostile", "of these refused in one line", bombs.share_of(bombs.refused - bombs.odd), 0.0,
                  "%", 100.0, at_least});
  rows.push_back({"hostile", "of these, memory of the process that asks, more at the most", found.asking_mb,
                  0.0, "MB", more_server_memory_goal_mb});
  rows.push_back({"hostile", "of these, memory of the reader at the most; its limit: 3/4 of what is free",
                  found.reader_mb, 0.0, "MB", 0.75 * found.free_mb});
  rows.push_back({"hostile", "volumes whose header names another file", double(thieves.files), 0.0, ""});
  rows.push_back({"hostile", "of these refused in one line, or read without a value of that file",
                  thieves.share_of(thieves.files - thieves.leaked - thieves.odd), 0.0, "%", 100.0, at_least});
  rows.push_back({"hostile", "nothing outside written, nothing of the readers left (1: so)",
                  found.untouched ? 1.0 : 0.0, 0.0, "", 1.0, at_least});
  rows.push_back({"hostile", "version of this kernel's Landlock",
                  static_cast<double>(isolation::sandbox_support().landlock), 0.0, "", 1.0, at_least});
}

void add_session_rows(const Turns& beside, const Turns& alone, const Outcomes& damaged,
                      std::vector<Row>& rows) {
  rows.push_back({"hostile", "damaged small CTs fed one after another", double(damaged.files), 0.0, "",
                  double(hostile_goal), Goal::at_least});
  rows.push_back({"hostile", "of these refused", damaged.share_of(damaged.refused), 0.0, "%"});
  rows.push_back({"hostile", "of these read, or refused in one line",
                  damaged.share_of(damaged.files - damaged.odd - damaged.leaked), 0.0, "%", 100.0,
                  Goal::at_least});
  const std::string name = "thesis-5-4-2 served beside these and (baseline) alone, medians of " +
                           std::to_string(alone.p99_us.size()) + " turns each, tick p99";
  rows.push_back(
      {"hostile", name, beside.median_us(), alone.median_us(), "us", tick_ratio_goal * alone.median_us()});
  rows.push_back({"hostile", "memory of the server beside these and (baseline) alone, at the most",
                  beside.peak_memory_mb, alone.peak_memory_mb, "MB",
                  alone.peak_memory_mb + more_server_memory_goal_mb});
}

}  // namespace

std::vector<Row> hostile_suite(const Options&) {
  const SideProcess bomber(serve_bombs);  // its memory is not that of the bone
  StreamViewer viewer;
  bomber.send(0);
  const auto bombs = bomber.receive<BombFigures>();
  const test::TemporaryFolder folder;
  HostileFiles files(folder.path());
  const fs::path scratch = folder.path() / "scratch";
  fs::create_directory(scratch);
  ServedReaming served(sim::Realtime::attempt, hostile_turn_s);
  Turns alone, beside;
  Outcomes damaged;
  served.run(viewer);  // the first maps memory
  for (int turn = 0; turn < fewest_turns || damaged.files < hostile_goal; ++turn) {
    alone.add(served.run(viewer));
    std::unique_ptr<Feeder> feeding;
    beside.add(served.run(viewer,
                          [&](const Door&) { feeding = std::make_unique<Feeder>(files, scratch, damaged); }));
  }
  std::vector<Row> rows;
  add_bomb_rows(bombs, rows);
  add_session_rows(beside, alone, damaged, rows);
  add_machine_rows(rows);
  return rows;
}

}  // namespace ream::bench
