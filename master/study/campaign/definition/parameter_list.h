// The parameters of a campaign while its file is read: each has one source.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_PARAMETER_LIST_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_PARAMETER_LIST_H

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/study/campaign/definition/definition.h"

namespace stride::campaign {

inline constexpr const char* kStrideCampaign = "urn:org.stride:campaign:1";

class ParameterList {
 public:
  explicit ParameterList(std::vector<Parameter>& parameters) : parameters_(parameters) {}

  /// Returns the place of the new parameter. Throws core::Error (Input) for a second source of one,
  /// and for what cannot be a name.
  std::size_t add(const std::string& name, const core::Location& where);

 private:
  std::vector<Parameter>& parameters_;
  std::map<std::string, std::size_t> places_;
};

/// The text of a value. Throws core::Error (Input) for a reference to a parameter of OpenSCENARIO
/// ("$speed", "${2 * $speed}"), since such a file declares none.
std::string literal(const std::string& text, const core::Location& where);

}  // namespace stride::campaign

#endif
