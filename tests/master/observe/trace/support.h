// What several tests of master/observe/trace share.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_TRACE_SUPPORT_H
#define STRIDE_TESTS_MASTER_OBSERVE_TRACE_SUPPORT_H

#include <algorithm>
#include <string>
#include <vector>

#include "master/observe/trace/reader.h"
#include "tests/master/system/ssp/support.h"

namespace stride::trace {

using tests::content;
using tests::error_of;
using tests::TemporaryFolder;

/// A header with these declarations in a scope (from line 3 on), its end, and what comes then.
inline std::string dump(const std::string& declarations, const std::string& changes) {
  return "$timescale 1 ps $end\n$scope module top $end\n" + declarations +
         "$upscope $end\n$enddefinitions $end\n" + changes;
}

/// Two variables, from line 3 on; the changes begin in line 7.
inline std::string two_variables(const std::string& changes) {
  return dump("$var wire 1 ! a $end\n$var wire 8 \" b $end\n", changes);
}

/// One variable and advanceTime, whose code is t; the changes begin in line 7.
inline std::string skipping(const std::string& changes) {
  return dump("$var wire 1 ! a $end\n$var integer 64 t advanceTime $end\n", changes);
}

/// The entries of a dump, as texts: "#5", "1!", "b101 !", "$dumpvars".
inline std::vector<std::string> entries(Reader& reader) {
  std::vector<std::string> texts;
  while (const Entry* entry = reader.next()) {
    switch (entry->kind) {
      case Entry::Kind::Stamp:
        texts.push_back("#" + std::to_string(entry->stamp));
        break;
      case Entry::Kind::Change:
        texts.push_back(std::string(entry->value) + "|" + std::string(entry->code_text));
        break;
      default:
        texts.emplace_back(entry->section);
        break;
    }
  }
  return texts;
}

}  // namespace stride::trace

#endif
