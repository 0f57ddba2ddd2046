#ifndef STRIDE_MASTER_BASE_ARCHIVE_TEMPORARY_FOLDER_H
#define STRIDE_MASTER_BASE_ARCHIVE_TEMPORARY_FOLDER_H

#include <filesystem>

#include <sys/types.h>

#include "master/base/files/descriptor.h"
#include "master/base/text/listed.h"

namespace stride::archive {

/// A fresh, empty folder that goes when the object goes.
///
/// It is in `<TMPDIR or /tmp>/stride-<uid>/`, beside a file of the same name with `.lock` that
/// this process keeps locked (flock), so the kernel frees the lock however the process ends. The
/// lock is taken before the folder is made, and its file goes after the folder. Each new folder
/// first removes those whose lock is free or missing, which crashed runs have left. No lock is
/// waited for, so no other process can stop this one.
class TemporaryFolder {
 public:
  /// Throws core::Error of the kind Run if it cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// The folder of the folders of this user; it need not exist.
  static std::filesystem::path parent();

  /// Removes all of a process, where no destructors will run: of this one, or of one that it is a
  /// fork of.
  static void remove_all(pid_t owner) noexcept;

  /// Removes what crashed runs of this user have left; what cannot be removed stays.
  static void sweep_abandoned() noexcept;

 private:
  void remove() const noexcept;

  std::filesystem::path path_;
  core::Descriptor lock_;
  pid_t owner_;  ///< a forked child must not remove what its parent uses
  core::Listed<TemporaryFolder> listed_{*this};
};

}  // namespace stride::archive

#endif
