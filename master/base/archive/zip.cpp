#include "master/base/archive/zip.h"

#include <algorithm>
#include <array>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"

namespace stride::archive {
namespace {

namespace fs = std::filesystem;

class ZipWriter {
 public:
  /// Writes to `path`; complaints name the file that it is to become.
  ZipWriter(const fs::path& path, fs::path target)
      : target_(std::move(target)), writer_(archive_write_new(), &archive_write_free) {
    check(archive_write_set_format_zip(writer_.get()));
    check(archive_write_open_filename(writer_.get(), path.c_str()));
  }

  void add(const std::string& name, const Content& content) {
    if (content.file.empty()) {
      write_header(name, content.text.size(), false);
      write(content.text.data(), content.text.size());
      return;
    }
    const core::Descriptor file = core::open_input(content.file);
    struct stat status {};
    ::fstat(file.number(), &status);
    write_header(name, static_cast<std::uintmax_t>(status.st_size), content.executable);
    copy(file, content.file, static_cast<std::uintmax_t>(status.st_size));
  }

  void close() { check(archive_write_close(writer_.get())); }

 private:
  /// As many bytes as the header has announced.
  void copy(const core::Descriptor& file, const fs::path& path, std::uintmax_t size) {
    std::array<char, 1 << 16> buffer;
    while (size > 0) {
      const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(size, buffer.size()));
      std::size_t count = 0;
      std::string reason = "it has become shorter";
      try {
        count = core::read_from(file, buffer.data(), wanted);
      } catch (const std::system_error& failure) {
        reason = failure.code().message();
      }
      if (count < wanted) {
        core::fail_input({.where = {path.string(), 0}},
                         fmt::format("cannot read the file: {}", reason), "pack again");
      }
      write(buffer.data(), count);
      size -= count;
    }
  }

  /// No time and no owner, so that the archive depends on the contents alone.
  void write_header(const std::string& name, std::uintmax_t size, bool executable) {
    const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(),
                                                                              &archive_entry_free);
    archive_entry_set_pathname_utf8(entry.get(), name.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), executable ? 0755 : 0644);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(size));
    check(archive_write_header(writer_.get(), entry.get()));
  }

  void write(const char* data, std::size_t size) {
    if (archive_write_data(writer_.get(), data, size) != static_cast<la_ssize_t>(size)) {
      check(ARCHIVE_FATAL);
    }
  }

  void check(int status) const {
    if (status >= ARCHIVE_WARN) return;
    core::fail_run({}, fmt::format("cannot write '{}': {}", target_.string(), reason()),
                   "choose a file in a folder in which you may write, on a disk that has room");
  }

  /// That of the system, if there is one: libarchive's own names the temporary file.
  std::string reason() const {
    const int error = archive_errno(writer_.get());
    if (error > 0) return std::generic_category().message(error);
    const char* const known = archive_error_string(writer_.get());
    return known != nullptr ? known : "no reason is known";
  }

  fs::path target_;
  std::unique_ptr<::archive, decltype(&archive_write_free)> writer_;
};

/// A file under a temporary name that goes unless it is kept.
class PendingFile {
 public:
  explicit PendingFile(fs::path target)
      : target_(std::move(target)), path_(fmt::format("{}.{}.tmp", target_.string(), ::getpid())) {}
  ~PendingFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const fs::path& path() const { return path_; }
  void keep() const {
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) {
      core::fail_run({}, fmt::format("cannot write '{}': {}", target_.string(), error.message()));
    }
  }

 private:
  fs::path target_;
  fs::path path_;
};

/// Adds what is below a folder, also behind links.
class FolderWalk {
 public:
  FolderWalk(Contents& contents, std::string prefix, fs::path top)
      : contents_(contents), prefix_(std::move(prefix)), top_(std::move(top)) {}

  void run() { add(top_); }

 private:
  using Identity = std::pair<dev_t, ino_t>;

  [[noreturn]] static void fail(const fs::path& path, const std::string& message,
                                const std::string& hint) {
    core::fail_input({.where = {path.string(), 0}}, message, hint);
  }

  void add(const fs::path& folder) {
    enter(folder);
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      if (core::is_folder(entry->path())) {
        add(entry->path());
      } else {
        add_one(entry->path());
      }
    }
    if (error) {
      fail(folder, fmt::format("cannot list the folder: {}", error.message()),
           "check that it is a folder that you may read");
    }
    around_.pop_back();
  }

  /// A folder within itself has no end.
  void enter(const fs::path& folder) {
    struct stat status {};
    ::stat(folder.c_str(), &status);
    const Identity identity(status.st_dev, status.st_ino);
    if (std::find(around_.begin(), around_.end(), identity) != around_.end()) {
      fail(folder, "this link leads to a folder that it is in itself",
           "take it out of what is to be packed");
    }
    around_.push_back(identity);
  }

  void add_one(const fs::path& file) {
    std::error_code ignored;
    const fs::perms permissions = fs::status(file, ignored).permissions();
    add_file(contents_, prefix_ + file.lexically_relative(top_).generic_string(), file,
             (permissions & fs::perms::owner_exec) != fs::perms::none);
  }

  Contents& contents_;
  std::string prefix_;
  fs::path top_;
  std::vector<Identity> around_;  ///< the folders that the present one is in, and itself
};

}  // namespace

void add_file(Contents& contents, const std::string& name, const fs::path& file, bool executable) {
  if (!core::is_file(file)) {
    core::fail_input({}, fmt::format("'{}' is not a file that can be packed", file.string()));
  }
  if (!contents.emplace(name, Content{{}, file, executable}).second) {
    core::fail_input({}, fmt::format("two files would be '{}' in the archive", name));
  }
}

void add_folder(Contents& contents, const std::string& prefix, const fs::path& folder) {
  if (!core::is_folder(folder)) {
    core::fail_input({}, fmt::format("'{}' is not a folder that can be packed", folder.string()));
  }
  FolderWalk(contents, prefix, folder).run();
}

void write_zip(const fs::path& path, const Contents& contents) {
  if (core::path_exists(path) && !core::is_file(path)) {  // a device would be replaced
    core::fail_input({.where = {path.string(), 0}}, "this is not a regular file",
                     "choose another file to write to");
  }
  const PendingFile pending(path);
  ZipWriter zip(pending.path(), path);
  for (const auto& [name, content] : contents) zip.add(name, content);
  zip.close();
  pending.keep();
}

}  // namespace stride::archive
