// coverage.json, which is read to be merged.
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/coverage/merge.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

void read_coverage(const std::string& bytes) {
  const auto file = write_file("coverage/coverage.json", bytes);
  refusing_input(file.string(), [&] {
    const coverage::Report report = coverage::read_coverage(file);
    coverage::Report twice = report;
    merge(twice, report);
    for (std::size_t i = 0; i < report.groups.size(); ++i) {
      const auto percentage = report.groups[i].percentage().value_or(0);
      ensure(percentage >= 0 && percentage <= 100, "a percentage is from 0 to 100");
      ensure(twice.groups[i].points.size() == report.groups[i].points.size(), "points stay");
    }
  });
}

const Registration kCoverageParsers("coverage", {{.name = "coverage_json",
                                                  .read = read_coverage,
                                                  .seed_files = {"tests/fuzz/seeds/coverage"},
                                                  .alphabet = ",\".0123456789-e[]{}:truefalsn"}});

}  // namespace
}  // namespace stride::tests
