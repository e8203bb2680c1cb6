// What a step reports: fine, or which particle failed, when, and the likely cause.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "fpz/types.hpp"

namespace fpz::sph {

enum class Failure : std::uint8_t {
  none,
  constitutive,  ///< the library could not update a particle; see `status`
  not_finite,    ///< a velocity became infinite or NaN
  too_fast       ///< a particle is faster than sound: the run explodes
};

struct Outcome {
  Failure failure = Failure::none;
  Status status = Status::ok;  ///< of the constitutive update
  std::size_t particle = 0;    ///< index in the arrangement
  double time = 0.0;           ///< s
  double speed = 0.0;          ///< m/s, of that particle
  bool loose = false;          ///< its bonds were cut, so that few hold it

  [[nodiscard]] bool ok() const { return failure == Failure::none; }
  /// One sentence: what happened to which particle, when, why and what to change.
  [[nodiscard]] std::string message() const;
};

}  // namespace fpz::sph
