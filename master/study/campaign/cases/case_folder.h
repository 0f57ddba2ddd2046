// Where a campaign keeps what became of its cases.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_FOLDER_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_FOLDER_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "master/base/files/descriptor.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

inline constexpr const char* kCases = "cases";
inline constexpr const char* kRunning = "running";

/// Below the folder of a campaign or a search, of the case with this name ("000017"):
/// "cases/000/000017", "cases/000/000017.json" and "cases/000/000017.stimuli".
std::filesystem::path results_of_case(const std::string& name);
std::filesystem::path record_of_case(const std::string& name);
std::filesystem::path stimuli_of_case(const std::string& name);

/// The records in the folder of a campaign, one file for each case, in folders of a thousand:
/// cases/000/000017.json, and beside it, of a case whose results are kept, the folder of that name,
/// and that of its stimuli, if the campaign captures some.
class CaseFolder {
 public:
  /// The plan must outlive it.
  CaseFolder(const Plan& plan, std::filesystem::path folder);

  const std::filesystem::path& path() const { return folder_; }

  /// Below path(): "cases/000/000017".
  std::filesystem::path results_name(std::uint64_t index) const;
  std::filesystem::path stimuli_name(std::uint64_t index) const;
  std::filesystem::path record_file(std::uint64_t index) const;

  /// The line of the record, and what it says; nothing if there is none, or what is there is none.
  struct Record {
    std::string line;
    CaseResult result;
  };
  std::optional<Record> read(std::uint64_t index) const;

 private:
  const Plan& plan_;
  std::filesystem::path folder_;
};

/// What a process writes of the cases that it runs, until they are complete: in a folder of its own
/// below the campaign's, running/HOST.PROCESS, which goes with this object. Any number of processes
/// may be at work.
class CaseScratch {
 public:
  /// Removes what processes of this host have left that were killed, unless the file system has no
  /// locks (flock), which tell them from those at work. `folder` must outlive this.
  /// Throws core::Error (Input) if nothing can be written there.
  explicit CaseScratch(const CaseFolder& folder);
  ~CaseScratch();
  CaseScratch(const CaseScratch&) = delete;
  CaseScratch& operator=(const CaseScratch&) = delete;

  /// Where the case's results go meanwhile; a folder that does not exist.
  std::filesystem::path results(std::uint64_t index) const;
  /// Where they are in the end, below the campaign's folder.
  std::filesystem::path results_name(std::uint64_t index) const {
    return cases_.results_name(index);
  }
  void drop_results(std::uint64_t index) const;
  /// Moves them to their place. To be called before write().
  void keep_results(std::uint64_t index) const;

  /// The same of the stimuli that it captures.
  std::filesystem::path stimuli(std::uint64_t index) const;
  void drop_stimuli(std::uint64_t index) const;
  void keep_stimuli(std::uint64_t index) const;
  /// Of a case that is to be run again, or has none: the results and the stimuli.
  void drop_all(std::uint64_t index) const;

  /// Why nothing more can be written here, if that is so: a case fails by that without being to
  /// blame. `amply`: much more, such as all results of a case.
  std::optional<std::string> why_unusable(bool amply = false) const;

  /// The record is there as a whole or not at all. Throws core::Error (Run).
  void write(std::uint64_t index, const std::string& line) const;

  /// A file to be written here and then moved to the folder of the campaign, in the place of one
  /// that is there.
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  /// Throws core::Error (Run).
  void publish(const std::string& name) const;

 private:
  bool is_made();

  const CaseFolder& cases_;
  std::filesystem::path folder_;
  core::Descriptor lock_;
};

}  // namespace stride::campaign

#endif
