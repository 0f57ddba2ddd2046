#include "master/base/process/locale_state.h"

#include <clocale>

namespace stride::core {

LocaleState::LocaleState() : c_(std::setlocale(LC_ALL, nullptr)), thread_(::uselocale(nullptr)) {}

void LocaleState::restore(std::vector<std::string>& changes) const {
  bool is_changed = false;
  if (std::locale() != cpp_) {
    std::locale::global(cpp_);  // may set that of C, too
    is_changed = true;
  }
  if (std::setlocale(LC_ALL, nullptr) != c_) {
    std::setlocale(LC_ALL, c_.c_str());
    is_changed = true;
  }
  if (::uselocale(nullptr) != thread_) {
    ::uselocale(thread_);
    is_changed = true;
  }
  if (is_changed) changes.emplace_back("the locale");
}

}  // namespace stride::core
