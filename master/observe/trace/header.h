// The declarations of a value change dump.
#ifndef STRIDE_MASTER_OBSERVE_TRACE_HEADER_H
#define STRIDE_MASTER_OBSERVE_TRACE_HEADER_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "master/observe/trace/timescale.h"
#include "master/observe/trace/words.h"

namespace stride::trace {

/// Numbers the codes from 0, in the order in which they come. Looking one up is what reading a
/// trace does most, so codes of up to eight characters, that is practically all, are compared as
/// integers.
class CodeTable {
 public:
  /// The number of a code, a new one where it is not known. It is not empty and has no NUL in it.
  std::uint32_t add(std::string_view code);
  std::optional<std::uint32_t> find(std::string_view code) const;
  std::uint32_t size() const { return size_; }

 private:
  struct Slot {
    std::uint64_t key = 0;  ///< the characters; 0 is an empty slot
    std::uint32_t number = 0;
  };

  std::size_t slot_of(std::uint64_t key) const;
  void grow();

  std::vector<Slot> slots_ = std::vector<Slot>(64);  ///< open addressing, a power of two
  std::unordered_map<std::string, std::uint32_t> long_codes_;
  std::uint32_t size_ = 0;
};

/// A piece of the header's text.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// A name for a code. Several may share one.
struct Declaration {
  std::uint32_t code = 0;  ///< its number in the table
  std::int64_t line = 0;
  Span section{};  ///< from $var to $end
  Span type{};     ///< "wire", "real", …
  Span name{};     ///< without scope and range: "level"
  std::uint32_t width = 0;
};

/// All up to $enddefinitions. It grows with the number of variables, not with the trace.
struct Header {
  std::string text;  ///< as in the file
  Timescale timescale;
  std::vector<Declaration> declarations;
  CodeTable codes;
  std::size_t first_scope_end = 0;  ///< behind the first $scope section; 0 where there is none
  std::size_t end_definitions = 0;  ///< where $enddefinitions begins

  std::string_view at(Span span) const {
    return std::string_view(text).substr(span.begin, span.end - span.begin);
  }
};

/// Reads up to $enddefinitions $end. Throws core::Error (Input) for what is no such header.
Header read_header(Words& words);

}  // namespace stride::trace

#endif
