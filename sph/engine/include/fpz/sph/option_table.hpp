// The one list of the options of the particle method. Scene files, checks, fingerprints, summaries and tables of the
// documentation derive from it.
#pragma once

#include <string_view>
#include <tuple>

#include "fpz/parameters.hpp"
#include "fpz/sph/options.hpp"

namespace fpz::sph {

/// Values that a scene file may state, the ends included: narrower than what a run accepts, to catch slips.
struct FileRange {
  double lowest = 0.0;
  double highest = 0.0;
};

/// What is known about one option besides its member.
struct OptionInfo {
  std::string_view name = {};  ///< key in files and messages
  std::string_view unit = {};  ///< SI; empty: a pure number or a word
  std::string_view text = {};  ///< one line for tables
  Bounds valid = {};           ///< numbers: what a run accepts
  FileRange file = {};         ///< numbers
  bool changes_result = true;  ///< belongs to the fingerprint of a run
  bool in_summary = true;      ///< stands in the summary of a run
};

/// One option of an Options<Dim>: T is double, int, an enumeration with Words, RveLength or Vec<double, Dim>.
template <int Dim, class T>
struct OptionEntry {
  OptionInfo info;
  T Options<Dim>::*member;
};
template <int Dim, class T>
OptionEntry(OptionInfo, T Options<Dim>::*) -> OptionEntry<Dim, T>;

namespace detail {
inline constexpr Bounds positive = {};
inline constexpr Bounds not_negative = {0.0, unbounded, true};
inline constexpr Bounds part = {0.0, 1.0, true};
}  // namespace detail

/// The options in the order of the struct.
// clang-format off
template <int Dim>
inline constexpr auto option_table = std::tuple{
    OptionEntry{{.name = "configuration",
                 .text = "`reference` (total Lagrangian) or `updated` (the paper)"},
                &Options<Dim>::configuration},
    OptionEntry{{.name = "momentum",
                 .text = "`adjoint` (conserves momentum) or `paper` (eq 20)"},
                &Options<Dim>::momentum},
    OptionEntry{{.name = "gradient",
                 .text = "reference: `consistent` (constant stress is in equilibrium on any arrangement; not with "
                         "momentum `paper`) or `kernel` (corrected kernel gradients, eq 17)"},
                &Options<Dim>::gradient},
    OptionEntry{{.name = "kernel",
                 .text = "`cubic_spline` or `wendland_c2`"},
                &Options<Dim>::kernel},
    OptionEntry{{.name = "smoothing_ratio",
                 .text = "h over spacing",
                 .valid = detail::positive, .file = {0.8, 3.0}},
                &Options<Dim>::smoothing_ratio},
    OptionEntry{{.name = "courant",
                 .text = "largest time step in units of h / sqrt(E/rho) (eq 32)",
                 .valid = detail::positive, .file = {1e-3, 2.0}},
                &Options<Dim>::courant},
    OptionEntry{{.name = "rve_length", .unit = "m",
                 .text = "H: `spacing` (the paper), `band` (the width over which the crack spreads) or a number",
                 .valid = detail::positive},
                &Options<Dim>::rve_length},
    OptionEntry{{.name = "integrator",
                 .text = "of cracked particles: `implicit`, `accurate` or `paper`"},
                &Options<Dim>::method},
    OptionEntry{{.name = "viscosity_alpha",
                 .text = "updated: linear artificial viscosity",
                 .valid = detail::not_negative, .file = {0.0, 100.0}, .in_summary = false},
                &Options<Dim>::viscosity_alpha},
    OptionEntry{{.name = "viscosity_beta",
                 .text = "updated: quadratic artificial viscosity",
                 .valid = detail::not_negative, .file = {0.0, 100.0}, .in_summary = false},
                &Options<Dim>::viscosity_beta},
    OptionEntry{{.name = "artificial_stress",
                 .text = "updated: part of a tensile principal stress that repels close particles",
                 .valid = detail::not_negative, .file = {0.0, 10.0}, .in_summary = false},
                &Options<Dim>::artificial_stress},
    OptionEntry{{.name = "skin",
                 .text = "updated: margin of the neighbour lists, in spacings",
                 .valid = detail::not_negative, .file = {0.0, 10.0}, .in_summary = false},
                &Options<Dim>::skin},
    OptionEntry{{.name = "zero_energy_control",
                 .text = "reference: stiffness, in units of lambda + 2 mu, against displacements that the gradients do "
                         "not see; 0: off",
                 .valid = detail::not_negative, .file = {0.0, 100.0}},
                &Options<Dim>::zero_energy_control},
    OptionEntry{{.name = "contact_stiffness",
                 .text = "reference: stiffness of faces that meet, in units of (lambda + 2 mu)/spacing; 0: they pass "
                         "through each other",
                 .valid = detail::not_negative, .file = {0.0, 1000.0}},
                &Options<Dim>::contact_stiffness},
    OptionEntry{{.name = "damping",
                 .text = "local damping: part of the resultant force that opposes the velocity",
                 .valid = detail::part, .file = {0.0, 0.99}},
                &Options<Dim>::damping},
    OptionEntry{{.name = "mass_scale",
                 .text = "factor of the inertia",
                 .valid = {1.0, unbounded, true}, .file = {1.0, 1e12}},
                &Options<Dim>::mass_scale},
    OptionEntry{{.name = "release_integrity",
                 .text = "reference: bonds across a crack are cut when 1 - D is below this; 0: never",
                 .valid = detail::part, .file = {0.0, 0.99}},
                &Options<Dim>::release_integrity},
    OptionEntry{{.name = "reorientation_damage",
                 .text = "reference: a crack with D below this takes another plane when that one fails; 0: never",
                 .valid = detail::part, .file = {0.0, 0.02}},
                &Options<Dim>::reorientation_damage},
    OptionEntry{{.name = "gravity", .unit = "m/s2",
                 .text = "acceleration, a vector",
                 .valid = {-unbounded, unbounded}, .in_summary = false},
                &Options<Dim>::gravity},
    OptionEntry{{.name = "threads",
                 .text = "0: as many as pay off; results do not depend on it",
                 .valid = detail::not_negative, .file = {0.0, 4096.0}, .changes_result = false, .in_summary = false},
                &Options<Dim>::threads},
    OptionEntry{{.name = "instruction_set",
                 .text = "`best`, `baseline`, `avx2` or `avx512`; results do not depend on it",
                 .changes_result = false, .in_summary = false},
                &Options<Dim>::instruction_set},
};
// clang-format on

template <int Dim>
inline constexpr std::size_t option_count = std::tuple_size_v<std::remove_cvref_t<decltype(option_table<Dim>)>>;

/// Calls visit(info, member) once for every option in the order of the table; what to do depends on the member's type.
template <int Dim, class Visit>
void for_each_option(Options<Dim>& options, Visit&& visit) {
  std::apply([&](const auto&... entry) { (visit(entry.info, options.*entry.member), ...); }, option_table<Dim>);
}
template <int Dim, class Visit>
void for_each_option(const Options<Dim>& options, Visit&& visit) {
  std::apply([&](const auto&... entry) { (visit(entry.info, options.*entry.member), ...); }, option_table<Dim>);
}

}  // namespace fpz::sph
