#include "master/base/process/processor_mode.h"

namespace stride::core {
namespace {

const char* rounding_name(int rounding) {
  switch (rounding) {
    case FE_DOWNWARD:
      return "rounding downward";
    case FE_UPWARD:
      return "rounding upward";
    case FE_TOWARDZERO:
      return "rounding toward zero";
    default:
      return "rounding to nearest";
  }
}

}  // namespace

#if defined(__x86_64__)

// Intel 64 and IA-32 Architectures Software Developer's Manual, volume 1, 10.2.3: the bits of
// MXCSR; those of rounding are three higher than in the control word of x87, whose values the FE_
// constants are.
int ProcessorMode::rounding() const noexcept {
  return static_cast<int>((sse_ >> 3) & FE_TOWARDZERO);
}

bool ProcessorMode::flushes_to_zero() const noexcept { return (sse_ & 0x8040) != 0; }

void ProcessorMode::set() const noexcept {
  __builtin_ia32_ldmxcsr((__builtin_ia32_stmxcsr() & kFlags) | sse_);
  asm volatile("fldcw %0" : : "m"(x87_));
  const std::uint64_t flags = __builtin_ia32_readeflags_u64();
  __builtin_ia32_writeeflags_u64((flags & ~(kBackward | kAligned)) | flags_);
}

bool ProcessorMode::are_registers_empty() noexcept {
  struct {
    std::uint32_t control, status, tags, rest[4];
  } environment{};
  asm volatile("fnstenv %0\n\tfldenv %0" : "+m"(environment));  // storing masks exceptions
  return (environment.tags & 0xffff) == 0xffff;
}

bool ProcessorMode::goes_backward() const noexcept { return (flags_ & kBackward) != 0; }
bool ProcessorMode::needs_alignment() const noexcept { return (flags_ & kAligned) != 0; }

#elif defined(__aarch64__)

// Arm Architecture Reference Manual, FPCR: RMode are the bits 22 and 23, as the FE_ constants; FZ
// is bit 24.
int ProcessorMode::rounding() const noexcept { return static_cast<int>(control_ & FE_TOWARDZERO); }

bool ProcessorMode::flushes_to_zero() const noexcept {
  return (control_ & (std::uint64_t{1} << 24)) != 0;
}

void ProcessorMode::set() const noexcept { asm volatile("msr fpcr, %0" : : "r"(control_)); }

#else

int ProcessorMode::rounding() const noexcept { return rounding_; }
bool ProcessorMode::flushes_to_zero() const noexcept { return false; }
void ProcessorMode::set() const noexcept { std::fesetround(rounding_); }

#endif

#if !defined(__x86_64__)
bool ProcessorMode::are_registers_empty() noexcept { return true; }
bool ProcessorMode::goes_backward() const noexcept { return false; }
bool ProcessorMode::needs_alignment() const noexcept { return false; }
#endif

bool ProcessorMode::is_usual() const noexcept {
  return rounding() == FE_TONEAREST && !flushes_to_zero();
}

std::string ProcessorMode::differences(const ProcessorMode& other) const {
  std::string text;
  const auto add = [&](const char* difference) {
    if (!text.empty()) text += ", ";
    text += difference;
  };
  if (other.rounding() != rounding()) add(rounding_name(other.rounding()));
  if (other.flushes_to_zero() != flushes_to_zero()) {
    add(other.flushes_to_zero() ? "subnormal numbers become 0, as after linking with -ffast-math"
                                : "subnormal numbers do not become 0");
  }
  if (other.goes_backward() != goes_backward()) {
    add(other.goes_backward() ? "the direction flag is set: string instructions run backward"
                              : "string instructions run forward");
  }
  if (other.needs_alignment() != needs_alignment()) {
    add(other.needs_alignment() ? "the flag AC is set: accesses to memory have to be aligned"
                                : "accesses to memory need not be aligned");
  }
  if (text.empty() && other != *this) add("other exceptions or another precision");
  return text;
}

}  // namespace stride::core
