// Files that a scenario names.
#ifndef STRIDE_MASTER_IO_URI_H
#define STRIDE_MASTER_IO_URI_H

#include <filesystem>
#include <string>

#include "master/xml/element.h"

namespace stride::io {

/// The path that the attribute `source` of an element names: a URI (RFC 3986) relative to `folder`,
/// or with the scheme file. Throws core::Error (Input) for any other scheme, a fragment, a query or
/// a malformed escape.
std::filesystem::path source_path(const xml::Element& element, const std::filesystem::path& folder);

}  // namespace stride::io

#endif
