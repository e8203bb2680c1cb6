// What a client learns about the behaviour before it calls it.
#include <cmath>

#include "fpz/parameters.hpp"
#include "fpz/point/state_layout.hpp"
#include "interfaces/generic/generic_call.hpp"

namespace fpz {
namespace {

using test::symbol;

unsigned short flag(const std::string& name) { return symbol<unsigned short>("Fpz_" + name); }

std::string text(const std::string& name) { return symbol<const char*>("Fpz_" + name); }

/// The names of a list with its length n<name>; `prefix` is that of a hypothesis.
std::vector<std::string> names(const std::string& name, const std::string& prefix = "") {
  const std::size_t count = flag(prefix + "n" + name);
  const char* const* first = &symbol<const char*>("Fpz_" + prefix + name);
  return {first, first + count};
}

std::vector<int> types(const std::string& name, const std::string& prefix = "") {
  const int* first = &symbol<int>("Fpz_" + prefix + name + "Types");
  return {first, first + flag(prefix + "n" + name)};
}

using Names = std::vector<std::string>;
using Types = std::vector<int>;

TEST(GenericSymbols, SayWhatTheBehaviourIs) {
  EXPECT_EQ(text("mfront_ept"), "Fpz");
  EXPECT_EQ(text("mfront_interface"), "Generic");
  for (const char* one : {"mfront_mkt", "api_version", "BehaviourType", "BehaviourKinematic", "ComputesInternalEnergy",
                          "ComputesDissipatedEnergy"}) {
    EXPECT_EQ(flag(one), 1) << one;
  }
  for (const char* none :
       {"SymmetryType", "ElasticSymmetryType", "TemperatureRemovedFromExternalStateVariables",
        "requiresStiffnessTensor", "requiresThermalExpansionCoefficientTensor", "nInitializeFunctions",
        "nPostProcessings", "nExternalStateVariables", "UsableInPurelyImplicitResolution"}) {
    EXPECT_EQ(flag(none), 0) << none;
  }
  for (const char* there : {"InitializeFunctions", "PostProcessings", "ExternalStateVariables",
                            "ExternalStateVariablesTypes", "setOutOfBoundsPolicy"}) {
    EXPECT_NE(test::find_symbol(std::string("Fpz_") + there), nullptr) << there;
  }
}

TEST(GenericSymbols, HypothesesHaveTheirFunctions) {
  const Names hypotheses = names("ModellingHypotheses");
  EXPECT_EQ(hypotheses, Names({"Tridimensional", "PlaneStrain", "GeneralisedPlaneStrain", "PlaneStress"}));
  for (const std::string& h : hypotheses) EXPECT_NE(test::find_symbol("Fpz_" + h), nullptr) << h;
}

TEST(GenericSymbols, StrainAndStressAreSymmetricTensors) {
  EXPECT_EQ(names("Gradients"), Names({"Strain"}));
  EXPECT_EQ(types("Gradients"), Types({1}));
  EXPECT_EQ(names("ThermodynamicForces"), Names({"Stress"}));
  EXPECT_EQ(types("ThermodynamicForces"), Types({1}));
  EXPECT_EQ(names("TangentOperatorBlocks"), Names({"Stress", "Strain"}));
}

TEST(GenericSymbols, MaterialPropertiesAreTheParametersAndTheChoices) {
  Names expected;
  for (const auto& p : parameter_table<double>) expected.emplace_back(p.name);
  MaterialChoices choices;
  visit_choices(choices, [&expected](const char* key, auto&) { expected.emplace_back(key); });
  EXPECT_EQ(names("MaterialProperties"), expected);
  EXPECT_EQ(types("MaterialProperties"), Types(expected.size(), 0));
}

TEST(GenericSymbols, ParametersAreTheOptionsOfTheIntegratorWithTheirDefaults) {
  const Names parameters = names("Parameters");
  const auto& all = point::properties();
  ASSERT_EQ(flag("nMaterialProperties") + parameters.size(), all.size());
  EXPECT_EQ(types("Parameters"), Types(parameters.size(), 0));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    EXPECT_EQ(parameters[k], all[flag("nMaterialProperties") + k].name);
    EXPECT_EQ(parameters[k].substr(0, 11), "integrator_");
  }
  EXPECT_EQ(symbol<double>("Fpz_integrator_name_ParameterDefaultValue"), 0.0);
  EXPECT_EQ(symbol<double>("Fpz_integrator_tolerance_ParameterDefaultValue"), Options{}.tolerance);
  EXPECT_EQ(symbol<double>("Fpz_integrator_max_substeps_ParameterDefaultValue"), Options{}.max_substeps);
  EXPECT_EQ(symbol<double>("Fpz_integrator_preferred_normal_z_ParameterDefaultValue"), 0.0);
}

TEST(GenericSymbols, BoundsAreThoseOfTheTable) {
  int found = 0;
  for (const auto& p : parameter_table<double>) {
    for (const auto& [name, bound] :
         {std::pair("_LowerPhysicalBound", p.bounds.lower), std::pair("_UpperPhysicalBound", p.bounds.upper)}) {
      const std::string full = "Fpz_" + std::string(p.name) + name;
      if (std::isfinite(bound)) {
        EXPECT_EQ(symbol<long double>(full), static_cast<long double>(bound)) << full;
        ++found;
      } else {
        EXPECT_EQ(test::find_symbol(full), nullptr) << full;
      }
    }
  }
  EXPECT_EQ(found, 13);  // eleven lower ones, nu < 1/2, phi < 90
}

template <int Dim>
Names internal_names() {
  const Names& all = point::state_names(Dim);
  const auto first = std::find(all.begin(), all.end(), "cracked");  // before it: strain and stress
  EXPECT_EQ(first - all.begin(), 2 * tensor_size<Dim>);
  return {first, all.end()};
}

TEST(GenericSymbols, EveryHypothesisHasTheInternalStateVariablesOfItsDimension) {
  const std::string list = "InternalStateVariables";
  for (const char* plane : {"PlaneStrain_", "GeneralisedPlaneStrain_", "PlaneStress_"}) {
    EXPECT_EQ(names(list, plane), internal_names<2>()) << plane;
    EXPECT_EQ(types(list, plane), Types(17, 0)) << plane;
  }
  for (const char* solid : {"Tridimensional_", ""}) {
    EXPECT_EQ(names(list, solid), internal_names<3>()) << solid;
    EXPECT_EQ(types(list, solid), Types(26, 0)) << solid;
  }
}

}  // namespace
}  // namespace fpz
