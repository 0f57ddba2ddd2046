// printf's formats with arguments that may be missing or wrong.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_PRINTF_TEXT_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_PRINTF_TEXT_H

#include <cstdarg>
#include <string>

namespace stride::importer {

/// What printf would print, where its arguments are as the format says. Many a unit passes a text
/// of its own as the format, so a % in it has no argument: what is read in its place may be any
/// number, and a text whose memory cannot be read is "(no text)". A conversion that printf does not
/// know, and %n, which would write to memory, are given as they are, as is all behind them.
std::string printf_text(const char* format, std::va_list arguments);

}  // namespace stride::importer

#endif
