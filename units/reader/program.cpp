#include "units/reader/program.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <tinyxml2.h>

#include "units/reader/xml.h"

namespace reader {
namespace {

constexpr double kDefaultTimeout = 0.05;  // [s]
constexpr double kDefaultBitRate = 106;   // [kbit/s]

struct CommandName {
  const char* name;
  nfc::Command command;
};
constexpr CommandName kCommandNames[] = {{"identify", nfc::Command::kIdentify},
                                         {"read_temperature", nfc::Command::kReadTemperature},
                                         {"set_led", nfc::Command::kSetLed}};

nfc::Command to_command(const Element& element) {
  const std::string name = element.text("name");
  std::vector<std::string> known;
  for (const auto& entry : kCommandNames) {
    if (name == entry.name) return entry.command;
    known.push_back(entry.name);
  }
  element.fail("unknown command '" + name + "': expected one of " + quoted_list(known));
}

/// Fills a program section by section; each may refer to what stands before it.
class Parser {
 public:
  Program parse(const Element& root) {
    if (root.name() != "reader-program") root.fail("expected <reader-program> as the root");
    root.allow_only({"version"});
    if (const std::string version = root.text("version"); version != "1") {
      root.fail("version=\"" + version + "\" is not known: expected 1");
    }
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
    } else {
      element.fail("unknown element: expected <axes>, <poses>, <motion>, <antenna> or <command>");
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
    element.allow_only_leaf({"name"});
    const std::string name = element.text("name");
    const auto& axes = program_.axes;
    if (name.empty() || name == "name") {
      element.fail("name=\"" + name + "\" cannot be used: expected the name of an actuator");
    }
    if (std::find(axes.begin(), axes.end(), name) != axes.end()) {
      element.fail("the axis '" + name + "' stands here for the second time");
    }
    if (!poses_.empty()) element.fail("expected all axes before the poses");
    program_.axes.push_back(name);
  }

  void pose(const Element& element) {
    auto attributes = program_.axes;
    attributes.insert(attributes.begin(), "name");
    element.allow_only_leaf(attributes);
    std::vector<double> positions;
    for (const auto& axis : program_.axes) positions.push_back(element.number(axis.c_str()));
    const std::string name = element.text("name");
    if (!poses_.emplace(name, std::move(positions)).second) {
      element.fail("the pose '" + name + "' stands here for the second time");
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
      element.fail("unknown pose '" + name + "': expected one that stands above: " + pose_names());
    }
    program_.waypoints.push_back({at, pose->second});
  }

  std::string pose_names() const {
    std::vector<std::string> names;
    for (const auto& entry : poses_) names.push_back(entry.first);
    return quoted_list(names);
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
    ProgramCommand command;
    command.at = element.time("at");
    command.command = to_command(element);
    command.arguments = arguments(element, command.command);
    command.timeout = timeout(element);
    command.bit_rate = bit_rate(element);
    const auto& commands = program_.commands;
    if (!commands.empty() && command.at < commands.back().at) {
      element.fail("at=\"" + element.text("at") + "\": expected commands in the order of time");
    }
    if (!(carrier_power(program_, command.at) > 0.0)) {
      element.fail("at=\"" + element.text("at") +
                   "\": the antenna is off then; expected a time within an <antenna> interval");
    }
    program_.commands.push_back(std::move(command));
  }

  static nfc::Bytes arguments(const Element& element, nfc::Command command) {
    if (command != nfc::Command::kSetLed) {
      element.allow_only_leaf({"at", "name", "timeout", "bit_rate"});
      return {};
    }
    element.allow_only_leaf({"at", "name", "led", "timeout", "bit_rate"});
    const std::string led = element.text("led");
    if (led != "on" && led != "off") element.fail("led=\"" + led + "\": expected 'on' or 'off'");
    return {static_cast<std::uint8_t>(led == "on" ? 1 : 0)};
  }

  static stride::Duration timeout(const Element& element) {
    const double timeout = element.number("timeout", kDefaultTimeout);
    if (!(timeout > 0.0 && timeout <= stride::kMaxSeconds)) {
      element.fail("timeout=\"" + element.text("timeout") + "\": expected more than 0 seconds");
    }
    return stride::duration_from_seconds(timeout);
  }

  static std::uint32_t bit_rate(const Element& element) {
    const double rate = element.number("bit_rate", kDefaultBitRate);
    for (const std::uint32_t known : {106, 212, 424, 848}) {
      if (rate == known) return known;
    }
    element.fail("bit_rate=\"" + element.text("bit_rate") +
                 "\": expected 106, 212, 424 or 848 kbit/s");
  }

  Program program_;
  std::map<std::string, std::vector<double>> poses_;
  std::vector<Element> commands_;
};

Program parse_document(const tinyxml2::XMLDocument& document, const std::string& name) {
  if (document.ErrorID() == tinyxml2::XML_ERROR_FILE_NOT_FOUND ||
      document.ErrorID() == tinyxml2::XML_ERROR_FILE_COULD_NOT_BE_OPENED) {
    throw std::runtime_error(name + ": cannot be read: expected the reader's program file");
  }
  if (document.Error()) {
    throw std::runtime_error(name + ":" + std::to_string(document.ErrorLineNum()) +
                             ": expected well-formed XML: " + document.ErrorName());
  }
  if (document.RootElement() == nullptr) {
    throw std::runtime_error(name + ":1: expected <reader-program> as the root");
  }
  return Parser().parse(Element(*document.RootElement(), name));
}

}  // namespace

double carrier_power(const Program& program, stride::Time time) {
  for (const auto& interval : program.antenna) {
    if (interval.on <= time && time < interval.off) return interval.power;
  }
  return 0.0;
}

Program load_program(const std::string& path) {
  tinyxml2::XMLDocument document;
  document.LoadFile(path.c_str());
  return parse_document(document, path);
}

Program parse_program(const std::string& text, const std::string& name) {
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  return parse_document(document, name);
}

std::string name_of(nfc::Command command) {
  for (const auto& entry : kCommandNames) {
    if (entry.command == command) return entry.name;
  }
  throw std::invalid_argument("no name for command " + std::to_string(static_cast<int>(command)));
}

}  // namespace reader
