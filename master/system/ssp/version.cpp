#include "master/system/ssp/version.h"

#include <fmt/format.h>

namespace stride::ssp {

std::string read_version(const xml::Element& root, std::vector<std::string>& warnings) {
  const std::string version = xml::without_blanks(root.required("version"));
  const std::string major = version.substr(0, version.find('.'));
  for (const std::string known : {"1.0", "2.0"}) {
    if (version == known) return known;
    if (major != known.substr(0, 1)) continue;
    warnings.push_back(core::to_text({.where = root.where()}) +
                       fmt::format("the version '{}' of {} is not known; it is read as {}", version,
                                   root.tag(), known));
    return known;
  }
  root.fail(fmt::format("the version '{}' of {} is not known", version, root.tag()),
            "stride reads SSP 1.0 and 2.0: export the file as one of them");
}

}  // namespace stride::ssp
