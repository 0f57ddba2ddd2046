#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_OPEN_FILES_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_OPEN_FILES_H

#include <vector>

#include <sys/types.h>

namespace stride::isolation {

/// The positions of this process in its open regular files, and how long those are that it writes.
/// A forked process has them in common with the other one: what either reads or writes moves both
/// on.
///
/// What was written over is not brought back, nor a file that was opened afterwards: whoever does
/// the same again writes the same again.
class OpenFiles {
 public:
  /// All but these, which belong to the master.
  explicit OpenFiles(std::vector<int> others);

  /// In place of what was noted before. Throws std::system_error if they cannot be found out.
  void note();
  /// Makes positions and lengths what they were. Throws std::runtime_error, naming the file, if
  /// what was in it is gone.
  void set_back() const;

 private:
  struct File {
    int number;
    off_t position;
    off_t size;
    bool is_written;
  };

  std::vector<int> others_;
  std::vector<File> files_;
};

}  // namespace stride::isolation

#endif
