#include "master/base/files/input_file.h"

#include <algorithm>
#include <cerrno>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/files/output_file.h"

namespace stride::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = std::size_t{1} << 16;

std::string reason(int error) { return std::generic_category().message(error); }

/// What it is instead of a regular file.
const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

struct Mistake {
  std::string message;
  std::string hint;
  bool is_shortage = false;

  [[noreturn]] void fail(const Context& context, const std::string& text) const {
    if (is_shortage) throw EnvironmentError(context, text, hint);
    fail_input(context, text, hint);
  }
};

Mistake mistake_of(int error) {
  if (error == ENOENT || error == ENOTDIR) return {"the file does not exist", "check its path"};
  const std::string message = fmt::format("cannot read the file: {}", reason(error));
  if (is_shortage(error))
    return {message, "raise the limit of open files (ulimit -n), or end other programs", true};
  if (error == ELOOP) return {message, kLinkLoopHint};
  return {message, "check that it is a file that you may read"};
}

Mistake mistake_of_kind(mode_t mode) {
  return {fmt::format("this is {}, not a regular file", kind_of(mode)),
          S_ISDIR(mode) ? "name the file inside it" : "copy what it holds into a file"};
}

/// The file, or why there is none. A device is not even opened, since that may have effects.
std::optional<Mistake> open(const fs::path& file, Descriptor& opened) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return mistake_of(errno);
  if (!S_ISREG(status.st_mode)) return mistake_of_kind(status.st_mode);
  opened = Descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!opened.is_open()) return mistake_of(errno);
  if (::fstat(opened.number(), &status) != 0) return mistake_of(errno);
  if (!S_ISREG(status.st_mode)) return mistake_of_kind(status.st_mode);  // replaced meanwhile
  return std::nullopt;
}

Context at(const fs::path& file, const std::string& shown_as) {
  return {.where = {shown_as.empty() ? file.string() : shown_as, 0}};
}

[[noreturn]] void fail_reading(const Context& context, const std::system_error& failure) {
  fail_input(context, fmt::format("cannot read the file: {}", failure.code().message()),
             "check that it is a file that you may read");
}

constexpr std::string_view kLfsBeginning = "version https://git-lfs.github.com/spec/";

}  // namespace

Descriptor open_input(const fs::path& file, const Location& where) {
  Descriptor opened;
  if (const auto mistake = open(file, opened)) {
    mistake->fail({.where = where}, fmt::format("'{}': {}", file.string(), mistake->message));
  }
  return opened;
}

Descriptor open_input(const fs::path& file, const std::string& shown_as) {
  Descriptor opened;
  if (const auto mistake = open(file, opened)) {
    mistake->fail(at(file, shown_as), mistake->message);
  }
  return opened;
}

std::string read_input(const fs::path& file, const std::string& shown_as, std::uintmax_t most) {
  const Descriptor opened = open_input(file, shown_as);
  const Context context = at(file, shown_as);
  std::string content;
  try {
    for (std::size_t begin = 0;; begin = content.size()) {  // the size of some is not known before
      content.resize(begin + kPiece);
      const std::size_t count = read_from(opened, content.data() + begin, kPiece);
      content.resize(begin + count);
      if (content.size() > most) {
        fail_input(context, fmt::format("the file has more than {} bytes", most),
                   "this is more than stride reads; check that it is the file that was meant");
      }
      if (count < kPiece) return content;
    }
  } catch (const std::system_error& failure) {
    fail_reading(context, failure);
  }
}

std::string head_of(const fs::path& file, std::size_t count) {
  Descriptor opened;
  std::string head(count, '\0');
  if (open(file, opened)) return {};
  try {
    head.resize(read_from(opened, head.data(), count));
  } catch (const std::system_error&) {
    return {};
  }
  return head;
}

bool is_lfs_pointer(const fs::path& file) {
  return begins_as_lfs_pointer(head_of(file, kLfsBeginning.size()));
}

bool begins_as_lfs_pointer(std::string_view content) { return content.starts_with(kLfsBeginning); }

void copy_input(const fs::path& file, const fs::path& copy) {
  const Descriptor opened = open_input(file);
  OutputFile output(copy, {.write = "make room on the disk that this file is on"});
  std::string piece(kPiece, '\0');
  try {
    while (const std::size_t count = read_from(opened, piece.data(), kPiece)) {
      output.write(std::string_view(piece).substr(0, count));
    }
  } catch (const std::system_error& failure) {
    fail_reading(at(file, ""), failure);
  }
  output.close();
}

std::size_t read_from(const Descriptor& file, char* bytes, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t size = ::read(file.number(), bytes + done, count - done);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) throw std::system_error(errno, std::generic_category());
    if (size == 0) break;
    done += static_cast<std::size_t>(size);
  }
  return done;
}

std::vector<fs::path> folder_entries(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    paths.push_back(entry->path());
  }
  std::ranges::sort(paths);
  return paths;
}

bool is_link_loop(const fs::path& path) {
  std::error_code error;
  static_cast<void>(fs::status(path, error));
  return error == std::errc::too_many_symbolic_link_levels;
}

std::string why_unreachable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const bool is_simple = fs::exists(status) || status.type() == fs::file_type::not_found;
  return is_simple ? "" : error.message();
}

}  // namespace stride::core
