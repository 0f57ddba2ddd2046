// Two enumerations, connected without a mapping of their items.
#ifndef STRIDE_MASTER_ENGINE_MODEL_ITEM_MATCH_H
#define STRIDE_MASTER_ENGINE_MODEL_ITEM_MATCH_H

#include <string>
#include <vector>

#include "master/engine/model/transformation.h"

namespace stride::core {

/// What the items of one enumeration are in another one. FMI and SSP transfer the number of an
/// item; its name is what it means. Names that differ by the case of letters alone are the same.
struct ItemMatch {
  /// By the names, if the other enumeration has all of them and not all with the same numbers; else
  /// empty, and the numbers stay what they are.
  NumberMap by_name{};
  /// Items that become one of another name, as text: "'idle' (2) becomes 'standby'".
  std::vector<std::string> renamed{};
  /// Items that both have with different numbers, likewise, where other items have no counterpart,
  /// so that neither names nor numbers tell what is meant: "'on' is 1 and 2".
  std::vector<std::string> contradictions{};
};
ItemMatch match_items(const EnumerationItems& from, const EnumerationItems& to);

}  // namespace stride::core

#endif
