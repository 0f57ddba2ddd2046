// A text file that is written from start to end, fast, and loses nothing unnoticed.
#ifndef STRIDE_MASTER_BASE_FILES_OUTPUT_FILE_H
#define STRIDE_MASTER_BASE_FILES_OUTPUT_FILE_H

#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/base/files/file_identity.h"
#include "master/base/files/unwritten_rest.h"
#include "master/base/outliving.h"
#include "master/base/text/listed.h"

namespace stride::core {

class StateArchive;

/// Other code in this process has closed an open file, or put another one in its place. It may go
/// on with that.
class TakenFileError : public Error {
 public:
  using Error::Error;
};

/// Collects what is written in a buffer and hands it to the system in large pieces. When that fails
/// (the disk is full), the file is cut behind its last whole line and Error (Run) is thrown,
/// which names the file and the simulated time; nothing is written from then on.
///
/// Code of a unit in this process can close the open file, or put another one in its place. Then
/// the file is opened again by its path, what is left is written, and that is a TakenFileError
/// (Run).
class OutputFile {
 public:
  /// What to do about failures.
  struct Hints {
    const char* create = "choose a results folder in which you may write";
    const char* write = nullptr;  ///< what suits the error, for results, where there is none
  };

  /// What becomes of a file of this name: a refused one, or a link, is an error; a kept one has to
  /// be there, and stays as it is until go_on(): what is written before that is dropped.
  enum class Existing { Emptied, Refused, Kept };

  /// Creates the file or empties it. Throws Error (Input) if that is not possible, and Error (Run)
  /// if the disk is full, or the process has too many open files.
  explicit OutputFile(std::filesystem::path path) : OutputFile(std::move(path), Hints{}) {}
  OutputFile(std::filesystem::path path, Hints hints, Existing existing = Existing::Emptied);
  /// Closes the file; a failure is lost then, so call close() where it matters.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The simulated time that an error names.
  void set_time(Time time) { time_ = time; }

  void write(std::string_view text) {
    if (text.size() > room()) return write_slowly(text);
    std::memcpy(rest_->end(), text.data(), text.size());
    rest_->size += text.size();
  }
  void write(char c) {
    if (room() == 0) flush();
    rest_->bytes[rest_->size++] = c;
  }
  /// The shortest decimal text that reads back as the same number.
  template <class Number>
  void write_number(Number value) {
    if (room() < kLongestNumber) flush();
    char* const at = rest_->end();
    rest_->size += static_cast<std::size_t>(std::to_chars(at, at + kLongestNumber, value).ptr - at);
  }
  /// Exact decimal seconds without trailing zeros.
  void write_seconds(Time time);
  void write_hex(std::span<const std::uint8_t> bytes);

  /// Hands everything to the system.
  void flush();
  /// Writing: flushes the file to the disk, and notes how far it goes and a checksum up to there.
  /// Reading: compares the file, which was kept, with that, and changes nothing. Throws Error
  /// (Run), Error (Input) for a file that does not go so far or has other bytes before that, and
  /// for a pipe, and BadState.
  void persist(StateArchive& state);
  /// Where persist() has read: cuts the file behind that, to write on there. Does nothing for one
  /// that was not kept. Throws Error (Run).
  void go_on();
  /// A kept one, before go_on().
  bool is_untouched() const { return is_untouched_; }
  /// Flushes and closes. Does nothing if it was closed, or failed, before.
  void close();

  /// In a fork of the process that has written the file, behind a flush() in that one: goes on in a
  /// copy of what was written, at this path. Throws as the constructor and flush() do.
  void continue_in_copy(std::filesystem::path path);

  /// Hands the whole lines of all open files to the system, where the process has to end. For
  /// signal handlers: throws nothing, allocates nothing and takes no lock. A line that was begun is
  /// cut off.
  static void rescue_all() noexcept;

  /// Before the process is forked that is watched, and when it has ended: the same for the files
  /// that it has left.
  static void share() { Outliving<UnwrittenRest>::share(); }
  static void rescue_left();

 private:
  static constexpr std::size_t kLongestNumber = 32;

  void write_fraction(std::int64_t numerator, std::int64_t denominator);
  std::size_t room() const { return UnwrittenRest::kCapacity - rest_->size; }
  void write_slowly(std::string_view text);
  void rescue() noexcept;
  std::optional<std::int64_t> rescue_into_pipe() noexcept;
  bool is_own() const noexcept { return FileIdentity::of(descriptor_) == identity_; }
  /// Returns whether the descriptor is that of the file, be it after it was opened again.
  bool get_back() noexcept;
  long write_piece(const char* bytes, std::size_t size) const noexcept;
  void check_size();
  void check_path();
  void compare(std::int64_t size, std::uint32_t checksum);
  void extend_checksum(std::int64_t size);
  [[noreturn]] void fail(int error);
  [[noreturn]] void fail_taken(bool is_back);

  void open(Existing existing);
  void let_rescue();
  template <class Take>
  void read_back(const std::filesystem::path& from, std::int64_t begin, std::int64_t end,
                 Take&& take);

  std::filesystem::path path_;
  std::filesystem::path absolute_path_;  ///< of a regular file
  std::optional<FileIdentity> identity_;
  Hints hints_;
  std::optional<Time> time_;
  Outliving<UnwrittenRest> rest_;
  std::int64_t taken_ = 0;  ///< bytes that the system has taken
  int descriptor_ = -1;
  std::uint32_t checksum_ = 0;  ///< CRC-32 of the first bytes,
  std::int64_t summed_ = 0;     ///< so many of them
  bool is_untouched_ = false;   ///< a kept file before go_on()
  bool has_failed_ = false;
  volatile bool is_flushing_ = false;  ///< for a signal handler
  Listed<OutputFile> listed_{*this};
};

}  // namespace stride::core

#endif
