#include "master/study/compare/comparison_page.h"

#include <set>
#include <string>
#include <vector>

#include "master/report/page.h"
#include "master/report/page_data.h"
#include "master/report/page_file.h"
#include "master/report/results.h"
#include "master/study/compare/comparison_json.h"

namespace stride::compare {
namespace {

using report::json_text;

report::Results read(const std::filesystem::path& folder) {
  return report::read_results(folder, report::result_files(folder));
}

/// Those of A that are the same have their curves there.
void keep_differing(report::Signals& signals, const Differences& differences) {
  std::set<std::string> names;
  for (const Difference& difference : differences) {
    if (difference.kind == Kind::Signal) names.insert(difference.name);
  }
  std::erase_if(signals.columns,
                [&](const report::Column& column) { return !names.contains(column.name()); });
}

void write_run(report::Sink& file, const char* name, const report::Results& results) {
  report::write_member(file, name, "{\"run\":");
  file.write(json_text(report::with_exact_integers(results.run.json)));
  report::write_member(file, "notes", json_text(results.notes));
  report::write_signals(file, results.signals);
  file.write('}');
}

}  // namespace

void write_comparison_page(const std::filesystem::path& file, const Comparison& comparison,
                           const Settings& settings, const std::string& version) {
  report::Results a = read(comparison.a);
  report::Results b = read(comparison.b);
  keep_differing(b.signals, comparison.differences);
  report::write_page(file, report::comparison_page(), version, [&](report::Sink& output) {
    report::write_member(output, "comparison", json_text(comparison_json(comparison, settings)));
    write_run(output, "a", a);
    write_run(output, "b", b);
  });
}

}  // namespace stride::compare
