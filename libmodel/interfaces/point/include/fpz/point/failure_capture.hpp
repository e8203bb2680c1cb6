// Failing updates, written down by themselves for `fpz-driver replay` when somebody has asked for it.
#pragma once

#include <string>

#include "fpz/point/behaviour.hpp"
#include "fpz/state.hpp"

namespace fpz::point {

/// Environment variable with the folder into which failing updates are written.
inline constexpr const char* capture_variable = "FPZ_CAPTURE";

/// Most captures that one process writes into its folder: a run that fails everywhere must not fill a disk.
inline constexpr int most_captures = 100;

/// The folder for captures of this process, made when it is first needed; it goes before the environment's. Empty: the
/// environment's again. Captures are counted anew.
void set_capture_folder(const std::string& folder);

/// Writes the update into the folder, if there is one, under a name that no other thread, process or machine takes:
/// fpz-<host>-<process>-<number>.json. Returns what a message should say about it: where the file is, or why there is
/// none; empty when nobody has asked.
template <int Dim>
[[nodiscard]] std::string capture_failure(const Behaviour& behaviour, const State<double, Dim>& begin,
                                          const Tensor<double, Dim>& strain_increment, Status status);

}  // namespace fpz::point
