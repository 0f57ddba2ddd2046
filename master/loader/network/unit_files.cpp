#include "master/loader/network/unit_files.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/descriptor.h"
#include "master/base/text/readable_text.h"

namespace stride::remote {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::size_t kLongestShown = 300;

/// In the order of their names. What is no file and no folder is counted.
std::vector<fs::path> regular_files(const fs::path& folder, std::size_t& others) {
  std::vector<fs::path> files;
  std::error_code none;
  fs::recursive_directory_iterator entry(folder, none), end;
  while (!none && entry != end && files.size() < UnitFileWriter::kMostFiles) {
    std::error_code unknown;
    const fs::file_status status = entry->symlink_status(unknown);
    if (fs::is_regular_file(status)) {
      files.push_back(entry->path().lexically_relative(folder));
    } else if (!fs::is_directory(status)) {
      ++others;
    }
    entry.increment(none);
  }
  std::ranges::sort(files);
  return files;
}

void read_file(std::FILE* file, const std::string& name, const TakePiece& take) {
  std::vector<char> bytes(kPiece);
  bool is_first = true;
  for (std::size_t size = kPiece; size == kPiece; is_first = false) {
    size = std::fread(bytes.data(), 1, bytes.size(), file);
    if (size > 0 || is_first) take(name, {bytes.data(), size}, is_first);
  }
}

bool is_inside(const fs::path& name) {
  const auto is_step = [](const fs::path& part) { return part == ".." || part == "."; };
  return !name.empty() && name.is_relative() && name.has_filename() &&
         std::none_of(name.begin(), name.end(), is_step) &&
         std::ranges::none_of(name.native(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

}  // namespace

std::string read_unit_files(const fs::path& folder, const TakePiece& take) {
  std::size_t left_out = 0;
  const core::UntrustedFolder untrusted(folder);
  for (const fs::path& file : regular_files(folder, left_out)) {
    if (const core::FileStream stream = untrusted.open(file)) {
      read_file(stream.get(), file.generic_string(), take);
    } else {
      ++left_out;
    }
  }
  if (left_out == 0) return "";
  return fmt::format("{} of its files are links or the like, or cannot be read, and stay there",
                     left_out);
}

void UnitFileWriter::fail(const std::string& name, const std::string& why) const {
  core::fail_run(context_, fmt::format("'{}', a file of the unit, {}",
                                       core::readable_text(name, kLongestShown), why));
}

void UnitFileWriter::make_folders(const fs::path& inside) const {
  fs::path folder = folder_;
  for (const fs::path& part : inside) {
    folder /= part;
    std::error_code error;
    fs::create_directory(folder, error);
    if (error || fs::is_symlink(folder, error)) fail(inside.string(), "has no folder here");
  }
}

void UnitFileWriter::take(const std::string& name, std::string_view bytes, bool is_first) {
  const fs::path inside(name);
  if (!is_inside(inside)) fail(name, "has a name that leads elsewhere");
  bytes_ += bytes.size();
  files_ += is_first ? 1 : 0;
  if (files_ > kMostFiles || bytes_ > kMostBytes) fail(name, "is one too many");
  make_folders(inside.parent_path());
  const int how = O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | (is_first ? O_TRUNC : O_APPEND);
  core::Descriptor file(::open((folder_ / inside).c_str(), how, 0666));
  while (file.is_open() && !bytes.empty()) {
    const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (file.is_open() && bytes.empty()) return;
  const int reason = errno;
  throw core::EnvironmentError(context_,
                               fmt::format("'{}', a file of the unit, cannot be written: {}", name,
                                           std::generic_category().message(reason)));
}

}  // namespace stride::remote
