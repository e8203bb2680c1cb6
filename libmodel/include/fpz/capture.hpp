// One update, written down so that it can be repeated elsewhere: `fpz-driver replay FILE` reads these files.
#pragma once

#include <filesystem>

#include "fpz/law/softening.hpp"
#include "fpz/options.hpp"
#include "fpz/parameters.hpp"
#include "fpz/state_fields.hpp"

namespace fpz {

/// Everything that a single update depends on.
template <int Dim>
struct Capture {
  Parameters parameters;
  Setting setting = Setting::plane_strain;
  Options options;
  State<double, Dim> begin;
  Tensor<double, Dim> strain_increment = Tensor<double, Dim>::Zero();
  Status status = Status::ok;  ///< what the update returned
};

/// The layout of a capture file, for the writer and for readers. C is Capture<Dim>, const or not. The archive offers
/// `archive(key, member)` for numbers, vectors and matrices (row by row), flags and words, and
/// `archive.object(key, f)`, which calls `f` with the archive of an object inside, and `archive.choice(key, word)` for
/// words that are left out where they are the default.
template <class Archive, class C>
void visit_capture(Archive& archive, C& c) {
  archive("setting", c.setting);
  archive.object("material", [&c](Archive& material) {
    for (const ParameterInfo<double>& p : parameter_table<double>) {
      if (p.of_material) material(p.name, c.parameters.*p.member);
    }
    visit_choices(c.parameters.choices, [&material](const char* key, auto& x) { material.choice(key, x); });
  });
  for (const ParameterInfo<double>& p : parameter_table<double>) {
    if (!p.of_material) archive(p.name, c.parameters.*p.member);
  }
  archive.object("integrator", [&o = c.options](Archive& integrator) { visit_options(o, integrator); });
  archive.object("begin", [&s = c.begin](Archive& begin) {
    visit_point(s, begin);
    if (s.cracked) visit_crack(s, begin);
  });
  archive("strain_increment", c.strain_increment);
  archive("status", c.status);
}

inline constexpr int capture_version = 1;  ///< the file's "fpz_capture"

/// Writes a capture as JSON (numbers with 17 digits, NaN and infinity as strings). The file appears under its name only
/// when it is complete. Returns false when it cannot be written.
template <int Dim>
[[nodiscard]] bool write_capture(const std::filesystem::path& file, const Capture<Dim>& capture);

}  // namespace fpz
