#ifndef STRIDE_MASTER_FRONT_CLI_TERMINAL_BROWSER_H
#define STRIDE_MASTER_FRONT_CLI_TERMINAL_BROWSER_H

#include <filesystem>
#include <string>

namespace stride::cli {

/// Starts the first existing program of $BROWSER, or else xdg-open, with the file, and does not
/// wait for it. Throws core::Error (Run) with a hint.
void open_in_browser(const std::filesystem::path& file);
/// The same with an address.
void open_address_in_browser(const std::string& address);

}  // namespace stride::cli

#endif
