#include "master/base/archive/unpacked_archive.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <locale.h>
#include <unistd.h>

#include "master/base/archive/entry_name.h"
#include "master/base/archive/zip_directory.h"
#include "master/base/files/input_file.h"

namespace stride::archive {
namespace {

namespace fs = std::filesystem;

const char* kind_name(mode_t type) {
  switch (type) {
    case AE_IFLNK:
      return "a symbolic link";
    case AE_IFCHR:
    case AE_IFBLK:
      return "a device";
    case AE_IFIFO:
      return "a pipe";
    case AE_IFSOCK:
      return "a socket";
    default:
      return "of an unknown kind";
  }
}

/// A new file, never one that is there already.
class UnpackedFile {
 public:
  UnpackedFile(const fs::path& path, mode_t mode)
      : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode)) {}
  ~UnpackedFile() {
    if (file_ >= 0) ::close(file_);
  }
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  bool is_open() const { return file_ >= 0; }
  bool write(const char* data, std::size_t size) {
    while (size != 0) {
      const ssize_t written = ::write(file_, data, size);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return false;
      data += written;
      size -= static_cast<std::size_t>(written);
    }
    return true;
  }

 private:
  int file_;
};

/// While it lives, this thread's characters are UTF-8, without which libarchive has no name for an
/// entry whose name is marked as UTF-8 and goes beyond ASCII.
class Utf8Names {
 public:
  Utf8Names() : own_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
    if (own_ != nullptr) before_ = ::uselocale(own_);
  }
  ~Utf8Names() {
    if (own_ == nullptr) return;
    ::uselocale(before_);
    ::freelocale(own_);
  }
  Utf8Names(const Utf8Names&) = delete;
  Utf8Names& operator=(const Utf8Names&) = delete;

 private:
  locale_t own_;
  locale_t before_ = nullptr;
};

/// Unpacks one archive into one folder. Symbolic links are never made, and files never overwritten,
/// so a path of checked names cannot leave the folder.
class Extraction {
 public:
  Extraction(fs::path archive, fs::path folder, std::string shown_as, std::string expected,
             core::Location where, UnpackLimits limits)
      : archive_(std::move(archive)),
        shown_as_(std::move(shown_as)),
        folder_(std::move(folder)),
        expected_("expected " + std::move(expected)),
        where_(std::move(where)),
        limits_(std::move(limits)),
        reader_(archive_read_new(), &archive_read_free) {}

  void run() {
    const Utf8Names names;
    open();
    const std::optional<std::uint64_t> announced = announced_entries(file_);
    check_count(announced.value_or(0));  // before the work of unpacking them
    std::uint64_t entries = 0;
    while (next()) {
      check_count(++entries);
      unpack_entry();
    }
    if (entries == 0) fail("is an empty archive", expected_);
    if (!announced) fail("is cut off: it has no directory at its end", "pack or copy it again");
    for (const Link& link : links_) make_link(link);
  }

