#include "master/front/cli/program/end_note.h"

#include <new>
#include <string>
#include <system_error>

#include <sys/mman.h>

#include "master/base/outliving.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

RunFiles* files = nullptr;

void allow_writing(bool is_allowed) {
  ::mprotect(files, sizeof(RunFiles), is_allowed ? PROT_READ | PROT_WRITE : PROT_READ);
}

/// Empty if the working folder is gone; then nothing is added to the file.
std::string absolute_text(const fs::path& file) {
  std::error_code none;
  return fs::absolute(file, none).native();
}

}  // namespace

void share_end_note() {
  core::Outliving<EndNote>::share();
  end_note();
  files = new (core::OutlivingMemory::add(sizeof(RunFiles))) RunFiles;
  allow_writing(false);
}

EndNote& end_note() {
  static auto* const owner = new core::Outliving<EndNote>;
  static EndNote& note = **owner;  // reached without the heap, which may be damaged
  return note;
}

const RunFiles& run_files() { return *files; }

void note_run_file(const fs::path& file) {
  allow_writing(true);
  files->run_file.set(absolute_text(file));
  allow_writing(false);
}

void note_test_report(const fs::path& file, const fs::path& scenario) {
  allow_writing(true);
  files->test_report.set(absolute_text(file));
  files->scenario.set(scenario.native());
  allow_writing(false);
}

}  // namespace stride::cli
