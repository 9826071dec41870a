#include "api/job_service.hpp"

#include <gtest/gtest.h>

#include <future>
#include <latch>
#include <thread>

#include "support/expect_error.hpp"

namespace ream::api {
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
  const JobRecord first = jobs.submit("import", "a", [&](const Progress& progress) {
    progress(0.25, "reading slices");
    begun.count_down();
    may_end.wait();
  });
  const JobRecord second = jobs.submit("build", "b", [](const Progress&) {});
  begun.wait();
  EXPECT_EQ(jobs.get(first.id).state, JobState::running);
  EXPECT_DOUBLE_EQ(jobs.get(first.id).share, 0.25);
  EXPECT_EQ(jobs.get(first.id).step, "reading slices");
  EXPECT_EQ(jobs.get(second.id).state, JobState::waiting);
  may_end.count_down();
  EXPECT_EQ(ended(jobs, second.id).state, JobState::done);
  EXPECT_EQ(jobs.get(first.id).state, JobState::done);
  EXPECT_DOUBLE_EQ(jobs.get(first.id).share, 1.0);
  ASSERT_EQ(jobs.list("").size(), 2u);
  EXPECT_EQ(jobs.list("").front().id, second.id);
  ASSERT_EQ(jobs.list("a").size(), 1u);
  EXPECT_EQ(jobs.list("a").front().id, first.id);
}

TEST(JobService, OneAtATimeOnACase) {
  JobService jobs;
  std::latch may_end(1);
  const JobRecord first = jobs.submit("import", "a", [&](const Progress&) { may_end.wait(); });
  EXPECT_TRUE(jobs.busy("a"));
  EXPECT_FALSE(jobs.busy("b"));
  test::expect_error(ErrorKind::conflict, "other work on case 'a' is not done; wait for it or cancel it",
                     [&] { jobs.submit("build", "a", [](const Progress&) {}); });
  may_end.count_down();
  ended(jobs, first.id);
  EXPECT_FALSE(jobs.busy("a"));
  EXPECT_EQ(ended(jobs, jobs.submit("build", "a", [](const Progress&) {}).id).state, JobState::done);
}

TEST(JobService, CancelledWorkEndsAtItsNextStep) {
  JobService jobs;
  std::latch begun(1);
  const JobRecord job = jobs.submit("segmentation", "a", [&](const Progress& progress) {
    begun.count_down();
    while (true) progress(0.5, "working");
  });
  const JobRecord waiting = jobs.submit("build", "b", [](const Progress&) { FAIL() << "it was cancelled"; });
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
      "import", "a", [](const Progress&) { throw Error(ErrorKind::invalid_input, "x.nii is cut short"); });
  EXPECT_EQ(ended(jobs, refused.id).state, JobState::failed);
  EXPECT_EQ(jobs.get(refused.id).problem, "x.nii is cut short");
  EXPECT_EQ(jobs.get(refused.id).problem_kind, ErrorKind::invalid_input);
  const JobRecord starved = jobs.submit("import", "a", [](const Progress&) { throw std::bad_alloc(); });
  EXPECT_EQ(ended(jobs, starved.id).problem, "there is not enough memory for this work");
  const JobRecord odd =
      jobs.submit("import", "a", [](const Progress&) { throw std::runtime_error("secret words"); });
  EXPECT_EQ(ended(jobs, odd.id).problem, "the work failed; the server's log says why");
}

TEST(JobService, ShutDownCancelsWhatRunsAndTakesNothingMore) {
  JobService jobs;
  std::latch begun(1);
  const JobRecord job = jobs.submit("import", "a", [&](const Progress& progress) {
    begun.count_down();
    while (true) progress(0.5, "working");
  });
  begun.wait();
  jobs.shut_down();
  jobs.shut_down();
  EXPECT_EQ(jobs.get(job.id).state, JobState::cancelled);
  test::expect_error(ErrorKind::unavailable, "the server is stopping",
                     [&] { jobs.submit("import", "b", [](const Progress&) {}); });
  test::expect_error(ErrorKind::not_found, "no job 'x'; GET /api/v1/jobs lists them", [&] { jobs.get("x"); });
}

}  // namespace
}  // namespace ream::api
