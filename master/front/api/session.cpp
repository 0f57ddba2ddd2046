#include "master/front/api/session.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <iterator>
#include <ranges>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/state_archive.h"
#include "master/base/text/suggest.h"
#include "master/base/time_text.h"
#include "master/engine/model/item_text.h"
#include "master/front/api/process_use.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/study/results/checkpoint_states.h"
#include "master/study/results/output_paths.h"
#include "master/study/results/provenance.h"
#include "master/study/results/report_page.h"
#include "master/system/plan/instances.h"

namespace stride::api {
namespace {

namespace fs = std::filesystem;

std::optional<checkpoint::Checkpoint> read_checkpoint(const fs::path& file) {
  if (file.empty()) return std::nullopt;
  return checkpoint::read_checkpoint(file);
}

/// As long as a run lasts, no other one writes there, and what an earlier one has left is gone.
std::optional<recorders::ResultsLock> locked_folder(const results::ResultsTarget& target,
                                                    const scenario::RunPlan& loaded) {
  if (target.folder.empty()) return std::nullopt;
  results::make_folder(target, loaded);
  std::optional<recorders::ResultsLock> lock(target.folder);
  recorders::remove_results(target.folder, loaded.scenario().annotation.results);
  recorders::clean_unit_folders(target.folder, loaded.component_names());
  return lock;
}

scenario::InterventionDeclaration parse_intervention(const std::string& option,
                                                     const std::string& text,
                                                     const core::KnownNames& names) {
  if (option == "set-at") return scenario::parse_set_at(text, names);
  if (option == "force") return scenario::parse_force(text, names);
  if (option == "drop") return scenario::parse_drop(text, names);
  if (option == "delay") return scenario::parse_delay(text, names);
  if (option == "corrupt") return scenario::parse_corrupt(text, names);
  const std::vector<std::string> known{"set-at", "force", "drop", "delay", "corrupt"};
  core::fail_input({}, fmt::format("there is no intervention '{}'", option),
                   core::suggestion(option, known));
}

/// Those that decide what a run computes, up to the checkpoint.
std::multiset<std::string> deciding_settings(const recorders::Command& command) {
  constexpr std::size_t kFirst = 2;  // behind "run" and the file
  std::multiset<std::string> settings;
  for (std::size_t i = kFirst; i < command.words.size(); ++i) {
    const std::string& word = command.words[i];
    const bool may_differ = word.starts_with("--stop=") || word.starts_with("--signals=") ||
                            word.starts_with("--threads=");
    if (!may_differ) settings.insert(word);
  }
  return settings;
}

/// Throws core::Error (Input), at the checkpoint.
void require_same_settings(const recorders::Provenance& before, const recorders::Command& now,
                           const fs::path& checkpoint) {
  const auto then = before.commands.empty() ? std::multiset<std::string>{}
                                            : deciding_settings(before.commands.front());
  const auto given = deciding_settings(now);
  if (then == given) return;
  const auto only = [](const auto& these, const auto& others) {
    std::vector<std::string> words;
    std::ranges::set_difference(these, others, std::back_inserter(words));
    return words.empty() ? "none" : fmt::format("{}", fmt::join(words, " "));
  };
  core::fail_input(
      {.where = {checkpoint.string(), 0}},
      fmt::format("the checkpoint is of a simulation with other settings: that one has "
                  "{}, this one {}",
                  only(then, given), only(given, then)),
      "open this one with the same; what is to change is set from there on");
}

}  // namespace

Session::Session(Request request, SessionOptions options)
    : request_(std::move(request)),
      given_(std::move(options)),
      checkpoint_(read_checkpoint(given_.checkpoint)),
      loaded_(request_.scenario),
      target_(target_of(given_, loaded_)),
      lock_(locked_folder(target_, loaded_)),
      provenance_(provenance()),
      options_(run_options()),
      journals_(loaded_.system()),
      simulation_(loaded_.system(), instantiate(), options_),
      records_({loaded_, options_, provenance_, target_}, simulation_, results::Beginning::Empty),
      messages_(loaded_.system(), given_.message_limit),
      pace_([this](Time time) {
        if (!given_.progress(time)) interrupt();
      }) {
  if (given_.message_limit > 0) simulation_.add_observer(messages_, {});
  if (given_.progress) simulation_.add_observer(pace_, {});
  list_variables();
  begin();
}

Session::~Session() {
  if (has_ended_ || has_failed_) return;
  try {
    end();
  } catch (const std::exception& failure) {
    spdlog::error("{}", failure.what());
  }
}

results::ResultsTarget Session::target_of(const SessionOptions& options,
                                          const scenario::RunPlan& loaded) {
  if (options.results.empty()) return {{}, results::no_files()};
  return {fs::absolute(options.results), results::possible_files(loaded)};
}

recorders::Provenance Session::provenance() {
  recorders::Provenance made = results::provenance_of(loaded_, request_.command, digests_);
  if (!checkpoint_) return made;
  results::require_same(checkpoint_->provenance, made, given_.checkpoint);
  require_same_settings(checkpoint_->provenance, request_.command, given_.checkpoint);
  return made;
}

core::RunOptions Session::run_options() const {
  core::RunOptions options = results::options_for(loaded_, target_.files);
  options.threads.count = request_.threads;
  options.interrupted = &interrupted_;
  return options;
}

std::vector<std::unique_ptr<core::Unit>> Session::instantiate() {
  if (!target_.folder.empty()) {
    unit_folders_.emplace(target_.folder, loaded_.component_names());
  }
  auto units = make_units();
  if (given_.can_save || checkpoint_) journals_.wrap(units, options_.stop);
  if (checkpoint_) results::restore_units(journals_, *checkpoint_, given_.checkpoint);
  return units;
}

std::vector<std::unique_ptr<core::Unit>> Session::make_units() {
  const auto is_hosted = [](const auto& hosting) { return hosting.has_value(); };
  if (std::ranges::any_of(loaded_.hostings(), is_hosted)) {
    const ExclusiveUse use;
    return scenario::instantiate(loaded_, target_.folder, &interrupted_);
  }
  const SharedUse use;
  return scenario::instantiate(loaded_, target_.folder, &interrupted_);
}

void Session::list_variables() {
  const auto add = [&](core::VariableId id) {
    indices_.emplace(system().full_name(id), ids_.size());
    ids_.push_back(id);
  };
  for (std::size_t i = 0; i < system().components().size(); ++i) {
    firsts_.push_back(ids_.size());
    const auto& variables = system().components()[i].description->variables;
    for (std::size_t k = 0; k < variables.size(); ++k) add({i, k});
  }
  firsts_.push_back(ids_.size());
  for (std::size_t i = 0; i < system().outputs().size(); ++i) add(system().output_id(i));
}

core::Context Session::context(core::VariableId id) const {
  const std::string component =
      system().is_output(id) ? "" : system().components()[id.component].name;
  return {.unit = component, .variable = system().variable(id).name};
}

std::size_t Session::index(core::VariableId id) const {
  return firsts_[id.component] + id.variable;
}

std::size_t Session::find(const std::string& name) const {
  const std::string full = core::with_component(loaded_.scenario().alone, name);
  for (const std::string& meant : {name, full}) {
    if (const auto found = indices_.find(meant); found != indices_.end()) return found->second;
  }
  std::vector<std::string> names;
  for (const auto& [known, index] : indices_) names.push_back(known);
  core::fail_input({}, fmt::format("there is no variable '{}'", name),
                   core::suggestion(full, names));
}

bool Session::is_over() const {
  const core::RunStatistics& statistics = simulation_.statistics();
  return has_ended_ || has_failed_ || statistics.end != core::RunEnd::Completed ||
         statistics.reached >= options_.stop;
}

const char* Session::end_reason() const {
  if (!is_over()) return "";
  return has_failed_ ? "failed" : name(simulation_.statistics().end);
}

void Session::require_under_way() const {
  if (has_failed_) throw std::logic_error("the run has failed");
  if (has_ended_) throw std::logic_error("the run has ended");
}

void Session::begin() {
  make_part([&] {
    records_.announce();
    if (!checkpoint_) return simulation_.begin();
    try {
      results::go_on_from(
          *checkpoint_, simulation_,
          [&](core::StateArchive& state, const auto& started) {
            simulation_.begin(state, started);
          },
          [&] { records_.restore_checks(*checkpoint_); });
    } catch (const core::BadState& mistake) {
      results::fail_checkpoint(given_.checkpoint, mistake);
    }
  });
}

/// What fails, ends the run, and is in its records.
template <class Part>
void Session::make_part(Part&& part) {
  try {
    part();
  } catch (const std::exception& failure) {
    has_failed_ = true;
    try {
      conclude(failure.what());
    } catch (const std::exception& further) {
      spdlog::warn("{}", further.what());
    }
    throw;
  }
}

void Session::advance(Time until) {
  require_under_way();
  if (until < now()) {
    core::fail_input({.time = now()}, fmt::format("the simulation is at {} s, which is later than "
                                                  "{} s",
                                                  core::to_text(now()), core::to_text(until)));
  }
  make_changes();
  make_part([&] { simulation_.advance(until); });
  if (simulation_.statistics().end != core::RunEnd::Interrupted) return;
  core::fail_run({.time = now()}, "the run was interrupted; its results up to there are complete");
}

void Session::end() {
  require_under_way();
  make_changes();
  make_part([&] { simulation_.end(); });
  has_ended_ = true;
  conclude(std::nullopt);
}

void Session::conclude(std::optional<std::string> error) {
  const bool is_good = !error;
  if (is_good) records_.warn_of_units();
  records_.collect_verdicts(is_good && records_.is_complete());
  records_.write_files(error);
  records_.write_page();
  lock_.reset();  // another run may write there, though this one is looked at
}

/// An event at this instant, if there is anything to be changed.
void Session::make_changes() {
  if (changes_.sets.empty() && changes_.messages.empty() && changes_.interventions.empty()) return;
  make_part([&] { simulation_.make_event(std::exchange(changes_, {})); });
}

core::ValueBlock Session::get(core::VariableId id) {
  require_under_way();
  if (system().variable(id).type == core::ValueType::Clock) {
    core::fail_input(context(id), "a clock has no value between its ticks", "look at the messages");
  }
  make_changes();
  std::optional<core::ValueBlock> value;
  make_part([&] { value = simulation_.value(id); });
  return *std::move(value);
}

/// Throws core::Error (Input) for a value that is none of the variable.
void Session::require_value(core::VariableId id, const core::ValueBlock& value) const {
  const core::Variable& variable = system().variable(id);
  if (variable.type != core::ValueType::Enumeration) return;
  const auto numbers = variable.items | std::views::values;
  for (const std::int64_t number : value.numbers<std::int64_t>()) {
    if (std::ranges::find(numbers, number) != numbers.end()) continue;
    core::fail_input(context(id), fmt::format("{} is none of the items of its type: {}", number,
                                              core::item_text(variable.items)));
  }
}

const core::KnownNames& Session::names() {
  if (!names_) names_.emplace(system(), loaded_.scenario().alone);
  return *names_;
}

void Session::set(core::VariableId id, core::ValueBlock value) {
  require_under_way();
  if (system().is_output(id)) {
    core::fail_input(context(id), "an output of the system cannot be set",
                     "set an input of a component");
  }
  scenario::require_settable(system(), id);
  require_value(id, value);
  if (now() >= options_.stop) {
    core::fail_input(context(id), "the run is at its end, so a value has no effect");
  }
  std::erase_if(changes_.sets, [&](const core::Intervention& set) { return set.id == id; });
  changes_.sets.push_back({.id = id, .from = now(), .value = std::move(value)});
}

void Session::require_message(const core::SentMessage& message) const {
  const core::VariableId clock = message.clock;
  const bool is_of_component = !system().is_output(clock);
  const core::Variable& variable = system().variable(clock);
  const bool is_clock = is_of_component && variable.type == core::ValueType::Clock &&
                        variable.causality == core::Causality::Input;
  if (!is_clock || variable.clock->variability != core::IntervalVariability::Triggered) {
    core::fail_input(context(clock), "it is no input clock that ticks at events",
                     "send to a triggered input clock");
  }
  for (const auto& [id, block] : message.values) {
    const core::Variable& payload = system().variable(id);
    const bool belongs = id.component == clock.component &&
                         payload.causality == core::Causality::Input &&
                         payload.belongs_to(variable.reference);
    if (!belongs) {
      core::fail_input(context(id),
                       fmt::format("it is no input that belongs to the clock '{}'", variable.name));
    }
    require_value(id, block);
  }
}

void Session::send(core::SentMessage message) {
  require_under_way();
  require_message(message);
  if (now() >= options_.stop) {
    core::fail_input(context(message.clock), "the run is at its end, so a message is not received");
  }
  const bool ticks_already = std::ranges::any_of(
      changes_.messages,
      [&](const core::SentMessage& other) { return other.clock == message.clock; });
  if (ticks_already) make_changes();
  changes_.messages.push_back(std::move(message));
}

void Session::intervene(const std::string& option, const std::string& text) {
  require_under_way();
  const scenario::InterventionDeclaration declared = parse_intervention(option, text, names());
  if (declared.from < now()) {
    core::fail_input(
        {.where = declared.where, .time = now()},
        fmt::format("it would begin at {} s, which is over", core::to_text(declared.from)));
  }
  auto all = interventions_;
  all.push_back(declared);
  loaded_.interventions_of_branch(all, options_.start);  // they may contradict each other
  for (core::Intervention& change : loaded_.interventions_of_branch({&declared, 1}, now())) {
    changes_.interventions.push_back(std::move(change));
  }
  interventions_.push_back(declared);
}

void Session::save(const fs::path& file) {
  require_under_way();
  if (!given_.can_save) throw std::logic_error("the simulation was opened without can_save");
  for (const auto& declared : interventions_) {
    if (declared.until && *declared.until <= now()) continue;
    if (declared.kind == core::Intervention::Kind::Set && declared.from < now()) continue;
    core::fail_input({.where = declared.where, .time = now()},
                     "a checkpoint does not contain this intervention, which has not ended",
                     "make it a setting with which both simulations are opened");
  }
  make_changes();
  checkpoint::Checkpoint taken{.provenance = provenance_, .time = now()};
  taken.results = target_.folder;
  taken.interventions = results::interventions_until(options_, now());
  make_part([&] {
    journals_.add_to(taken);
    results::add_state(taken, results::kSimulation, simulation_);
    records_.add_to(taken);
  });
  checkpoint::write_checkpoint(file, taken);
}

}  // namespace stride::api
