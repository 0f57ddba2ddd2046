#include "master/study/replay/replay_system.h"

#include <algorithm>
#include <cctype>
#include <span>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/base/xml/writer.h"
#include "master/engine/model/array_element.h"
#include "master/engine/model/item_text.h"
#include "master/system/declaration/coverage_writer.h"
#include "master/system/ssp/ssp.h"

namespace stride::replay {
namespace {

/// Of stimuli: as long as the unit promises.
constexpr const char* kEndless = "for ever";

/// A name as one of the words of an attribute that lists patterns.
std::string pattern_of(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isspace(c) != 0; }, '?');
  return name;
}

class ReplayWriter {
 public:
  explicit ReplayWriter(const ReplayRequest& request)
      : request_(request),
        system_(request.loaded.system()),
        component_(system_.components()[request.component]),
        device_(device_name(component_.name)),
        player_(device_ == "player" ? "stimuli" : "player") {}

  std::string document() {
    writer_.open("ssd:SystemStructureDescription");
    writer_.attribute("version", "2.0");
    writer_.attribute("name", request_.name);
    writer_.attribute("xmlns:ssd", ssp::kSsd);
    writer_.attribute("xmlns:ssc", ssp::kSsc);
    writer_.attribute("xmlns:ssv", ssp::kSsv);
    write_system();
    write_element("ssd:DefaultExperiment",
                  {{"startTime", request_.stimuli.start}, {"stopTime", request_.stimuli.end}});
    writer_.open("ssd:Annotations");
    writer_.open("ssc:Annotation");
    writer_.attribute("type", ssp::kStrideAnnotation);
    write_annotation();
    writer_.close();
    writer_.close();
    writer_.close();
    return writer_.document();
  }

 private:
  struct Attribute {
    const char* name;
    std::string value;
  };

  void write_element(const char* name, std::initializer_list<Attribute> attributes) {
    writer_.open(name);
    for (const Attribute& attribute : attributes)
      writer_.attribute(attribute.name, attribute.value);
    writer_.close();
  }

  void write_system() {
    writer_.open("ssd:System");
    writer_.attribute("name", request_.name);
    writer_.open("ssd:Elements");
    write_element("ssd:Component", {{"name", player_}, {"source", request_.player}});
    writer_.open("ssd:Component");
    writer_.attribute("name", device_);
    writer_.attribute("source", request_.unit);
    write_parameters();
    writer_.close();
    writer_.close();
    writer_.open("ssd:Connections");
    for (const std::string& input : request_.stimuli.inputs) {
      if (is_set_in_the_run(input)) continue;
      write_element("ssd:Connection", {{"startElement", player_},
                                       {"startConnector", input},
                                       {"endElement", device_},
                                       {"endConnector", input}});
    }
    writer_.close();
    writer_.close();
  }

  void write_parameters() {
    writer_.open("ssd:ParameterBindings");
    writer_.open("ssd:ParameterBinding");
    writer_.open("ssd:ParameterValues");
    writer_.open("ssv:ParameterSet");
    writer_.attribute("version", "2.0");
    writer_.attribute("name", "start");
    writer_.open("ssv:Parameters");
    for (const auto& values : {system_.structural_values(), system_.start_values()}) {
      for (const core::StartValue& start : values) write_start_value(start);
    }
    for (int i = 0; i < 5; ++i) writer_.close();
  }

  /// The player has those of the inputs.
  void write_start_value(const core::StartValue& start) {
    const core::Variable& variable = system_.variable(start.id);
    if (start.id.component != request_.component || is_played(variable)) return;
    for (std::size_t i = 0; i < variable.size; ++i) {
      if (std::ranges::find(start.kept, i) != start.kept.end()) continue;
      writer_.open("ssv:Parameter");
      writer_.attribute("name", core::element_name(variable, i));
      write_element(fmt::format("ssv:{}", core::name(variable.type)).c_str(),
                    {{"value", value_text(variable, start.value, i)}});
      writer_.close();
    }
  }

  /// An item has its name, since another one may have its number for a name.
  static std::string value_text(const core::Variable& variable, const core::ValueBlock& value,
                                std::size_t element) {
    if (variable.type != core::ValueType::Enumeration) return core::element_text(value, element);
    return core::item_name(value.numbers<std::int64_t>()[element], variable.items);
  }

  std::string value_texts(core::VariableId id, const core::ValueBlock& value) const {
    std::string texts;
    for (std::size_t i = 0; i < value.size(); ++i) {
      texts += (i == 0 ? "" : " ") + value_text(system_.variable(id), value, i);
    }
    return texts;
  }

  bool is_played(const core::Variable& variable) const {
    const auto& inputs = request_.stimuli.inputs;
    return std::ranges::find(inputs, variable.name) != inputs.end() &&
           !is_set_in_the_run(variable.name);
  }

  /// An input without a source, which has none in the replay either.
  bool is_set_in_the_run(const std::string& input) const {
    return std::ranges::any_of(request_.loaded.options().interventions, [&](const auto& change) {
      return is_own(change) && change.kind == core::Intervention::Kind::Set &&
             system_.variable(change.id).name == input;
    });
  }

  /// Whether it is of the device's own parameters and inputs, and within the stimuli.
  bool is_own(const core::Intervention& change) const {
    return change.id.component == request_.component && !disturbs_messages(change.kind) &&
           change.from <= core::parse_time(request_.stimuli.end);
  }

