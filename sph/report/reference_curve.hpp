// Load-deflection curves of notched specimens by finite elements, as fpz-notched-reference writes them
// (data/reference).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fpz::report {

/// Load and supports, geometry or material for which a curve holds: a key in the first lines of its file, and an option
/// of the program that makes it.
struct Condition {
  std::string name, value;
  bool acts = true;  ///< false: has no effect on the curve, a file may state another value
};

/// States of equilibrium under growing opening.
struct ReferenceCurve {
  std::vector<double> load;                  ///< N
  std::vector<double> cmod;                  ///< opening of the notch, m
  std::vector<double> deflection_mid_depth;  ///< relative to the supports, m
};

/// Reads a curve. Numbers agree when they differ by less than 1e-9 of their size. Throws io::InputError naming the
/// file, the key and the command that makes a matching file: when the file is missing, or states another value than
/// `wanted`, or none.
[[nodiscard]] ReferenceCurve read_reference_curve(const std::filesystem::path& file,
                                                  const std::vector<Condition>& wanted);

}  // namespace fpz::report
