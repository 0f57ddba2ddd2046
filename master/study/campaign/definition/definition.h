// What a campaign file says: what varies, and how. Nothing of its scenario is known yet.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DEFINITION_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DEFINITION_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "master/base/error.h"
#include "master/study/campaign/definition/decimal.h"
#include "master/study/campaign/definition/distribution.h"
#include "master/system/declaration/interventions.h"

namespace stride::campaign {

/// The text of a value; nothing: as the scenario, or what declares the parameter, has it.
using Text = std::optional<std::string>;

/// What varies, by its name: a start value ("component.variable", an element of an array, a
/// connector of the root system), a swap, or a part of an intervention ("NAME.from").
struct Parameter {
  std::string name;
  core::Location where{};
};

/// Parameters that change together: a row has a value, or nothing, for each of them.
struct ValueTable {
  struct Row {
    std::vector<Text> values;
    core::Location where{};
  };
  std::vector<std::size_t> parameters;  ///< by their places in Campaign::parameters
  std::vector<Row> rows;
};

/// The values first, first + step and so on of one parameter.
struct ValueRange {
  std::size_t parameter = 0;
  Decimal first;
  Decimal step;
  std::uint64_t count = 1;
};

/// One of the sets of which all combinations are made.
using Factor = std::variant<ValueTable, ValueRange>;
/// How many values, or sets of values, it has.
std::uint64_t size_of(const Factor& factor);

struct Deterministic {
  std::vector<Factor> factors;  ///< the last one changes from case to case
};

/// How the points of a stochastic campaign are spread.
enum class SamplingMethod { Independent, LatinHypercube, Sobol };
const char* name(SamplingMethod method);
inline constexpr SamplingMethod kSamplingMethods[] = {
    SamplingMethod::Independent, SamplingMethod::LatinHypercube, SamplingMethod::Sobol};

struct StochasticParameter {
  std::size_t parameter = 0;
  Distribution distribution;
  core::Location where{};
};

struct Stochastic {
  std::uint64_t runs = 0;
  std::vector<StochasticParameter> parameters;
  SamplingMethod method = SamplingMethod::Independent;
};

/// A component whose unit varies. The values of its parameter are the names of the alternatives.
struct Swap {
  struct Alternative {
    std::string name;
    std::filesystem::path file;  ///< empty: the unit of the scenario
    core::Location where{};
  };
  std::string name;
  std::string component;
  std::vector<Alternative> alternatives;
  core::Location where{};
};

/// An intervention, and its name.
struct NamedIntervention {
  std::string name;
  scenario::InterventionDeclaration declared;
  core::Location where{};
};

/// Which cases leave all results.
struct Keep {
  enum class Results { None, Failed, All };
  Results results = Results::Failed;
  std::uint64_t every = 0;  ///< beside these each one whose index is a multiple; 0: no further one

  /// Whether those of the case are kept however it ends.
  bool are_kept_anyway(std::uint64_t index) const {
    return results == Results::All || (every != 0 && index % every == 0);
  }
  /// Whether they are kept if it fails, at least.
  bool may_be_kept(std::uint64_t index) const {
    return are_kept_anyway(index) || results == Results::Failed;
  }
};
const char* name(Keep::Results results);
inline constexpr Keep::Results kKeptResults[] = {Keep::Results::None, Keep::Results::Failed,
                                                 Keep::Results::All};

/// A number that sums up a signal of a run.
struct Aggregate {
  enum class Function { Min, Max, Mean, Final, At, Integral };
  std::string name;
  std::string signal;  ///< "component.variable", or an element
  Function function = Function::Final;
  Time at{};  ///< of At
  core::Location where{};
};
const char* name(Aggregate::Function function);
inline constexpr Aggregate::Function kAggregateFunctions[] = {
    Aggregate::Function::Min,   Aggregate::Function::Max, Aggregate::Function::Mean,
    Aggregate::Function::Final, Aggregate::Function::At,  Aggregate::Function::Integral};

/// A component whose stimuli each case keeps, to be played to it alone.
struct CapturedComponent {
  std::string component;
  core::Location where{};
};

struct Campaign {
  std::filesystem::path file;      ///< as it was given
  std::filesystem::path scenario;  ///< relative to the working directory or absolute
  core::Location scenario_where{};
  double random_seed = 0;
  std::vector<Parameter> parameters;  ///< in the order of the file; no two have one name
  std::variant<Deterministic, Stochastic> variation;
  std::vector<Parameter> seeds;  ///< variables that get a number of their own in each case
  std::vector<Swap> swaps;
  std::vector<NamedIntervention> interventions;
  Keep keep;
  std::vector<CapturedComponent> captures;  ///< no two of them name one component
  std::vector<Aggregate> aggregates;
  std::optional<double> wall_time_limit;  ///< of a case [s]
  std::vector<std::string> warnings;      ///< of what is odd, but no mistake
};

}  // namespace stride::campaign

#endif
