// When an answer may start.
#ifndef STRIDE_NFC_FRAME_DELAY_H
#define STRIDE_NFC_FRAME_DELAY_H

#include <stride/nfc/frame.h>
#include <stride/time.h>

namespace nfc {

/// The first instant at which an answer to this request of 106 kbit/s may start: (n * 128 + 84) /
/// fc after the end of its last pause if its last bit is a one, (n * 128 + 20) / fc if it is a
/// zero, with n = 9 (ISO/IEC 14443-3, 6.2.1.1, frame delay time PCD to PICC).
///
/// The last pause depends on the last bit. In modified Miller code a one has its pause from the
/// middle of the bit on, and the end of communication that follows it none; after a zero the end
/// of communication has one from its beginning on (ISO/IEC 14443-2, 8.1.3). A pause lasts 32 / fc,
/// a quarter of the bit. Both cases lead to the same instant, a bit's time being 128 / fc: 1204 /
/// fc after the beginning of the end of communication.
stride::Time first_answer_start(const Frame& request);

/// The first instant of the grid that begins with `first` and has one every 128 / fc, not before
/// `earliest`.
stride::Time answer_start(stride::Time first, stride::Time earliest);

}  // namespace nfc

#endif
