#include "tests/test_units/registrar/registry.h"

#include <utility>
#include <vector>

Listener::~Listener() = default;

void register_listener(std::shared_ptr<Listener> listener) {
  static std::vector<std::shared_ptr<Listener>> listeners;
  listeners.push_back(std::move(listener));
}
