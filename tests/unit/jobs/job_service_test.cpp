#include "jobs/job_service.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <future>
#include <latch>
#include <thread>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::jobs {
namespace {

JobRecord ended(const JobService& jobs, const std::string& id) {
  while (true) {
    JobRecord job = jobs.get(id);
    if (job.state != JobState::waiting && job.state != JobState::running) return job;
    std::this_thread::yield();
  }
}

TEST(JobService, DoesWorkInTurnAndTellsHowFarItIs) {
  JobService jobs;
  std::latch begun(1), may_end(1);
  const JobRecord first = jobs.submit({"import", "a"}, [&](const Progress& progress) {
    progress(0.25, "reading slices");
    begun.count_down();
    may_end.wait();
  });
  const JobRecord second = jobs.submit({"build", "b"}, [](const Progress&) {});
  begun.wait();
  EXPECT_EQ(jobs.get(first.id).state, JobState::running);
  EXPECT_DOUBLE_EQ(jobs.get(first.id).share, 0.25);
  EXPECT_EQ(jobs.get(first.id).step, "reading slices");
  EXPECT_EQ(jobs.get(second.id).state, JobState::waiting);
  may_end.count_down();
  EXPECT_EQ(ended(jobs, second.id).state, JobState::done);
  EXPECT_EQ(jobs.get(first.id).state, JobState::done);
  EXPECT_DOUBLE_EQ(jobs.get(first.id).share, 1.0);
  ASSERT_EQ(jobs.list().size(), 2u);
  EXPECT_EQ(jobs.list().front().id, second.id);
  EXPECT_EQ(jobs.list().front().order.case_id, "b");
}

TEST(JobService, OneAtATimeOnACase) {
  JobService jobs;
  std::latch may_end(1);
  const JobRecord first = jobs.submit({"import", "a"}, [&](const Progress&) { may_end.wait(); });
  EXPECT_TRUE(jobs.busy("a"));
  EXPECT_FALSE(jobs.busy("b"));
  test::expect_error(ErrorKind::conflict, "other work on case 'a' is not done; wait for it or cancel it",
                     [&] {
                       jobs.submit({"build", "a"}, [](const Progress&) {});
                     });
  may_end.count_down();
  ended(jobs, first.id);
  EXPECT_FALSE(jobs.busy("a"));
  EXPECT_EQ(ended(jobs, jobs.submit({"build", "a"}, [](const Progress&) {}).id).state, JobState::done);
}

TEST(JobService, CancelledWorkEndsAtItsNextStep) {
  JobService jobs;
  std::latch begun(1);
  const JobRecord job = jobs.submit({"segmentation", "a"}, [&](const Progress& progress) {
    begun.count_down();
    while (true) progress(0.5, "working");
  });
  const JobRecord waiting =
      jobs.submit({"build", "b"}, [](const Progress&) { FAIL() << "it was cancelled"; });
  begun.wait();
  EXPECT_EQ(jobs.cancel(waiting.id).state, JobState::cancelled);
  jobs.cancel(job.id);
  EXPECT_EQ(ended(jobs, job.id).state, JobState::cancelled);
  EXPECT_EQ(jobs.get(job.id).problem, "");
  EXPECT_EQ(jobs.get(waiting.id).state, JobState::cancelled);
  EXPECT_EQ(jobs.cancel(job.id).state, JobState::cancelled);
}

TEST(JobService, AFailureKeepsItsReason) {
  JobService jobs;
  const JobRecord refused = jobs.submit(
      {"import", "a"}, [](const Progress&) { throw Error(ErrorKind::invalid_input, "x.nii is cut short"); });
  EXPECT_EQ(ended(jobs, refused.id).state, JobState::failed);
  EXPECT_EQ(jobs.get(refused.id).problem, "x.nii is cut short");
  EXPECT_EQ(jobs.get(refused.id).problem_kind, ErrorKind::invalid_input);
  const JobRecord starved = jobs.submit({"import", "a"}, [](const Progress&) { throw std::bad_alloc(); });
  EXPECT_EQ(ended(jobs, starved.id).problem, "there is not enough memory for this work");
  const JobRecord odd =
      jobs.submit({"import", "a"}, [](const Progress&) { throw std::runtime_error("secret words"); });
  EXPECT_EQ(ended(jobs, odd.id).problem, "the work failed; the server's log says why");
}

TEST(JobService, ShutDownCancelsWhatRunsAndTakesNothingMore) {
  JobService jobs;
  std::latch begun(1);
  const JobRecord job = jobs.submit({"import", "a"}, [&](const Progress& progress) {
    begun.count_down();
    while (true) progress(0.5, "working");
  });
  begun.wait();
  jobs.shut_down();
  jobs.shut_down();
  EXPECT_EQ(jobs.get(job.id).state, JobState::cancelled);
  test::expect_error(ErrorKind::unavailable, "the server is stopping", [&] {
    jobs.submit({"import", "b"}, [](const Progress&) {});
  });
  test::expect_error(ErrorKind::not_found, "no job 'x'", [&] { jobs.get("x"); });
}

class JobFilesTest : public testing::Test {
 protected:
  JobOptions options() {
    return {folder.path() / "jobs", std::chrono::hours(24), 2,
            [this](const JobRecord& job) {
              const std::lock_guard lock(mutex);
              told.push_back(to_text(job.state));
            },
            [this] { return now.load(); }};
  }
  static JobService::FileWork writing(const std::string& text) {
    return [text](const std::filesystem::path& place, const Progress&) {
      std::ofstream(place / "trace.csv") << text;
      return JobService::MadeFile{"trace.csv", "text/csv"};
    };
  }

