#include "jobs/job_service.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/clock.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "core/signal_handlers.hpp"
#include "core/temporary_file.hpp"
#include "core/thread_pool.hpp"

namespace ream::jobs {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_waiting = 16;
/// Progress is announced no more often than this.
constexpr int64_t announce_interval_ns = 500'000'000;

std::string about(const JobOrder& order) {
  if (!order.case_id.empty()) return "the work on case '" + order.case_id + "'";
  if (!order.session_id.empty()) return "the work on session '" + order.session_id + "'";
  return "the work";
}

}  // namespace

struct JobService::Job {
  JobRecord record;
  Work work;  ///< until it runs
  std::atomic<bool> cancel_wanted{false};
  int64_t announced_ns = 0;
};

std::string to_text(JobState state) {
  switch (state) {
    case JobState::waiting: return "waiting";
    case JobState::running: return "running";
    case JobState::done: return "done";
    case JobState::failed: return "failed";
    case JobState::cancelled: return "cancelled";
  }
  return "failed";
}

bool is_open(JobState state) { return state == JobState::waiting || state == JobState::running; }

JobService::JobService(JobOptions options) : options_(std::move(options)) {
  if (!options_.folder.empty()) remove_tree(options_.folder);
  thread_ = start_thread([this] { work(); });
}

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

fs::path JobService::folder_of(const Job& job) const { return options_.folder / job.record.id; }

void JobService::notify(const JobRecord& record) const {
  try {
    if (options_.on_change) options_.on_change(record);
  } catch (...) {
    log::current_exception("a change of a job could not be announced");
  }
}

bool JobService::busy_locked(const std::string& case_id) const {
  return std::any_of(jobs_.begin(), jobs_.end(), [&](const auto& job) {
    return job->record.order.case_id == case_id && is_open(job->record.state);
  });
}

bool JobService::busy(const std::string& case_id) const {
  const std::lock_guard lock(mutex_);
  return busy_locked(case_id);
}

std::optional<JobRecord> JobService::open_on_session(const std::string& kind,
                                                     const std::string& session_id) const {
  const std::lock_guard lock(mutex_);
  for (const auto& job : jobs_)
    if (is_open(job->record.state) && job->record.order.kind == kind &&
        job->record.order.session_id == session_id)
      return job->record;
  return std::nullopt;
}

/// With the mutex held.
void JobService::forget_surplus() {
  while (jobs_.size() > options_.max_kept && !is_open(jobs_.front()->record.state)) {
    if (jobs_.front()->record.result) remove_tree(folder_of(*jobs_.front()));
    jobs_.pop_front();
  }
}

JobRecord JobService::add(const JobOrder& order, const std::shared_ptr<Job>& job) {
  JobRecord record;
  {
    const std::lock_guard lock(mutex_);
    if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
    if (!order.case_id.empty() && busy_locked(order.case_id))
      throw Error(ErrorKind::conflict,
                  "other work on case '" + order.case_id + "' is not done; wait for it or cancel it");
    const auto own = std::count_if(jobs_.begin(), jobs_.end(), [&](const auto& other) {
      return is_open(other->record.state) && other->record.order.counted_for == order.counted_for;
    });
    if (!order.counted_for.empty() && own >= static_cast<std::ptrdiff_t>(options_.of_caller))
      throw Error(ErrorKind::unavailable, std::to_string(options_.of_caller) +
                                              " jobs of yours wait or run, as many as you may have at once; "
                                              "wait for one or cancel it");
    const auto waiting = std::count_if(jobs_.begin(), jobs_.end(),
                                       [](const auto& other) { return is_open(other->record.state); });
    if (waiting >= static_cast<std::ptrdiff_t>(max_waiting))
      throw Error(ErrorKind::unavailable, "too much work waits already; try again later");
    job->record.id = random_id();
    job->record.number = ++submitted_;
    job->record.order = order;
    job->record.step = "waiting for its turn";
    job->record.created_utc = ream::utc_text(options_.now());
    jobs_.push_back(job);
    forget_surplus();
    record = job->record;
  }
  changed_.notify_all();
  notify(record);
  return record;
}

