// What the variables of a channel's tags are called.
#ifndef STRIDE_UNITS_CHANNEL_NAMES_H
#define STRIDE_UNITS_CHANNEL_NAMES_H

#include <string>

namespace channel {

/// A tag's name, empty for the only tag of a channel that lists none.
struct TagName {
  std::string name;

  std::string coil() const { return name.empty() ? "tag_coil" : name + ".coil"; }
  /// What the tag's other parameters begin with.
  std::string prefix() const { return name.empty() ? "tag" : name; }
  /// Of a variable that has another name where there is only one tag.
  std::string variable(const std::string& plain, const std::string& of_the_only_tag) const {
    return name.empty() ? of_the_only_tag : name + "." + plain;
  }
  std::string variable(const std::string& plain) const { return variable(plain, plain); }
  /// In a sentence.
  std::string text() const { return name.empty() ? "tag" : "tag " + name; }
};

}  // namespace channel

#endif
