#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace ream::sim {

/// CPUs that this process may use; never empty.
std::vector<int> allowed_cpus();

/// Which haptic loop runs on which CPU, and whether there is room for one more. Each loop has its CPU
/// (several may share one), and what it needs of it is measured: before it starts by a rehearsal
/// (sim/tick_trial.hpp), while it runs by itself. Thread-safe.
class CpuAllocator {
 public:
  /// Of each millisecond of a CPU at most so much is given to loops that share it: what is left is for the
  /// wait that is spun, the kernel, and everybody who follows the loops.
  static constexpr double shared_cpu_us = 700.0;
  /// A running loop that misses more than this share of its ticks shows that the machine is at its limit.
  static constexpr double too_many_missed = 0.02;
  /// Misses are counted over so many of the newest ticks.
  static constexpr uint32_t watched_ticks = 10'000;

  explicit CpuAllocator(std::vector<int> cpus = allowed_cpus());
  CpuAllocator(const CpuAllocator&) = delete;
  CpuAllocator& operator=(const CpuAllocator&) = delete;

  /// The share of a CPU that one loop has, until it is destroyed. The allocator outlives it.
  class Reservation {
   public:
    ~Reservation();
    Reservation(const Reservation&) = delete;
    Reservation& operator=(const Reservation&) = delete;

    int cpu() const { return cpu_; }
    /// What the loop says of itself, now and then: slow ticks (99th percentile), and ticks and misses since
    /// it began.
    void measured(double tick_p99_us, uint64_t ticks, uint64_t missed);

   private:
    friend class CpuAllocator;
    struct Count {
      uint64_t ticks, missed;
    };
    Reservation(CpuAllocator& allocator, std::string session, int cpu, double tick_us);
    double missed_share() const;

    CpuAllocator& allocator_;
    const std::string session_;
    const int cpu_;
    double tick_us_;  ///< the larger of rehearsed and measured; guarded by the allocator's mutex, as the next
    std::deque<Count> counts_;
  };

  /// A reservation on the least loaded CPU for a loop whose slow ticks take `tick_us`. Error unavailable,
  /// with the figures, when loops that run already would begin to miss, or do so.
  std::unique_ptr<Reservation> reserve(const std::string& session, double tick_us);

 private:
  double load_us(int cpu) const;

  const std::vector<int> cpus_;
  mutable std::mutex mutex_;
  std::vector<const Reservation*> reservations_;
};

}  // namespace ream::sim
