#include "units/reader/program.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

#include "units/xml/document.h"
#include "units/xml/text.h"

namespace reader {

using xml::Element;

namespace {

constexpr double kLargestTremor = 0.5;       // [rad]
constexpr double kLargestStartOffset = 1.0;  // [rad]
constexpr double kHighestFrequency = 100.0;  // of a tremor [Hz]

/// Fills a program section by section; each may refer to what comes before it.
class Parser {
 public:
  Program parse(const Element& root) {
    for (const auto& element : root.children()) section(element);
    if (!program_.axes.empty() && program_.waypoints.empty()) {
      root.fail("expected a <motion> with at least one <waypoint>, because there are axes");
    }
    for (const auto& element : commands_) command(element);
    return std::move(program_);
  }

 private:
  void section(const Element& element) {
    const std::string name = element.name();
    if (name == "axes") {
      for (const auto& child : entries(element, "axis")) axis(child);
    } else if (name == "poses") {
      for (const auto& child : entries(element, "pose")) pose(child);
    } else if (name == "motion") {
      for (const auto& child : entries(element, "waypoint")) waypoint(child);
    } else if (name == "antenna") {
      antenna(element);
    } else if (name == "command") {
      commands_.push_back(element);  // looked at when all antenna intervals are known
    } else if (name == "variation") {
      variation(element);
    } else {
      element.fail(
          "unknown element: expected <axes>, <poses>, <motion>, <variation>, <antenna> or "
          "<command>");
    }
  }

  static std::vector<Element> entries(const Element& list, const std::string& name) {
    list.allow_only({});
    auto children = list.children();
    for (const auto& child : children) {
      if (child.name() != name) child.fail("unknown element: expected <" + name + ">");
    }
    return children;
  }

  void axis(const Element& element) {
    element.allow_only_leaf({"name", "tremor", "start_offset"});
    const std::string name = element.text("name");
    const auto& axes = program_.axes;
    if (name.empty() || name == "name") {
      element.fail("name=\"" + name + "\" cannot be used: expected the name of an actuator");
    }
    if (std::find(axes.begin(), axes.end(), name) != axes.end()) {
      element.fail("the axis '" + name + "' is listed here for the second time");
    }
    if (!poses_.empty()) element.fail("expected all axes before the poses");
    program_.axes.push_back(name);
    const auto amplitude = [&](const char* attribute, double most) {
      return element.has(attribute) ? element.number_within(attribute, 0, most) : 0.0;
    };
    program_.variation.tremor.push_back(amplitude("tremor", kLargestTremor));
    program_.variation.start_offset.push_back(amplitude("start_offset", kLargestStartOffset));
  }

  void variation(const Element& element) {
    element.allow_only_leaf({"seed", "lowest_frequency", "highest_frequency"});
    if (has_variation_) element.fail("expected one <variation> at most");
    has_variation_ = true;
    auto& variation = program_.variation;
    if (element.has("seed")) variation.seed = element.whole_number("seed", 1, UINT64_MAX);
    const auto frequency = [&](const char* attribute, double& value) {
      if (element.has(attribute)) value = element.number_within(attribute, 0, kHighestFrequency);
    };
    frequency("lowest_frequency", variation.lowest_frequency);
    frequency("highest_frequency", variation.highest_frequency);
    if (variation.lowest_frequency < variation.highest_frequency) return;
    element.fail("expected lowest_frequency (" + xml::shortest(variation.lowest_frequency) +
                 " Hz) to be less than highest_frequency (" +
                 xml::shortest(variation.highest_frequency) + " Hz)");
  }

  void pose(const Element& element) {
    auto attributes = program_.axes;
    attributes.insert(attributes.begin(), "name");
    element.allow_only_leaf(attributes);
    std::vector<double> positions;
    for (const auto& axis : program_.axes) positions.push_back(element.number(axis.c_str()));
    const std::string name = element.text("name");
    if (!poses_.emplace(name, std::move(positions)).second) {
      element.fail("the pose '" + name + "' is listed here for the second time");
    }
  }

  void waypoint(const Element& element) {
    element.allow_only_leaf({"at", "pose"});
    const stride::Time at = element.time("at");
    if (!program_.waypoints.empty() && at <= program_.waypoints.back().at) {
      element.fail("at=\"" + element.text("at") + "\": expected a later time than the waypoint's " +
                   "before it");
    }
    const std::string name = element.text("pose");
    const auto pose = poses_.find(name);
    if (pose == poses_.end()) {
      element.fail("unknown pose '" + name +
                   "': expected one that is listed above: " + pose_names());
    }
    program_.waypoints.push_back({at, pose->second});
  }

  std::string pose_names() const {
    std::vector<std::string> names;
    for (const auto& entry : poses_) names.push_back(entry.first);
    return xml::quoted_list(names);
  }

  void antenna(const Element& element) {
    element.allow_only_leaf({"on", "off", "power"});
    const AntennaInterval interval{element.time("on"), element.time("off"),
                                   element.number("power")};
    if (interval.off <= interval.on) {
      element.fail("off=\"" + element.text("off") + "\": expected a later time than on");
    }
    if (!program_.antenna.empty() && interval.on < program_.antenna.back().off) {
      element.fail("on=\"" + element.text("on") +
                   "\": expected the antenna to be off again after the interval before");
    }
    if (!(interval.power > 0.0)) {
      element.fail("power=\"" + element.text("power") + "\": expected more than 0 W");
    }
    program_.antenna.push_back(interval);
  }

  void command(const Element& element) {
    ProgramCommand command = parse_command(element);
    const auto& commands = program_.commands;
    if (!commands.empty() && command.at < commands.back().at) {
      element.fail("at=\"" + element.text("at") + "\": expected commands in the order of time");
    }
    if (!carrier_end(program_, command.at)) {
      element.fail("at=\"" + element.text("at") +
                   "\": the antenna is off then; expected a time within an <antenna> interval");
    }
    program_.commands.push_back(std::move(command));
  }

  Program program_;
  std::map<std::string, std::vector<double>> poses_;
  std::vector<Element> commands_;
  bool has_variation_ = false;
};

constexpr const char* kRoot = "reader-program";

}  // namespace

double carrier_power(const Program& program, stride::Time time) {
  for (const auto& interval : program.antenna) {
    if (interval.on <= time && time < interval.off) return interval.power;
  }
  return 0.0;
}

std::optional<stride::Time> carrier_end(const Program& program, stride::Time time) {
  std::optional<stride::Time> end;
  for (const auto& interval : program.antenna) {
    const bool covers = interval.on <= time && time < interval.off;
    if (covers || end == interval.on) end = interval.off;
  }
  return end;
}

Program load_program(const std::string& path) {
  const auto document = xml::Document::load(path, kRoot);
  return Parser().parse(document.root());
}

Program parse_program(const std::string& text, const std::string& name) {
  const auto document = xml::Document::parse(text, name, kRoot);
  return Parser().parse(document.root());
}

}  // namespace reader
