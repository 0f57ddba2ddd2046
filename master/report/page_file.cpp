#include "master/report/page_file.h"

#include <cstddef>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "master/report/page.h"
#include "master/report/page_data.h"
#include "master/util/error.h"
#include "master/util/replacement.h"

namespace stride::report {
namespace {

/// The scripts of the pages know it.
constexpr int kFormat = 1;

}  // namespace

void write_page(const std::filesystem::path& file, std::string_view page,
                const std::string& version,
                const std::function<void(core::OutputFile&)>& write_members,
                std::string_view elements) {
  const std::size_t mark = page.find(kDataMark);
  if (mark == std::string_view::npos) {
    core::fail_input({}, "this stride was built without reports (STRIDE_REPORT=OFF)");
  }
  core::Replacement written(file);
  core::OutputFile& output = written.file();
  output.write(page.substr(0, mark));
  output.write(elements);
  output.write(
      fmt::format(R"(<script type="application/json" id="stride-report">{{"format":{},"stride":{})",
                  kFormat, json_text(version)));
  write_members(output);
  output.write("}</script>\n");
  output.write(page.substr(mark + kDataMark.size()));
  written.commit();
}

void write_member(core::OutputFile& file, std::string_view name, std::string_view text) {
  file.write(fmt::format(",\"{}\":", name));
  file.write(text);
}

void write_signals(core::OutputFile& file, const Signals& signals) {
  write_member(file, "time", blob(std::span(signals.times)));
  write_member(file, "rows", std::to_string(signals.times.size()));
  write_member(file, "columns", "[");
  bool is_first = true;
  for (const Column& column : signals.columns) {
    file.write(fmt::format(R"({}{{"name":{},"unit":{},"type":"{}","stepped":{},"values":)",
                           std::exchange(is_first, false) ? "" : ",", json_text(column.name()),
                           json_text(column.unit()), core::name(column.type()),
                           column.is_stepped()));
    file.write(blob(column.values()));
    file.write('}');
  }
  file.write(']');
}

}  // namespace stride::report
