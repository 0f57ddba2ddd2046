// What a reader hears of the frames of several tags at once.
#ifndef STRIDE_UNITS_CHANNEL_SUPERPOSITION_H
#define STRIDE_UNITS_CHANNEL_SUPERPOSITION_H

#include <vector>

#include <stride/nfc/frame.h>

namespace channel {

/// What a reader hears of frames that overlap, in the bits of the earliest. Where all senders send
/// the same bit at the same time, to a sixteenth of a bit, the reader hears that bit. Anything else
/// is a collision: bits that differ, which in Manchester code is a carrier modulated in both halves
/// (ISO/IEC 14443-3, 6.5.2), or frames that are not in step. A bit in collision is heard as 1, and
/// its byte gets a wrong parity bit, so that no collision is ever taken for a good frame.
nfc::Frame superposed(const std::vector<nfc::Frame>& frames);

}  // namespace channel

#endif
