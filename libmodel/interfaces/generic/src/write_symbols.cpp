// Writes, as C++ source, the data symbols by which clients describe the behaviour to themselves: names, types, defaults
// and bounds, from the lists of the common room. Runs while the library is built.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "lists.hpp"

namespace {

using namespace fpz;
using namespace fpz::generic;

using Names = std::vector<std::string>;

constexpr int scalar = 0;
constexpr int symmetric_tensor = 1;

/// Defines Fpz_<name>.
void define(const std::string& type, const std::string& name, const std::string& value) {
  std::printf("extern \"C\" const %s %s_%s = %s;\n", type.c_str(), behaviour_name, name.c_str(), value.c_str());
}

void define_array(const std::string& type, const std::string& name, const std::string& values) {
  std::printf("extern \"C\" const %s %s_%s[] = {%s};\n", type.c_str(), behaviour_name, name.c_str(), values.c_str());
}

void define_flag(const std::string& name, std::size_t value) { define("unsigned short", name, std::to_string(value)); }

void define_text(const std::string& name, const std::string& text) { define("char* const", name, '"' + text + '"'); }

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17e", x);
  return text;
}

/// <prefix>n<name> and <prefix><name>: a client looks for the array even where it has no names.
void define_names(const std::string& prefix, const std::string& name, const Names& names) {
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "\"" : ", \"") + n + '"';
  define_flag(prefix + "n" + name, names.size());
  define_array("char* const", prefix + name, names.empty() ? "nullptr" : list);
}

/// The same for variables, with their types, which all are one.
void define_variables(const std::string& prefix, const std::string& name, const Names& names, int type) {
  define_names(prefix, name, names);
  std::string types = std::to_string(type);
  for (std::size_t k = 1; k < names.size(); ++k) types += ", " + std::to_string(type);
  define_array("int", prefix + name + "Types", types);
}

/// What the behaviour is: a strain based one, isotropic as far as a client is concerned (it has no material frame).
void define_kind() {
  define_text("mfront_ept", behaviour_name);
  define_flag("mfront_mkt", 1);
  define_flag("api_version", 1);
  define_text("mfront_interface", "Generic");
  define_flag("BehaviourType", 1);
  define_flag("BehaviourKinematic", 1);
  define_flag("SymmetryType", 0);
  define_flag("ElasticSymmetryType", 0);
  define_flag("requiresStiffnessTensor", 0);
  define_flag("requiresThermalExpansionCoefficientTensor", 0);
  define_flag("TemperatureRemovedFromExternalStateVariables", 0);
  define_flag("UsableInPurelyImplicitResolution", 0);
  define_flag("ComputesInternalEnergy", 1);
  define_flag("ComputesDissipatedEnergy", 1);
}

Names property_names(std::size_t first, std::size_t count) {
  Names names;
  for (std::size_t k = first; k < first + count; ++k) names.push_back(point::properties()[k].name);
  return names;
}

void define_bounds() {
  for (const ParameterInfo<double>& p : parameter_table<double>) {
    const auto define_one = [&p](const char* which, double bound) {
      if (std::isfinite(bound)) define("long double", std::string(p.name) + which, number(bound) + "L");
    };
    define_one("_LowerPhysicalBound", p.bounds.lower);
    define_one("_UpperPhysicalBound", p.bounds.upper);
  }
}

void define_parameters() {
  define_variables("", "Parameters", property_names(material_property_count, setting_count), scalar);
  for (std::size_t k = material_property_count; k < point::property_count; ++k) {
    const point::Property& p = point::properties()[k];
    define("double", p.name + "_ParameterDefaultValue", number(p.default_value));
  }
}

template <int Dim>
void define_internal_variables(const std::string& prefix) {
  const Names& all = point::state_names(Dim);
  define_variables(prefix, "InternalStateVariables", {all.begin() + kept_by_client<Dim>, all.end()}, scalar);
}

}  // namespace

int main() {
  std::puts("// Written by write_symbols.cpp.\n#pragma GCC visibility push(default)");
  define_kind();
  define_names("", "ModellingHypotheses", {"Tridimensional", "PlaneStrain", "GeneralisedPlaneStrain", "PlaneStress"});
  define_variables("", "Gradients", {"Strain"}, symmetric_tensor);
  define_variables("", "ThermodynamicForces", {"Stress"}, symmetric_tensor);
  define_names("", "TangentOperatorBlocks", {"Stress", "Strain"});
  define_variables("", "MaterialProperties", property_names(0, material_property_count), scalar);
  define_bounds();
  define_parameters();
  define_internal_variables<3>("");
  define_internal_variables<3>("Tridimensional_");
  for (const char* prefix : {"PlaneStrain_", "GeneralisedPlaneStrain_", "PlaneStress_"}) {
    define_internal_variables<2>(prefix);
  }
  define_variables("", "ExternalStateVariables", {}, scalar);
  define_names("", "InitializeFunctions", {});
  define_names("", "PostProcessings", {});
}
