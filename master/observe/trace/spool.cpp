#include "master/observe/trace/spool.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "master/base/error.h"

namespace stride::trace {
namespace {

std::filesystem::path folder() {
  const char* const wanted = std::getenv("TMPDIR");  // opening a file fails if it is not a folder
  return wanted != nullptr ? wanted : "/tmp";
}

[[noreturn]] void fail(const char* what) {
  core::fail_run(
      {.where = {folder().string(), 0}},
      fmt::format("cannot {} a temporary file: {}", what, std::generic_category().message(errno)),
      "very much happens at one instant of this trace, which takes room for it here; "
      "the environment variable TMPDIR names another folder");
}

int nameless_file() {
  std::string name = (folder() / "stride-trace-XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) fail("make");
  ::unlink(name.c_str());
  return descriptor;
}

}  // namespace

Spool::~Spool() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Spool::clear() {
  memory_.clear();
  spilled_ = 0;
}

void Spool::spill() {
  if (descriptor_ < 0) descriptor_ = nameless_file();
  for (std::string_view rest = memory_; !rest.empty();) {
    const ssize_t count =
        ::pwrite(descriptor_, rest.data(), rest.size(), static_cast<off_t>(spilled_));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("write");
    spilled_ += static_cast<std::size_t>(count);
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  memory_.clear();
}

void Spool::copy_to(core::OutputFile& file) const {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  const auto piece = std::make_unique<char[]>(spilled_ > 0 ? kPiece : 0);
  for (std::size_t done = 0; done < spilled_;) {
    const std::size_t wanted = std::min(kPiece, spilled_ - done);
    const ssize_t count = ::pread(descriptor_, piece.get(), wanted, static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail("read");
    file.write(std::string_view(piece.get(), static_cast<std::size_t>(count)));
    done += static_cast<std::size_t>(count);
  }
  file.write(memory_);
}

}  // namespace stride::trace
