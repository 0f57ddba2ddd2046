// The namespaces of SSP, and of our annotation. They are the same for SSP 1.0 and 2.0.
#ifndef STRIDE_MASTER_SYSTEM_SSP_SSP_H
#define STRIDE_MASTER_SYSTEM_SSP_SSP_H

#include "master/base/xml/document.h"

namespace stride::ssp {

inline constexpr const char* kSsd = "http://ssp-standard.org/SSP1/SystemStructureDescription";
inline constexpr const char* kSsc = "http://ssp-standard.org/SSP1/SystemStructureCommon";
inline constexpr const char* kSsv = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";
inline constexpr const char* kSsm = "http://ssp-standard.org/SSP1/SystemStructureParameterMapping";
inline constexpr const char* kSsb = "http://ssp-standard.org/SSP1/SystemStructureSignalDictionary";

/// As the standard and most files write them.
inline constexpr xml::Prefix kPrefixes[] = {
    {"ssd", kSsd}, {"ssc", kSsc}, {"ssv", kSsv}, {"ssm", kSsm}, {"ssb", kSsb}};

/// The type of stride's annotation, and the namespace of what is in it.
inline constexpr const char* kStrideAnnotation = "org.stride";
inline constexpr const char* kStrideScenario = "urn:org.stride:scenario:1";

}  // namespace stride::ssp

#endif
