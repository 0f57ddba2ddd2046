// When an answer may start.
#ifndef STRIDE_NFC_FRAME_DELAY_H
#define STRIDE_NFC_FRAME_DELAY_H

#include <stride/time.h>

namespace nfc {

/// The first instant, not before `earliest`, at which an answer to a request that ended at
/// `request_end` may start: (n * 128 + 84) / fc later, n >= 9 (ISO/IEC 14443-3, 6.2.1.1, frame
/// delay time PCD to PICC at 106 kbit/s). The standard counts from the last pause of the request,
/// with 84 after a one and 20 after a zero; the pause of a zero comes 64 / fc later, so both name
/// the same grid, and here it is counted from the end of the frame.
stride::Time answer_start(stride::Time request_end, stride::Time earliest);

}  // namespace nfc

#endif
