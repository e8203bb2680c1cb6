// The geometry of a notched specimen in a specification.
#pragma once

#include "data_set_reader.hpp"
#include "fpz/calibration/notched_specimen.hpp"

namespace fpz::calibration::detail {

/// The specimen that the member "geometry" of `object` describes; problems are recorded.
[[nodiscard]] NotchedSpecimen read_geometry(const SetContext& s, const Place& object, SpecimenShape shape);

/// How large a load of this specimen may be, by the stress that it means.
[[nodiscard]] Typical typical_load(const NotchedSpecimen& specimen);

}  // namespace fpz::calibration::detail
