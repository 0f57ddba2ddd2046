// Which FMUs a server makes units of.
#ifndef STRIDE_MASTER_LOADER_NETWORK_SERVER_UNIT_OFFER_H
#define STRIDE_MASTER_LOADER_NETWORK_SERVER_UNIT_OFFER_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/base/archive/temporary_folder.h"
#include "master/loader/fmu/fmu.h"

namespace stride::remote {

/// Those of this machine, all or only some, and one that the master sends, if that is allowed.
class UnitOffer {
 public:
  /// The path of the FMU with this path or name. Throws core::Error (Input).
  using Find = std::function<std::filesystem::path(const std::string& name)>;

  /// `only`: those that are offered, by path or name; empty for all. `file_limit`: of an FMU that
  /// is sent, and of its files together [byte]; none is accepted without. Throws core::Error
  /// (Input) for one that is not there.
  UnitOffer(std::vector<std::string> only, std::optional<std::uint64_t> file_limit, Find find);

  /// The FMU, loaded once. An empty name is that of the only one. What was sent takes precedence.
  /// Throws core::Error (Input).
  std::shared_ptr<importer::Fmu> fmu(const std::string& name);
  /// Whether other FMUs than these are not to be seen, nor where they are.
  bool is_pinned() const { return !only_.empty(); }
  /// A piece of an FMU. Throws core::Error: Input if none is accepted, or none of this size, Run
  /// where it cannot be written.
  void take_piece(const std::string& name, std::string_view bytes, bool is_first);

 private:
  struct Offered {
    std::string name;  ///< as it was given
    std::filesystem::path path;
  };
  struct Sent {
    archive::TemporaryFolder folder;
    std::filesystem::path path;
    std::uint64_t size = 0;
  };

  std::filesystem::path path(const std::string& name) const;

  std::vector<Offered> only_;
  std::optional<std::uint64_t> file_limit_;
  Find find_;
  std::unique_ptr<Sent> sent_;
  std::shared_ptr<importer::Fmu> fmu_;
  std::filesystem::path loaded_;  ///< the path of fmu_
};

}  // namespace stride::remote

#endif
