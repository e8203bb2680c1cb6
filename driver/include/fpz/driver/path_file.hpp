// What a loading-path file says, after reading and validation. The format is documented in docs/path-files.md.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/io/input_error.hpp"
#include "fpz/options.hpp"
#include "fpz/parameters.hpp"

namespace fpz::driver {

/// Tensor components in the order of history.csv.
inline constexpr std::array<std::string_view, 6> component_names = {"xx", "yy", "zz", "xy", "xz", "yz"};

using io::InputError;

/// What mixed control prescribes of one component during a stage.
enum class Prescribed {
  strain_increment,  ///< value is the strain increment per increment of the stage (with automatic stepping: of the
                     ///< whole stage divided by `increments`)
  strain,            ///< value is the strain at the end of the stage, approached linearly
  stress             ///< value is the stress at the end of the stage, approached linearly, Pa
};

}  // namespace fpz::driver

/// The keys of a stage.
template <>
struct fpz::Words<fpz::driver::Prescribed> {
  static constexpr Word<driver::Prescribed> list[] = {{driver::Prescribed::strain_increment, "strain_increment"},
                                                      {driver::Prescribed::strain, "strain"},
                                                      {driver::Prescribed::stress, "stress"}};
};

namespace fpz::driver {

struct ComponentControl {
  int component = 0;  ///< index into component_names
  Prescribed prescribed = Prescribed::strain_increment;
  double value = 0.0;
};

/// sum_i strain[i] eps_i + stress[i] sig_i = value at the end of the stage, approached linearly from its value at the
/// stage's begin. A component that a constraint names and no control prescribes is free; a stage has as many
/// constraints as free components.
struct LinearConstraint {
  std::array<double, 6> strain{};
  std::array<double, 6> stress{};  ///< 1/Pa scale is the user's choice
  double value = 0.0;
};

/// The stage ends when `quantity` (a column name of history.csv) reaches `value` from either side.
struct StopCondition {
  std::string quantity;  ///< a column of numbers
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
  std::string name;        ///< optional; the same for every repetition of the stage
  int increments = 1;      ///< with automatic stepping: only scales strain_increment
  bool automatic = false;  ///< step size chosen by the driver from `step_tolerance`
  /// Automatic stepping: largest change of stress per step over sigma_t0 that is not linear.
  double step_tolerance = 1e-4;
  std::vector<ComponentControl> controls;
  std::vector<LinearConstraint> constraints;
  std::vector<StopCondition> stop;
  std::optional<JumpControl> jump;
};

/// One test: a material point and the stages it goes through (repetitions already expanded).
struct Test {
  std::string name;  ///< never empty; unique in the file, letter case apart
  std::string description;
  Parameters parameters;  ///< rve_length included
  std::string material_name;
  Setting setting = Setting::plane_strain;
  Options options;
  std::vector<Stage> stages;
  std::vector<std::string> conversions;  ///< parameters that follow from other quantities of the material, in words
  std::vector<std::string> warnings;     ///< doubtful but admissible values; one line each, with file and line
};

struct PathFile {
  std::filesystem::path file;
  std::vector<Test> tests;
};

/// What a path file may ask for at most.
struct Limits : io::ReadLimits {
  std::size_t tests = 10'000;  ///< tests in a file
  double stages = 1e6;         ///< stages of all tests together, repetitions expanded
  double increments = 1e9;     ///< increments of all tests together
};

/// Reads and validates a path file; material files are looked up relative to it. Throws InputError listing every
/// problem found.
[[nodiscard]] PathFile read_path_file(const std::filesystem::path& file);

/// The same from text, for tests and the fuzz target; `origin` names the text in messages and gives the folder for
/// material files.
[[nodiscard]] PathFile parse_path_file(std::string_view text, const std::filesystem::path& origin,
                                       const Limits& limits = {});

}  // namespace fpz::driver
