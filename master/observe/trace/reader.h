// A value change dump, from its header to its last change.
#ifndef STRIDE_MASTER_OBSERVE_TRACE_READER_H
#define STRIDE_MASTER_OBSERVE_TRACE_READER_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "master/observe/trace/header.h"
#include "master/observe/trace/words.h"

namespace stride::trace {

/// What is behind the header; the views are valid until the next one is read.
struct Entry {
  enum class Kind {
    Stamp,    ///< "#1000"
    Change,   ///< "1!", "b101 !", "r0.5 !", "stext !"
    Section,  ///< "$comment … $end" whole
    Dump,     ///< "$dumpvars", "$dumpall", "$dumpon" or "$dumpoff", whose changes follow
    DumpEnd,  ///< "$end"
  };

  Kind kind = Kind::Stamp;
  std::int64_t line = 0;
  std::int64_t stamp = 0;    ///< of a Stamp [ticks of the time scale]
  std::uint32_t code = 0;    ///< of a Change, its number in the header's table
  std::string_view value{};  ///< of a Change, with the letter of its type: "1", "b101"
  std::string_view code_text{};
  std::string_view section{};  ///< of the others
};

/// What to do where a file ends in the middle of something.
enum class CutOff {
  Refuse,  ///< it is an error
  Accept,  ///< the entries end there, and cut() is where
};

/// Reads a dump of any length (IEEE 1364, four states; and what GTKWave takes beyond it: strings,
/// the nine states of VHDL, events, values before the first stamp, sections of other names). The
/// memory that it takes grows with the header only. All errors are core::Error (Input) with file
/// and line.
class Reader {
 public:
  /// Opens the file and reads its header.
  explicit Reader(std::filesystem::path file, CutOff cut_off = CutOff::Refuse);

  const std::filesystem::path& path() const { return words_.path(); }
  const Header& header() const { return header_; }
  /// The next entry, or null at the end. Throws for time that goes back, a code that no variable
  /// has, and whatever is no entry.
  const Entry* next();

  /// The line in which the file was cut off, once next() has come there.
  std::optional<std::int64_t> cut() const { return cut_; }
  std::uint64_t bytes_read() const { return words_.bytes_read(); }

  [[noreturn]] void fail(std::int64_t line, const std::string& message,
                         const std::string& hint = "") const {
    words_.fail(line, message, hint);
  }

 private:
  const Entry* read_stamp(std::string_view word);
  const Entry* read_scalar(std::string_view word);
  const Entry* read_vector(std::string_view word);
  const Entry* read_section(std::string_view word);
  const Entry* change(std::string_view value, std::string_view code);
  const Entry* end_of_file();
  /// Ends the entries, or throws.
  const Entry* cut_off(const std::string& within, const std::string& further_hint = "");

  Words words_;
  Header header_;
  CutOff on_cut_;
  Entry entry_;
  std::string value_;
  std::string section_;
  std::optional<std::int64_t> last_stamp_;
  std::int64_t last_stamp_line_ = 0;
  std::string open_section_;  ///< "$dumpvars", whose $end has not come yet
  std::optional<std::int64_t> cut_;
};

}  // namespace stride::trace

#endif
