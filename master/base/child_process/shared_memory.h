// Memory that processes have in common: those that are forked after it was made.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_SHARED_MEMORY_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_SHARED_MEMORY_H

#include <cstddef>
#include <new>
#include <type_traits>

#include "master/base/child_process/descriptor.h"

namespace stride::isolation {

/// Of a fixed size, zeros at first. Throws std::system_error if there is none.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t size);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  void* data() const { return data_; }
  /// Processes that are forked from now on do not have it.
  void hide_from_children();

 private:
  std::size_t size_;
  void* data_;
};

/// One object in shared memory. It has no destructor, since no process knows whether it is the
/// last.
template <class T>
class Shared {
 public:
  Shared() : memory_(sizeof(T)), object_(new (memory_.data()) T) {}

  T& operator*() const { return *object_; }
  T* operator->() const { return object_; }
  void hide_from_children() { memory_.hide_from_children(); }

 private:
  static_assert(std::is_trivially_destructible_v<T>);
  SharedMemory memory_;
  T* object_;
};

/// Memory that can be enlarged.
class ResizableMemory {
 public:
  std::byte* data() const { return data_; }
  /// As much as is seen here [byte].
  std::size_t size() const { return size_; }
  /// Makes room for at least `size` bytes; data() may be another afterwards.
  virtual void grow(std::size_t size) = 0;

 protected:
  ~ResizableMemory() = default;

  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Memory that any of the processes may enlarge; the others see it after follow(). It never
/// shrinks, so what was seen once can be read whatever another process does.
class GrowingMemory final : public ResizableMemory {
 public:
  /// Throws std::system_error if there is none. The name is for /proc/PID/maps.
  GrowingMemory(const char* name, std::size_t size);
  ~GrowingMemory();
  GrowingMemory(const GrowingMemory&) = delete;
  GrowingMemory& operator=(const GrowingMemory&) = delete;

  /// To be kept open by all processes.
  const Descriptor& file() const { return file_; }

  /// Throws std::system_error if there is no memory.
  void grow(std::size_t size) override;
  /// Sees at least `size` bytes, if another process has made room for them by grow(); false if none
  /// has.
  bool follow(std::size_t size);
  /// Processes that this one forks from now on do not see it.
  void hide_from_children();

 private:
  void map(std::size_t size);

  Descriptor file_;
  bool is_hidden_ = false;
};

}  // namespace stride::isolation

#endif
