// Material parameters from JSON, inline or from a file of their own, with the place of every value for later
// complaints.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/io/input_reader.hpp"
#include "fpz/io/plausibility.hpp"
#include "fpz/law/softening.hpp"
#include "fpz/parameters.hpp"

namespace fpz::io {

/// The parameters that a material file states, each itself or by quantities from which it follows (see
/// material_alternatives).
inline constexpr std::span<const ParameterInfo<double>> material_keys(parameter_table<double>.data(),
                                                                      material_parameter_count);

/// Where a value stands.
struct Location {
  std::string file;
  std::size_t line = 0;
  std::string path;
};

/// A quantity that may be stated in place of parameters.
struct MaterialAlternative {
  std::string_view key;
  std::string_view symbol;   ///< also taken as the key
  std::string_view meaning;  ///< in words
  std::string_view formula;  ///< what follows, with its source
  Typical typical;
};

/// The list of them. Elastic constants: any two of four; the others stand for one parameter each.
[[nodiscard]] std::span<const MaterialAlternative> material_alternatives();

/// One quantity as stated.
struct MaterialStatement {
  std::string_view key;  ///< of material_keys or material_alternatives
  Written value;
  Location at;
  double depth = 0.0;                       ///< m, of a beam whose bending strength it is
  Setting setting = Setting::plane_strain;  ///< of a toughness
};

/// What a material file states, with the places of its values. (fpz::Material is what the model makes of parameters.)
struct MaterialFile {
  Parameters parameters;  ///< rve_length is 0
  std::string name;
  std::array<Location, material_parameter_count> locations;  ///< in the order of material_keys
  std::vector<MaterialStatement> statements;
  std::vector<std::string> conversions;  ///< which parameters follow from other quantities, how, and their values
  std::vector<std::string> warnings;     ///< doubtful values of those quantities
};

/// The material at `place`; nothing when a value is missing or of a wrong type. `name` is used when it has none.
[[nodiscard]] std::optional<MaterialFile> read_material(const InputReader& reader, const Place& place,
                                                        std::string name);

/// The material at `place` where it states only what differs from `base`: a quantity replaces those that determine the
/// same parameter. Nothing when there is a problem.
[[nodiscard]] std::optional<MaterialFile> read_difference(const InputReader& reader, const Place& place,
                                                          const MaterialFile& base);

/// Puts the parameters themselves in place of what the tree of a material states.
void state_parameters(const MaterialFile& material, JsonValue& tree);

/// Reads the material file that the string at a place names; what is wrong is a problem.
using MaterialLoader = std::function<std::optional<MaterialFile>(const Place& name)>;

/// The material as files that use one may give it: its parameters, the name of a material file, or an object whose key
/// "file" names one and whose other keys replace what that file says.
[[nodiscard]] std::optional<MaterialFile> material_at(const InputReader& reader, const Place& place,
                                                      const MaterialLoader& load);

/// The material in a file, which messages call `shown_as`.
[[nodiscard]] std::optional<MaterialFile> load_material(const std::filesystem::path& file, const std::string& shown_as,
                                                        const ReadLimits& limits, Problems& problems,
                                                        std::string& error);

/// Applies fpz::validate(). Errors become problems at the places of the values, warnings are returned. Without
/// `rve_length` the constraints that do not need it are checked.
std::vector<std::string> check_material(const MaterialFile& material, const Parameters& parameters, Setting setting,
                                        const std::optional<Location>& rve_length, Problems& problems);

/// The material in the file that the string at `place` names, relative to `folder`. A name that cannot be one, and a
/// file that cannot be read, are problems at the place.
[[nodiscard]] std::optional<MaterialFile> load_named_material(const InputReader& reader, const Place& place,
                                                              const std::filesystem::path& folder);

/// Reads and validates a material file (keys as in data/materials). `rve_length` is left at 0. Without a key "name" the
/// name is that of the file.
[[nodiscard]] Parameters read_material_file(const std::filesystem::path& file, std::string* name = nullptr);

/// The keys of the choices of a material, all optional.
[[nodiscard]] std::vector<std::string_view> choice_keys();

/// Reads those of them that the object at `place` has.
void read_choices(const InputReader& reader, const Place& place, MaterialChoices& choices);

/// Adds the choices of a material that are not the default to a JSON object.
template <class Json>
void put_choices(Json& j, const MaterialChoices& choices) {
  visit_choices(choices, [&j](const char* key, auto choice) {
    if (choice != decltype(choice){}) j[key] = to_string(choice);
  });
}

}  // namespace fpz::io
