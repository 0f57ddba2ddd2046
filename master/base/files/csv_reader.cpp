#include "master/base/files/csv_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/text/readable_text.h"

namespace stride::core {
namespace {

constexpr std::size_t kCapacity = std::size_t{1} << 16;
constexpr std::size_t kLongestRow = std::size_t{1} << 28;

FileStream open_stream(const std::filesystem::path& file) {
  Descriptor opened = open_input(file);
  FileStream stream(::fdopen(opened.number(), "rb"), &std::fclose);
  if (stream) opened.release();
  return stream;
}

}  // namespace

CsvReader::CsvReader(std::filesystem::path file) : CsvReader(file, open_stream(file)) {}

CsvReader::CsvReader(std::filesystem::path file, FileStream stream)
    : file_(std::move(file)), stream_(std::move(stream)), buffer_(kCapacity) {
  if (stream_) return;
  fail_input({.where = {file_.string(), 0}},
             fmt::format("cannot read the file: {}", std::generic_category().message(errno)));
}

std::string CsvReader::Field::value() const {
  std::string value;
  value.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    value += text[i];
    i += is_quoted && text[i] == '"';  // the second of two
  }
  return value;
}

bool CsvReader::next() {
  line_ = next_line_;
  while (split() == Row::Unfinished) {
    if (refill()) continue;
    is_cut_ = begin_ != end_;
    return false;
  }
  next_line_ += feeds_;
  return true;
}

/// Splits the row at the begin of what is in the buffer, if it is whole.
CsvReader::Row CsvReader::split() {
  const char* at = buffer_.data() + begin_;
  const char* const end = buffer_.data() + end_;
  fields_.clear();
  feeds_ = 1;
  while (at != end) {
    Field field;
    if (*at == '"') {
      if (!take_quoted(at, end, field)) return Row::Unfinished;
    } else {
      const char* const first = at;
      while (at != end && *at != ',' && *at != '\n') ++at;
      if (at == end) return Row::Unfinished;
      const bool has_return = *at == '\n' && at != first && at[-1] == '\r';
      field.text = {first, static_cast<std::size_t>(at - first) - has_return};
    }
    fields_.push_back(field);
    if (*at++ == ',') continue;
    begin_ = static_cast<std::size_t>(at - buffer_.data());
    return Row::Whole;
  }
  return Row::Unfinished;
}

/// From its opening quotation mark to the separator behind it; returns whether all of it is there.
bool CsvReader::take_quoted(const char*& at, const char* end, Field& field) {
  const char* const first = ++at;
  while (true) {
    at = std::find(at, end, '"');
    if (end - at < 2) return false;
    if (at[1] != '"') break;
    at += 2;
  }
  field = {{first, static_cast<std::size_t>(at - first)}, true};
  feeds_ += static_cast<std::size_t>(std::count(first, at, '\n'));
  ++at;
  if (*at == '\r' && ++at == end) return false;
  if (*at != ',' && *at != '\n') {
    fail("a quotation mark ends a field, but no comma and no end of the line follows");
  }
  return true;
}

/// Gets more of the file; returns whether there was more.
bool CsvReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) {
    if (buffer_.size() >= kLongestRow) {
      fail(
          fmt::format("the row has more than {} MiB, which is not read; a quotation mark may be "
                      "missing",
                      kLongestRow >> 20));
    }
    buffer_.resize(2 * buffer_.size());
  }
  const std::size_t count =
      std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, stream_.get());
  if (count == 0 && std::ferror(stream_.get()) != 0) {
    fail(fmt::format("cannot read on: {}", std::generic_category().message(errno)));
  }
  end_ += count;
  return count != 0;
}

void CsvReader::fail(const std::string& message) const {
  fail_input({.where = {file_.string(), static_cast<int>(line_)}}, message);
}

/// A file that is none of ours may have anything in its first row.
void CsvReader::fail(const std::string& column, const std::string& message) const {
  constexpr std::size_t kMost = 200;
  std::size_t end = std::min(column.size(), kMost);
  while (end < column.size() && is_within_character(column[end])) --end;
  fail(fmt::format("column '{}{}': {}", column.substr(0, end), end < column.size() ? "…" : "",
                   message));
}

}  // namespace stride::core
