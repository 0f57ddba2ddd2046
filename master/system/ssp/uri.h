// Files that a scenario names.
#ifndef STRIDE_MASTER_SYSTEM_SSP_URI_H
#define STRIDE_MASTER_SYSTEM_SSP_URI_H

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "master/base/xml/element.h"

namespace stride::ssp {

/// What the attribute `source` of an element names.
struct Source {
  std::filesystem::path path;
  std::string fragment;   ///< what is behind a '#', a part of the file
  std::string warning{};  ///< where a file is named in another way than it should be
};

/// Whether there is an attribute `source`. One that is empty counts as absent.
bool has_source(const xml::Element& element);

/// The attribute `source`, which must be there, as it is written but for blanks around it.
std::string source_text(const xml::Element& element);

/// The folders that the sources in a file are relative to: its own. Of a symbolic link this is the
/// folder of the link, and behind it that of the file that it leads to.
std::vector<std::filesystem::path> source_folders(const std::filesystem::path& file);

/// A URI (RFC 3986) relative to the first of the `folders` that has it, or else to the first one,
/// or with the scheme file. What is no such URI, and names a file as it is written, is this file; a
/// path that leads to none is also looked for with '\\' as its separator, in the folder
/// `resources`, and by names that differ by case only or by the form of their letters
/// (find_loosely()), with a warning. Throws core::Error (Input) for any other scheme, a query or a
/// malformed escape.
Source source_of(const xml::Element& element, std::span<const std::filesystem::path> folders);

/// Likewise, where a fragment is refused, too. Adds the source's warning, if it has one.
std::filesystem::path source_path(const xml::Element& element,
                                  std::span<const std::filesystem::path> folders,
                                  std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
