// SHA-256 (FIPS 180-4): whether two things are the same, for what is kept or repeated.
#ifndef STRIDE_MASTER_BASE_FILES_SHA256_H
#define STRIDE_MASTER_BASE_FILES_SHA256_H

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace stride::core {

using Sha256Digest = std::array<std::uint8_t, 32>;

/// The digest of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void add(std::string_view bytes);
  /// Of all bytes so far; more may follow.
  Sha256Digest digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// 64 hexadecimal digits.
std::string to_hex(const Sha256Digest& digest);
/// The digest of the bytes, as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);
/// Likewise of the content of a regular file of any length. Throws Error (Input) as open_input()
/// does, and for one that cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);
/// Likewise of the names and contents of all files in a folder and those in it.
std::string sha256_of_folder(const std::filesystem::path& folder);

}  // namespace stride::core

#endif
