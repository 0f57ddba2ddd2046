#include "master/observe/trace/expand.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "master/observe/trace/instants.h"
#include "master/observe/trace/writer.h"

namespace stride::trace {
namespace {

/// The section, and its whole line where nothing else is on it.
Span with_line(const std::string& text, Span section) {
  const auto is_inner_blank = [&](std::size_t at) {
    return at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\r');
  };
  Span line = section;
  while (line.begin > 0 && is_inner_blank(line.begin - 1)) --line.begin;
  while (is_inner_blank(line.end)) ++line.end;
  const bool is_alone = line.begin > 0 && text[line.begin - 1] == '\n' && line.end < text.size() &&
                        text[line.end] == '\n';
  return is_alone ? Span{line.begin, line.end + 1} : section;
}

void write_header(Writer& writer, const Header& header) {
  std::size_t done = 0;
  for (const Declaration& declaration : header.declarations) {
    if (!is_advance_time(header, declaration)) continue;
    const Span gone = with_line(header.text, declaration.section);
    writer.write(header.at({done, gone.begin}));
    done = gone.end;
  }
  writer.write(header.at({done, header.text.size()}));
  writer.write("\n");
}

}  // namespace

std::optional<std::int64_t> expand(const std::filesystem::path& from,
                                   const std::filesystem::path& to, CutOff cut_off) {
  Reader reader(from, cut_off);
  InstantReader instants(reader, InstantReader::Text::Keep);
  if (!instants.advance_time()) {
    reader.fail(
        0, fmt::format("the trace has no variable {}, so nothing in it was skipped", kAdvanceTime),
        "its time is true already; 'stride trace compress' is the reverse");
  }
  Writer writer(from, to);
  write_header(writer, reader.header());
  Instant instant;
  std::optional<std::int64_t> end;  // of an instant that is the last one, perhaps
  while (instants.next(instant)) {
    if (instant.has_stamp) end = instant.time;
    if (instant.is_empty) continue;
    // changes before the first stamp need none, unless something was skipped before
    if (instant.has_stamp || (instant.changes > 0 && instant.time > 0))
      writer.write_stamp(instant.time);
    writer.write_text(instant);
  }
  if (end) writer.write_stamp(*end);
  writer.finish();
  return reader.cut();
}

}  // namespace stride::trace
