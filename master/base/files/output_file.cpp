#include "master/base/files/output_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <type_traits>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "master/base/error.h"
#include "master/base/files/descriptor.h"
#include "master/base/state_archive.h"
#include "master/base/text/hex.h"
#include "master/base/time_text.h"

namespace stride::core {
namespace {

/// Of a file that cannot be created.
const char* hint_for_shortage(int error) {
  return error == EMFILE || error == ENFILE ? "raise the limit of open files (ulimit -n)"
                                            : "make room on the disk";
}

const char* hint_for(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "make room on the disk, or record fewer signals; the lines before are complete";
    case EFBIG:
      return "raise the limit of file sizes (ulimit -f), or record fewer signals; the lines before "
             "are complete";
    default:
      return "check the disk that the results folder is on; the lines before are complete";
  }
}

/// For a file that a thread closes again and again.
constexpr int kMostTries = 100;

constexpr const char* kTakenHint =
    "a unit may close its own files only; with --isolate it has no others";

constexpr const char* kKeepHint =
    "results can be continued only as they were left; let the whole run be made again";

/// Opens it without waiting for the reader of a pipe; writing waits as usual.
int open_without_waiting(const std::filesystem::path& path, int how) {
  constexpr mode_t kEverybodyMayRead = 0666;  // less the umask
  const int file = ::open(path.c_str(), O_NONBLOCK | O_NOCTTY | O_CLOEXEC | how, kEverybodyMayRead);
  if (file >= 0) ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
  return file;
}

int flags(OutputFile::Existing existing) {
  switch (existing) {
    case OutputFile::Existing::Emptied:
      return O_WRONLY | O_CREAT | O_TRUNC;
    case OutputFile::Existing::Refused:
      return O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW;
    case OutputFile::Existing::Kept:
      return O_RDWR;
  }
  return 0;
}

bool is_regular(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

bool is_pipe(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_fifo(path, ignored);
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, Hints hints, Existing existing)
    : path_(std::move(path)), hints_(hints) {
  open(existing);
}

void OutputFile::open(Existing existing) {
  descriptor_ = open_without_waiting(path_, flags(existing));
  if (descriptor_ >= 0) {
    identity_ = FileIdentity::of(descriptor_);
    std::error_code ignored;  // then it cannot be opened again
    if (is_regular(descriptor_)) absolute_path_ = std::filesystem::absolute(path_, ignored);
    is_untouched_ = existing == Existing::Kept;
    if (!is_untouched_) let_rescue();
    return;
  }
  const int error = errno;
  const Context where{.where = {path_.string(), 0}};
  if (error == ENXIO && is_pipe(path_)) {
    fail_input(where, "this is a pipe (FIFO) that no program reads",
               "start the program that reads it first, or choose a file");
  }
  if (existing == Existing::Kept) {
    fail_input(
        where,
        fmt::format("cannot write on in this file: {}", std::generic_category().message(error)),
        kKeepHint);
  }
  const std::string message =
      fmt::format("cannot create the file: {}", std::generic_category().message(error));
  if (is_shortage(error)) throw EnvironmentError(where, message, hint_for_shortage(error));
  fail_input(where, message, hints_.create);
}

/// By another process, when this one has ended.
void OutputFile::let_rescue() {
  rest_->identity = identity_.value_or(FileIdentity{});
  rest_->path.set(absolute_path_.native());
}

OutputFile::~OutputFile() {
  try {
    close();
  } catch (const Error&) {  // a destructor cannot report it
  }
}

void OutputFile::write_slowly(std::string_view text) {
  while (!text.empty()) {
    if (room() == 0) flush();
    const std::string_view piece = text.substr(0, room());
    write(piece);
    text.remove_prefix(piece.size());
  }
}

void OutputFile::write_seconds(Time time) {
  const Duration since = time.time_since_epoch();
  if (since < Duration()) write('-');
  const auto [seconds, picoseconds] = split(since < Duration() ? -since : since);
  write_number(seconds);
  if (picoseconds != 0) write_fraction(picoseconds, 1'000'000'000'000);
}

/// ".DIGITS" of numerator / denominator, a power of ten, which is greater.
void OutputFile::write_fraction(std::int64_t numerator, std::int64_t denominator) {
  const auto reduce = [&](auto factor) {
    if (numerator % factor != 0) return;
    numerator /= factor;
    denominator /= factor;
  };
  reduce(std::integral_constant<std::int64_t, 1'000'000>());  // most times are whole milliseconds
  reduce(std::integral_constant<std::int64_t, 1'000>());
  if (room() < kLongestNumber) flush();
  char* const point = rest_->end();
  write_number(denominator + numerator);
  *point = '.';  // instead of the first digit, 1
  while (rest_->end()[-1] == '0') --rest_->size;
}

void OutputFile::write_hex(std::span<const std::uint8_t> bytes) {
  core::write_hex(bytes, [&](char digit) { write(digit); });
}

void OutputFile::rescue_all() noexcept {
  Listed<OutputFile>::for_each([](OutputFile& file) { file.rescue(); });
}

void OutputFile::rescue_left() {
  Outliving<UnwrittenRest>::for_each_left([](const UnwrittenRest& rest) { rest.write(); });
}

/// In the middle of flush(), too.
void OutputFile::rescue() noexcept {
  if (descriptor_ < 0 || has_failed_ || is_untouched_) return;
  std::optional<std::int64_t> end;
  for (int tries = kMostTries; tries > 0 && !end && get_back(); --tries) {
    end = absolute_path_.empty() ? rescue_into_pipe() : rest_->write_to(descriptor_);
    if (!end && errno != EBADF) return;
  }
  if (!end) return;
  rest_->size = 0;
  taken_ = rest_->place = rest_->line_end = *end;
}

/// What is being written is lost.
std::optional<std::int64_t> OutputFile::rescue_into_pipe() noexcept {
  const std::size_t lines = std::string_view(rest_->bytes, rest_->size).rfind('\n') + 1;
  std::size_t done = is_flushing_ ? lines : 0;
  while (done < lines) {
    const ssize_t count = ::write(descriptor_, rest_->bytes + done, lines - done);
    if (count < 0 && errno != EINTR) return std::nullopt;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  return taken_;
}

void OutputFile::flush() {
  if (is_untouched_) {
    rest_->size = 0;
    return;
  }
  bool was_taken = rest_->size > 0 && !has_failed_ && !is_own();
  bool is_back = !was_taken || get_back();
  if (!has_failed_ && is_own()) check_size();
  is_flushing_ = true;
  std::size_t done = 0;
  int error = 0, tries = kMostTries;
  while (!has_failed_ && is_back && error == 0 && done < rest_->size) {
    const long count = write_piece(rest_->bytes + done, rest_->size - done);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
      taken_ += count;
    } else if (errno == EBADF) {
      was_taken = true;
      is_back = tries-- > 0 && get_back();
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  const std::size_t last = std::string_view(rest_->bytes, done).rfind('\n');
  if (last != std::string_view::npos) {
    rest_->line_end =
        taken_ - static_cast<std::int64_t>(done) + static_cast<std::int64_t>(last) + 1;
  }
  rest_->size = 0;
  std::atomic_signal_fence(std::memory_order_seq_cst);  // or it would be written at a wrong place
  rest_->place = taken_;
  is_flushing_ = false;
  if (error != 0) fail(error);
  if (was_taken) fail_taken(is_back);
}

/// At its place in a regular file, whose open file may have been moved elsewhere.
long OutputFile::write_piece(const char* bytes, std::size_t size) const noexcept {
  if (absolute_path_.empty()) return ::write(descriptor_, bytes, size);
  return ::pwrite(descriptor_, bytes, size, taken_);
}

bool OutputFile::get_back() noexcept {
  for (int tries = kMostTries; tries > 0; --tries) {
    if (is_own()) return true;
    if (absolute_path_.empty()) return false;
    const int file = ::open(absolute_path_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (file < 0) return false;
    if (FileIdentity::of(file) == identity_) {
      descriptor_ = file;  // what has the number now is not to be closed here
      return true;
    }
    ::close(file);
  }
  return false;
}

/// Of the open file, which is its own.
void OutputFile::check_size() {
  struct stat status {};
  const bool is_cut =
      !absolute_path_.empty() && ::fstat(descriptor_, &status) == 0 && status.st_size < taken_;
  if (!is_cut) return;
  has_failed_ = true;
  throw EnvironmentError(
      {.where = {path_.string(), 0}, .time = time_},
      fmt::format("other code has cut the file off while it was written: it has {} bytes of {}",
                  status.st_size, taken_),
      kTakenHint);
}

/// What was written is lost for whoever looks for it there.
void OutputFile::check_path() {
  if (absolute_path_.empty() || FileIdentity::of(absolute_path_.c_str()) == identity_) return;
  has_failed_ = true;
  throw EnvironmentError(
      {.where = {path_.string(), 0}, .time = time_},
      "other code has moved or removed the file, or put another one in its place, while it was "
      "written",
      "leave the results where they are until the run has ended; a unit may change its own "
      "files only");
}

void OutputFile::persist(StateArchive& state) {
  if (!state.is_reading()) {
    flush();
    if (!absolute_path_.empty() && ::fdatasync(descriptor_) != 0) fail(errno);
    extend_checksum(taken_);
  }
  std::int64_t size = taken_;
  std::uint32_t checksum = checksum_;
  state.value(size);
  state.value(checksum);
  if (!state.is_reading()) return;
  if (size < 0) state.fail("the place in a file is negative");
  compare(size, checksum);
}

void OutputFile::compare(std::int64_t size, std::uint32_t checksum) {
  const Context where{.where = {path_.string(), 0}};
  if (absolute_path_.empty()) {
    fail_input(where, "this is no regular file, so nothing can be written on in it", kKeepHint);
  }
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail(errno);
  if (status.st_size < size) {
    fail_input(where,
               fmt::format("the file has {} bytes, and {} of the run had been written",
                           status.st_size, size),
               kKeepHint);
  }
  extend_checksum(size);
  if (checksum_ != checksum) {
    fail_input(where, "the file is not the one that the run had written", kKeepHint);
  }
  taken_ = size;
}

/// To the first bytes of the file; of a pipe nothing can be read again.
void OutputFile::extend_checksum(std::int64_t size) {
  if (absolute_path_.empty()) return;
  read_back(absolute_path_, summed_, size, [&](std::string_view piece) {
    const auto* const bytes = reinterpret_cast<const Bytef*>(piece.data());
    checksum_ = static_cast<std::uint32_t>(::crc32_z(checksum_, bytes, piece.size()));
  });
  summed_ = size;
}

void OutputFile::go_on() {
  if (!is_untouched_) return;
  if (::ftruncate(descriptor_, taken_) != 0) fail(errno);
  is_untouched_ = false;
  rest_->size = 0;
  rest_->place = rest_->line_end = taken_;
  let_rescue();
}

void OutputFile::continue_in_copy(std::filesystem::path path) {
  const std::filesystem::path original = std::exchange(absolute_path_, {});
  const std::int64_t size = std::exchange(taken_, 0);
  ::close(std::exchange(descriptor_, -1));
  path_ = std::move(path);
  rest_->size = 0;  // what is there may be that of the other process
  rest_->place = rest_->line_end = 0;
  open(Existing::Emptied);
  read_back(original, 0, size, [&](std::string_view piece) { write(piece); });
  flush();
}

/// The other process, or this one, may write on behind it.
template <class Take>
void OutputFile::read_back(const std::filesystem::path& from, std::int64_t begin, std::int64_t end,
                           Take&& take) {
  const Descriptor file(::open(from.c_str(), O_RDONLY | O_CLOEXEC));
  std::string piece(UnwrittenRest::kCapacity, '\0');
  while (begin < end) {
    const auto most =
        static_cast<std::size_t>(std::min<std::int64_t>(end - begin, UnwrittenRest::kCapacity));
    const ssize_t count = ::pread(file.number(), piece.data(), most, begin);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      fail_run({.where = {from.string(), 0}},
               "the file was cut off, or removed, while it was written", kTakenHint);
    }
    take(std::string_view(piece).substr(0, static_cast<std::size_t>(count)));
    begin += count;
  }
}

void OutputFile::close() {
  if (descriptor_ < 0) return;
  flush();
  if (!has_failed_ && !is_own()) fail_taken(get_back());
  if (!has_failed_ && !is_untouched_) check_path();
  rest_->path.set("");
  const int result = ::close(std::exchange(descriptor_, -1));
  if (result == 0 || has_failed_) return;
  if (errno == EBADF) fail_taken(true);
  fail(errno);
}

void OutputFile::fail(int error) {
  has_failed_ = true;
  // fails for what is no regular file, where there is nothing to cut
  if (descriptor_ >= 0 && !is_untouched_ && is_own() && taken_ > rest_->line_end)
    (void)!::ftruncate(descriptor_, rest_->line_end);
  const Context where{.where = {path_.string(), 0}, .time = time_};
  const std::string message =
      fmt::format("cannot write the file: {}", std::generic_category().message(error));
  const char* const hint = hints_.write != nullptr ? hints_.write : hint_for(error);
  if (is_shortage(error)) throw EnvironmentError(where, message, hint);
  fail_run(where, message, hint);
}

void OutputFile::fail_taken(bool is_back) {
  has_failed_ = true;
  if (!is_back) descriptor_ = -1;  // the number is of another file, which is not to be closed
  throw TakenFileError(
      Error::Kind::Run, {.where = {path_.string(), 0}, .time = time_},
      fmt::format("other code in this process, such as that of a unit, has closed the open file or "
                  "put another one in its place; {}",
                  is_back ? "the lines up to here are complete"
                          : "it cannot be opened again, so lines are lost"),
      kTakenHint);
}

}  // namespace stride::core
