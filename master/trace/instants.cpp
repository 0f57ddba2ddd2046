#include "master/trace/instants.h"

#include <limits>
#include <utility>

#include <fmt/format.h>

namespace stride::trace {
namespace {

/// The letter of its type tells that its code stands behind a blank.
bool is_vector(std::string_view value) {
  return std::string_view("bBrRsS").find(value.front()) != std::string_view::npos;
}

void write_line(Spool& text, std::string_view line) {
  text.write(line);
  text.write('\n');
}

}  // namespace

Instants::Instants(Reader& reader, Text text)
    : reader_(reader), keeps_text_(text == Text::Keep), advance_(AdvanceTime::of(reader)) {}

bool Instants::next(Instant& instant) {
  if (!is_first_ && ahead_ == nullptr) return false;
  instant.has_stamp = ahead_ != nullptr;
  instant.stamp = ahead_ != nullptr ? ahead_->stamp : 0;
  instant.line = ahead_ != nullptr ? ahead_->line : 0;
  instant.changes = 0;
  instant.is_empty = true;
  instant.text.clear();
  is_first_ = false;
  while ((ahead_ = reader_.next()) != nullptr) {
    const bool is_stamp = ahead_->kind == Entry::Kind::Stamp;
    if (is_stamp && !(instant.has_stamp && ahead_->stamp == instant.stamp)) break;
    take(instant, *ahead_);
  }
  if (reader_.cut()) return false;
  finish(instant);
  return true;
}

void Instants::take(Instant& instant, const Entry& entry) {
  switch (entry.kind) {
    case Entry::Kind::Stamp:
      return;
    case Entry::Kind::Change:
      return take_change(instant, entry);
    case Entry::Kind::Dump:
      end_dump(instant);
      is_in_dump_ = true;
      break;
    case Entry::Kind::DumpEnd:
      return end_dump(instant);
    case Entry::Kind::Section:
      break;
  }
  instant.is_empty = false;
  if (keeps_text_) write_line(instant.text, entry.section);
}

void Instants::take_change(Instant& instant, const Entry& entry) {
  if (advance_ && advance_->is(entry)) {
    advance_->update(reader_, entry);
    if (advance_->is_alone()) return;
  }
  instant.is_empty = false;
  ++instant.changes;
  if (!keeps_text_) return;
  instant.text.write(entry.value);
  if (is_vector(entry.value)) instant.text.write(' ');
  write_line(instant.text, entry.code_text);
}

void Instants::end_dump(Instant& instant) {
  if (std::exchange(is_in_dump_, false) && keeps_text_) write_line(instant.text, "$end");
}

void Instants::finish(Instant& instant) {
  end_dump(instant);
  instant.skipped = advance_ ? advance_->total() : 0;
  if (instant.stamp > std::numeric_limits<std::int64_t>::max() - instant.skipped) {
    reader_.fail(instant.line,
                 fmt::format("the true time of #{} is beyond 2^63 - 1, with {} of {}",
                             instant.stamp, kAdvanceTime, instant.skipped),
                 "a trace of such a length needs a coarser $timescale");
  }
  instant.time = instant.stamp + instant.skipped;
}

}  // namespace stride::trace
