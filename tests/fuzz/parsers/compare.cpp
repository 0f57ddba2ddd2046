// Results that are compared with others.
#include "master/study/compare/compare.h"

#include <cstddef>
#include <iterator>
#include <string>

#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

struct ComparedFile {
  const char* name;
  const char* seed;
};

constexpr ComparedFile kComparedFiles[] = {{"run.json", "run_json/run.json"},
                                           {"signals.csv", "signals/signals.csv"},
                                           {"events.csv", "events/events.csv"},
                                           {"activity.csv", "activity/activity.csv"},
                                           {"tolerances.csv", "tolerances/tolerances.csv"}};

/// The others; run.json only where that is the one, since it names fewer files than there are.
void copy_others(const std::string& folder, std::size_t place) {
  for (std::size_t i = place == 0 ? 0 : 1; i < std::size(kComparedFiles); ++i) {
    if (i != place) copy_seed(kComparedFiles[i].seed, folder + kComparedFiles[i].name);
  }
}

/// A whole folder with one in which this file is another one.
template <std::size_t file>
void compare_with(const std::string& bytes) {
  const std::string name = kComparedFiles[file].name;
  const std::string whole = "compared/" + name + "/whole/";
  const std::string other = "compared/" + name + "/other/";
  copy_others(whole, file);
  copy_seed(kComparedFiles[file].seed, whole + name);
  copy_others(other, file);
  write_file(other + name, bytes);
  const auto a = working_path(whole);
  const auto b = working_path(other);
  refusing<core::Error>(b.string(), [&] {
    for (const bool is_golden : {false, true}) {
      compare::Settings settings{.is_golden = is_golden};
      const compare::Comparison rows = compare::compare_results(a, b, settings);
      for (std::size_t i = 1; i < rows.differences.size(); ++i) {
        const auto& before = rows.differences[i - 1].time;
        const auto& time = rows.differences[i].time;
        ensure(!time || (before && *before <= *time), "differences are in the order of time");
      }
      settings.time_tolerance = Duration(1'000'000);
      compare::compare_results(a, b, settings);
    }
  });
}

constexpr const char* kComparedAlphabet = ",\"\n.0123456789-e[]{}:truefalsn";

const Registration kCompareParsers("compare", {
                                                  {.name = "compared_run_json",
                                                   .read = compare_with<0>,
                                                   .seed_files = {"tests/fuzz/seeds/run_json"},
                                                   .alphabet = kComparedAlphabet},
                                                  {.name = "compared_signals",
                                                   .read = compare_with<1>,
                                                   .seed_files = {"tests/fuzz/seeds/signals"},
                                                   .alphabet = kComparedAlphabet},
                                                  {.name = "compared_events",
                                                   .read = compare_with<2>,
                                                   .seed_files = {"tests/fuzz/seeds/events"},
                                                   .alphabet = kComparedAlphabet},
                                                  {.name = "compared_activity",
                                                   .read = compare_with<3>,
                                                   .seed_files = {"tests/fuzz/seeds/activity"},
                                                   .alphabet = kComparedAlphabet},
                                                  {.name = "tolerances",
                                                   .read = compare_with<4>,
                                                   .seed_files = {"tests/fuzz/seeds/tolerances"},
                                                   .alphabet = kComparedAlphabet},
                                              });

}  // namespace
}  // namespace stride::tests
