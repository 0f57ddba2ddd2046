#include "master/isolation/process/system_calls.h"

#include <cerrno>
#include <initializer_list>
#include <system_error>

#include <fcntl.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

namespace stride::isolation {
namespace {

/// What libseccomp returns: 0 or an errno, negated.
void require(int result) {
  if (result < 0) throw std::system_error(-result, std::generic_category(), "seccomp");
}

scmp_arg_cmp argument(unsigned index, scmp_compare how, scmp_datum_t value,
                      scmp_datum_t second = 0) {
  return {index, how, value, second};
}

/// The part of a register that holds an int.
constexpr scmp_datum_t kInt = 0xffffffffU;

/// Lets through what no rule denies.
class Filter {
 public:
  Filter() : context_(::seccomp_init(SCMP_ACT_ALLOW)) {
    if (context_ == nullptr) throw std::system_error(ENOMEM, std::generic_category(), "seccomp");
    add_architectures();
  }
  ~Filter() { ::seccomp_release(context_); }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  /// The call with such arguments.
  void deny(int call, std::initializer_list<scmp_arg_cmp> arguments = {}) {
    require(::seccomp_rule_add_array(context_, SCMP_ACT_ERRNO(EACCES), call,
                                     static_cast<unsigned>(arguments.size()), arguments.begin()));
  }

  void load() {
    // it is no filter between secrets, so memory accesses need not be slowed down for it
    ::seccomp_attr_set(context_, SCMP_FLTATR_CTL_SSB, 1);
    require(::seccomp_load(context_));
  }

 private:
  /// Programs of a machine's other interfaces pass through the same filter.
  void add_architectures() {
    require(::seccomp_attr_set(context_, SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_ERRNO(EACCES)));
    if (::seccomp_arch_native() == SCMP_ARCH_X86_64) {
      require(::seccomp_arch_add(context_, SCMP_ARCH_X86));
      require(::seccomp_arch_add(context_, SCMP_ARCH_X32));
    } else if (::seccomp_arch_native() == SCMP_ARCH_AARCH64) {
      require(::seccomp_arch_add(context_, SCMP_ARCH_ARM));
    }
  }

  scmp_filter_ctx context_;
};

}  // namespace

void forbid_network() {
  Filter filter;
  filter.deny(SCMP_SYS(socket), {argument(0, SCMP_CMP_NE, AF_UNIX)});
  constexpr int kSocket = 1;  // of a 32-bit program, whose arguments cannot be seen
  filter.deny(SCMP_SYS(socketcall), {argument(0, SCMP_CMP_EQ, kSocket)});
  filter.deny(SCMP_SYS(io_uring_setup));  // makes sockets, too
  // the shell that stride was started from would take it for the user's
  filter.deny(SCMP_SYS(ioctl), {argument(1, SCMP_CMP_MASKED_EQ, kInt, TIOCSTI)});
  filter.deny(SCMP_SYS(ioctl), {argument(1, SCMP_CMP_MASKED_EQ, kInt, TIOCLINUX)});
  filter.load();
}

void forbid_truncation() {
  Filter filter;
  filter.deny(SCMP_SYS(truncate));
  filter.deny(SCMP_SYS(truncate64));
  filter.deny(SCMP_SYS(openat2));  // its flags cannot be seen
  constexpr scmp_datum_t kSeen = O_TRUNC | O_ACCMODE;
  constexpr scmp_datum_t kDenied = O_TRUNC | O_RDONLY;
  filter.deny(SCMP_SYS(open), {argument(1, SCMP_CMP_MASKED_EQ, kSeen, kDenied)});
  filter.deny(SCMP_SYS(openat), {argument(2, SCMP_CMP_MASKED_EQ, kSeen, kDenied)});
  filter.load();
}

}  // namespace stride::isolation
