// How a thread rounds, what it does with the smallest numbers, and how it accesses memory.
#ifndef STRIDE_MASTER_BASE_PROCESS_PROCESSOR_MODE_H
#define STRIDE_MASTER_BASE_PROCESS_PROCESSOR_MODE_H

#include <cfenv>
#include <cstdint>
#include <string>

namespace stride::core {

/// The direction of rounding, whether subnormal numbers become 0, which exceptions raise a signal,
/// the precision of the x87 unit, and, on x86-64, the direction of string instructions and whether
/// accesses to memory have to be aligned. Each thread has its own; a new one begins with that of
/// the thread that starts it. Flags of exceptions that have occurred are no part of it.
class ProcessorMode {
 public:
  /// That of the calling thread.
  [[gnu::always_inline]] static ProcessorMode present() noexcept {
    ProcessorMode mode;
#if defined(__x86_64__)
    mode.sse_ = __builtin_ia32_stmxcsr() & ~kFlags;
    asm volatile("fnstcw %0" : "=m"(mode.x87_));
    mode.flags_ = __builtin_ia32_readeflags_u64() & (kBackward | kAligned);
#elif defined(__aarch64__)
    asm volatile("mrs %0, fpcr" : "=r"(mode.control_));
#else
    mode.rounding_ = std::fegetround();
#endif
    return mode;
  }

  /// Whether the calling thread has it: some nanoseconds.
  [[gnu::always_inline]] bool is_present() const noexcept {
#if defined(__x86_64__)
    std::uint16_t x87;  // in this order: the first takes longest, and the others go on meanwhile
    const std::uint32_t sse = __builtin_ia32_stmxcsr();
    asm volatile("fnstcw %0" : "=m"(x87));
    const std::uint64_t flags = __builtin_ia32_readeflags_u64();
    return (((sse ^ sse_) & ~kFlags) | std::uint32_t(x87 ^ x87_) |
            ((flags ^ flags_) & (kBackward | kAligned))) == 0;
#else
    return present() == *this;
#endif
  }
  /// Whether is_almost_present() can be used: it rounds to nearest and keeps subnormal numbers.
  bool is_usual() const noexcept;
  /// As is_present(), in a third of the time: from what becomes of numbers. What it does not see
  /// are Signals, unless exceptions of x87 raise signals, too; those of inexact results and
  /// subnormal numbers are raised by it.
  [[gnu::always_inline]] bool is_almost_present() const noexcept {
#if defined(__x86_64__)
    std::uint16_t x87;
    asm volatile("fnstcw %0" : "=m"(x87));
    const std::uint64_t flags = __builtin_ia32_readeflags_u64();
    double one = 1, small = 0x1p-60, least = 0x1p-1074;
    asm volatile("" : "+x"(one), "+x"(small), "+x"(least));  // computed here, not by the compiler
    const bool is_same =
        (std::uint32_t(x87 ^ x87_) | ((flags ^ flags_) & (kBackward | kAligned))) == 0;
    return is_same && one + small == one && one - small == one && least + least != 0;
#else
    return is_present();
#endif
  }
  /// What is_almost_present() does not see: which exceptions of SSE raise signals.
  class Signals {
   public:
    /// Those of the calling thread. Costs less than to read and compare them at once.
    [[gnu::always_inline]] void note() noexcept {
#if defined(__x86_64__)
      asm volatile("stmxcsr %0" : "=m"(sse_));
#endif
    }
    bool operator==(const Signals& other) const noexcept {
      return ((sse_ ^ other.sse_) & kMasks) == 0;
    }

   private:
    friend ProcessorMode;
    static constexpr std::uint32_t kMasks = 0x1f80;  ///< Intel's manual, volume 1, 10.2.3
    std::uint32_t sse_ = 0;
  };
  Signals signals() const noexcept {
    Signals signals;
#if defined(__x86_64__)
    signals.sse_ = sse_;
#endif
    return signals;
  }
  /// Gives it to the calling thread.
  void set() const noexcept;
  /// Empties the registers of the x87 unit, which are those of MMX, too: a function that returns
  /// has to leave them empty, or the next one that uses them gets NaN. About a nanosecond.
  static void empty_registers() noexcept {
#if defined(__x86_64__)
    asm volatile("emms" : : : "st", "st(1)", "st(2)", "st(3)", "st(4)", "st(5)", "st(6)", "st(7)");
#endif
  }
  /// Whether they are empty: some hundred nanoseconds.
  static bool are_registers_empty() noexcept;
  /// What another mode does differently, in words: "rounding upward".
  std::string differences(const ProcessorMode& other) const;

#if defined(__x86_64__)
  [[gnu::always_inline]] bool operator==(const ProcessorMode& other) const {
    return ((sse_ ^ other.sse_) | (x87_ ^ other.x87_) | (flags_ ^ other.flags_)) == 0;
  }
#else
  bool operator==(const ProcessorMode&) const = default;
#endif

 private:
  int rounding() const noexcept;
  bool flushes_to_zero() const noexcept;
  bool goes_backward() const noexcept;
  bool needs_alignment() const noexcept;

#if defined(__x86_64__)
  static constexpr std::uint32_t kFlags = 0x3f;
  static constexpr std::uint64_t kBackward = 1 << 10, kAligned = 1 << 18;  ///< of RFLAGS
  std::uint32_t sse_ = 0;
  std::uint16_t x87_ = 0;
  std::uint64_t flags_ = 0;
#elif defined(__aarch64__)
  std::uint64_t control_ = 0;
#else
  int rounding_ = FE_TONEAREST;
#endif
};

/// Gives the calling thread this mode, for as long as it lives.
class ProcessorModeScope {
 public:
  explicit ProcessorModeScope(const ProcessorMode& mode) noexcept { mode.set(); }
  ~ProcessorModeScope() { before_.set(); }
  ProcessorModeScope(const ProcessorModeScope&) = delete;
  ProcessorModeScope& operator=(const ProcessorModeScope&) = delete;

 private:
  const ProcessorMode before_ = ProcessorMode::present();
};

}  // namespace stride::core

#endif
