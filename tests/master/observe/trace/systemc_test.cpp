// Traces that SystemC really writes.
#include <catch2/catch.hpp>

#include "master/observe/trace/compress.h"
#include "master/observe/trace/expand.h"
#include "master/observe/trace/info.h"
#include "tests/master/observe/trace/support.h"
#include "tests/master/observe/trace/systemc_trace.h"

using namespace stride;
using namespace stride::trace;

namespace {

/// All entries with their times; codes are replaced by names.
std::vector<std::string> changes_of(const std::filesystem::path& file) {
  Reader reader(file);
  const Header& header = reader.header();
  std::vector<std::string> names(header.codes.size());
  for (const Declaration& declaration : header.declarations) {
    names[declaration.code] = header.at(declaration.name);
  }
  std::vector<std::string> changes;
  std::int64_t time = 0;
  while (const Entry* entry = reader.next()) {
    if (entry->kind == Entry::Kind::Stamp) time = entry->stamp;
    const std::string at = std::to_string(time) + " ";
    if (entry->kind == Entry::Kind::Change) {
      changes.push_back(at + names[entry->code] + " " + std::string(entry->value));
    } else if (entry->kind != Entry::Kind::Stamp) {
      changes.push_back(at + std::string(entry->section));
    }
  }
  changes.push_back(std::to_string(time) + " end");
  return changes;
}

}  // namespace

TEST_CASE("A device that skips, expanded, has the trace of one that does not") {
  const TemporaryFolder folder;
  write_systemc_trace(folder / "plain.vcd", false);
  write_systemc_trace(folder / "skipping.vcd", true);
  expand(folder / "skipping.vcd", folder / "expanded.vcd", CutOff::Refuse);
  const auto expected = changes_of(folder / "plain.vcd");
  CHECK(expected.size() > 4000);
  CHECK(expected.back() == "5000000000000 end");
  CHECK(changes_of(folder / "skipping.vcd") != expected);
  CHECK(changes_of(folder / "expanded.vcd") == expected);

  const Info plain = info(folder / "plain.vcd", {}, CutOff::Refuse);
  const Info skipping = info(folder / "skipping.vcd", {}, CutOff::Refuse);
  CHECK(skipping.true_time == plain.kernel_time);
  CHECK(skipping.changes == plain.changes);
  CHECK(skipping.variables == plain.variables);
  CHECK(skipping.skips == 40);
  CHECK(plain.skips == 0);
}

TEST_CASE("SystemC's trace, compressed and expanded again, is the same") {
  const TemporaryFolder folder;
  write_systemc_trace(folder / "plain.vcd", false);
  compress(folder / "plain.vcd", folder / "short.vcd", Duration(1'000'000), CutOff::Refuse);
  expand(folder / "short.vcd", folder / "long.vcd", CutOff::Refuse);
  CHECK(changes_of(folder / "long.vcd") == changes_of(folder / "plain.vcd"));
  const Info shortened = info(folder / "short.vcd", {}, CutOff::Refuse);
  CHECK(shortened.true_time == 5'000'000'000'000);
  CHECK(shortened.kernel_time < shortened.true_time / 10'000);
}
