#include "admissible.hpp"

namespace fpz::calibration {

std::string why_inadmissible(Parameters p, Setting setting, bool with_length) {
  p.density = 1.0;
  if (!with_length) p.rve_length = 1.0;
  const Validation found = validate(p, setting);
  if (found.ok()) return {};
  std::string text = "these parameters break a constraint of the model: ";
  text += Validation{.errors = found.errors, .warnings = {}}.report();
  text.pop_back();  // the end of the last line
  return text;
}

}  // namespace fpz::calibration
