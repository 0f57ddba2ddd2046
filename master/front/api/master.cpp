// The C interface of the master, interfaces/stride/master.h, on api::Session.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include <stride/master.h>

#include "master/front/api/c_time.h"
#include "master/front/api/elements.h"
#include "master/front/api/last_error.h"
#include "master/front/api/log.h"
#include "master/front/api/process_use.h"
#include "master/front/api/session.h"

using stride::Time;
using stride::api::c_time;
using stride::api::CElements;
using stride::api::duration_of;
using stride::api::kNoTime;
using stride::api::Session;

namespace core = stride::core;

/// A session, and what its caller has been given pointers to.
struct stride_simulation {
  explicit stride_simulation(stride::api::Request request, stride::api::SessionOptions options)
      : session(std::move(request), std::move(options)) {}

  Session session;
  pid_t process = ::getpid();
  std::atomic<bool> is_in_use{false};  ///< by a call
  CElements elements{};
  std::string name{}, content{};
  std::vector<std::size_t> dimensions{}, clocks{};
};

namespace {

void require(bool condition, const char* message) {
  if (!condition) throw std::logic_error(message);
}

/// Of the caller's structure, which may be that of an earlier version: its size and a part of it.
template <class Structure>
void give(Structure* to, Structure from) {
  require(to->size > 0, "the size of a structure is 0: set it to its sizeof");
  const std::size_t size = std::min(to->size, sizeof(Structure));
  from.size = to->size;
  std::memcpy(to, &from, size);
}

template <class Structure>
Structure taken(const Structure* from) {
  Structure structure{};
  if (from == nullptr) return structure;
  require(from->size > 0, "the size of a structure is 0: set it to its sizeof");
  std::memcpy(&structure, from, std::min(from->size, sizeof(Structure)));
  return structure;
}

template <class Action>
stride_status attempt(Action&& action) noexcept {
  try {
    action();
    return STRIDE_OK;
  } catch (const std::exception& error) {
    return stride::api::note_error(error);
  } catch (...) {
    return stride::api::note_misuse("an exception of an unknown type");
  }
}

/// Of one call: others meanwhile, of another thread or of a function that the call calls, are
/// misuse.
class Use {
 public:
  explicit Use(stride_simulation& simulation) : simulation_(simulation) {
    require(!simulation.is_in_use.exchange(true),
            "the simulation is in use: by another thread, or by the call that has called this");
  }
  ~Use() { simulation_.is_in_use = false; }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

 private:
  stride_simulation& simulation_;
};

/// An action with an open simulation.
template <class Action>
stride_status attempt_with(stride_simulation* simulation, Action&& action) noexcept {
  return attempt([&] {
    require(simulation != nullptr, "the simulation is NULL");
    require(simulation->process == ::getpid(),
            "the simulation was opened by another process, of which this one is a fork");
    const stride::api::SharedUse in_library;
    const Use use(*simulation);
    action();
  });
}

/// The variable, which has so many elements.
const core::Variable& variable_of(const Session& session, std::size_t index, std::size_t count) {
  require(index < session.variable_count(), "there is no variable with this index");
  const core::Variable& variable = session.system().variable(session.id(index));
  if (count != variable.size) {
    throw std::logic_error(fmt::format("'{}' has {} elements, not {}",
                                       session.system().full_name(session.id(index)), variable.size,
                                       count));
  }
  return variable;
}

core::ValueBlock read_value(const Session& session, std::size_t index, const void* elements,
                            std::size_t count) {
  const core::Variable& variable = variable_of(session, index, count);
  require(variable.type != stride::core::ValueType::Clock, "a clock has no value");
  require(elements != nullptr || count == 0, "the elements are NULL");
  return stride::api::read_elements(variable, session.context(session.id(index)), elements);
}

}  // namespace

