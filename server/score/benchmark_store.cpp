#include "score/benchmark_store.hpp"

#include <sys/stat.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_listing.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "core/text.hpp"

namespace ream::score {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

fs::path cuts_beside(const fs::path& benchmark) {
  return benchmark.parent_path() / (benchmark.stem().string() + ".cuts.json");
}

std::string changed_utc(const fs::path& file) {
  struct stat about {};
  ::stat(file.c_str(), &about);
  return utc_text(about.st_mtime);
}

json cuts_json(const KeptBenchmark& kept) {
  return {{"created_utc", kept.created_utc},
          {"novices", kept.novices},
          {"rubric", kept.rubric},
          {"density", kept.density},
          {"cuts", kept.cuts}};
}

}  // namespace

fs::path BenchmarkStore::file_of(const std::string& id) const {
  const fs::path file = folder_ / (id + ".json");
  std::error_code failed;
  if (folder_.empty() || !is_name(id) || !fs::is_regular_file(file, failed))
    throw Error(ErrorKind::not_found, "no benchmark '" + id + "'");
  return file;
}

KeptBenchmark BenchmarkStore::get(const std::string& id) const {
  const fs::path file = file_of(id);
  KeptBenchmark kept;
  kept.id = id;
  kept.benchmark = score::load_benchmark(file);
  kept.created_utc = changed_utc(file);
  std::error_code failed;
  if (!fs::exists(cuts_beside(file), failed)) return kept;
  const json about = read_json_file(cuts_beside(file));
  try {
    kept.created_utc = about.at("created_utc").get<std::string>();
    kept.novices = about.at("novices").get<std::vector<std::string>>();
    kept.rubric = about.at("rubric").get<std::string>();
    kept.density = about.at("density").get<std::string>();
    kept.cuts = about.at("cuts");
  } catch (const json::exception&) {
    throw Error(ErrorKind::invalid_input, cuts_beside(file).string() + " is not as benchmarks have it");
  }
  return kept;
}

std::vector<KeptBenchmark> BenchmarkStore::list() const {
  std::vector<KeptBenchmark> all;
  for (const fs::path& path : paths_in(folder_)) {
    const std::string id = path.stem().string();
    if (path.extension() != ".json" || !is_name(id)) continue;
    try {
      all.push_back(get(id));
    } catch (const Error& damage) {
      log::warn("benchmark " + id + " is left out: " + damage.what());
    }
  }
  std::sort(all.begin(), all.end(), [](const KeptBenchmark& a, const KeptBenchmark& b) {
    return a.created_utc != b.created_utc ? a.created_utc > b.created_utc : a.id < b.id;
  });
  return all;
}

KeptBenchmark BenchmarkStore::keep(KeptBenchmark wanted) const {
  if (folder_.empty()) throw Error(ErrorKind::unavailable, "this server keeps no benchmarks");
  make_writable_folder(folder_);
  std::error_code failed;
  do {
    wanted.id = random_id();
  } while (fs::exists(folder_ / (wanted.id + ".json"), failed));
  wanted.created_utc = utc_now();
  const fs::path file = folder_ / (wanted.id + ".json");
  write_json_file(cuts_beside(file), cuts_json(wanted));
  write_json_file(file, score::benchmark_json(wanted.benchmark));
  return wanted;
}

}  // namespace ream::score
