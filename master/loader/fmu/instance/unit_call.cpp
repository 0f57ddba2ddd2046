#include "master/loader/fmu/instance/unit_call.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <sys/uio.h>
#include <unistd.h>

#include "master/base/outliving.h"
#include "master/loader/fmu/instance/present_call.h"

namespace stride::importer {
namespace {

/// A function's name, which is a text of this program, and so of a forked process at the same
/// address.
std::string name_at(const char* pointer) {
  std::array<char, 64> text{};
  constexpr std::size_t kPiece = 16;  // the last ones may be beyond the end of the memory
  for (std::size_t at = 0; at + kPiece < text.size(); at += kPiece) {
    const iovec here{text.data() + at, kPiece};
    const iovec there{const_cast<char*>(pointer) + at, kPiece};
    if (::process_vm_readv(::getpid(), &here, 1, &there, 1, 0) <= 0) break;
  }
  return text[0] != '\0' ? text.data() : "a function whose name is lost";
}

}  // namespace

void share_calls() {
  core::Outliving<LeftCall>::share();
  core::Outliving<LibraryWork>::share();
}

std::vector<UnitCall> left_calls(const char* thread) {
  std::vector<UnitCall> calls;
  core::Outliving<LeftCall>::for_each_left([&](const LeftCall& call) {
    const char* const function = call.function;
    if (function == nullptr || !call.is_unfinished) return;
    const LeftCall* const member = call.member;
    const LeftCall* const whose =
        member != nullptr ? core::Outliving<LeftCall>::left_at(member) : &call;
    if (whose == nullptr) return;
    calls.push_back({.function = name_at(function),
                     .unit = std::string(whose->unit.view()),
                     .where = {std::string(whose->file.view()), whose->line},
                     .time = call.has_time ? std::optional(call.time) : std::nullopt,
                     .variable = {},
                     .is_by_thread = thread != nullptr && call.thread == thread});
  });
  return calls;
}

LibraryWork left_library_work() {
  LibraryWork left;
  core::Outliving<LibraryWork>::for_each_left([&](const LibraryWork& work) { left = work; });
  return left;
}

}  // namespace stride::importer
