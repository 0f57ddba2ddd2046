#include <optional>

#include <catch2/catch.hpp>

#include "master/trace/compress.h"
#include "master/trace/expand.h"
#include "master/trace/info.h"
#include "master/util/error.h"
#include "tests/fuzz/mutator.h"
#include "tests/master/ssp/support.h"
#include "tests/master/trace/random_trace.h"

using namespace stride;
using namespace stride::trace;

namespace {

constexpr std::nullopt_t kMinGap = std::nullopt;  // the default suits all time scales

/// A small trace of a device that skips.
const std::string kSkipping =
    "$date today $end $version SystemC $end\n$timescale\n  1 ps\n$end\n$scope module SystemC $end\n"
    "$var wire 64 aaaaa advanceTime [63:0] $end\n$var real 1 aaaab v $end\n"
    "$scope module m $end $var wire 1 aaaac b $end $var string 1 % s $end\n$upscope $end\n"
    "$upscope $end\n$enddefinitions  $end\n\n$comment\nAll initial values $end\n\n"
    "$dumpvars\nb0 aaaaa\nr0 aaaab\nxaaaac\n$end\n\n#20000\n1aaaac\nr0.1 aaaab\n\n"
    "#3000000\nb1011101001 aaaaa\n0aaaac\nstext %\n\n$dumpoff xaaaac $end\n#3000010\n"
    "b1111101001 aaaaa\n0aaaac\n#4000000\n";

/// What has happened to the mutants so far.
struct Outcomes {
  int good = 0;
  int refused = 0;
};

/// Calls work(), which may throw an input error that names this file, and nothing else.
template <class Work>
void attempt(const std::filesystem::path& file, Outcomes& outcomes, Work&& work) {
  try {
    work();
    ++outcomes.good;
  } catch (const core::Error& error) {
    ++outcomes.refused;
    CHECK(error.kind() == core::Error::Kind::Input);
    CHECK(error.context().where.file == file.string());
  }
}

class TraceCommands {
 public:
  explicit TraceCommands(const tests::TemporaryFolder& folder)
      : folder_(folder), short_(folder / "short.vcd"), long_(folder / "long.vcd") {}

  void try_all(const std::string& text, CutOff cut_off) {
    // replacing a file makes some file systems wait for the disk
    for (const auto& old : {folder_ / "x.vcd", short_, long_}) std::filesystem::remove(old);
    const auto file = folder_.write("x.vcd", text);
    attempt(file, inspected, [&] { info(file, kMinGap, cut_off); });
    attempt(file, expanded, [&] {
      expand(file, long_, cut_off);
      check_same(info(file, kMinGap, cut_off), info(long_, kMinGap, CutOff::Refuse));
    });
    attempt(file, compressed, [&] {
      compress(file, short_, kMinGap, cut_off);
      std::filesystem::remove(long_);
      check_same(info(file, kMinGap, cut_off), info(short_, kMinGap, CutOff::Refuse));
      expand(short_, long_, CutOff::Refuse);
      check_same(info(file, kMinGap, cut_off), info(long_, kMinGap, CutOff::Refuse));
    });
    CHECK_FALSE(std::filesystem::exists(folder_ / "short.vcd.new"));
    CHECK_FALSE(std::filesystem::exists(folder_ / "long.vcd.new"));
  }

  Outcomes inspected, expanded, compressed;

 private:
  static void check_same(const Info& found, const Info& expected) {
    CHECK(found.changes == expected.changes);
    CHECK(found.instants == expected.instants);
    CHECK(found.gaps == expected.gaps);
  }

  const tests::TemporaryFolder& folder_;
  std::filesystem::path short_;
  std::filesystem::path long_;
};

constexpr const char* kAlphabet = "#$01xzbrs!\"\n 9-";

}  // namespace

TEST_CASE("A mutated trace of a device that skips is read or refused, and never anything else") {
  const tests::TemporaryFolder folder;
  TraceCommands commands(folder);
  commands.try_all(kSkipping, CutOff::Refuse);
  REQUIRE(commands.expanded.good == 1);
  tests::Mutator mutator(20240201, kAlphabet);
  for (int i = 0; i < 4000; ++i) {
    const std::string text = mutator.mutate(kSkipping);
    INFO(text);
    commands.try_all(text, i % 2 == 0 ? CutOff::Refuse : CutOff::Accept);
  }
  CHECK(commands.inspected.good > 300);
  CHECK(commands.inspected.refused > 1000);
  CHECK(commands.expanded.good > 300);
  CHECK(commands.expanded.refused > 1000);
  CHECK(commands.compressed.good > 5);  // those whose advanceTime has another name now
}

TEST_CASE("A mutated trace of any simulator is read or refused, and never anything else") {
  const tests::TemporaryFolder folder;
  TraceCommands commands(folder);
  tests::Mutator mutator(20240202, kAlphabet);
  for (unsigned i = 0; i < 1000; ++i) {
    const RandomTrace trace(i % 100);
    const std::string text = mutator.mutate(i % 2 == 0 ? trace.text() : trace.untidy_text());
    commands.try_all(text, i % 3 == 0 ? CutOff::Accept : CutOff::Refuse);
  }
  CHECK(commands.compressed.good > 50);
  CHECK(commands.compressed.refused > 100);
  CHECK(commands.expanded.good == 0);
}
