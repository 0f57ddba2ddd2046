// Objects of others, kept until the process ends.
#ifndef STRIDE_TEST_UNITS_REGISTRAR_REGISTRY_H
#define STRIDE_TEST_UNITS_REGISTRAR_REGISTRY_H

#include <memory>

struct Listener {
  virtual ~Listener();
  virtual void hear(const char* text) = 0;
};

void register_listener(std::shared_ptr<Listener> listener);

#endif
