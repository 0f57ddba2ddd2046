// What the tests of coverage share: definitions by hand, and a run without a simulation.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_COVERAGE_SUPPORT_H
#define STRIDE_TESTS_MASTER_OBSERVE_COVERAGE_SUPPORT_H

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "master/base/state_archive.h"
#include "master/observe/coverage/coverage.h"

namespace stride::coverage {

constexpr Time at(std::int64_t milliseconds) {
  return Time(std::chrono::milliseconds(milliseconds));
}

inline PointDefinition values_of(const std::string& name, std::size_t variable, Classes classes) {
  PointDefinition point;
  point.name = point.signal = name;
  point.id = {0, variable};
  point.bins = std::visit([](const auto& all) { return all.bins(); }, classes);
  point.classes = std::move(classes);
  return point;
}

inline Items truths() { return Items({{0, "false"}, {1, "true"}}); }

inline PointDefinition transitions_of(const std::string& name, std::size_t variable, Items items) {
  PointDefinition point = values_of(name, variable, items);
  point.kind = Kind::Transitions;
  point.bins = items.transitions();
  return point;
}

/// Open where no bins are declared.
inline PointDefinition messages_of(Kind kind, const std::string& name,
                                   std::vector<DeclaredBin> bins = {}) {
  PointDefinition point;
  point.name = name;
  point.kind = kind;
  point.id = {0, 9};
  point.is_open = bins.empty();
  point.is_text = true;
  point.bins = std::move(bins);
  return point;
}

inline PointDefinition cross_of(const GroupDefinition& group, std::vector<std::size_t> of) {
  PointDefinition point;
  point.name = "cross";
  point.kind = Kind::Cross;
  std::vector<const PointDefinition*> parts;
  for (const std::size_t part : of) {
    parts.push_back(&group.points[part]);
    point.is_open |= parts.back()->is_open;
  }
  if (!point.is_open) point.bins = cross_bins(parts);
  point.of = std::move(of);
  return point;
}

/// The bins that were hit: "true 2 at 0.001, ...".
inline std::string hits(const PointReport& point) {
  std::string text;
  for (const BinCount& bin : point.bins) {
    if (bin.count == 0) continue;
    text += text.empty() ? "" : ", ";
    text += bin.name + (bin.is_ignored ? "!" : "") + " " + std::to_string(bin.count);
  }
  return text;
}

/// A component with a number (variable 0), a truth (1), and messages (9).
struct Device {
  explicit Device(GroupDefinition group) : coverage({std::move(group)}) { start(coverage); }

  void start(Coverage& of) {
    std::vector<core::Signal> signals;
    for (const core::VariableId id : of.signals()) {
      signals.push_back({id, id.variable == 0 ? &number : &truth, 0});
    }
    of.on_start(signals);
  }
  void point(std::int64_t milliseconds, double value, bool is_true = false) {
    number.numbers<double>()[0] = value;
    truth.numbers<bool>()[0] = is_true;
    coverage.on_communication_point(at(milliseconds));
  }
  void message(std::int64_t milliseconds, const std::string& content, std::size_t bytes = 1) {
    binary.binaries()[0].assign(bytes, 0x26);
    core::Message message{at(milliseconds), 0, {0, 9}, true, &binary, 0};
    message.content = content;
    coverage.on_message(message);
  }
  PointReport report(std::size_t point) const {
    return coverage.report("s").groups[0].points[point];
  }

  Coverage coverage;
  core::ValueBlock number{core::ValueType::Float64, 1};
  core::ValueBlock truth{core::ValueType::Boolean, 1};
  core::ValueBlock binary{core::ValueType::Binary, 1};
};

inline GroupDefinition group_of(std::vector<PointDefinition> points) {
  return {0, "device", {}, std::move(points)};
}

/// A level in two bins, words, and a cross of both; covered in part, by a message if `has_message`.
inline Report example_report(std::string scenario, double goal, bool has_message = true) {
  GroupDefinition group =
      group_of({values_of("level", 0, equal_ranges(0, 2, 2, false, core::ValueType::Float64)),
                messages_of(Kind::Words, "words")});
  group.points.push_back(cross_of(group, {0, 1}));
  group.goal = goal;
  Device device(group);
  device.point(0, 0.5);
  if (has_message) device.message(1, "read");
  device.point(1, 7);
  device.point(2, 7);
  return device.coverage.report(std::move(scenario));
}

}  // namespace stride::coverage

#endif
