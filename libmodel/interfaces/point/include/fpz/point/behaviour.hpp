// A material, ready to be used by an interface: made from a list of properties, checked once, and found again.
#pragma once

#include <span>
#include <string>

#include "fpz/material.hpp"
#include "fpz/point/properties.hpp"

namespace fpz::point {

struct Behaviour {
  Setting setting = Setting::plane_strain;
  Parameters parameters;
  Options options;
  Material<double> material;
  double snap_back_length = 0.0;  ///< largest H without snap-back in mode I, m
  std::string warnings;           ///< what is doubtful, one line each; empty as a rule
};

/// Makes a behaviour from a list of numbers (properties.hpp). `rve_length` (m) is H where the list has 0 or nothing,
/// such as the size of the element. Throws std::invalid_argument; its text names every property that is at fault by its
/// number, its name, its value and its constraint.
[[nodiscard]] Behaviour make_behaviour(Setting setting, std::span<const double> list, double rve_length = 0.0);

/// The same statement, checked, from parameters and options.
[[nodiscard]] Behaviour make_behaviour(Setting setting, const Statement& statement);

/// The behaviour of a list, made and checked when a thread first meets it; the last ones are kept, compared by their
/// bytes. Nothing is allocated when it is found. The reference is good until the thread's next call. Warnings of
/// a new one are printed (notice.hpp). Throws as make_behaviour() does.
[[nodiscard]] const Behaviour& behaviour_of(Setting setting, std::span<const double> list, double rve_length = 0.0);

}  // namespace fpz::point
