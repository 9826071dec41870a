#include "sim/cpu_allocator.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace ream::sim {

std::vector<int> allowed_cpus() {
  std::vector<int> cpus;
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
      if (CPU_ISSET(cpu, &set)) cpus.push_back(cpu);
  if (cpus.empty()) cpus.push_back(0);
  return cpus;
}

CpuAllocator::CpuAllocator(std::vector<int> cpus) : cpus_(std::move(cpus)) {}

CpuAllocator::Reservation::Reservation(CpuAllocator& allocator, std::string session, int cpu, double tick_us)
    : allocator_(allocator), session_(std::move(session)), cpu_(cpu), tick_us_(tick_us) {}

CpuAllocator::Reservation::~Reservation() {
  const std::lock_guard lock(allocator_.mutex_);
  std::erase(allocator_.reservations_, this);
}

void CpuAllocator::Reservation::measured(double tick_p99_us, uint64_t ticks, uint64_t missed) {
  const std::lock_guard lock(allocator_.mutex_);
  tick_us_ = std::max(tick_us_, tick_p99_us);
  counts_.push_back({ticks, missed});
  // The oldest that is kept is the last from before the watched ticks.
  while (counts_.size() > 2 && counts_[1].ticks + watched_ticks <= ticks) counts_.pop_front();
}

double CpuAllocator::Reservation::missed_share() const {
  if (counts_.size() < 2) return 0.0;
  const uint64_t ticks = counts_.back().ticks - counts_.front().ticks;
  const uint64_t missed = counts_.back().missed - counts_.front().missed;
  return ticks == 0 ? 0.0 : static_cast<double>(missed) / static_cast<double>(ticks);
}

double CpuAllocator::load_us(int cpu) const {
  double sum_us = 0.0;
  for (const Reservation* reservation : reservations_)
    if (reservation->cpu_ == cpu) sum_us += reservation->tick_us_;
  return sum_us;
}

std::unique_ptr<CpuAllocator::Reservation> CpuAllocator::reserve(const std::string& session, double tick_us) {
  const std::lock_guard lock(mutex_);
  for (const Reservation* reservation : reservations_)
    if (reservation->missed_share() > too_many_missed) {
      std::ostringstream text;
      text.precision(2);
      text << "session " << reservation->session_ << " already misses " << 100.0 * reservation->missed_share()
           << " % of its ticks; another would make it worse. Stop one first";
      throw Error(ErrorKind::unavailable, text.str());
    }
  const int cpu =
      *std::min_element(cpus_.begin(), cpus_.end(), [this](int a, int b) { return load_us(a) < load_us(b); });
  const double load = load_us(cpu);
  if (load > 0.0 && load + tick_us > shared_cpu_us) {
    std::ostringstream text;
    text << "this session needs " << std::lround(tick_us)
         << " us of each millisecond, and on the least loaded of " << cpus_.size()
         << (cpus_.size() == 1 ? " processor" : " processors") << " running sessions use "
         << std::lround(load) << " us of " << std::lround(shared_cpu_us)
         << "; they would begin to miss ticks. Stop one first";
    throw Error(ErrorKind::unavailable, text.str());
  }
  std::unique_ptr<Reservation> reservation(new Reservation(*this, session, cpu, tick_us));
  reservations_.push_back(reservation.get());
  return reservation;
}

}  // namespace ream::sim
