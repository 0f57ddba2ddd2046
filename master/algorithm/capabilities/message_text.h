#ifndef STRIDE_MASTER_ALGORITHM_CAPABILITIES_MESSAGE_TEXT_H
#define STRIDE_MASTER_ALGORITHM_CAPABILITIES_MESSAGE_TEXT_H

#include <string>

#include "master/algorithm/capability.h"
#include "master/model/description.h"
#include "master/model/values.h"

namespace stride::core {

class MessageText : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::MessageText;

  /// A readable description of a Binary value, made by the unit; untrusted, so pass it through
  /// readable_text(). Empty if the unit has none. In any mode; changes nothing.
  virtual std::string describe_message(ValueReference variable, const Binary& value) = 0;
};

}  // namespace stride::core

#endif
