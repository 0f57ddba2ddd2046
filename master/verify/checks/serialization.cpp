#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/algorithm/capabilities/state_saving.h"
#include "master/algorithm/capabilities/state_serialization.h"
#include "master/util/error.h"
#include "master/util/hex.h"
#include "master/verify/checks.h"

namespace stride::verify {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// A state as bytes, where it was made, and what followed.
struct Serialized {
  Bytes bytes;
  TestInstance::Position position;
  std::vector<Row> rows;
  std::size_t to;
};

Serialized serialize(const Trial& trial) {
  const std::size_t from = trial.point_at(0.3);
  Serialized made{{}, {}, {}, trial.point_at(0.8)};
  TestInstance instance = trial.make_instance();
  instance.start();
  instance.run_to(from, false);
  instance.capability<core::StateSaving>().save_state();
  made.bytes = instance.capability<core::StateSerialization>().serialize_state();
  made.position = instance.position();
  instance.clear_recorded();
  instance.run_to(made.to);
  made.rows = instance.recording().rows;
  return made;
}

std::string to_text(const Serialized& made) {
  const auto& [now, point, next] = made.position;
  return Json{{"bytes", core::to_hex(made.bytes)},
              {"now", now.time_since_epoch().count()},
              {"point", point},
              {"next", next.value_or(Time::min()).time_since_epoch().count()},
              {"to", made.to},
              {"recording", to_text(Recording{made.rows})}}
      .dump();
}

Serialized serialized_from_text(const std::string& text) {
  const Json json = Json::parse(text);
  const auto time = [&](const char* key) { return Time(Duration(json[key].get<std::int64_t>())); };
  Serialized made{core::from_hex(json["bytes"].get<std::string>()).value(),
                  {time("now"), json["point"], time("next")},
                  recording_from_text(json["recording"]).rows,
                  json["to"]};
  if (made.position.next_event == Time::min()) made.position.next_event.reset();
  return made;
}

bool has_schedule(const core::UnitDescription& unit) {
  return std::any_of(unit.variables.begin(), unit.variables.end(),
                     [](const core::Variable& variable) { return variable.is_time_based_clock(); });
}

enum class Receiver { New, Initialized };

/// Goes on from the bytes in an instance that was never started, or was initialized. The importer's
/// own schedule of time-based clocks is not in them: a second instance, which makes the same steps,
/// has it.
Recording continue_from(const Trial& trial, const Serialized& made, Receiver receiver) {
  std::optional<core::Clocks> clocks;
  if (has_schedule(trial.tested.description())) {
    TestInstance guide = trial.make_instance({.name = "guide"});
    guide.start();
    guide.run_to(made.position.point, false);
    clocks.emplace(guide.clocks());
  }
  TestInstance instance = trial.make_instance();
  if (receiver == Receiver::Initialized) instance.start();
  instance.clear_recorded();
  instance.capability<core::StateSerialization>().deserialize_state(made.bytes);
  instance.capability<core::StateSaving>().restore_state();
  instance.set_position(made.position, clocks ? &*clocks : nullptr);
  instance.run_to(made.to);
  return instance.recording();
}

/// Throws Failure where what follows in such an instance is not what followed in the first one.
/// Returns how it differs by rounding.
std::string require_same(const Trial& trial, const Serialized& made, Receiver receiver,
                         const std::string& where) {
  std::string note;
  const auto differs =
      difference_beyond_rounding(trial.tested, made.rows, continue_from(trial, made, receiver).rows,
                                 "in the instance that was serialised", where, note);
  if (differs) throw Failure(*differs);
  return note;
}

/// Many units need an initialized instance, though the standards allow the calls in a new one, too
/// (FMI 2.0, 4.2.4; FMI 3.0, 2.3.1).
bool goes_on_if_initialized(const Trial& trial, const Serialized& made) {
  try {
    trial.in_child([&] { return require_same(trial, made, Receiver::Initialized, ""); });
    return true;
  } catch (const Failure&) {
    return false;
  }
}

/// As require_same(), in a process of its own.
std::string require_same_in_child(const Trial& trial, const Serialized& made,
                                  const std::function<std::string()>& work) {
  try {
    return trial.in_child(work);
  } catch (const Failure& failure) {
    if (!goes_on_if_initialized(trial, made)) throw;
    throw Failure(fmt::format(
        "{}; this is in an instance that was never initialised, another one goes on well",
        failure.what()));
  }
}

/// What the unit makes of bytes that are not a state.
std::string reaction(const Trial& trial, const Bytes& bytes) {
  try {
    return trial.in_child([&] {
      TestInstance instance = trial.make_instance();
      try {
        instance.capability<core::StateSerialization>().deserialize_state(bytes);
        instance.capability<core::StateSaving>().restore_state();
        return std::string("accepted");
      } catch (const core::Error&) {
        return std::string("refused");
      }
    });
  } catch (const Failure& failure) {
    return failure.what();
  }
}

}  // namespace

Finding check_serialization(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  if (!unit.can_serialize_state) return skipped("it has no canSerializeFMUState");
  const Serialized made =
      serialized_from_text(trial.in_child([&] { return to_text(serialize(trial)); }));
  std::vector<std::string> notes;
  const auto require = [&](const std::function<std::string()>& work) {
    const std::string note = require_same_in_child(trial, made, work);
    if (notes.empty() && !note.empty()) notes.push_back(note);
  };
  if (!unit.single_instance) {
    require([&] {
      return require_same(trial, serialize(trial), Receiver::New,
                          "in another one of the same process");
    });
  }
  require([&] {
    return require_same(trial, made, Receiver::New, "in an instance of another process");
  });

  bool refuses_all = true;
  const auto examine = [&](const char* what, const Bytes& bytes) {
    const std::string seen = reaction(trial, bytes);
    if (seen == "refused") return;
    refuses_all = false;
    notes.push_back(fmt::format("{}: {}", what, seen));
  };
  examine("bytes that break off",
          Bytes(made.bytes.begin(),
                made.bytes.begin() + static_cast<std::ptrdiff_t>(made.bytes.size() / 2)));
  examine("no bytes at all", {});
  Bytes longer = made.bytes;
  longer.insert(longer.end(), 64, 0xFF);
  examine("bytes with something behind them", longer);
  return passed(fmt::format("{} bytes go on in a new instance of {} process{}", made.bytes.size(),
                            unit.single_instance ? "another" : "this and of another",
                            refuses_all ? "; damaged bytes are refused" : ""),
                std::move(notes));
}

}  // namespace stride::verify
