// A simulation as a caller of the library sees it.
#ifndef STRIDE_MASTER_FRONT_API_SESSION_H
#define STRIDE_MASTER_FRONT_API_SESSION_H

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/master.h>

#include "master/base/files/file_digests.h"
#include "master/engine/run/simulation.h"
#include "master/front/api/message_queue.h"
#include "master/front/api/pace.h"
#include "master/front/api/request.h"
#include "master/observe/checkpoint/journals.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/study/results/run_records.h"
#include "master/system/declaration/interventions.h"

namespace stride::api {

struct SessionOptions {
  std::filesystem::path results{};     ///< empty: none are written
  std::filesystem::path checkpoint{};  ///< empty: the run begins at its start
  bool can_save = false;
  std::size_t message_limit = 0;
  std::function<bool(Time)> progress{};  ///< whether the run goes on
};

/// Its functions throw core::Error; after one of the kind Run is_over() is true. Calls that its
/// state does not allow throw std::logic_error, and change nothing.
class Session {
 public:
  Session(Request request, SessionOptions options);
  /// Ends the run; what fails then is lost.
  ~Session();

  void advance(Time until);
  void end();
  void interrupt() { interrupted_ = 1; }

  bool is_over() const;
  Time now() const { return simulation_.statistics().reached; }
  const core::RunOptions& options() const { return options_; }
  const char* end_reason() const;

  const core::System& system() const { return loaded_.system(); }
  std::size_t variable_count() const { return ids_.size(); }
  /// Throws std::out_of_range.
  core::VariableId id(std::size_t index) const { return ids_.at(index); }
  std::size_t index(core::VariableId id) const;
  std::size_t find(const std::string& name) const;
  /// That the texts of interventions may begin with.
  const core::KnownNames& names();
  /// For an error about the variable.
  core::Context context(core::VariableId id) const;

  core::ValueBlock get(core::VariableId id);
  void set(core::VariableId id, core::ValueBlock value);
  void send(core::SentMessage message);
  void intervene(const std::string& option, const std::string& text);
  std::optional<MessageQueue::Entry> next_message() { return messages_.take(); }

  void save(const std::filesystem::path& file);

  const std::vector<core::Verdict>& verdicts() const { return records_.verdicts(); }

 private:
  static results::ResultsTarget target_of(const SessionOptions& options,
                                          const scenario::RunPlan& loaded);
  core::RunOptions run_options() const;
  recorders::Provenance provenance();
  void list_variables();
  void require_under_way() const;
  void require_value(core::VariableId id, const core::ValueBlock& value) const;
  void require_message(const core::SentMessage& message) const;
  std::vector<std::unique_ptr<core::Unit>> instantiate();
  std::vector<std::unique_ptr<core::Unit>> make_units();
  void begin();
  void make_changes();
  template <class Part>
  void make_part(Part&& part);
  void conclude(std::optional<std::string> error);

  const Request request_;
  const SessionOptions given_;
  const std::optional<checkpoint::Checkpoint> checkpoint_;
  volatile std::sig_atomic_t interrupted_ = 0;
  const scenario::RunPlan loaded_;
  const results::ResultsTarget target_;
  std::optional<recorders::ResultsLock> lock_;
  core::FileDigests digests_;
  const recorders::Provenance provenance_;
  const core::RunOptions options_;
  std::optional<recorders::UnitFolders> unit_folders_;
  checkpoint::Journals journals_;
  core::Simulation simulation_;
  results::RunRecords records_;
  MessageQueue messages_;
  Pace pace_;

  std::vector<core::VariableId> ids_;
  std::vector<std::size_t> firsts_;  ///< of each component, and of the system's outputs, in `ids_`
  std::map<std::string, std::size_t, std::less<>> indices_;  ///< by name
  std::optional<core::KnownNames> names_;                    ///< once they are asked for
  core::ChangesAtInstant changes_;                           ///< that are not made yet
  std::vector<scenario::InterventionDeclaration> interventions_;
  bool has_failed_ = false;
  bool has_ended_ = false;
};

}  // namespace stride::api

#endif
