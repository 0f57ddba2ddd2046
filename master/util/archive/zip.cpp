#include "master/util/archive/zip.h"

#include <array>
#include <fstream>
#include <memory>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <unistd.h>

#include "master/util/error.h"

namespace stride::archive {
namespace {

namespace fs = std::filesystem;

class ZipWriter {
 public:
  explicit ZipWriter(const fs::path& path)
      : path_(path), writer_(archive_write_new(), &archive_write_free) {
    check(archive_write_set_format_zip(writer_.get()));
    check(archive_write_open_filename(writer_.get(), path.c_str()));
  }

  void add(const std::string& name, const Content& content) {
    if (content.file.empty()) {
      write_header(name, content.text.size(), false);
      write(content.text.data(), content.text.size());
      return;
    }
    write_header(name, fs::file_size(content.file), content.executable);
    std::ifstream file(content.file, std::ios::binary);
    std::array<char, 1 << 16> buffer;
    while (file.read(buffer.data(), buffer.size()) || file.gcount() > 0) {
      write(buffer.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (!file.eof()) {
      core::fail_input({}, fmt::format("'{}' cannot be read", content.file.string()));
    }
  }

  void close() { check(archive_write_close(writer_.get())); }

 private:
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
    const char* reason = archive_error_string(writer_.get());
    core::fail_run({}, fmt::format("cannot write '{}': {}", path_.string(),
                                   reason != nullptr ? reason : "no reason is known"));
  }

  fs::path path_;
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

}  // namespace

void add_file(Contents& contents, const std::string& name, const fs::path& file, bool executable) {
  if (!fs::is_regular_file(file)) {
    core::fail_input({}, fmt::format("'{}' is not a file that can be packed", file.string()));
  }
  if (!contents.emplace(name, Content{{}, file, executable}).second) {
    core::fail_input({}, fmt::format("two files would be '{}' in the archive", name));
  }
}

void add_folder(Contents& contents, const std::string& prefix, const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    core::fail_input({}, fmt::format("'{}' is not a folder that can be packed", folder.string()));
  }
  constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, kFollow)) {
    if (entry.is_directory()) continue;
    const bool executable =
        (entry.status().permissions() & fs::perms::owner_exec) != fs::perms::none;
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    add_file(contents, prefix + name, entry.path(), executable);
  }
}

void write_zip(const fs::path& path, const Contents& contents) {
  const PendingFile pending(path);
  ZipWriter zip(pending.path());
  for (const auto& [name, content] : contents) zip.add(name, content);
  zip.close();
  pending.keep();
}

}  // namespace stride::archive
