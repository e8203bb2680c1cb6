// The pictures of the report.
#pragma once

#include <filesystem>

#include "studies.hpp"

namespace fpz::bench {

void draw_increment(const std::vector<PathStudy>& studies, const std::filesystem::path& folder);
void draw_time(const std::vector<PathStudy>& studies, const std::filesystem::path& folder);
void draw_tolerance(const std::vector<ToleranceRow>& rows, const std::filesystem::path& folder);
void draw_onset(const OnsetStudy& study, const std::filesystem::path& folder);
void draw_maps(const MapStudy& study, const std::filesystem::path& folder);
void draw_newton(const NewtonStudy& study, const std::filesystem::path& folder);
void draw_alternatives(const AlternativeStudy& study, const std::filesystem::path& folder);

}  // namespace fpz::bench