JobRecord JobService::submit(const JobOrder& order, Work work) {
  const auto job = std::make_shared<Job>();
  job->work = std::move(work);
  return add(order, job);
}

JobRecord JobService::submit_file(const JobOrder& order, FileWork work) {
  if (options_.folder.empty())
    throw Error(ErrorKind::unavailable, "this server has no folder for files that work makes");
  const auto job = std::make_shared<Job>();
  job->work = [this, &record = job->record, folder_work = std::move(work)](const Progress& progress) {
    const fs::path folder = options_.folder / record.id;
    make_writable_folder(folder);
    try {
      const MadeFile made = folder_work(folder, progress);
      const std::lock_guard lock(mutex_);
      record.result = JobResult{folder / made.name, made.media_type, fs::file_size(folder / made.name)};
    } catch (...) {
      remove_tree(folder);
      throw;
    }
  };
  return add(order, job);
}

std::shared_ptr<JobService::Job> JobService::find(const std::string& id) const {
  for (const auto& job : jobs_)
    if (job->record.id == id) return job;
  throw Error(ErrorKind::not_found, "no job '" + id + "'");
}

JobRecord JobService::get(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return find(id)->record;
}

std::vector<JobRecord> JobService::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<JobRecord> records;
  for (auto job = jobs_.rbegin(); job != jobs_.rend(); ++job) records.push_back((*job)->record);
  return records;
}

JobRecord JobService::cancel(const std::string& id) {
  JobRecord record;
  {
    const std::lock_guard lock(mutex_);
    const auto job = find(id);
    job->cancel_wanted = true;
    if (job->record.state != JobState::waiting) return job->record;
    job->record.state = JobState::cancelled;
    job->record.ended_utc = ream::utc_text(options_.now());
    record = job->record;
  }
  notify(record);
  return record;
}

void JobService::remove_old_results() {
  const std::string oldest = ream::utc_text(options_.now() - options_.results_kept);
  const std::lock_guard lock(mutex_);
  for (const auto& job : jobs_)
    if (job->record.result && job->record.ended_utc < oldest) {
      remove_tree(folder_of(*job));
      job->record.result.reset();
    }
}

void JobService::work() {
  lower_thread_priority();
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
    try {
      run(job);
    } catch (...) {
      log::current_exception("a job could not be ended in order");
    }
    lock.lock();
    if (is_open(job->record.state)) job->record.state = JobState::failed;
  }
}

void JobService::note_progress(Job& job, double share, std::string_view step) {
  const int64_t now_ns = steady_ns();
  const bool is_due = now_ns - job.announced_ns > announce_interval_ns;
  JobRecord record;
  {
    const std::lock_guard lock(mutex_);
    job.record.share = std::clamp(share, 0.0, 1.0);
    job.record.step = step;
    record = job.record;
  }
  if (!is_due) return;
  job.announced_ns = now_ns;
  notify(record);
}

void JobService::end(Job& job, JobState state, ErrorKind kind, const std::string& problem) {
  JobRecord record;
  {
    const std::lock_guard lock(mutex_);
    job.record.state = state;
    job.record.problem_kind = kind;
    job.record.problem = problem;
    job.record.ended_utc = ream::utc_text(options_.now());
    if (state == JobState::done) job.record.share = 1.0;
    record = job.record;
  }
  notify(record);
}

void JobService::run(const std::shared_ptr<Job>& job) {
  const Progress progress = [this, job](double share, std::string_view step) {
    if (job->cancel_wanted) throw Error(ErrorKind::cancelled, about(job->record.order) + " was cancelled");
    note_progress(*job, share, step);
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
    log::warn(about(job->record.order) + " failed: " + failure.what());
    end(*job, JobState::failed, ErrorKind::io, "the work failed; the server's log says why");
  } catch (...) {
    log::current_exception("a job failed");
    end(*job, JobState::failed, ErrorKind::io, "the work failed; the server's log says why");
  }
}

}  // namespace ream::jobs