  void write_annotation() {
    writer_.open("stride:Scenario");
    writer_.attribute("xmlns:stride", ssp::kStrideScenario);
    write_steps();
    if (!component_.early_return_allowed) {
      write_element("stride:EarlyReturn", {{"components", device_}, {"allowed", "false"}});
    }
    write_idle_skipping();
    write_settings_in_the_run();
    write_records();
    write_coverage();
    write_expectations();
    writer_.close();
  }

  /// A step that ends at the player's events only, or that which the unit demands, or that of the
  /// run whose points have fractions of picoseconds, which no event of the player has.
  void write_steps() {
    const core::StepOptions& step = request_.loaded.options().step;
    const core::Interval size = component_.own_step.value_or(step.size);
    const bool has_fractions = !size.is_whole() && (component_.own_step || step.policy->has_grid);
    if (!component_.description->can_vary_step || has_fractions) {
      return write_element("stride:Step", {{"policy", "fixed"}, {"size", core::to_text(size)}});
    }
    const std::string run = core::to_text(run_length());
    if (is_bounded_skip()) {
      return write_element("stride:Step", {{"size", run}, {"maximum", run}});
    }
    write_element("stride:Step", {{"policy", "event-driven"}, {"maximum", run}});
  }

  Duration run_length() const {
    return core::parse_time(request_.stimuli.end) - core::parse_time(request_.stimuli.start);
  }

  static bool is_default(const std::string& skip) {
    return skip == core::to_text(scenario::IdleSettings::kDefaultMaxSkip);
  }

  /// Whether idle skipping goes with one step as long as the run: a skip other than the default may
  /// not be shorter than a step of a grid.
  bool is_bounded_skip() const {
    const auto& skip = request_.stimuli.max_skip;
    return skip &&
           (*skip == kEndless || is_default(*skip) || core::parse_seconds(*skip) >= run_length());
  }

  void write_idle_skipping() {
    const auto& skip = request_.stimuli.max_skip;
    if (!skip) return write_element("stride:IdleSkip", {{"enabled", "false"}});
    if (!is_default(*skip)) {
      write_element("stride:IdleSkip",
                    {{"maxSkip", *skip == kEndless ? core::to_text(run_length()) : *skip}});
    }
    for (const auto& tolerance : request_.loaded.options().idle.tolerances) {
      if (tolerance.id.component != request_.component) continue;
      write_element("stride:Tolerance",
                    {{"variable", own_name(system_.variable(tolerance.id).name)},
                     {"value", fmt::format("{}", tolerance.value)}});
    }
  }

  /// Forced inputs have the same values from the player, but the unit would not be in Event Mode.
  void write_settings_in_the_run() {
    for (const core::Intervention& change : request_.loaded.options().interventions) {
      if (!is_own(change)) continue;
      const bool is_set = change.kind == core::Intervention::Kind::Set;
      writer_.open(is_set ? "stride:Set" : "stride:Force");
      writer_.attribute("variable", own_name(system_.variable(change.id).name));
      if (change.value) writer_.attribute("value", value_texts(change.id, *change.value));
      writer_.attribute(is_set ? "at" : "from", core::to_text(change.from));
      if (change.until) writer_.attribute("until", core::to_text(*change.until));
      writer_.close();
    }
  }

  void write_records() {
    const auto& variables = component_.description->variables;
    for (const core::Variable& variable : variables) {
      if (!is_recorded(*component_.description, variable)) continue;
      write_element("stride:Record", {{"signals", pattern_of(own_name(variable.name))}});
    }
    write_element("stride:Results", {{"trace", "none"}, {"activity", "none"}, {"report", "none"}});
  }

  void write_coverage() {
    for (const auto& group : request_.loaded.scenario().annotation.coverage) {
      if (group.component != component_.name) continue;
      writer_.open("stride:Coverage");
      scenario::write_group(writer_, group, device_);
      writer_.close();
    }
  }

  void write_expectations() {
    if (request_.expectations.empty()) return;
    writer_.open("stride:Checks");
    for (const Expectation& expected : request_.expectations) {
      const bool is_count = expected.kind == Expectation::Kind::Count;
      writer_.open(is_count ? "stride:Count" : "stride:Final");
      writer_.attribute(is_count ? "event" : "signal", own_name(expected.output));
      writer_.attribute("equals", expected.equals);
      if (!expected.tolerance.empty()) writer_.attribute("tolerance", expected.tolerance);
      writer_.close();
    }
    writer_.close();
  }

  std::string own_name(const std::string& variable) const { return device_ + "." + variable; }

  const ReplayRequest& request_;
  const core::System& system_;
  const core::Component& component_;
  const std::string device_;
  const std::string player_;
  xml::Writer writer_;
};

}  // namespace

std::string device_name(const std::string& component) {
  return component.substr(component.rfind('.') + 1);
}

bool is_recorded(const core::UnitDescription& device, const core::Variable& variable) {
  return variable.causality == core::Causality::Output && variable.type != core::ValueType::Clock &&
         !device.is_message(variable);
}

bool is_reported(const core::UnitDescription& device, const core::Variable& variable) {
  return variable.causality == core::Causality::Output && device.is_reported(variable);
}

std::string replay_system(const ReplayRequest& request) { return ReplayWriter(request).document(); }

}  // namespace stride::replay
