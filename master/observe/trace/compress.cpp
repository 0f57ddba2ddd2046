#include "master/observe/trace/compress.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "master/base/text/vcd_code.h"
#include "master/base/time_text.h"
#include "master/observe/trace/instants.h"
#include "master/observe/trace/writer.h"

namespace stride::trace {
namespace {

/// The first code that no variable has.
std::string free_code(const CodeTable& codes) {
  for (std::uint64_t number = 0;; ++number) {
    const std::string code = core::vcd_code(number);
    if (!codes.find(code)) return code;
  }
}

void write_header(Writer& writer, const Header& header, const std::string& code) {
  const std::string declaration = fmt::format("$var integer 64 {} {} $end", code, kAdvanceTime);
  if (header.first_scope_end > 0) {
    writer.write(header.at({0, header.first_scope_end}));
    writer.write("\n" + declaration);
    writer.write(header.at({header.first_scope_end, header.text.size()}));
  } else {
    writer.write(header.at({0, header.end_definitions}));
    writer.write(declaration + "\n");
    writer.write(header.at({header.end_definitions, header.text.size()}));
  }
  writer.write("\n");
}

/// Moves instants together.
class Compressor {
 public:
  Compressor(Writer& writer, std::string code, std::int64_t min_gap)
      : writer_(writer), code_(std::move(code)), min_gap_(min_gap) {}

  void write(const Instant& instant) {
    // a comment before the first stamp is at no instant
    if (instant.has_stamp || instant.changes > 0) move_to(instant.stamp, instant.has_stamp);
    writer_.write_text(instant);
  }

  void finish(std::int64_t end) { move_to(end, true); }

 private:
  void move_to(std::int64_t time, bool has_stamp) {
    const bool is_first = !last_.has_value();
    const std::int64_t gap = is_first ? 0 : time - *last_;
    const std::int64_t excess = std::max(gap - min_gap_, std::int64_t{0});
    skipped_ += excess;
    last_ = time;
    if (has_stamp) writer_.write_stamp(time - skipped_);
    if (is_first || excess > 0) writer_.write_advance_time(skipped_, code_);
  }

  Writer& writer_;
  std::string code_;
  std::int64_t min_gap_;
  std::optional<std::int64_t> last_;  ///< the true time of what was written last
  std::int64_t skipped_ = 0;
};

}  // namespace

std::int64_t min_gap_ticks(const Reader& reader, std::optional<Duration> min_gap) {
  const Timescale timescale = reader.header().timescale;
  const std::int64_t ticks = timescale.ticks_in(min_gap.value_or(kDefaultMinGap));
  if (ticks == 0 && min_gap) {
    reader.fail(0,
                fmt::format("a gap of {} s is shorter than {}, the time scale of this trace",
                            core::to_text(*min_gap), timescale.text()),
                fmt::format("the shortest is --min-gap {}", timescale.seconds(1)));
  }
  return std::max(ticks, std::int64_t{1});
}

std::optional<std::int64_t> compress(const std::filesystem::path& from,
                                     const std::filesystem::path& to,
                                     std::optional<Duration> min_gap, CutOff cut_off) {
  Reader reader(from, cut_off);
  InstantReader instants(reader, InstantReader::Text::Keep);
  if (instants.advance_time()) {
    reader.fail(0,
                fmt::format("the trace has a variable {}, so idle time was taken out of it already",
                            kAdvanceTime),
                "'stride trace expand' puts it in again");
  }
  const std::int64_t ticks = min_gap_ticks(reader, min_gap);
  Writer writer(from, to);
  const std::string code = free_code(reader.header().codes);
  write_header(writer, reader.header(), code);
  Compressor compressor(writer, code, ticks);
  Instant instant;
  std::optional<std::int64_t> end;
  while (instants.next(instant)) {
    if (instant.has_stamp) end = instant.stamp;
    if (!instant.is_empty) compressor.write(instant);
  }
  if (end) compressor.finish(*end);
  writer.finish();
  return reader.cut();
}

}  // namespace stride::trace
