#include "master/report/page_file.h"

#include <cstddef>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/output_file.h"
#include "master/base/files/replacement.h"
#include "master/report/page.h"
#include "master/report/page_data.h"

namespace stride::report {
namespace {

/// The scripts of the pages know it.
constexpr int kFormat = 1;

class FileSink final : public Sink {
 public:
  explicit FileSink(core::OutputFile& file) : file_(file) {}
  void write(std::string_view text) override { file_.write(text); }

 private:
  core::OutputFile& file_;
};

class TextSink final : public Sink {
 public:
  void write(std::string_view text) override { text_ += text; }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Where the data belong in the page.
std::size_t data_mark(std::string_view page) {
  const std::size_t mark = page.find(kDataMark);
  if (mark == std::string_view::npos) {
    core::fail_input({}, "this stride was built without reports (STRIDE_REPORT=OFF)");
  }
  return mark;
}

void write_to(Sink& sink, std::string_view page, const std::string& version,
              const WriteMembers& write_members, std::string_view elements) {
  const std::size_t mark = data_mark(page);
  sink.write(page.substr(0, mark));
  sink.write(elements);
  sink.write(
      fmt::format(R"(<script type="application/json" id="stride-report">{{"format":{},"stride":{})",
                  kFormat, json_text(version)));
  write_members(sink);
  sink.write("}</script>\n");
  sink.write(page.substr(mark + kDataMark.size()));
}

}  // namespace

void write_page(const std::filesystem::path& file, std::string_view page,
                const std::string& version, const WriteMembers& write_members,
                std::string_view elements) {
  data_mark(page);
  core::Replacement written(file);
  FileSink sink(written.file());
  write_to(sink, page, version, write_members, elements);
  written.commit();
}

std::string page_text(std::string_view page, const std::string& version,
                      const WriteMembers& write_members, std::string_view elements) {
  TextSink sink;
  write_to(sink, page, version, write_members, elements);
  return sink.take();
}

void write_member(Sink& sink, std::string_view name, std::string_view text) {
  sink.write(fmt::format(",\"{}\":", name));
  sink.write(text);
}

void write_signals(Sink& sink, const Signals& signals) {
  write_member(sink, "time", blob(std::span(signals.times)));
  write_member(sink, "rows", std::to_string(signals.times.size()));
  write_member(sink, "columns", "[");
  bool is_first = true;
  for (const Column& column : signals.columns) {
    sink.write(fmt::format(R"({}{{"name":{},"unit":{},"type":"{}","stepped":{},"values":)",
                           std::exchange(is_first, false) ? "" : ",", json_text(column.name()),
                           json_text(column.unit()), core::name(column.type()),
                           column.is_stepped()));
    sink.write(blob(column.values()));
    sink.write('}');
  }
  sink.write(']');
}

}  // namespace stride::report
