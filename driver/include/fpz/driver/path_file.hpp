// What a loading-path file says, after reading and validation. The format is documented in docs/path-files.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/options.hpp"
#include "fpz/parameters.hpp"

namespace fpz::driver {

/// Tensor components in the order of history.csv.
inline constexpr std::array<std::string_view, 6> component_names = {"xx", "yy", "zz", "xy", "xz", "yz"};

/// Bad input: what() names the file, the place in it (line and key path), the value, and the constraint or nearest
/// valid name.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How one component is controlled during a stage.
enum class Control {
  strain_increment,  ///< value is the strain increment per increment of the stage (with automatic stepping: of the
                     ///< whole stage divided by `increments`)
  strain,            ///< value is the strain at the end of the stage, approached linearly
  stress             ///< value is the stress at the end of the stage, approached linearly, Pa
};

struct ComponentControl {
  int component = 0;  ///< index into component_names
  Control control = Control::strain_increment;
  double value = 0.0;
};

/// sum_i strain[i] eps_i + stress[i] sig_i = value at the end of the stage, approached linearly from its value at the
/// stage's begin.
struct LinearConstraint {
  std::array<double, 6> strain{};
  std::array<double, 6> stress{};  ///< 1/Pa scale is the user's choice
  double value = 0.0;
};

/// The stage ends when `quantity` (a column name of history.csv) reaches `value` from either side.
struct StopCondition {
  std::string quantity;
  double value = 0.0;
};

/// Jump (arc-length) control: the inelastic displacement kappa = up_n + up_s is prescribed instead of the size of the
/// strain increment, which then gives only a direction; passes snap-back points.
struct JumpControl {
  double increment = 0.0;  ///< d(kappa) per increment, m
};

/// One stage of a path. Components of the setting that are not mentioned keep their strain constant
/// (in plane stress zz follows from sig_zz = 0 and cannot be controlled; in plane strain zz, xz, yz cannot).
struct Stage {
  int increments = 1;
  bool automatic = false;  ///< step size chosen by the driver from `step_tolerance`
  double step_tolerance =
      1e-4;  ///< automatic stepping: largest change of stress per step over sigma_t0 that is not linear
  std::vector<ComponentControl> controls;
  std::vector<LinearConstraint> constraints;
  std::vector<StopCondition> stop;
  std::optional<JumpControl> jump;
};

/// One test: a material point and the stages it goes through (repetitions already expanded).
struct Test {
  std::string name;
  Parameters parameters;  ///< rve_length included
  std::string material_name;
  Setting setting = Setting::plane_strain;
  Options options;
  std::vector<Stage> stages;
};

struct PathFile {
  std::filesystem::path file;
  std::vector<Test> tests;
};

/// Reads and validates a path file; material files are looked up relative to it. Throws InputError listing every
/// problem found.
[[nodiscard]] PathFile read_path_file(const std::filesystem::path& file);

/// The same from text, for tests and the fuzz target; `origin` names the text in messages and gives the folder for
/// material files.
[[nodiscard]] PathFile parse_path_file(std::string_view text, const std::filesystem::path& origin);

/// Reads a material file (keys as in data/materials). `rve_length` is left at 0.
[[nodiscard]] Parameters read_material_file(const std::filesystem::path& file, std::string* name = nullptr);

}  // namespace fpz::driver
