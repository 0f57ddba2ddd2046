// A message from outside of the system.
#ifndef STRIDE_MASTER_ENGINE_RUN_EVENTS_SENT_MESSAGE_H
#define STRIDE_MASTER_ENGINE_RUN_EVENTS_SENT_MESSAGE_H

#include <vector>

#include "master/engine/model/values.h"
#include "master/engine/model/variable_id.h"

namespace stride::core {

/// A tick of an input clock, with values of inputs that belong to it.
struct SentMessage {
  struct Value {
    VariableId id;
    ValueBlock block;
  };
  VariableId clock;
  std::vector<Value> values;
};

}  // namespace stride::core

#endif
