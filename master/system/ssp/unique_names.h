// Names that a list of a file of SSP holds once.
#ifndef STRIDE_MASTER_SYSTEM_SSP_UNIQUE_NAMES_H
#define STRIDE_MASTER_SYSTEM_SSP_UNIQUE_NAMES_H

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "master/base/xml/element.h"

namespace stride::ssp {

/// The names of the elements of one list, with the line of each.
class UniqueNames {
 public:
  /// `what` the list holds, in the plural: "parameters". The warnings must outlive this object.
  UniqueNames(std::string what, std::vector<std::string>& warnings)
      : what_(std::move(what)), warnings_(warnings) {}

  /// Whether the element is the first of its name. A later one that `is_same` as the first is
  /// ignored with a warning. Throws core::Error (Input) for one that differs from it.
  template <class IsSame>
  bool add(const xml::Element& element, const std::string& name, IsSame&& is_same) {
    const auto [first, is_new] = lines_.emplace(name, element.where().line);
    if (!is_new) refuse(element, name, first->second, is_same());
    return is_new;
  }

 private:
  void refuse(const xml::Element& element, const std::string& name, int first, bool is_same);

  std::string what_;
  std::vector<std::string>& warnings_;
  std::map<std::string, int> lines_;
};

}  // namespace stride::ssp

#endif
