#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_MESSAGE_TEXT_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_MESSAGE_TEXT_H

#include <string>

#include "master/engine/model/description.h"
#include "master/engine/model/values.h"
#include "master/engine/port/capability.h"

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
