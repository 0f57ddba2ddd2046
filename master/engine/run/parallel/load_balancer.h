// Load balancing: which units step on which thread, and whether threads are worthwhile.
#ifndef STRIDE_MASTER_ENGINE_RUN_PARALLEL_LOAD_BALANCER_H
#define STRIDE_MASTER_ENGINE_RUN_PARALLEL_LOAD_BALANCER_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace stride::core {

/// The units of one thread, by their positions in the step order, in that order.
using ThreadShare = std::vector<std::size_t>;

/// Shares out `positions` among at most `threads` threads, so that the longest share is short:
/// units that are bound to the first thread, then the others, the most expensive first, each to the
/// thread with the least load (Graham, "Bounds on Multiprocessing Timing Anomalies", 1969). Equal
/// costs are taken in the order of the positions. `costs` and `main_only` are indexed by position.
std::vector<ThreadShare> balance_load(std::span<const std::size_t> positions,
                                      std::span<const std::chrono::nanoseconds> costs,
                                      std::span<const char> main_only, std::size_t threads);

/// Measures communication steps and decides how the next ones are made. At first all units step one
/// after another, and the time of each is measured. Where the expected gain is well above the cost
/// of a hand-over to threads, serial and parallel steps race: they alternate for some steps each,
/// and the faster way is kept. All of it is repeated, less often where threads were not worthwhile.
///
/// The race decides, since only it includes units that wait for each other's locks, shared memory,
/// and the load of other programs.
///
/// For each communication step: shares() for each stage, record_cost() for each unit while
/// is_measuring(), then end_step(). Used by one thread.
class LoadBalancer {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  struct Plan {
    std::vector<std::vector<std::size_t>>
        stages;                   ///< positions in the step order that step together
    std::vector<char> main_only;  ///< by position
    std::size_t threads = 1;
    bool always = false;
    /// Measures a hand-over; called only where the shares promise a gain that could pay for it.
    std::function<Nanoseconds()> hand_over;
  };

  /// Communication steps in which units are measured; fewer where they take long.
  static constexpr std::size_t kMeasured = 16;
  /// Turns of a race, every second one on threads, and how long one of them takes at least.
  static constexpr std::size_t kTurns = 8;
  static constexpr Nanoseconds kTurn = std::chrono::microseconds(2500);
  /// A decision holds for so many times the communication steps that it took. Each time that it
  /// goes against threads it holds twice as long as before, up to the second number.
  static constexpr std::uint64_t kHoldFactor = 64;
  static constexpr std::uint64_t kLargestHoldFactor = 4096;

  explicit LoadBalancer(Plan plan);

  std::size_t threads() const { return plan_.threads; }
  /// Whether the time of this communication step has to be passed to end_step().
  bool is_deciding() const { return phase_ == Phase::Measuring || phase_ == Phase::Racing; }
  /// Whether the time of each unit has to be passed to record_cost(); all step on one thread then.
  bool is_measuring() const { return phase_ == Phase::Measuring; }
  /// Whether any stage of this communication step is made on several threads.
  bool is_parallel() const { return parallel_; }

  /// How the stage is made: one share for each thread, or none if its units step one after another.
  std::span<const ThreadShare> shares(std::size_t stage) const {
    return parallel_ ? std::span<const ThreadShare>(shares_[stage])
                     : std::span<const ThreadShare>();
  }

  void record_cost(std::size_t position, Nanoseconds cost) { costs_[position] += cost; }
  /// Ends the communication step. `elapsed`: the time of its unit steps, while is_deciding().
  void end_step(Nanoseconds elapsed = {}) {
    if (is_deciding()) return record_step(elapsed);
    if (phase_ == Phase::Decided && --steps_ == 0) begin_measuring();
  }

 private:
  enum class Phase { Fixed, Measuring, Racing, Decided };

  struct Pace {
    Nanoseconds time{};
    std::uint64_t steps = 0;
  };

  void record_step(Nanoseconds elapsed);
  void begin_measuring();
  void begin_turn(std::size_t turn);
  void decide(bool parallel);
  void measure();
  void race();
  bool share_stages();
  bool is_parallel_faster() const;

  Plan plan_;
  Phase phase_ = Phase::Fixed;
  bool parallel_ = false;
  std::vector<std::vector<ThreadShare>>
      shares_;                      ///< by stage; empty where threads are not worthwhile
  std::vector<Nanoseconds> costs_;  ///< by position, of the present communication step
  std::vector<std::vector<Nanoseconds>> samples_;  ///< by position
  std::size_t turn_ = 0;
  Pace turn_pace_;           ///< of the present turn, or while measuring
  Pace paces_[2]{};          ///< of all turns: one after another, on threads
  std::uint64_t steps_ = 0;  ///< that the present decision has taken, or until the next one
  std::uint64_t hold_factor_ = kHoldFactor;
};

}  // namespace stride::core

#endif
