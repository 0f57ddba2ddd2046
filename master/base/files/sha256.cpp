#include "master/base/files/sha256.h"

#include <algorithm>
#include <span>
#include <system_error>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <sha2.h>

#include "master/base/files/descriptor.h"
#include "master/base/files/input_file.h"
#include "master/base/text/hex.h"

namespace stride::core {

struct Sha256::State {
  SHA2_CTX context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) { SHA256Init(&state_->context); }
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::string_view bytes) {
  SHA256Update(&state_->context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

Sha256Digest Sha256::digest() const {
  static_assert(std::tuple_size_v<Sha256Digest> == SHA256_DIGEST_LENGTH);
  SHA2_CTX copy = state_->context;
  Sha256Digest digest;
  SHA256Final(digest.data(), &copy);
  return digest;
}

std::string to_hex(const Sha256Digest& digest) {
  return to_hex(std::span<const std::uint8_t>(digest));
}

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return to_hex(hash.digest());
}

std::string sha256_of_file(const std::filesystem::path& file) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  const Descriptor opened = open_input(file);
  std::vector<char> piece(kPiece);
  Sha256 hash;
  try {
    while (const std::size_t count = read_from(opened, piece.data(), piece.size())) {
      hash.add({piece.data(), count});
    }
  } catch (const std::system_error& error) {
    fail_input({.where = {file.string(), 0}},
               fmt::format("cannot read the file: {}", error.code().message()));
  }
  return to_hex(hash.digest());
}

std::string sha256_of_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::recursive_directory_iterator();
       entry.increment(error)) {
    if (is_file(entry->path())) files.push_back(entry->path());
  }
  if (error) {
    fail_input({.where = {folder.string(), 0}},
               fmt::format("cannot list the folder: {}", error.message()));
  }
  std::ranges::sort(files);
  Sha256 hash;
  for (const std::filesystem::path& file : files) {
    const std::string name = file.lexically_relative(folder).generic_string();
    hash.add(fmt::format("{} {} {}\n", sha256_of_file(file), name.size(), name));
  }
  return to_hex(hash.digest());
}

}  // namespace stride::core
