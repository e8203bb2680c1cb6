#include "fpz/options.hpp"

namespace fpz {

std::string why_unfit(Method method, const MaterialChoices& choices) {
  if (method != Method::paper || choices.cohesive_zone == CohesiveZone::published) return {};
  return "paper integrates the published zone only: add \"cohesive_zone\": \"published\" to the material, or use "
         "accurate or implicit";
}

}  // namespace fpz
