// MuJoCo reports errors and warnings through two hooks of the process. By default an error ends the
// process and either writes MUJOCO_LOG.TXT into the current folder.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_HOOKS_H
#define STRIDE_UNITS_MUJOCO_WORLD_HOOKS_H

#include <string>
#include <utility>
#include <vector>

namespace mujoco_world {

/// Points MuJoCo's hooks at this library's: an error throws std::runtime_error with MuJoCo's text,
/// a warning is kept for take_warnings(). Cheap, and repeated before every call that may report,
/// because the hooks are shared with all other users of MuJoCo in this process.
///
/// The error hook throws in any caller's call that fails; a standard type, so that two libraries
/// which both contain this code can serve each other. It may leave through MuJoCo's frames, which
/// need no clean-up but must have unwind tables: the rule on x86-64 and AArch64, C code included,
/// and checked by a test. What it leaves behind is MuJoCo's stack mark in mjData.
void install_hooks();

/// Calls into MuJoCo with the hooks installed.
template <typename Call>
decltype(auto) guarded(Call&& call) {
  install_hooks();
  return std::forward<Call>(call)();
}

/// Keeps a warning of ours with MuJoCo's.
void add_warning(std::string warning);

/// The warnings of the calling thread since the last call, oldest first.
std::vector<std::string> take_warnings();

}  // namespace mujoco_world

#endif
