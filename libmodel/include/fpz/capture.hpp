// One update, written down so that it can be repeated elsewhere: `fpz-driver replay FILE` reads these files.
#pragma once

#include <filesystem>

#include "fpz/double_scale.hpp"

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

/// Writes a capture as JSON (numbers with 17 digits, NaN and infinity as strings). The file appears under its name only
/// when it is complete. Returns false when it cannot be written.
template <int Dim>
[[nodiscard]] bool write_capture(const std::filesystem::path& file, const Capture<Dim>& capture);

}  // namespace fpz
