#include "api/job_service.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "api/new_id.hpp"
#include "core/log.hpp"

namespace ream::api {
namespace {

constexpr size_t most_waiting = 16, most_kept = 64;

/// Work on a case never takes a processor from a haptic loop or a viewer's stream.
void give_way() {
  const sched_param lowest{};
  ::sched_setscheduler(0, SCHED_BATCH, &lowest);
}

bool is_open(JobState state) { return state == JobState::waiting || state == JobState::running; }

}  // namespace

struct JobService::Job {
  JobRecord record;
  Work work;
  std::atomic<bool> cancel_wanted{false};
};

std::string to_text(JobState state) {
  switch (state) {
    case JobState::waiting:
      return "waiting";
    case JobState::running:
      return "running";
    case JobState::done:
      return "done";
    case JobState::failed:
      return "failed";
    case JobState::cancelled:
      return "cancelled";
  }
  return "failed";
}

JobService::JobService() : thread_([this] { work(); }) {}

JobService::~JobService() { shut_down(); }

void JobService::shut_down() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    for (const auto& job : jobs_) job->cancel_wanted = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool JobService::busy_locked(const std::string& case_id) const {
  return std::any_of(jobs_.begin(), jobs_.end(), [&](const auto& job) {
    return job->record.case_id == case_id && is_open(job->record.state);
  });
}

bool JobService::busy(const std::string& case_id) const {
  const std::lock_guard lock(mutex_);
  return busy_locked(case_id);
}

JobRecord JobService::submit(const std::string& kind, const std::string& case_id, Work work) {
  const std::lock_guard lock(mutex_);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  if (busy_locked(case_id))
    throw Error(ErrorKind::conflict,
                "other work on case '" + case_id + "' is not done; wait for it or cancel it");
  const auto waiting =
      std::count_if(jobs_.begin(), jobs_.end(), [](const auto& job) { return is_open(job->record.state); });
  if (waiting >= static_cast<std::ptrdiff_t>(most_waiting))
    throw Error(ErrorKind::unavailable, "too much work waits already; try again later");
  const auto job = std::make_shared<Job>();
  job->record = {random_id(),   kind, case_id, JobState::waiting, 0.0, "waiting for its turn",
                 ErrorKind::io, {}};
  job->work = std::move(work);
  jobs_.push_back(job);
  while (jobs_.size() > most_kept && !is_open(jobs_.front()->record.state)) jobs_.pop_front();
  changed_.notify_all();
  return job->record;
}

std::shared_ptr<JobService::Job> JobService::find(const std::string& id) const {
  for (const auto& job : jobs_)
    if (job->record.id == id) return job;
  throw Error(ErrorKind::not_found, "no job '" + id + "'; GET /api/v1/jobs lists them");
}

JobRecord JobService::get(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return find(id)->record;
}

std::vector<JobRecord> JobService::list(const std::string& case_id) const {
  const std::lock_guard lock(mutex_);
  std::vector<JobRecord> records;
  for (auto job = jobs_.rbegin(); job != jobs_.rend(); ++job)
    if (case_id.empty() || (*job)->record.case_id == case_id) records.push_back((*job)->record);
  return records;
}

JobRecord JobService::cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto job = find(id);
  job->cancel_wanted = true;
  if (job->record.state == JobState::waiting) job->record.state = JobState::cancelled;
  return job->record;
}

void JobService::work() {
  give_way();
  std::unique_lock lock(mutex_);
  while (true) {
    const auto next = std::find_if(jobs_.begin(), jobs_.end(),
                                   [](const auto& job) { return job->record.state == JobState::waiting; });
    if (closed_) return;
    if (next == jobs_.end()) {
      changed_.wait(lock);
      continue;
    }
    const auto job = *next;
    job->record.state = JobState::running;
    lock.unlock();
    run(job);
    lock.lock();
  }
}

void JobService::end(Job& job, JobState state, ErrorKind kind, const std::string& problem) {
  const std::lock_guard lock(mutex_);
  job.record.state = state;
  job.record.problem_kind = kind;
  job.record.problem = problem;
  if (state == JobState::done) job.record.share = 1.0;
}

void JobService::run(const std::shared_ptr<Job>& job) {
  const Progress progress = [this, job](double share, std::string_view step) {
    if (job->cancel_wanted)
      throw Error(ErrorKind::cancelled, "the work on case '" + job->record.case_id + "' was cancelled");
    const std::lock_guard lock(mutex_);
    job->record.share = std::clamp(share, 0.0, 1.0);
    job->record.step = step;
  };
  try {
    progress(0.0, "beginning");
    const Work work = std::exchange(job->work, {});
    work(progress);
    end(*job, JobState::done, ErrorKind::io, {});
  } catch (const Error& error) {
    const bool cancelled = error.kind() == ErrorKind::cancelled;
    end(*job, cancelled ? JobState::cancelled : JobState::failed, error.kind(),
        cancelled ? "" : error.what());
  } catch (const std::bad_alloc&) {
    end(*job, JobState::failed, ErrorKind::unavailable, "there is not enough memory for this work");
  } catch (const std::exception& failure) {
    log::warn(std::string("work on case ") + job->record.case_id + " failed: " + failure.what());
    end(*job, JobState::failed, ErrorKind::io, "the work failed; the server's log says why");
  }
}

}  // namespace ream::api
