// A file of stimuli whose run could not end it: its process was killed.
#ifndef STRIDE_MASTER_OBSERVE_CAPTURE_UNENDED_STIMULI_H
#define STRIDE_MASTER_OBSERVE_CAPTURE_UNENDED_STIMULI_H

#include <filesystem>
#include <string_view>

namespace stride::capture {

/// Gives the file its end mark, unless it has one: before the last step that it has, since nothing
/// says where that one has ended, and what is behind it may be cut off. Returns whether the file
/// can be played; one without a step that is known to have ended cannot. Throws core::Error if it
/// cannot be read or written.
bool end_stimuli(const std::filesystem::path& file, std::string_view ending);

}  // namespace stride::capture

#endif
