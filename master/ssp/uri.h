// Files that a scenario names.
#ifndef STRIDE_MASTER_SSP_URI_H
#define STRIDE_MASTER_SSP_URI_H

#include <filesystem>
#include <string>

#include "master/util/xml/element.h"

namespace stride::ssp {

/// What the attribute `source` of an element names.
struct Source {
  std::filesystem::path path;
  std::string fragment;  ///< what is behind a '#', a part of the file
};

/// A URI (RFC 3986) relative to `folder`, or with the scheme file. What is no such URI, and names a
/// file as it is written, is this file; a path that leads to none is also looked for with '\\' as
/// its separator, and in the folder `resources`. Throws core::Error (Input) for any other scheme, a
/// query or a malformed escape.
Source source_of(const xml::Element& element, const std::filesystem::path& folder);

/// Likewise, where a fragment is refused, too.
std::filesystem::path source_path(const xml::Element& element, const std::filesystem::path& folder);

}  // namespace stride::ssp

#endif
