// Paths as URIs (RFC 3986), for the standards that name files by these.
#ifndef STRIDE_MASTER_BASE_FILES_FILE_URI_H
#define STRIDE_MASTER_BASE_FILES_FILE_URI_H

#include <filesystem>
#include <string>

namespace stride::core {

/// The path within a URI: what is neither a letter, a digit nor one of "-._~/" is escaped.
std::string uri_path(const std::filesystem::path& path);

/// The URI of the absolute path, with the scheme file (RFC 8089), whether the file exists or not.
std::string file_uri(const std::filesystem::path& path);

}  // namespace stride::core

#endif