  const test::TemporaryFolder folder;
  std::atomic<UtcMoment> now{utc_moment("2026-01-31T12:00:00Z")};
  std::mutex mutex;
  std::vector<std::string> told;
};

TEST_F(JobFilesTest, AFileIsKeptForADay) {
  folder.write("jobs/left/over.csv", "by an earlier server");
  JobService jobs(options());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "jobs/left"));
  const JobRecord done = ended(jobs, jobs.submit_file({"export", {}, "abcd2345"}, writing("a,b")).id);
  ASSERT_TRUE(done.result);
  EXPECT_EQ(done.result->media_type, "text/csv");
  EXPECT_EQ(done.result->bytes, 3u);
  EXPECT_EQ(read_text_file(done.result->path), "a,b");
  EXPECT_EQ(done.created_utc, "2026-01-31T12:00:00Z");
  now = now.load() + std::chrono::hours(23);
  jobs.remove_old_results();
  EXPECT_TRUE(jobs.get(done.id).result);
  now = now.load() + std::chrono::hours(2);
  jobs.remove_old_results();
  EXPECT_FALSE(jobs.get(done.id).result);
  EXPECT_FALSE(std::filesystem::exists(done.result->path));
}

TEST_F(JobFilesTest, WorkThatFailsLeavesNoFile) {
  JobService jobs(options());
  const JobRecord failed = ended(jobs, jobs.submit_file({"export", {}, "abcd2345"},
                                                        [](const auto& place, const Progress&) {
                                                          std::ofstream(place / "half.csv") << "a";
                                                          throw Error(ErrorKind::io, "the disk is full");
                                                          return JobService::MadeFile{};
                                                        })
                                           .id);
  EXPECT_EQ(failed.state, JobState::failed);
  EXPECT_FALSE(failed.result);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "jobs"));
}

TEST_F(JobFilesTest, OfManyJobsTheNewestAreKeptWithTheirFiles) {
  JobService jobs(options());
  std::vector<JobRecord> all;
  for (const char* text : {"1", "2", "3", "4"})
    all.push_back(ended(jobs, jobs.submit_file({"export", {}, "abcd2345"}, writing(text)).id));
  test::expect_error(ErrorKind::not_found, all[0].id, [&] { jobs.get(all[0].id); });
  EXPECT_FALSE(std::filesystem::exists(all[0].result->path));
  EXPECT_EQ(read_text_file(all[3].result->path), "4");
}

TEST_F(JobFilesTest, EveryChangeIsToldAndWorkOnASessionIsFound) {
  JobService jobs(options());
  std::latch may_end(1);
  const JobRecord first = jobs.submit({"mesh", {}, "abcd2345"}, [&](const Progress&) { may_end.wait(); });
  EXPECT_EQ(jobs.open_on_session("mesh", "abcd2345")->id, first.id);
  EXPECT_FALSE(jobs.open_on_session("mesh", "other"));
  EXPECT_FALSE(jobs.open_on_session("snapshot", "abcd2345"));
  jobs.cancel(jobs.submit({"import"}, [](const Progress&) {}).id);
  may_end.count_down();
  EXPECT_EQ(ended(jobs, first.id).state, JobState::done);
  EXPECT_FALSE(jobs.open_on_session("mesh", "abcd2345"));
  jobs.shut_down();
  for (const char* state : {"waiting", "running", "done", "cancelled"})
    EXPECT_NE(std::find(told.begin(), told.end(), state), told.end()) << state;
}

TEST(JobService, WhateverWorkThrowsItHasFailedAndTheNextIsDone) {
  struct Wordless {};
  JobOptions options;
  options.on_change = [](const JobRecord&) { throw Wordless(); };
  JobService jobs(options);
  const JobRecord first = jobs.submit({"import", "a"}, [](const Progress&) { throw Wordless(); });
  const JobRecord second = jobs.submit({"import", "b"}, [](const Progress&) {});
  EXPECT_EQ(ended(jobs, first.id).state, JobState::failed);
  EXPECT_EQ(ended(jobs, second.id).state, JobState::done) << "though nobody could be told";
}

}  // namespace
}  // namespace ream::jobs
