#include "master/observe/coverage/definition.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "master/base/files/sha256.h"
#include "master/base/text/glob.h"

namespace stride::coverage {
namespace {

constexpr std::array<const char*, 7> kKindNames{"values",    "transitions", "words", "lengths",
                                                "sequences", "gaps",        "cross"};

constexpr std::size_t kPointDigits = 16;

/// Of any text, so that no two lists of fields are written alike.
void add_field(std::string& text, std::string_view field) {
  text += fmt::format("{}:{}\n", field.size(), field);
}

}  // namespace

const char* name(Kind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

std::optional<Kind> kind_of(std::string_view name) {
  const auto found =
      std::ranges::find(kKindNames, name, [](const char* k) { return std::string_view(k); });
  if (found == kKindNames.end()) return std::nullopt;
  return static_cast<Kind>(found - kKindNames.begin());
}

bool PointDefinition::ignores(const std::string& bin) const {
  const auto is_meant = [&](const std::string& pattern) { return core::means(pattern, bin); };
  return !is_open || bin == kFurther || std::ranges::any_of(ignored, is_meant);
}

bool PointDefinition::counts(const std::string& bin) const {
  const auto declared = std::ranges::find(bins, bin, &DeclaredBin::name);
  return declared != bins.end() ? !declared->is_ignored : !ignores(bin);
}

void append_crossed(std::string& text, std::string_view bin) {
  if (!text.empty()) text.append(kCrossJoint);
  text.append(bin);
}

std::vector<DeclaredBin> cross_bins(std::span<const PointDefinition* const> parts) {
  std::vector<DeclaredBin> bins{{""}};
  for (const PointDefinition* const part : parts) {
    std::vector<DeclaredBin> crossed;
    for (const DeclaredBin& left : bins) {
      for (const DeclaredBin& bin : part->bins) {
        if (bin.is_ignored) continue;
        append_crossed(crossed.emplace_back(left).name, bin.name);
        if (crossed.size() > kMostBins) {
          throw std::invalid_argument(fmt::format("it has more than {} bins", kMostBins));
        }
      }
    }
    bins = std::move(crossed);
  }
  return bins;
}

std::string hash(const GroupDefinition& group, const PointDefinition& point) {
  std::string text;
  for (const std::string& field :
       {point.name, std::string(name(point.kind)), point.signal, point.unit}) {
    add_field(text, field);
  }
  add_field(text, fmt::format("{} {} {}", point.at_least, point.is_open, point.bins.size()));
  for (const DeclaredBin& bin : point.bins) {
    add_field(text, bin.name);
    add_field(text, bin.is_ignored ? "ignored" : "");
  }
  for (const std::string& pattern : point.ignored) add_field(text, pattern);
  for (const std::size_t part : point.of) add_field(text, hash(group, group.points[part]));
  return core::sha256(text).substr(0, kPointDigits);
}

std::string hash(std::span<const GroupDigest> groups) {
  std::string text;
  for (const GroupDigest& group : groups) {
    add_field(text, group.component);
    add_field(text, group.goal ? fmt::format("{}", *group.goal) : "");
    add_field(text, std::to_string(group.points.size()));
    for (const std::string& point : group.points) add_field(text, point);
  }
  return core::sha256(text);
}

std::string hash(std::span<const GroupDefinition> groups) {
  std::vector<GroupDigest> digests;
  for (const GroupDefinition& group : groups) {
    GroupDigest& digest = digests.emplace_back(GroupDigest{group.name, group.goal});
    for (const PointDefinition& point : group.points) digest.points.push_back(hash(group, point));
  }
  return hash(digests);
}

}  // namespace stride::coverage
