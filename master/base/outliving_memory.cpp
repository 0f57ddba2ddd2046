#include "master/base/outliving_memory.h"

#include <array>
#include <new>
#include <span>

#include <sys/mman.h>
#include <unistd.h>

namespace stride::core {
namespace {

struct Piece {
  void* data;
  std::size_t size;
};

constexpr std::size_t kMostPieces = 8;
std::array<Piece, kMostPieces> pieces;
std::size_t piece_count = 0;
bool has_left = false;

void* map(void* place, std::size_t size, int how) {
  return ::mmap(place, size, PROT_READ | PROT_WRITE, MAP_ANONYMOUS | MAP_NORESERVE | how, -1, 0);
}

}  // namespace

void* OutlivingMemory::add(std::size_t size) {
  void* const data = piece_count < kMostPieces ? map(nullptr, size, MAP_SHARED) : MAP_FAILED;
  if (data == MAP_FAILED) throw std::bad_alloc();
  pieces[piece_count++] = {data, size};
  return data;
}

bool OutlivingMemory::is_shared() noexcept { return piece_count > 0 && !has_left; }

void OutlivingMemory::leave() noexcept {
  if (!is_shared()) return;
  has_left = true;
  for (const Piece& piece : std::span(pieces).first(piece_count)) {
    if (map(piece.data, piece.size, MAP_PRIVATE | MAP_FIXED) == MAP_FAILED) ::_exit(1);
  }
}

}  // namespace stride::core
