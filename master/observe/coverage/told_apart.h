// Points that not all runs have, or not all alike.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_TOLD_APART_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_TOLD_APART_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/observe/coverage/report.h"

namespace stride::coverage {

/// A name, and behind it a part of the definition of what it names: "output@3f2a91c0".
std::string label(const std::string& name, const std::string& definition);
/// What the point is called where names have to be unique in a group: its name, and behind it a
/// part of its definition where another definition has the same name.
std::string label(const GroupReport& group, const PointReport& point);
/// Of the parts of a cross.
std::vector<std::string> part_labels(const GroupReport& group, const PointReport& cross);

/// A point that some runs have not, or otherwise.
struct ToldApart {
  std::string component;
  std::string point;  ///< its label()
  std::string definition;
  std::uint64_t runs = 0;
  std::optional<std::uint64_t> first_case{};
  std::string why;  ///< "bin 2 is '[1, 3]', and '[1, 2]' in output@3f2a91c0"
};

/// In the order of the report; empty where all runs have the same points.
std::vector<ToldApart> told_apart(const Report& report);

}  // namespace stride::coverage

#endif
