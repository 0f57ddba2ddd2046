// The XML of campaigns for tests.
#ifndef STRIDE_TESTS_MASTER_STUDY_CAMPAIGN_TEXTS_H
#define STRIDE_TESTS_MASTER_STUDY_CAMPAIGN_TEXTS_H

#include <initializer_list>
#include <string>

namespace stride::tests {

/// A campaign over a scenario, whose distributions begin in line 5.
inline std::string campaign_text(const std::string& distributions,
                                 const std::string& extension = "",
                                 const std::string& scenario = "x.ssd") {
  return "<OpenSCENARIO>\n"
         "<FileHeader revMajor='1' revMinor='3' date='2026-01-01T00:00:00' description='' "
         "author=''/>\n"
         "<ParameterValueDistribution>\n"
         "<ScenarioFile filepath='" +
         scenario + "'/>\n" + distributions + "\n</ParameterValueDistribution>\n" +
         (extension.empty() ? ""
                            : "<stride:Campaign xmlns:stride='urn:org.stride:campaign:1'>\n" +
                                  extension + "\n</stride:Campaign>\n") +
         "</OpenSCENARIO>\n";
}

inline std::string deterministic(const std::string& inside) {
  return "<Deterministic>\n" + inside + "\n</Deterministic>";
}

inline std::string stochastic(const std::string& inside, const std::string& runs = "4",
                              const std::string& seed = "7") {
  return "<Stochastic numberOfTestRuns='" + runs + "' randomSeed='" + seed + "'>\n" + inside +
         "\n</Stochastic>";
}

/// A set of values for one parameter.
inline std::string value_set(const std::string& parameter,
                             std::initializer_list<const char*> values) {
  std::string text = "<DeterministicSingleParameterDistribution parameterName='" + parameter +
                     "'><DistributionSet>";
  for (const char* value : values) text += "<Element value='" + std::string(value) + "'/>";
  return text + "</DistributionSet></DeterministicSingleParameterDistribution>";
}

inline std::string value_range(const std::string& parameter, const std::string& lower,
                               const std::string& step, const std::string& upper) {
  return "<DeterministicSingleParameterDistribution parameterName='" + parameter +
         "'><DistributionRange stepWidth='" + step + "'><Range lowerLimit='" + lower +
         "' upperLimit='" + upper +
         "'/></DistributionRange></DeterministicSingleParameterDistribution>";
}

inline std::string drawn(const std::string& parameter, const std::string& distribution) {
  return "<StochasticDistribution parameterName='" + parameter + "'>" + distribution +
         "</StochasticDistribution>";
}

inline std::string uniform(const std::string& lower, const std::string& upper) {
  return "<UniformDistribution><Range lowerLimit='" + lower + "' upperLimit='" + upper +
         "'/></UniformDistribution>";
}

}  // namespace stride::tests

#endif