extern "C" {

const stride_error* stride_last_error(void) { return stride::api::last_error(); }

const char* stride_version(void) { return STRIDE_VERSION; }

void stride_set_log(stride_log log, void* user) {
  attempt([&] { stride::api::set_log(log, user); });
}

stride_time stride_seconds(double seconds) {
  if (std::isnan(seconds)) return kNoTime;
  return c_time(
      stride::time_from_seconds(std::clamp(seconds, -stride::kMaxSeconds, stride::kMaxSeconds)));
}

stride_time stride_sum(stride_time time, stride_time after) {
  if (time.seconds == STRIDE_NO_TIME || after.seconds == STRIDE_NO_TIME) return kNoTime;
  return c_time(Time(duration_of(time) + duration_of(after)));
}

stride_time stride_end_of_time(void) { return stride_seconds(stride::kMaxSeconds); }

stride_status stride_open(const char* scenario, const stride_options* given,
                          stride_simulation** simulation) {
  if (simulation != nullptr) *simulation = nullptr;
  return attempt([&] {
    require(simulation != nullptr, "there is no place for the simulation");
    require(scenario != nullptr, "the name of the scenario is NULL");
    const auto options = taken(given);
    require(options.settings != nullptr || options.setting_count == 0, "the settings are NULL");
    stride::api::set_default_log();
    stride::api::SessionOptions session{.can_save = options.can_save != 0,
                                        .message_limit = options.message_limit};
    if (options.results != nullptr) session.results = options.results;
    if (options.checkpoint != nullptr) session.checkpoint = options.checkpoint;
    if (options.progress != nullptr) {
      session.progress = [progress = options.progress, user = options.user](Time time) {
        return progress(user, c_time(time)) == 0;
      };
    }
    auto request = stride::api::read_request(scenario, {options.settings, options.setting_count});
    *simulation = new stride_simulation(std::move(request), std::move(session));
  });
}

stride_status stride_advance(stride_simulation* simulation, stride_time until) {
  return attempt_with(simulation, [&] {
    require(until.seconds != STRIDE_NO_TIME, "there is no time to simulate up to");
    simulation->session.advance(Time(duration_of(until)));
  });
}

stride_status stride_end(stride_simulation* simulation) {
  return attempt_with(simulation, [&] { simulation->session.end(); });
}

stride_status stride_close(stride_simulation* simulation) {
  if (simulation == nullptr) return STRIDE_OK;
  const stride_status status = attempt_with(simulation, [] {});
  if (status != STRIDE_OK) return status;
  const stride::api::SharedUse in_library;
  delete simulation;
  return STRIDE_OK;
}

void stride_interrupt(stride_simulation* simulation) {
  if (simulation != nullptr) simulation->session.interrupt();
}

stride_time stride_now(const stride_simulation* simulation) {
  return simulation == nullptr ? kNoTime : c_time(simulation->session.now());
}

stride_time stride_start_time(const stride_simulation* simulation) {
  return simulation == nullptr ? kNoTime : c_time(simulation->session.options().start);
}

stride_time stride_stop_time(const stride_simulation* simulation) {
  return simulation == nullptr ? kNoTime : c_time(simulation->session.options().stop);
}

int stride_is_over(const stride_simulation* simulation) {
  return simulation == nullptr || simulation->session.is_over() ? 1 : 0;
}

const char* stride_end_reason(const stride_simulation* simulation) {
  return simulation == nullptr ? "" : simulation->session.end_reason();
}

size_t stride_variable_count(const stride_simulation* simulation) {
  return simulation == nullptr ? 0 : simulation->session.variable_count();
}

stride_status stride_describe(stride_simulation* simulation, size_t index,
                              stride_variable* variable) {
  return attempt_with(simulation, [&] {
    require(variable != nullptr, "there is no place for the description");
    const Session& session = simulation->session;
    require(index < session.variable_count(), "there is no variable with this index");
    const core::VariableId id = session.id(index);
    const core::System& system = session.system();
    const core::Variable& described = system.variable(id);
    const bool is_of_component = !system.is_output(id);
    simulation->name = system.full_name(id);
    simulation->dimensions.clear();
    for (const core::Dimension& dimension : described.dimensions) {
      simulation->dimensions.push_back(dimension.size);
    }
    simulation->clocks.clear();
    for (const core::ValueReference clock : described.clocks) {
      if (!is_of_component) break;
      const auto found = system.components()[id.component].description->find(clock);
      simulation->clocks.push_back(session.index({id.component, *found}));
    }
    give(variable,
         {.size = 0,
          .name = simulation->name.c_str(),
          .component = is_of_component ? system.components()[id.component].name.c_str() : "",
          .type = stride::api::type_of(described.type),
          .causality = stride::api::causality_of(described.causality),
          .unit = described.unit.c_str(),
          .description = described.description.c_str(),
          .count = described.size,
          .dimensions = simulation->dimensions.data(),
          .dimension_count = simulation->dimensions.size(),
          .is_connected = is_of_component && !system.connections_to(id).empty(),
          .is_message = is_of_component && system.is_message(id),
          .clocks = simulation->clocks.data(),
          .clock_count = simulation->clocks.size(),
          .is_relative = described.is_relative});
  });
}

stride_status stride_find(stride_simulation* simulation, const char* name, size_t* index) {
  return attempt_with(simulation, [&] {
    require(name != nullptr && index != nullptr, "the name, or the place for the index, is NULL");
    *index = simulation->session.find(name);
  });
}

stride_status stride_get(stride_simulation* simulation, size_t index, void* elements,
                         size_t count) {
  return attempt_with(simulation, [&] {
    Session& session = simulation->session;
    variable_of(session, index, count);
    require(elements != nullptr || count == 0, "there is no place for the elements");
    simulation->elements = CElements(session.get(session.id(index)));
    simulation->elements.copy_to(elements);
  });
}

stride_status stride_set(stride_simulation* simulation, size_t index, const void* elements,
                         size_t count) {
  return attempt_with(simulation, [&] {
    Session& session = simulation->session;
    core::ValueBlock value = read_value(session, index, elements, count);
    session.set(session.id(index), std::move(value));
  });
}

stride_status stride_intervene(stride_simulation* simulation, const char* option,
                               const char* text) {
  return attempt_with(simulation, [&] {
    require(option != nullptr && text != nullptr, "the option, or its text, is NULL");
    simulation->session.intervene(option, text);
  });
}

stride_status stride_send(stride_simulation* simulation, size_t clock, const stride_value* values,
                          size_t value_count) {
  return attempt_with(simulation, [&] {
    Session& session = simulation->session;
    require(values != nullptr || value_count == 0, "the values are NULL");
    variable_of(session, clock, 1);
    core::SentMessage message{.clock = session.id(clock), .values = {}};
    for (const auto& [index, elements, count] : std::span(values, value_count)) {
      core::ValueBlock value = read_value(session, index, elements, count);
      message.values.push_back({session.id(index), std::move(value)});
    }
    session.send(std::move(message));
  });
}

int stride_next_message(stride_simulation* simulation, stride_message* message) {
  bool has_one = false;
  const stride_status status = attempt_with(simulation, [&] {
    require(message != nullptr, "there is no place for the message");
    auto entry = simulation->session.next_message();
    has_one = entry.has_value();
    if (!has_one) return;
    const std::size_t count = entry->value ? entry->value->size() : 0;
    simulation->elements = entry->value ? CElements(*std::move(entry->value)) : CElements();
    simulation->content = std::move(entry->content);
    give(message, {.size = 0,
                   .time = c_time(entry->time),
                   .super_dense_index = entry->index,
                   .index = simulation->session.index(entry->id),
                   .is_received = entry->is_received,
                   .elements = simulation->elements.data(),
                   .count = count,
                   .content = simulation->content.c_str(),
                   .dropped = entry->dropped});
  });
  return status == STRIDE_OK && has_one ? 1 : 0;
}

stride_status stride_save(stride_simulation* simulation, const char* file) {
  return attempt_with(simulation, [&] {
    require(file != nullptr, "the name of the file is NULL");
    simulation->session.save(file);
  });
}

size_t stride_verdict_count(const stride_simulation* simulation) {
  return simulation == nullptr ? 0 : simulation->session.verdicts().size();
}

stride_status stride_get_verdict(stride_simulation* simulation, size_t index,
                                 stride_verdict* verdict) {
  return attempt_with(simulation, [&] {
    require(verdict != nullptr, "there is no place for the verdict");
    const auto& verdicts = simulation->session.verdicts();
    require(index < verdicts.size(), "there is no verdict with this index");
    const core::Verdict& given = verdicts[index];
    give(verdict, {.size = 0,
                   .name = given.name.c_str(),
                   .text = given.text.c_str(),
                   .passed = given.passed ? static_cast<int>(*given.passed) : -1,
                   .time = given.time ? c_time(*given.time) : kNoTime,
                   .margin = given.margin ? given.margin->value : std::nan("")});
  });
}

}  // extern "C"
