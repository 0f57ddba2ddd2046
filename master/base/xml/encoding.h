// The character encoding of XML documents.
#ifndef STRIDE_MASTER_BASE_XML_ENCODING_H
#define STRIDE_MASTER_BASE_XML_ENCODING_H

#include <string>

namespace stride::xml {

struct DecodedText {
  std::string text;     ///< UTF-8; an XML declaration, if there is one, says so
  std::string warning;  ///< with the line of the first bytes that are none of the encoding, if any
};

/// A document from its bytes, whose lines stay where they are. The encoding is that of the byte
/// order mark, or of the first characters, or else the one that the XML declaration names (XML 1.0,
/// appendix F), which may be any that iconv knows. Bytes of "UTF-8" that are none are taken for
/// Windows-1252, since this is what declares it wrongly; those of other encodings become U+FFFD.
///
/// Throws core::Error (Input) for an encoding that iconv does not know; `file` is the document's
/// name in messages.
DecodedText decode(std::string bytes, const std::string& file);

}  // namespace stride::xml

#endif
