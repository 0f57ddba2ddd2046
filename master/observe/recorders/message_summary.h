#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_MESSAGE_SUMMARY_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_MESSAGE_SUMMARY_H

#include <cstddef>
#include <string>

#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"

namespace stride::recorders {

/// The human-readable content of a message, in a line of `most` characters at most: its content in
/// its component's words, else the text of a String, numbers with their unit of measure, the size
/// of bytes. Empty for a bare clock.
std::string message_summary(const core::System& system, const core::Message& message,
                            std::size_t most);

}  // namespace stride::recorders

#endif
