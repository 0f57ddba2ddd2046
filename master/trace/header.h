// The declarations of a value change dump.
#ifndef STRIDE_MASTER_TRACE_HEADER_H
#define STRIDE_MASTER_TRACE_HEADER_H

#include <cstdint>
#include <string>
#include <vector>

#include "master/trace/code_table.h"
#include "master/trace/timescale.h"
#include "master/trace/words.h"

namespace stride::trace {

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
  std::string text;  ///< as it stands in the file
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
