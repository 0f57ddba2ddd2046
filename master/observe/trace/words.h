// The words of a text file of any size.
#ifndef STRIDE_MASTER_OBSERVE_TRACE_WORDS_H
#define STRIDE_MASTER_OBSERVE_TRACE_WORDS_H

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "master/base/error.h"

namespace stride::trace {

/// Reads what is between blanks (space, tab, line ends), in memory that does not grow with the
/// file. Errors are core::Error (Input).
class Words {
 public:
  /// Throws if the file cannot be opened.
  explicit Words(std::filesystem::path path);
  ~Words();
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  /// The next word, valid until the next call; empty at the end of the file. Throws if the file
  /// cannot be read, and for a word that is longer than any in a trace (16 MiB).
  std::string_view next();
  /// The word of the last call ends with the file, without a blank behind it.
  bool is_at_end() const { return at_end_ && at_ == end_; }

  /// From now on all that is read, blanks included, is appended to `text`; null ends it. Throws, as
  /// next() does, where more is collected than a trace has in one piece.
  void record_into(std::string* text) { record_ = text; }

  const std::filesystem::path& path() const { return path_; }
  /// The line of the word of the last call, counted from 1; at the end of the file its last line.
  std::int64_t line() const { return line_; }
  std::uint64_t bytes_read() const { return bytes_read_; }

  /// A word as a message shows it: short, and printable.
  static std::string shown(std::string_view word);
  /// The place in this file, for an error.
  core::Context at(std::int64_t line) const;
  [[noreturn]] void fail(std::int64_t line, const std::string& message,
                         const std::string& hint = "") const;

  static constexpr std::size_t kLongest = std::size_t{16} << 20;

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 18;

  /// Reads more behind end_, keeping what begins at `from`; false at the end of the file.
  bool refill(std::size_t& from);
  void skip_blanks();

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::unique_ptr<char[]> buffer_;
  std::size_t capacity_ = kPiece;
  std::size_t at_ = 0;   ///< behind the last word
  std::size_t end_ = 0;  ///< of what has been read
  bool at_end_ = false;
  std::int64_t line_ = 1;
  std::uint64_t bytes_read_ = 0;
  std::string* record_ = nullptr;
};

}  // namespace stride::trace

#endif
