#include "master/study/campaign/cases/case_folder.h"

#include <cerrno>
#include <chrono>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/files/file_identity.h"
#include "master/base/files/output_file.h"
#include "master/base/process/host_name.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/plan_folder.h"

namespace stride::campaign {
namespace {

namespace fs = std::filesystem;

/// Digits of a name that are its place in its folder.
constexpr std::size_t kPlaces = 3;

/// That a case may need for its first files, and for all of them [byte].
constexpr off_t kRoom = off_t{64} << 10;
constexpr off_t kAmpleRoom = off_t{64} << 20;

std::error_code make_file(const fs::path& path, off_t size) {
  const core::Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  const int error = file.is_open() ? ::posix_fallocate(file.number(), 0, size) : errno;
  return {error, std::generic_category()};
}

core::Descriptor opened(const fs::path& folder) {
  return core::Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

/// Whoever is at work in a folder holds its lock.
enum class Lock { Taken, OfOther, None };  ///< a file system may have none

Lock lock(const core::Descriptor& folder) {
  if (::flock(folder.number(), LOCK_EX | LOCK_NB) == 0) return Lock::Taken;
  return errno == EWOULDBLOCK ? Lock::OfOther : Lock::None;
}

void remove_leftovers(const fs::path& running, const std::string& host) {
  std::error_code ignored;
  for (fs::directory_iterator it(running, ignored), end; it != end; it.increment(ignored)) {
    if (it->path().stem() != host) continue;
    const core::Descriptor folder = opened(it->path());
    if (folder.is_open() && lock(folder) == Lock::Taken) fs::remove_all(it->path(), ignored);
  }
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::rename(from, to, error);
  if (!error) return;
  core::fail_run({.where = {to.string(), 0}},
                 fmt::format("cannot put a result of the campaign here: {}", error.message()),
                 "see to the folder and its disk, and run the campaign again: it goes on");
}

/// A folder, in the place of one of a process that was killed before the record was there.
void replace(const fs::path& from, const fs::path& to) {
  std::error_code ignored;
  fs::remove_all(to, ignored);
  move(from, to);
}

}  // namespace

fs::path results_of_case(const std::string& name) {
  return fs::path(kCases) / name.substr(0, name.size() - kPlaces) / name;
}

fs::path record_of_case(const std::string& name) {
  return results_of_case(name).string() + ".json";
}

fs::path stimuli_of_case(const std::string& name) {
  return results_of_case(name).string() + ".stimuli";
}

CaseFolder::CaseFolder(const Plan& plan, fs::path folder)
    : plan_(plan), folder_(std::move(folder)) {}

fs::path CaseFolder::results_name(std::uint64_t index) const {
  return results_of_case(case_name(plan_, index));
}

fs::path CaseFolder::stimuli_name(std::uint64_t index) const {
  return stimuli_of_case(case_name(plan_, index));
}

fs::path CaseFolder::record_file(std::uint64_t index) const {
  return folder_ / record_of_case(case_name(plan_, index));
}

std::optional<CaseFolder::Record> CaseFolder::read(std::uint64_t index) const {
  std::ifstream file(record_file(index), std::ios::binary);
  if (!file) return std::nullopt;
  Record record;
  std::getline(file, record.line);
  auto result = parse_record(plan_, index, record.line);
  if (!result) return std::nullopt;
  record.result = std::move(*result);
  return record;
}

CaseScratch::CaseScratch(const CaseFolder& folder) : cases_(folder) {
  recorders::make_results_folder(cases_.path());
  const fs::path running = fs::absolute(cases_.path()) / kRunning;
  const std::string host = core::host_name();
  remove_leftovers(running, host);
  folder_ = running / fmt::format("{}.{}", host, ::getpid());
  constexpr int kAttempts = 1000;
  for (int attempt = 0; attempt < kAttempts && !is_made(); ++attempt) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  recorders::make_results_folder(folder_);
}

/// Until it is locked, another process may take it, or the folder above it, for a leftover.
bool CaseScratch::is_made() {
  std::error_code error;
  fs::create_directories(folder_, error);
  lock_ = opened(folder_);
  if (error || !lock_.is_open() || lock(lock_) == Lock::OfOther) return false;
  return core::FileIdentity::of(lock_.number()) == core::FileIdentity::of(folder_.c_str());
}

CaseScratch::~CaseScratch() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::remove(folder_.parent_path(), ignored);  // if others have nothing there
}

fs::path CaseScratch::results(std::uint64_t index) const { return folder_ / std::to_string(index); }

fs::path CaseScratch::stimuli(std::uint64_t index) const {
  return folder_ / fmt::format("{}.stimuli", index);
}

void CaseScratch::drop_results(std::uint64_t index) const {
  std::error_code ignored;
  fs::remove_all(results(index), ignored);
}

void CaseScratch::drop_stimuli(std::uint64_t index) const {
  std::error_code ignored;
  fs::remove_all(stimuli(index), ignored);
}

void CaseScratch::drop_all(std::uint64_t index) const {
  drop_results(index);
  drop_stimuli(index);
}

void CaseScratch::keep_results(std::uint64_t index) const {
  replace(results(index), cases_.path() / cases_.results_name(index));
}

void CaseScratch::keep_stimuli(std::uint64_t index) const {
  replace(stimuli(index), cases_.path() / cases_.stimuli_name(index));
}

std::optional<std::string> CaseScratch::why_unusable(bool amply) const {
  const fs::path probe = file(fmt::format("probe_{}", ::getpid()));  // forks look, too
  std::error_code error;
  fs::create_directory(probe, error);
  if (!error) error = make_file(probe / "file", amply ? kAmpleRoom : kRoom);
  std::error_code ignored;
  fs::remove_all(probe, ignored);
  if (!error) return std::nullopt;
  return fmt::format("no {} KiB can be written in {}: {}", (amply ? kAmpleRoom : kRoom) >> 10,
                     folder_.string(), error.message());
}

void CaseScratch::write(std::uint64_t index, const std::string& line) const {
  const fs::path fresh = file(fmt::format("record_{}.json", index));  // forks write, too
  try {
    core::OutputFile record(fresh);
    record.write(line);
    record.write('\n');
    record.close();
  } catch (const core::Error& failure) {
    core::fail_run(failure.context(),
                   fmt::format("case {} has no record: {}", index, failure.message()),
                   "see to the folder and its disk, and run the campaign again: it goes on");
  }
  move(fresh, cases_.record_file(index));
}

void CaseScratch::publish(const std::string& name) const { move(file(name), cases_.path() / name); }

}  // namespace stride::campaign