 private:
  static constexpr std::size_t kPiece = 1 << 16;
  struct Link {
    std::string name;
    fs::path path, target;
  };

  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    core::fail_input({.where = where_}, fmt::format("'{}' {}", shown_as_, what), hint);
  }
  [[noreturn]] void fail_entry(const std::string& what) const {
    fail(fmt::format("holds the entry '{}', {}", name_, what),
         "an archive holds plain files and folders with relative names only; pack it again");
  }
  [[noreturn]] void fail_writing(const fs::path& path) const {
    if (errno == ENAMETOOLONG) fail_entry("whose name is longer than the file system allows");
    core::fail_run({.where = where_},
                   fmt::format("cannot write '{}' while unpacking '{}': {}", path.string(),
                               shown_as_, std::strerror(errno)),
                   "set TMPDIR to a folder that you may write to and that has room");
  }

  void check_count(std::uint64_t entries) const {
    if (entries <= limits_.entries) return;
    fail(fmt::format("has more than {} entries", limits_.entries), limits_.hint);
  }

  /// libarchive does not always have one.
  std::string reason() const {
    const char* const known = archive_error_string(reader_.get());
    return known != nullptr ? known : "no reason is known";
  }

  void open() {
    file_ = core::open_input(archive_, where_);
    archive_read_support_format_zip(reader_.get());
    if (archive_read_open_fd(reader_.get(), file_.number(), kPiece) != ARCHIVE_OK) {
      if (core::is_lfs_pointer(archive_)) {
        fail(fmt::format("is {}, not the archive", core::kLfsPointer), core::kLfsHint);
      }
      fail("is not a zip archive", expected_);
    }
  }

  bool next() {
    const int status = archive_read_next_header(reader_.get(), &entry_);
    if (status == ARCHIVE_EOF) return false;
    if (status >= ARCHIVE_WARN) return true;
    fail(fmt::format("is damaged: {}", reason()), "pack or copy it again");
  }

  void unpack_entry() {
    const char* name = archive_entry_pathname_utf8(entry_);
    if (name == nullptr) name = archive_entry_pathname(entry_);
    name_ = entry_name(name != nullptr ? name : "");
    const fs::path target = folder_ / checked_name();
    const mode_t type = archive_entry_filetype(entry_);
    if (archive_entry_hardlink(entry_) != nullptr) fail_entry("a hard link");
    if (archive_entry_is_encrypted(entry_) != 0) fail_entry("which is encrypted");
    if (type == AE_IFDIR || (type == AE_IFREG && name_.ends_with('/'))) {  // of Windows: "a\\"
      make_folder(target);
    } else if (type == AE_IFREG) {
      make_folder(target.parent_path());
      write_file(target);
    } else if (type == AE_IFLNK && archive_entry_symlink(entry_) != nullptr) {
      links_.push_back({name_, target, archive_entry_symlink(entry_)});
    } else {
      fail_entry(kind_name(type));
    }
  }

  fs::path checked_name() const {
    const fs::path relative(name_);
    if (name_.empty()) fail_entry("which has no name");
    if (relative.is_absolute()) fail_entry("which is an absolute path");
    for (const fs::path& part : relative) {
      if (part == "..") fail_entry("which leads out of the archive's folder");
    }
    return relative.lexically_normal();
  }

  void make_folder(const fs::path& path) const {
    std::error_code error;
    fs::create_directories(path, error);
    if (core::is_folder(path)) return;
    if (core::path_exists(path)) fail_entry("but also a file in the place of one of its folders");
    errno = error.value();
    fail_writing(path);
  }

  void write_file(const fs::path& path) {
    const bool executable = (archive_entry_perm(entry_) & 0100) != 0;
    UnpackedFile file(path, executable ? 0700 : 0600);
    if (!file.is_open()) {
      if (errno == EEXIST) return compare(path);
      fail_writing(path);
    }
    while (const std::size_t size = read_piece()) {
      if (!file.write(buffer_.data(), size)) fail_writing(path);
    }
  }

  /// One to a file of the archive is another name of this file.
  void make_link(const Link& link) {
    name_ = link.name;
    const fs::path file = (link.path.parent_path() / link.target).lexically_normal();
    const fs::path inside = file.lexically_relative(folder_);
    const bool leads_out = link.target.is_absolute() || inside.empty() || *inside.begin() == "..";
    if (leads_out || !core::is_file(file)) {
      fail_entry(fmt::format("a symbolic link to '{}', which is no file of the archive",
                             link.target.string()));
    }
    make_folder(link.path.parent_path());
    std::error_code error;
    fs::create_hard_link(file, link.path, error);
    if (error == std::errc::file_exists) fail_entry("which it holds twice");
    if (!error) return;
    errno = error.value();
    fail_writing(link.path);
  }

  /// Some tools pack a folder twice, which does no harm.
  void compare(const fs::path& path) {
    bool is_same = core::is_file(path);
    const core::Descriptor file = is_same ? core::open_input(path) : core::Descriptor();
    std::array<char, kPiece> first;
    while (const std::size_t size = read_piece()) {
      is_same = is_same && core::read_from(file, first.data(), size) == size &&
                std::equal(first.data(), first.data() + size, buffer_.data());
    }
    is_same = is_same && core::read_from(file, first.data(), 1) == 0;
    if (!is_same) fail_entry("which it holds twice, with different contents");
  }

  /// The next bytes of the entry are in the buffer; returns how many.
  std::size_t read_piece() {
    const la_ssize_t size = archive_read_data(reader_.get(), buffer_.data(), buffer_.size());
    if (size < 0) {
      if (archive_errno(reader_.get()) == ENOMEM) throw std::bad_alloc();
      fail_entry(fmt::format("which is damaged: {}", reason()));
    }
    bytes_ += static_cast<std::uint64_t>(size);
    if (bytes_ > limits_.bytes) {
      fail(fmt::format("unpacks to more than {} bytes", limits_.bytes), limits_.hint);
    }
    return static_cast<std::size_t>(size);
  }

  fs::path archive_;
  std::string shown_as_;
  fs::path folder_;
  std::string expected_;
  core::Location where_;
  UnpackLimits limits_;
  core::Descriptor file_;  ///< open as long as it is read
  std::unique_ptr<::archive, decltype(&archive_read_free)> reader_;
  archive_entry* entry_ = nullptr;
  std::string name_;
  std::vector<Link> links_;  ///< made last, so that nothing is written to what they name
  std::uint64_t bytes_ = 0;
  std::array<char, kPiece> buffer_;
};

}  // namespace

UnpackedArchive::UnpackedArchive(const fs::path& path, const std::string& expected,
                                 const core::Location& where, const UnpackLimits& limits,
                                 const std::string& shown_as) {
  const std::string shown = shown_as.empty() ? path.string() : shown_as;
  if (const std::string reason = core::why_unreachable(path); !reason.empty()) {
    core::fail_input({.where = where}, fmt::format("cannot reach '{}': {}", shown, reason),
                     "check its path");
  }
  if (!core::path_exists(path)) {
    core::fail_input({.where = where}, fmt::format("there is no file '{}'", shown),
                     "relative names are taken from the folder of the file that names them");
  }
  if (core::is_folder(path)) {
    folder_ = fs::absolute(path);
  } else {
    temporary_.emplace();
    folder_ = temporary_->path();
    Extraction(path, folder_, shown, expected, where, limits).run();
  }
}

}  // namespace stride::archive
