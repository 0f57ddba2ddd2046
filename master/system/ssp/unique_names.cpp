#include "master/system/ssp/unique_names.h"

#include <fmt/format.h>

namespace stride::ssp {

void UniqueNames::refuse(const xml::Element& element, const std::string& name, int first,
                         bool is_same) {
  const std::string mistake =
      fmt::format("two {} are named '{}'; the first is in line {}", what_, name, first);
  if (!is_same) element.fail(mistake + ", and they differ", "keep one of them");
  warnings_.push_back(core::to_text({.where = element.where()}) + mistake +
                      ", and they are the same");
}

}  // namespace stride::ssp
