#include "master/base/process/processor_mode.h"

#include <limits>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/build.h"

using stride::core::ProcessorMode;
using stride::core::ProcessorModeScope;

namespace {

/// Not known to the compiler.
double third() {
  volatile double one = 1, three = 3;
  return one / three;
}

}  // namespace

TEST_CASE("a mode is put back, and what another one does is said") {
  const ProcessorMode usual = ProcessorMode::present();
  const double expected = third();
  CHECK(usual.is_present());
  std::fesetround(FE_UPWARD);
  const ProcessorMode upward = ProcessorMode::present();
  CHECK_FALSE(usual.is_present());
  CHECK(third() != expected);
  usual.set();
  CHECK(usual.is_present());
  CHECK(third() == expected);
  CHECK(std::fegetround() == FE_TONEAREST);
  CHECK(usual.differences(upward) == "rounding upward");
  CHECK(upward.differences(usual) == "rounding to nearest");
  CHECK(usual.differences(usual).empty());
}

TEST_CASE("the quick comparison sees all that changes numbers") {
  const ProcessorMode usual = ProcessorMode::present();
  CHECK(usual.is_usual());
  CHECK(usual.is_almost_present());
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(rounding);
    const bool is_seen = !usual.is_almost_present();
    const bool is_usual = ProcessorMode::present().is_usual();
    usual.set();
    CHECK(is_seen);
    CHECK_FALSE(is_usual);
  }
#if defined(__x86_64__)
  // of SSE alone: rounding up, down, and to zero; results that become 0, and arguments
  for (const unsigned bits : {0x4000U, 0x2000U, 0x6000U, 0x8000U, 0x0040U}) {
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | bits);
    const bool is_seen = !usual.is_almost_present();
    usual.set();
    INFO(bits);
    CHECK(is_seen);
  }
  ::feenableexcept(FE_DIVBYZERO);
  const bool is_seen = !usual.is_almost_present();
  usual.set();
  CHECK(is_seen);
#endif
}

#if defined(__x86_64__)
TEST_CASE("registers that are left in use are emptied") {
  volatile long double one = 1, three = 3;
  const bool is_by_mmx = GENERATE(true, false);
  CHECK(ProcessorMode::are_registers_empty());
  if (is_by_mmx) {
    asm volatile("pxor %mm0, %mm0");
  } else {
    asm volatile("fld1");
  }
  const bool are_empty = ProcessorMode::are_registers_empty();
  ProcessorMode::empty_registers();
  CHECK_FALSE(are_empty);
  CHECK(ProcessorMode::are_registers_empty());
  CHECK(static_cast<double>(one / three) == third());
}

struct FlagCase {
  unsigned bit;
  const char* words;
};

std::vector<FlagCase> flag_cases() {
  std::vector<FlagCase> cases{
      {1U << 10, "the direction flag is set: string instructions run backward"}};
  if (!stride::tests::kSanitized) {  // AddressSanitizer's own accesses are not aligned
    cases.push_back({1U << 18, "the flag AC is set: accesses to memory have to be aligned"});
  }
  return cases;
}

TEST_CASE("the direction of string instructions and the check of alignment are parts of it") {
  const auto [bit, words] = GENERATE(from_range(flag_cases()));
  const ProcessorMode usual = ProcessorMode::present();
  __builtin_ia32_writeeflags_u64(__builtin_ia32_readeflags_u64() | bit);
  const ProcessorMode left = ProcessorMode::present();
  const bool is_almost_present = usual.is_almost_present();
  usual.set();
  CHECK(usual.is_present());
  CHECK_FALSE(is_almost_present);
  CHECK(usual.differences(left) == words);
}

TEST_CASE("flushing of subnormal numbers, exceptions and the precision of x87 are parts of it") {
  const ProcessorMode usual = ProcessorMode::present();
  const unsigned bit = GENERATE(0x8000U, 0x0040U, 0x0200U);
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | bit);
  const ProcessorMode flushing = ProcessorMode::present();
  const bool is_present = usual.is_present();
  usual.set();
  CHECK(is_present == (bit == 0x0200U));  // that exception raises no signal as it is
  if (bit != 0x0200U) {
    CHECK(usual.differences(flushing) ==
          "subnormal numbers become 0, as after linking with -ffast-math");
  }
  const unsigned short single_precision = 0x007f;
  asm volatile("fldcw %0" : : "m"(single_precision));
  const ProcessorMode single = ProcessorMode::present();
  usual.set();
  CHECK(usual.differences(single) == "other exceptions or another precision");
  ::feenableexcept(FE_DIVBYZERO);
  CHECK_FALSE(usual.is_present());
  usual.set();
  CHECK(::fegetexcept() == 0);
}
#endif

TEST_CASE("exceptions that have occurred are no part of it, and stay noted") {
  std::feclearexcept(FE_ALL_EXCEPT);
  const ProcessorMode usual = ProcessorMode::present();
  third();
  CHECK(usual.is_present());
  usual.set();
  CHECK(std::fetestexcept(FE_INEXACT) != 0);
}

TEST_CASE("a scope gives a mode to its thread and no other") {
  const ProcessorMode usual = ProcessorMode::present();
  std::fesetround(FE_DOWNWARD);
  {
    const ProcessorModeScope scope(usual);
    CHECK(std::fegetround() == FE_TONEAREST);
  }
  CHECK(std::fegetround() == FE_DOWNWARD);
  usual.set();
  std::thread([] { std::fesetround(FE_UPWARD); }).join();
  CHECK(usual.is_present());
}
