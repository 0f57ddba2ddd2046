// A frame as human-readable text.
#ifndef STRIDE_NFC_IN_WORDS_H
#define STRIDE_NFC_IN_WORDS_H

#include <string>

#include <stride/nfc/frame.h>

namespace nfc {

enum class Sender { Reader, Tag };

/// The value of a Binary variable that holds a frame, in one short line: "set_led 1",
/// "ok 21.49 °C", "set_led, cut after 17 of 36 bits", "CRC wrong". Two bytes of data in an answer
/// are a temperature, four an identifier, more of them a log; which command it is the answer to
/// is not part of it. Any bytes are allowed; for what is not a frame the text is the reason.
std::string in_words(const Bytes& payload, Sender sender);

}  // namespace nfc

#endif
