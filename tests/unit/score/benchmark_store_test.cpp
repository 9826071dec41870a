#include "score/benchmark_store.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/some_metrics.hpp"
#include "support/temporary_folder.hpp"

namespace ream::score {
namespace {

KeptBenchmark some_benchmark(const std::string& name) {
  KeptBenchmark made;
  made.benchmark = score::make_benchmark(
      name, {{"a", nullptr, test::some_metrics(1.0)}, {"b", nullptr, test::some_metrics(3.0)}});
  return made;
}

TEST(BenchmarkStore, GivesBackWhatItKeeps) {
  const test::TemporaryFolder folder;
  const BenchmarkStore store(folder.path() / "benchmarks");
  EXPECT_TRUE(store.list().empty());
  KeptBenchmark wanted = some_benchmark("Ours");
  wanted.novices = {"n1", "n2", "n3"};
  wanted.rubric = "standard@1";
  wanted.density = "kernel";
  wanted.cuts = {{{"of", "points"}, {"error", "no spread"}}};
  const KeptBenchmark kept = store.keep(wanted), read = store.get(kept.id);
  EXPECT_EQ(score::benchmark_json(read.benchmark), score::benchmark_json(wanted.benchmark));
  EXPECT_EQ(read.novices, wanted.novices);
  EXPECT_EQ(read.rubric, "standard@1");
  EXPECT_EQ(read.density, "kernel");
  EXPECT_EQ(read.cuts, wanted.cuts);
  EXPECT_EQ(read.created_utc, kept.created_utc);
  EXPECT_NE(store.keep(some_benchmark("Ours")).id, kept.id);
  EXPECT_EQ(store.list().size(), 2u);
}

TEST(BenchmarkStore, TakesAFileThatWasPutThereByHand) {
  const test::TemporaryFolder folder;
  const BenchmarkStore store(folder.path());
  folder.write("hand-made.json", score::benchmark_json(some_benchmark("By hand").benchmark).dump());
  folder.write("damaged.json", "{");
  folder.write("NOT AN ID.json", "{}");
  ASSERT_EQ(store.list().size(), 1u);
  EXPECT_EQ(store.get("hand-made").benchmark.name, "By hand");
  EXPECT_TRUE(store.get("hand-made").cuts.empty());
  test::expect_error(ErrorKind::invalid_input, "damaged.json", [&] { store.get("damaged"); });
}

TEST(BenchmarkStore, KnowsNoFilesElsewhere) {
  const test::TemporaryFolder folder;
  folder.write("secret.json", score::benchmark_json(some_benchmark("Secret").benchmark).dump());
  const BenchmarkStore store(folder.path() / "benchmarks");
  for (const char* id : {"../secret", "nothing", ""})
    test::expect_error(ErrorKind::not_found, "no benchmark", [&] { store.get(id); });
  const BenchmarkStore nowhere{std::filesystem::path()};
  EXPECT_TRUE(nowhere.list().empty());
  test::expect_error(ErrorKind::not_found, "no benchmark", [&] { nowhere.get("secret"); });
  test::expect_error(ErrorKind::unavailable, "keeps no", [&] { nowhere.keep(some_benchmark("x")); });
}

}  // namespace
}  // namespace ream::score
