// The text file of what a unit received: docs/stimuli.md is its reference.
#ifndef STRIDE_MASTER_OBSERVE_CAPTURE_STIMULI_FILE_H
#define STRIDE_MASTER_OBSERVE_CAPTURE_STIMULI_FILE_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <stride/time.h>

#include "master/base/files/output_file.h"
#include "master/engine/model/description.h"
#include "master/engine/model/values.h"

namespace stride::capture {

/// Whose stimuli they are.
struct Origin {
  std::string component;
  std::string system;
  const core::UnitDescription* description = nullptr;  ///< of the component's unit
};

/// Whether it can be played: all inputs, but for those clocks that the master ticks by the time.
bool is_stimulus(const core::Variable& variable);

/// Rows wait until they are committed, and can be taken back until then. commit(), flush() and
/// close() throw core::Error (Run) as core::OutputFile does.
class StimuliFile {
 public:
  /// Creates the file and begins its head. Throws core::Error (Input) if it cannot be created.
  StimuliFile(std::filesystem::path path, const Origin& origin,
              core::OutputFile::Existing existing = core::OutputFile::Existing::Emptied);

  // The head, in any order.
  void add_start_value(const core::Variable& variable, const core::ValueBlock& values,
                       std::size_t first);
  /// Duration::max(): for ever.
  void add_skip(Duration max_skip);
  void add_tolerance(const core::Variable& output, double tolerance);
  /// The unit enters Initialization Mode: rows follow.
  void end_head(Time start);

  // The rows. `event`: the number of an event iteration, or nothing for Step Mode.
  void add_value(Time time, std::string_view event, const core::Variable& variable,
                 const core::ValueBlock& values, std::size_t first);
  void add_tick(Time time, std::string_view event, const core::Variable& clock);
  void add_step(Time from, Time to);

  /// For drop(): how much has been written that is not committed.
  std::size_t mark() const { return pending_.size(); }
  void drop(std::size_t mark) {
    if (mark < pending_.size()) pending_.resize(mark);
  }
  /// What waits is final. `time`: the unit's present time.
  void commit(Time time);
  /// When all is committed: as core::OutputFile::persist(), for a file that is kept.
  void persist(core::StateArchive& state);
  /// Has what is committed.
  core::OutputFile& file() { return file_; }
  /// Drops what waits, writes the end mark, at the time of the last commit, and closes the file.
  void close(std::string_view ending);

 private:
  void add_moment(Time time, std::string_view event);
  void add_elements(const core::Variable& variable, const core::ValueBlock& values,
                    std::size_t first);
  void add_input(const core::UnitDescription& description, const core::Variable& input);

  core::OutputFile file_;
  std::string pending_;
  bool has_head_ = false;
  Time committed_{};
};

}  // namespace stride::capture

#endif
