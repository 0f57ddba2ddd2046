// What holds for any trace.
#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>

#include "master/observe/trace/compress.h"
#include "master/observe/trace/expand.h"
#include "master/observe/trace/info.h"
#include "tests/master/observe/trace/random_trace.h"
#include "tests/master/observe/trace/support.h"

using namespace stride;
using namespace stride::trace;

namespace {

constexpr unsigned kSeeds = 300;

/// From a tick of any time scale on.
Duration gap_of(unsigned seed, const std::filesystem::path& file) {
  const int exponent = Reader(file).header().timescale.exponent;
  std::int64_t tick = 1;
  for (int i = -12; i < exponent; ++i) tick *= 10;
  const std::int64_t factors[] = {1, 2, 17, 1000, 100'000};
  return Duration(tick > 1'000'000'000'000 ? tick : tick * factors[seed % 5]);
}

/// The trace through both.
std::string there_and_back(const TemporaryFolder& folder, const std::string& text, unsigned seed) {
  // replacing a file makes some file systems wait for the disk
  for (const char* old : {"in.vcd", "short.vcd", "long.vcd"}) std::filesystem::remove(folder / old);
  const auto file = folder.write("in.vcd", text);
  compress(file, folder / "short.vcd", gap_of(seed, file), CutOff::Refuse);
  expand(folder / "short.vcd", folder / "long.vcd", CutOff::Refuse);
  return content(folder / "long.vcd");
}

/// Where two texts differ, and how; empty where they do not.
std::string difference(const std::string& found, const std::string& expected) {
  const auto [f, e] = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end());
  if (f == found.end() && e == expected.end()) return "";
  const auto from = [](const std::string& text, auto at) {
    const auto first = static_cast<std::size_t>(at - text.begin());
    return text.substr(first > 40 ? first - 40 : 0, 80);
  };
  return "found:\n" + from(found, f) + "\nexpected:\n" + from(expected, e);
}

}  // namespace

TEST_CASE("A trace that is compressed and expanded is the same, byte for byte") {
  const TemporaryFolder folder;
  int shortened = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    INFO("seed " << seed);
    const std::string text = RandomTrace(seed).text();
    REQUIRE(difference(there_and_back(folder, text, seed), text) == "");
    const Info before = info(folder / "in.vcd", {}, CutOff::Refuse);
    const Info after = info(folder / "short.vcd", {}, CutOff::Refuse);
    CHECK(after.true_time == before.true_time);
    CHECK(after.changes == before.changes);
    CHECK(after.variables == before.variables);
    CHECK(after.gaps == before.gaps);
    shortened += after.kernel_time < before.kernel_time ? 1 : 0;
  }
  CHECK(shortened > static_cast<int>(kSeeds / 2));
}

TEST_CASE("Blanks, and stamps without changes, make no difference") {
  const TemporaryFolder folder;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    INFO("seed " << seed);
    const RandomTrace trace(seed);
    REQUIRE(difference(there_and_back(folder, trace.untidy_text(), seed), trace.text()) == "");
  }
}

TEST_CASE("No gap is left that is longer than the shortest one, and kernel time always advances") {
  const TemporaryFolder folder;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    INFO("seed " << seed);
    there_and_back(folder, RandomTrace(seed).text(), seed);
    Reader reader(folder / "short.vcd");
    const std::int64_t longest = min_gap_ticks(reader, gap_of(seed, folder / "in.vcd"));
    std::optional<std::int64_t> last;
    while (const Entry* entry = reader.next()) {
      if (entry->kind == Entry::Kind::Change && !last) last = 0;
      if (entry->kind != Entry::Kind::Stamp) continue;
      if (last) CHECK(entry->stamp - *last <= longest);
      last = entry->stamp;
    }
  }
}

TEST_CASE("The same trace gives the same file") {
  const TemporaryFolder folder;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::string text = RandomTrace(seed).text();
    there_and_back(folder, text, seed);
    const std::string first = content(folder / "short.vcd");
    there_and_back(folder, text, seed);
    CHECK(content(folder / "short.vcd") == first);
  }
}

TEST_CASE("GTKWave's reader takes what is written, and finds the same instants in it") {
  if (std::system("command -v vcd2fst fst2vcd > /dev/null") != 0) {
    WARN("vcd2fst is not installed (Debian: gtkwave), so the traces are not checked with it");
    REQUIRE(std::getenv("CI") == nullptr);
    return;
  }
  const TemporaryFolder folder;
  const auto stamps = [](const std::string& text) {
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#")) found.push_back(line);
    }
    return found;
  };
  const std::string text =
      "$timescale 1 ns $end\n$scope module m $end\n$var wire 1 ! a $end\n$var real 64 \" r $end\n"
      "$var string 1 # s $end\n$upscope $end\n$enddefinitions $end\n#0\n$dumpvars\n0!\nr0 \"\ns #\n"
      "$end\n#10\n1!\nr0.5 \"\n#20000010\n0!\nstext #\n#20000020\n1!\n#7000000000\n";
  there_and_back(folder, text, 0);
  for (const std::string name : {"short", "long"}) {
    const std::string command = "cd '" + (folder / "").string() + "' && vcd2fst " + name + ".vcd " +
                                name + ".fst > log 2>&1 && fst2vcd " + name + ".fst > " + name +
                                ".back 2>> log";
    REQUIRE(std::system(command.c_str()) == 0);
    CHECK(content(folder / "log").empty());
    const std::string back = content(folder / (name + ".back"));
    CHECK(stamps(back) == stamps(content(folder / (name + ".vcd"))));
    CHECK((back.find("integer 64 ! advanceTime") != std::string::npos) == (name == "short"));
  }
}
